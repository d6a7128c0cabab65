"""Variants: one scenario with some values changed, side by side."""

from __future__ import annotations

import itertools
from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ssrics_like import settings
from ssrics_like.errors import ResultsError, SettingsError, choices, nearest
from ssrics_like.results.files import json_text, write_atomically
from ssrics_like.results.folder import MANIFEST
from ssrics_like.scenarios.resolving import Resolved, resolve
from ssrics_like.scenarios.runner import Progress, run_side_by_side
from ssrics_like.scenarios.schema import MODULES, NAME, Scenario, make_scenario

FORMAT, VERSION = "ssrics-variants", 1
VARIANTS = "variants.json"
VARIANTS_MAX = 1000


@dataclass(frozen=True)
class Variant:
    """A scenario with some values changed.

    Attributes
    ----------
    name, title : str
        Its folder, and what it is.
    factors : dict
        Name of a factor -> the level that it has here.
    set : dict
        What is changed.
    """

    name: str
    title: str
    factors: dict[str, str]
    set: dict[str, Any]


def variants_of(scenario: Scenario) -> list[Variant]:
    """Return every combination of the scenario's factors, then its single variants.

    Raises
    ------
    SettingsError
        Two have the same name, or there are too many.
    """
    found: list[Variant] = []
    if scenario.factors:
        names = list(scenario.factors)
        for levels in itertools.product(*scenario.factors.values()):
            chosen = dict(zip(names, levels, strict=True))
            values: dict[str, Any] = {}
            for factor, level in chosen.items():
                values |= scenario.factors[factor][level]
            folder = "_".join(level.replace(" ", "-") for level in levels)
            found.append(Variant(folder, ", ".join(levels), chosen, values))
    found += [Variant(v.name, v.title or v.name, {}, v.set) for v in scenario.variants]
    if len(found) > VARIANTS_MAX:
        raise SettingsError(f"{len(found)} variants are more than {VARIANTS_MAX}")
    seen: set[str] = set()
    for variant in found:
        if not NAME.fullmatch(variant.name):
            raise SettingsError(
                f"factors: '{variant.name}' cannot name a folder; expected levels of letters, "
                "digits, dots, dashes and spaces"
            )
        if variant.name in seen:
            raise SettingsError(f"variants: two are called '{variant.name}'")
        seen.add(variant.name)
    return found


def resolve_variants(
    scenario: Scenario,
    base: Path,
    overrides: list[str] | None = None,
    *,
    where: Callable[[settings.Key], str] | None = None,
) -> list[tuple[Variant, Resolved]]:
    """Resolve each variant of a scenario; parameters and errors as `resolving.resolve`."""
    found = []
    for variant in variants_of(scenario):
        modules = {key: value for key, value in variant.set.items() if "." not in key}
        unknown = [key for key in modules if key not in MODULES]
        if unknown:
            raise SettingsError(
                f"variant '{variant.name}' sets unknown key '{unknown[0]}'"
                f"{nearest(unknown[0], MODULES)}; known: {choices(MODULES)} and single values "
                "as memory.decay or world.people.count"
            )
        own = {k: v for k, v in variant.set.items() if k.startswith(("world.", "source."))}
        single = {k: v for k, v in variant.set.items() if k not in modules and k not in own}
        data = scenario.model_dump()
        data |= {**modules, "set": {**scenario.set, **single}, "factors": {}, "variants": []}
        data["title"] = f"{scenario.title}: {variant.title}"
        try:
            changed = settings.override(make_scenario(data), own, "")
            found.append((variant, resolve(changed, base, overrides, where=where)))
        except SettingsError as e:
            said = "\n".join(
                f"variant '{variant.name}': {line.removeprefix('--set ')}"
                for line in str(e).splitlines()
            )
            raise SettingsError(said) from None
    return found


def run_variants(
    scenario: Scenario,
    resolved: list[tuple[Variant, Resolved]],
    out: Path,
    *,
    resume: bool = False,
    jobs: int = 1,
    progress: Progress = lambda _task, _share: None,
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
    data = {
        "format": FORMAT,
        "version": VERSION,
        "title": scenario.title,
        "description": scenario.description,
        "variants": [
            {"name": v.name, "title": v.title, "factors": v.factors, "set": v.set}
            for v, _ in resolved
        ],
    }
    out.mkdir(parents=True, exist_ok=True)
    write_atomically(out / VARIANTS, json_text(data))
    return run_side_by_side(pairs, resume=resume, jobs=jobs, progress=progress)
