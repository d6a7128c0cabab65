"""Variants: one scenario with some values changed, side by side."""

from __future__ import annotations

import itertools
import math
from pathlib import Path
from typing import Any

from ssrics_like import settings
from ssrics_like.errors import ResultsError, SettingsError
from ssrics_like.results.listing import Listing, Variant, write_listing
from ssrics_like.results.manifest import MANIFEST
from ssrics_like.scenarios.pieces import Where, problems_of, resolve_with
from ssrics_like.scenarios.problems import Problems
from ssrics_like.scenarios.resolving import Resolved
from ssrics_like.scenarios.runner import Progress, Say, run_side_by_side
from ssrics_like.scenarios.schema import NAME, Scenario

VARIANTS_MAX = 1000
NO_FOLDER = "cannot name a folder; expected letters, digits, dots, dashes and spaces"


def variants_of(scenario: Scenario, where: Where | None = None) -> list[Variant]:
    """Return every combination of the scenario's factors, then its single variants.

    Parameters
    ----------
    scenario : Scenario
        As read.
    where : callable, optional
        Gives the place of a key in the scenario's file, for messages.

    Raises
    ------
    SettingsError
        With one line for each name that cannot name a folder or is there twice; or there are too
        many.
    """
    found: list[tuple[Variant, settings.Key]] = []
    names = list(scenario.factors)
    combinations = itertools.product(*scenario.factors.values()) if names else ()
    for levels in itertools.islice(combinations, VARIANTS_MAX + 1):
        chosen = dict(zip(names, levels, strict=True))
        values: dict[str, Any] = {}
        for factor, level in chosen.items():
            values |= scenario.factors[factor][level]
        folder = "_".join(level.replace(" ", "-") for level in levels)
        variant = Variant(folder, ", ".join(levels), chosen, values)
        found.append((variant, ("factors", names[-1], levels[-1])))
    found += [
        (Variant(v.name, v.title or v.name, {}, v.set), ("variants", i, "name"))
        for i, v in enumerate(scenario.variants)
    ]
    if len(found) > VARIANTS_MAX:
        count = math.prod(map(len, scenario.factors.values())) if names else 0
        count += len(scenario.variants)
        raise SettingsError(f"{count} variants are more than {VARIANTS_MAX}")
    problems: list[tuple[settings.Key, str]] = [
        (("factors", factor, level), f"factor '{factor}', level '{level}': {NO_FOLDER}")
        for factor, levels in scenario.factors.items()
        for level in levels
        if not NAME.fullmatch(level.replace(" ", "-"))
    ]
    seen: set[str] = set()
    for variant, key in found:
        if variant.name in seen:
            problems.append((key, f"variants: two are called '{variant.name}'"))
        seen.add(variant.name)
    if problems:
        said = [f"{where(key)}: {text}" if where else text for key, text in problems]
        raise SettingsError("\n".join(said))
    return [variant for variant, _ in found]


def resolve_variants(
    scenario: Scenario,
    base: Path,
    overrides: list[str] | None = None,
    *,
    where: Where | None = None,
) -> list[tuple[Variant, Resolved]]:
    """Resolve each variant of a scenario.

    Parameters and errors as of `resolving.resolve`; what is wrong with levels and variants is
    said of all of them at once.
    """
    found: list[tuple[Variant, Resolved]] = []
    variants: list[Variant] = []
    problems, together = Problems(), Problems()
    with problems.gathered():
        variants = variants_of(scenario, where)
    for variant in variants:
        with together.gathered(f"variant '{variant.name}': "):
            title = f"{scenario.title}: {variant.title}"
            each = resolve_with(scenario, variant.set, title, base, overrides, where)
            found.append((variant, each))
    if problems.lines or together.lines:
        problems.lines += problems_of(scenario, base, overrides, where)
        # Where each piece is right by itself, some do not go together.
        problems.lines = settings.in_order(problems.lines or together.lines)
        problems.complain()
    return found


def run_variants(
    scenario: Scenario,
    resolved: list[tuple[Variant, Resolved]],
    out: Path,
    *,
    resume: bool = False,
    jobs: int = 1,
    progress: Progress = lambda _task, _share: None,
    say: Say = lambda _: None,
) -> list[dict[str, Any]]:
    """Carry out all variants, each into a results folder below `out`.

    ``variants.json`` says what they are. Parameters, result and errors as
    `runner.run_side_by_side`.
    """
    pairs = [(each, out / variant.name) for variant, each in resolved]
    if (out / MANIFEST).exists():
        raise ResultsError(
            f"{out}: holds the results of a single scenario; name another folder for variants"
        )
    out.mkdir(parents=True, exist_ok=True)
    listed = tuple(variant for variant, _ in resolved)
    write_listing(out, Listing(scenario.title, scenario.description, listed))
    return run_side_by_side(pairs, resume=resume, jobs=jobs, progress=progress, say=say)
