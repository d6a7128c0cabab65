"""A scenario in several variants: what was varied, and how each of them scored."""

from __future__ import annotations

import math
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from ssrics_like.comparison.writing import SCORES
from ssrics_like.errors import ResultsError
from ssrics_like.results.counts import and_others
from ssrics_like.results.listing import Variant as Listed
from ssrics_like.results.listing import read_json, read_listing
from ssrics_like.results.manifest import MANIFEST, read_manifest, unfinished

FIGURES = (
    "recall",
    "low",
    "high",
    "chance",
    "clock",
    "corrected_recall",
    "precision",
    "marks_per_100_m",
    "duplicates",
    "consistency",
    "f",
)
"""The pooled figures of scores.json, in the order in which they are listed."""


@dataclass(frozen=True)
class Variant:
    """One variant of a scenario.

    Attributes
    ----------
    name : str
        Name of its results folder.
    title : str
        What it is; may be empty.
    factors : dict of str to str
        What was varied -> how it is here.
    settings : dict
        Key of the scenario -> value that makes the difference.
    runs : int
        How many there are.
    figures : dict of str to float
        `FIGURES`, pooled over the runs; NaN where there is none.
    shares, published : dict of str to float
        Location -> share of runs in which it was found, here and as published.
    unfinished : str
        How many of its runs are complete; empty if that is all of them.
    warnings : tuple of str
        Those of its runs.
    """

    name: str
    title: str
    factors: dict[str, str]
    settings: dict[str, Any]
    runs: int
    figures: dict[str, float]
    shares: dict[str, float]
    published: dict[str, float]
    unfinished: str = ""
    warnings: tuple[str, ...] = ()

    @property
    def distance(self) -> float:
        """Root mean square difference of the shares to the published ones; NaN without any."""
        both = [self.shares[key] - share for key, share in self.published.items()]
        return math.sqrt(sum(d * d for d in both) / len(both)) if both else math.nan

    @property
    def expected_distance(self) -> float:
        """Distance of runs that find each location with just the published probability.

        The square root of the mean of p (1 - p) / n: what the toss of n coins a location leaves.
        """
        if not self.published or self.runs == 0:
            return math.nan
        spread = [p * (1.0 - p) / self.runs for p in self.published.values()]
        return math.sqrt(sum(spread) / len(spread))


@dataclass(frozen=True)
class Variants:
    """A folder of variants.

    Attributes
    ----------
    folder : Path
        Where they are.
    title, description : str
        Of the scenario.
    done : tuple of Variant
        Those that have results, in the order of the file.
    missing : tuple of str
        Names of those that have none yet.
    published_in : str
        Where the published shares stand; may be empty.
    """

    folder: Path
    title: str
    description: str
    done: tuple[Variant, ...]
    missing: tuple[str, ...]
    published_in: str

    @property
    def factors(self) -> tuple[str, ...]:
        """Every factor, in the order in which they first appear."""
        return tuple(dict.fromkeys(name for variant in self.done for name in variant.factors))

    @property
    def warnings(self) -> list[str]:
        """Every warning of any run, once, with the variants whose runs have it."""
        of: dict[str, list[str]] = {}
        for variant in self.done:
            for text in dict.fromkeys(variant.warnings):
                of.setdefault(text, []).append(variant.name)
        return [f"{and_others(names)}: {text}" for text, names in of.items()]

    @property
    def unfinished(self) -> list[str]:
        """What is not complete yet, by variant."""
        found = [f"{v.name}: {v.unfinished}" for v in self.done if v.unfinished]
        if self.missing:
            have = "variant has" if len(self.missing) == 1 else "variants have"
            found.append(f"{len(self.missing)} {have} no results yet: {', '.join(self.missing)}")
        return found

    @property
    def nearest(self) -> Variant | None:
        """The variant whose shares come nearest to the published ones."""
        known = [variant for variant in self.done if not math.isnan(variant.distance)]
        return min(known, key=lambda variant: variant.distance, default=None)


def read_variants(folder: Path) -> Variants:
    """Read the variants of a scenario and their scores.

    Parameters
    ----------
    folder : Path
        A folder that ``ssrics run`` wrote for a scenario with variants.

    Raises
    ------
    ResultsError
        variants.json or a variant's scores.json is missing, damaged or newer than this program.
    """
    listing = read_listing(folder)
    done, missing, sources = [], [], []
    for listed in listing.variants:
        at = folder / listed.name
        if not (at / MANIFEST).is_file():
            missing.append(listed.name)
            continue
        manifest = read_manifest(at)
        scores = read_json(at / SCORES) if (at / SCORES).is_file() else {}
        try:
            done.append(_variant(listed, manifest, scores))
            sources.append(str(scores.get("published_in", "")))
        except (KeyError, TypeError, ValueError, AttributeError) as e:
            raise ResultsError(f"{at / SCORES}: is damaged: {e!r}") from None
    if not done:
        raise ResultsError(f"{folder}: no variant has results; there is nothing to report")
    return Variants(
        folder,
        listing.title,
        listing.description,
        tuple(done),
        tuple(missing),
        next(filter(None, sources), ""),
    )


def _variant(listed: Listed, manifest: dict[str, Any], scores: dict[str, Any]) -> Variant:
    """Join what is listed of a variant with its scores; none at all where nothing is labelled."""
    pooled = scores.get("pooled", {})
    shares, published = {}, {}
    for place in scores.get("locations", []):
        if place["share"] is not None:
            shares[str(place["location"])] = float(place["share"])
            if place["published"] is not None:
                published[str(place["location"])] = float(place["published"])
    return Variant(
        name=listed.name,
        title=listed.title,
        factors=listed.factors,
        settings=listed.set,
        runs=len(manifest["runs"]),
        figures={name: _number(pooled.get(name)) for name in FIGURES},
        shares=shares,
        published=published,
        unfinished=unfinished(manifest),
        warnings=tuple(str(text) for run in manifest["runs"] for text in run.get("warnings", ())),
    )


def _number(value: float | None) -> float:
    return math.nan if value is None else float(value)
