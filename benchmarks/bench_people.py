"""How often the 95 % intervals of a comparison of people hold what is known to be true.

    python benchmarks/bench_people.py [--studies N] [--people N] [--runs N]
                                      [--resamples N] [--seed N]

Participants and a robot mark places by signal detection along a straight route, a third of which
are targets. Of each study the intervals of d', kappa and the human ceiling are held against the
truth. What people share about a place makes the probability that each of them marks it a closed
form: from these probabilities follow kappa, what most of any number of such people would mark, and
d' against that, of people and of the robot. The ceiling is the mean of many groups of as many
people at the same places. "out" counts studies without an interval.
"""

from __future__ import annotations

import argparse
from collections.abc import Iterator
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.stats import norm

from ssrics_like.comparison.proportions import wilson
from ssrics_like.comparison.way import Way
from ssrics_like.people import Marker, Participants, Settings, compare_people
from ssrics_like.people.consensus import consensus_of_others
from ssrics_like.people.figures import Figure, Model
from ssrics_like.people.hits import paired_hits
from ssrics_like.people.markers import PEOPLE
from ssrics_like.people.settings import CONSENSUS
from ssrics_like.people.simulated import decisions, shared_evidence
from ssrics_like.world.locations import Location

PLACES, TARGET_EVERY, STEP_M, POSE_M = 99, 3, 2.0, 0.1
RADIUS_M, NOISE_M = 0.9, 0.2
GROUPS = 200
ROBOT = Participants(1, 2.5, 1.25, NOISE_M, 0.0)
CONDITIONS = (
    ("agree, nothing shared", 3.0, 1.5, 0.0),
    ("agree, .3 shared", 3.0, 1.5, 0.3),
    ("waver, nothing shared", 2.0, 1.2, 0.0),
    ("waver, .3 shared", 2.0, 1.2, 0.3),
)
"""Name, sensitivity, criterion, and share of the evidence that all have in common."""


@dataclass(frozen=True)
class Outcome:
    """A figure with its interval, and the truth."""

    measure: str
    figure: Figure
    truth: float

    @property
    def told(self) -> bool:
        return bool(np.isfinite(self.figure.interval).all())

    @property
    def held(self) -> bool:
        low, high = self.figure.interval
        return low <= self.truth <= high


def places() -> tuple[NDArray[np.float64], NDArray[np.bool_]]:
    """Return places along a straight line, and which are targets."""
    x = STEP_M * np.arange(PLACES)
    return np.column_stack([x, np.zeros(PLACES)]), np.arange(PLACES) % TARGET_EVERY == 1


def study(
    who: Participants, runs: int, settings: Settings, generator: np.random.Generator
) -> Iterator[Outcome]:
    """Make and compare one study."""
    at, target = places()
    common = shared_evidence(PLACES, generator)
    people = markers(who, PEOPLE, at, decisions(who, target, common, generator), generator)
    robot = Participants(
        runs, ROBOT.sensitivity, ROBOT.criterion, ROBOT.noise_m, ROBOT.shared
    )  # fmt: skip
    marked = decisions(robot, target, np.zeros(PLACES), generator)
    x = np.arange(at[0, 0], at[-1, 0] + POSE_M / 2, POSE_M)
    way = Way.through(np.column_stack([x, np.zeros(len(x))]))
    model = Model("robot", markers(robot, "robot", at, marked, generator), (way,) * runs)
    locations = [Location(f"T{i}", *at[i].tolist()) for i in np.flatnonzero(target)]
    made = compare_people(people, [model], locations, settings)
    assert len(made.units) == PLACES
    chances = probabilities(who, target, common)
    agreed = chances > CONSENSUS
    robots = probabilities(ROBOT, target, np.zeros(PLACES))
    of_people, of_robot = made.figures[PEOPLE], made.figures["robot"]
    yield Outcome("d', people", of_people["d_prime_others"], d_prime(chances, agreed))
    yield Outcome("kappa, people", of_people["kappa_people"], kappa(chances))
    yield Outcome("Fleiss' kappa", of_people["fleiss"], kappa(chances))
    yield Outcome("ceiling, F", of_people["f_others"], ceiling(who, target, common, generator))
    yield Outcome("d', robot", of_robot["d_prime"], d_prime(robots, agreed))


def markers(
    who: Participants,
    group: str,
    at: NDArray[np.float64],
    marked: NDArray[np.bool_],
    generator: np.random.Generator,
) -> tuple[Marker, ...]:
    """Return who marked what, where the marks fell."""
    found = []
    for number, row in enumerate(marked):
        xy = at[row] + who.noise_m * generator.standard_normal((int(row.sum()), 2))
        found.append(
            Marker(f"{group} {number}", group, xy, np.full(len(xy), np.nan), ("",) * len(xy))
        )
    return tuple(found)


def probabilities(
    who: Participants, target: NDArray[np.bool_], common: NDArray[np.float64]
) -> NDArray[np.float64]:
    """Return how probable it is that a person marks each place, given what is shared about it."""
    above = who.sensitivity * target + np.sqrt(who.shared) * common - who.criterion
    chances: NDArray[np.float64] = norm.cdf(above / np.sqrt(1.0 - who.shared))
    return chances


def d_prime(chances: NDArray[np.float64], agreed: NDArray[np.bool_]) -> float:
    """Return d' against what is agreed."""
    return float(norm.ppf(chances[agreed].mean()) - norm.ppf(chances[~agreed].mean()))


def kappa(chances: NDArray[np.float64]) -> float:
    """Return kappa of two people, who agree about a place with probability p^2 + (1 - p)^2."""
    agree, mean = (chances**2 + (1.0 - chances) ** 2).mean(), chances.mean()
    expected = mean**2 + (1.0 - mean) ** 2
    return float((agree - expected) / (1.0 - expected))


def ceiling(
    who: Participants,
    target: NDArray[np.bool_],
    common: NDArray[np.float64],
    generator: np.random.Generator,
) -> float:
    """Return the mean F of a person against the others' consensus, over many groups of people."""
    values = []
    for _ in range(GROUPS):
        marked = decisions(who, target, common, generator)
        values.append(np.nanmean(paired_hits(marked, consensus_of_others(marked)).f))
    return float(np.mean(values))


def main() -> None:
    parser = argparse.ArgumentParser()
    parser.add_argument("--studies", type=int, default=200)
    parser.add_argument("--people", type=int, default=12)
    parser.add_argument("--runs", type=int, default=14)
    parser.add_argument("--resamples", type=int, default=1000)
    parser.add_argument("--seed", type=int, default=6)
    options = parser.parse_args()
    print(f"{options.studies} studies of {options.people} people and {options.runs} runs")
    print()
    print("| people | measure | truth | found | holds the truth | 95 % interval of that | out |")
    print("|---|---|---|---|---|---|---|")
    for number, (name, sensitivity, criterion, shared) in enumerate(CONDITIONS):
        generator = np.random.default_rng([options.seed, number])
        who = Participants(options.people, sensitivity, criterion, NOISE_M, shared)
        outcomes: dict[str, list[Outcome]] = {}
        for k in range(options.studies):
            settings = Settings(RADIUS_M, STEP_M, seed=k, resamples=options.resamples)
            for one in study(who, options.runs, settings, generator):
                outcomes.setdefault(one.measure, []).append(one)
        for measure, made in outcomes.items():
            told = [one for one in made if one.told]
            held = sum(one.held for one in told)
            low, high = wilson(held, len(told))
            truth, found = (np.mean([v for v in values if np.isfinite(v)]) for values in (
                [one.truth for one in made], [one.figure.value for one in made]))  # fmt: skip
            print(
                f"| {name} | {measure} | {truth:.3f} | {found:.3f} "
                f"| {100 * held / max(len(told), 1):.1f} % | {100 * low:.0f}–{100 * high:.0f} % "
                f"| {len(made) - len(told)} |",
                flush=True,
            )


if __name__ == "__main__":
    main()
