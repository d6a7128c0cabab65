"""One drive of a course: its observations, and the truth that marks are compared with."""

from __future__ import annotations

from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.bench.conditions import NOMINAL, Condition
from ssrics_like.bench.plans import load_plan
from ssrics_like.comparison import Passages, Way, load_truth, passages_through, thresholds
from ssrics_like.comparison.scores import DESIGNATED
from ssrics_like.errors import ResultsError
from ssrics_like.perception.observation import Pose
from ssrics_like.sources import open_log
from ssrics_like.training.false_gaps import false_gaps
from ssrics_like.world.buildings.generator import generate
from ssrics_like.world.buildings.plan import build
from ssrics_like.world.disturbances import Crowd, Disturbances
from ssrics_like.world.exploration import Exploration
from ssrics_like.world.reachable import roomiest, standing
from ssrics_like.world.simulation import Simulation

if TYPE_CHECKING:
    from collections.abc import Sequence

    from numpy.typing import NDArray

    from ssrics_like.perception.observation import Observation
    from ssrics_like.world.disturbances import DoorChange, Kidnap
    from ssrics_like.world.grid import GridMap
    from ssrics_like.world.locations import Location
    from ssrics_like.world.navigation import Leg
    from ssrics_like.world.robot import RobotProfile

TESTING, TUNING, TRAINING = 0, 1, 2
"""Part of every seed, so that no building serves two purposes."""
LIMIT_S = 7200.0


@dataclass(frozen=True)
class Simulated:
    """A drive through a generated building.

    Attributes
    ----------
    condition : Condition
        What it is like.
    seed : int
        Which building, and all randomness of the drive.
    purpose : int
        What it serves.
    visit : int
        Which drive through that building; from the second on it begins at a place drawn at random.
    back : bool
        It begins where the first one began.
    """

    condition: Condition
    seed: int
    purpose: int = TESTING
    visit: int = 0
    back: bool = False


@dataclass(frozen=True)
class OnPlan:
    """A drive through a floor plan, from a place drawn at random; `seed` says which.

    The laser, robot and odometry are those of `condition`; the building is the plan's. It may begin
    where another drive, of the seed `begun`, does.
    """

    folder: Path
    seed: int
    condition: Condition = NOMINAL
    begun: int | None = None


@dataclass(frozen=True)
class OfLog:
    """A log with its labels."""

    log: Path
    truth: Path
    seed: int = 0


Spec = Simulated | OnPlan | OfLog
"""What a drive is made of; equal ones are the same drive."""


@dataclass(frozen=True, eq=False)
class BenchDrive:
    """A drive, ready for any designator.

    Attributes
    ----------
    observations : tuple of Observation
        In order.
    frame : str
        Of their poses.
    way : Way
        Where the laser really was, a pose for each observation.
    locations : tuple of Location
        Every labelled place, in the frame of the way.
    designated : ndarray of bool, shape (locations,)
        Which of them should be found.
    passages : Passages
        When the robot went through them.
    """

    observations: tuple[Observation, ...]
    frame: str
    way: Way
    locations: tuple[Location, ...]
    designated: NDArray[np.bool_]
    passages: Passages


def make_drive(spec: Spec) -> BenchDrive:
    """Simulate a drive, or read its log; the spec alone decides about it.

    Raises
    ------
    SourceError, MapError, ResultsError
        A log, a plan or labels cannot be read, or do not belong together.
    """
    if isinstance(spec, OfLog):
        return _of_log(spec)
    return _driven(stage(spec))


def _of_log(spec: OfLog) -> BenchDrive:
    source, truth = open_log(spec.log), load_truth(spec.truth)
    observations = tuple(source)
    if len(observations) != len(truth.way.xy_m):
        raise ResultsError(
            f"{spec.log}: has {len(observations)} scans, but {spec.truth} labels "
            f"{len(truth.way.xy_m)}: the labels are of another log"
        )
    return BenchDrive(
        observations, source.frame, truth.way, truth.locations, truth.designated, truth.passages
    )


@dataclass(frozen=True, eq=False)
class Stage:
    """Where a simulated drive happens, before anything moves.

    Attributes
    ----------
    grid : GridMap
        The building.
    robot : RobotProfile
        Who drives.
    start : Pose
        Where, grid frame.
    seed : numpy.random.SeedSequence
        Of the drive's randomness.
    locations : tuple of Location
        Labelled places, frame of the map.
    lines_m : ndarray, shape (locations, 2, 2)
        Both ends of the line across each.
    people : int
        How many walk about.
    """

    grid: GridMap
    robot: RobotProfile
    start: Pose
    seed: np.random.SeedSequence
    locations: tuple[Location, ...]
    lines_m: NDArray[np.float64]
    people: int = 0

    def simulation(
        self, legs: Sequence[Leg], *, doors: Sequence[DoorChange] = (),
        kidnaps: Sequence[Kidnap] = (),
    ) -> Simulation:  # fmt: skip
        """Return a drive on it; every one has the same randomness."""
        happenings = Disturbances(tuple(doors), tuple(kidnaps), Crowd(self.people))
        seed = np.random.SeedSequence(self.seed.entropy, spawn_key=self.seed.spawn_key)
        return Simulation(
            self.grid, self.robot, self.start, legs, seed, happenings, time_limit_s=LIMIT_S
        )


def stage(spec: Simulated | OnPlan) -> Stage:
    """Set up a simulated drive; the spec alone decides about it.

    Raises
    ------
    MapError
        A plan cannot be read.
    """
    return _plan_stage(spec) if isinstance(spec, OnPlan) else _generated_stage(spec)


def _plan_stage(spec: OnPlan) -> Stage:
    plan, robot = load_plan(spec.folder), spec.condition.robot()
    placing, driving = np.random.SeedSequence((TESTING, spec.seed)).spawn(2)
    if spec.begun is not None:
        placing = np.random.SeedSequence((TESTING, spec.begun)).spawn(1)[0]
    start = _drawn_start(plan.grid, robot.radius_m, np.random.default_rng(placing))
    return Stage(plan.grid, robot, start, driving, plan.locations, plan.lines_m)


def _generated_stage(spec: Simulated) -> Stage:
    condition, robot = spec.condition, spec.condition.robot()
    drawing, cluttering, driving = np.random.SeedSequence((spec.purpose, spec.seed)).spawn(3)
    building = build(generate(np.random.default_rng(drawing), condition.building()))
    start = roomiest(building.grid)
    lines_m = thresholds(building.grid, building.locations)
    grid: GridMap = building.grid
    if condition.false_gaps:
        labelled = grid.points_in_grid([(place.x_m, place.y_m) for place in building.locations])
        grid = false_gaps(
            grid, labelled, condition.false_gaps, start, robot.radius_m,
            np.random.default_rng(cluttering),
        )  # fmt: skip
    if spec.visit:
        placing, driving = driving.spawn(spec.visit + 1)[-1].spawn(2)
        if not spec.back:
            start = _drawn_start(grid, robot.radius_m, np.random.default_rng(placing))
    return Stage(grid, robot, start, driving, building.locations, lines_m, condition.people)


def _drawn_start(grid: GridMap, radius_m: float, rng: np.random.Generator) -> Pose:
    """Draw a place where the robot can stand, and a heading; the roomiest if it fits nowhere."""
    middle = roomiest(grid)
    places = np.argwhere(standing(grid, middle.x_m, middle.y_m, 1.2 * radius_m))
    if not len(places):
        return middle
    row, column = places[rng.integers(len(places))].tolist()
    return Pose((column + 0.5) * grid.cell_m, (row + 0.5) * grid.cell_m, float(rng.uniform(-3, 3)))


def _driven(there: Stage) -> BenchDrive:
    observations = tuple(there.simulation([Exploration()]))
    truths = [observation.true_pose for observation in observations]
    way = Way.through([(pose.x_m, pose.y_m) for pose in truths if pose is not None])
    designated = np.array([place.kind == DESIGNATED for place in there.locations], bool)
    return BenchDrive(
        observations, "odometry", way, there.locations, designated,
        passages_through(way, there.lines_m),
    )  # fmt: skip
