"""Where a run's observations come from: a log, or a drive through a building."""

from __future__ import annotations

import math
from collections.abc import Iterator
from typing import Any, Protocol

import numpy as np

from ssrics_like.perception.observation import Observation, Pose
from ssrics_like.scenarios.place import Place
from ssrics_like.scenarios.resolving import Resolved
from ssrics_like.scenarios.world_settings import LegSettings
from ssrics_like.sources import LogSource, open_log
from ssrics_like.world.buildings.furniture import furnish
from ssrics_like.world.disturbances import Crowd, Disturbances, SlipSettings
from ssrics_like.world.exploration import Exploration
from ssrics_like.world.grid import GridMap
from ssrics_like.world.leading import Guide, Lead
from ssrics_like.world.navigation import Leg
from ssrics_like.world.routes import Route, Wait
from ssrics_like.world.simulation import Simulation, mapped_cell_m, mapped_solid

SEEN_ENOUGH = 0.99
"""A drive that explores and sees less of the reachable space than this is warned of."""


class Feed(Protocol):
    """A run's observations, to be iterated over once, and what is known of them then.

    Attributes
    ----------
    frame : str
        Frame of the poses.
    outline : dict or None
        What to draw of the building besides its map; None if it has no map.
    """

    frame: str
    outline: dict[str, Any] | None

    def __iter__(self) -> Iterator[Observation]:
        """Return the observations in order of time."""

    @property
    def progress(self) -> float:
        """Share that is done, a guess where it cannot be known."""

    def be_led(self, guide: Guide) -> None:
        """Let somebody lead where the journey says so; before the first observation."""

    def entry(self) -> dict[str, Any]:
        """Return what the manifest says of the run, besides what the recorder has seen."""

    def warnings(self) -> list[str]:
        """Return what the user should know."""


class LogFeed:
    """The observations of a log.

    Parameters
    ----------
    source : LogSource
        The log.
    """

    def __init__(self, source: LogSource) -> None:
        self.frame = source.frame
        self.outline: dict[str, Any] | None = None
        self._source = source

    def __iter__(self) -> Iterator[Observation]:
        return iter(self._source)

    @property
    def progress(self) -> float:
        """Share of the file that has been read."""
        return self._source.progress

    def be_led(self, guide: Guide) -> None:
        """Go on: a log cannot be led."""

    def entry(self) -> dict[str, Any]:
        """Say why the run ended."""
        return {"ended": "end of log"}

    def warnings(self) -> list[str]:
        """Return the log's quirks."""
        return self._source.report.warnings()


class DriveFeed:
    """The observations of a drive through a building.

    Parameters
    ----------
    place : Place
        Building, robot, and what happens.
    seed : int
        The scenario's seed.
    run : int
        Number of the run: with the seed it decides all randomness of the drive.
    """

    frame = "odometry"

    def __init__(self, place: Place, seed: int, run: int) -> None:
        world = place.settings
        drawn, put = np.random.SeedSequence((seed, run), spawn_key=(1,)).spawn(2)
        grid = place.building.grid
        if world.furniture is not None and world.furniture.pieces:
            if not world.furniture.moved:
                put = np.random.SeedSequence((seed,), spawn_key=(2,))
            rng = np.random.default_rng(put)
            grid = furnish(
                grid, rng, world.furniture.pieces, _kept_clear(place), place.robot.radius_m
            )
        self.outline: dict[str, Any] | None = _added(place, grid)
        self._exploring = any(leg.explore for leg in world.journey)
        self.simulation = Simulation(
            grid,
            place.robot,
            place.start,
            [_leg(leg, place.building.grid) for leg in world.journey],
            drawn,
            Disturbances(
                doors=place.doors,
                kidnaps=place.kidnaps,
                crowd=Crowd(**world.people.model_dump()) if world.people else Crowd(),
                slip=SlipSettings(**world.slip.model_dump()) if world.slip else SlipSettings(),
            ),
            time_limit_s=world.time_limit_s,
        )

    def __iter__(self) -> Iterator[Observation]:
        return iter(self.simulation)

    @property
    def progress(self) -> float:
        """Share of the building seen, while it is explored; else of the time limit."""
        if self._exploring:
            return min(self.simulation.progress, 0.99)
        return self.simulation.t_s / self.simulation.time_limit_s

    def be_led(self, guide: Guide) -> None:
        """Set who leads on the legs ``goto``."""
        for leg in self.simulation.navigator.legs:
            if isinstance(leg, Lead):
                leg.guide = guide

    def entry(self) -> dict[str, Any]:
        """Say why the run ended, what was seen and how far the robot drove."""
        drive = self.simulation
        return {
            "ended": drive.ended,
            "coverage": drive.coverage,
            "path_length_m": drive.way_m,
            "bumps": drive.bumps,
        }

    def warnings(self) -> list[str]:
        """Return what did not go as planned."""
        drive = self.simulation
        found = list(drive.navigator.notes)
        if drive.outstanding:
            found.append(
                f"a run ended before {drive.outstanding} of the doors and kidnaps that the "
                "scenario has in store"
            )
        if drive.ended.startswith("time limit"):
            found.append(f"a run was ended by its {drive.ended}; world.time_limit_s raises it")
        elif self._exploring and drive.coverage < SEEN_ENOUGH:
            found.append(
                f"a run saw only {100 * drive.coverage:.1f} % of the free space that the robot "
                "could have reached at its start"
            )
        return found


def make_feed(resolved: Resolved, run: int) -> Feed:
    """Return the observations of a run of a scenario.

    Raises
    ------
    SourceError
        The log cannot be read.
    """
    if resolved.place is not None:
        return DriveFeed(resolved.place, resolved.scenario.seed, run)
    return LogFeed(open_source(resolved))


def open_source(resolved: Resolved) -> LogSource:
    """Open the log of a scenario.

    Raises
    ------
    SourceError
        It cannot be read.
    """
    said = resolved.scenario.source
    assert said is not None
    assert resolved.log is not None
    return open_log(
        resolved.log,
        format=said.format,
        strict=said.strict,
        fallback_rate_hz=said.fallback_rate_hz,
        frame=said.frame,
    )


def _leg(leg: LegSettings, plan: GridMap) -> Leg:
    if leg.wait_s is not None:
        return Wait(leg.wait_s)
    if leg.goto is not None:
        return Lead(leg.goto)
    if leg.waypoints is None:
        return Exploration()
    poses = [
        plan.pose_in_grid(Pose(w[0], w[1], w[2] if len(w) > 2 else 0.0))  # noqa: PLR2004
        for w in leg.waypoints
    ]
    waypoints = [
        (p.x_m, p.y_m, p.theta_rad) if len(w) > 2 else (p.x_m, p.y_m)  # noqa: PLR2004
        for p, w in zip(poses, leg.waypoints, strict=True)
    ]
    names = [f"waypoint {i} [{w[0]:g}, {w[1]:g}]" for i, w in enumerate(leg.waypoints, 1)]
    return Route(waypoints, names, leg.repeat, mapped_solid(plan, mapped_cell_m(plan)))


def _added(place: Place, grid: GridMap) -> dict[str, Any]:
    """Return the cells of furniture and closed doors that the map does not show, in its frame."""
    added = grid.solid & ~place.building.grid.solid
    for door in place.doors:
        added |= door.leaf
    # Where the map is turned, cells do not cover cells: several points of each leave no gaps.
    within = np.array([0.5] if math.remainder(grid.origin.theta_rad, math.pi / 2) == 0.0
                      else [0.1, 0.5, 0.9])  # fmt: skip
    offsets = np.array([(dx, dy) for dx in within for dy in within])
    places = (np.argwhere(added)[:, np.newaxis, ::-1] + offsets).reshape(-1, 2) * grid.cell_m
    cells = np.unique(np.floor(grid.points_in_map(places) / grid.cell_m).astype(np.int64), axis=0)
    return {"cell_m": grid.cell_m, "x": cells[:, 0].tolist(), "y": cells[:, 1].tolist()}


def _kept_clear(place: Place) -> list[list[float]]:
    """Return the places that furniture must leave free; the robot's start comes first."""
    world, grid = place.settings, place.building.grid
    named = [w[:2] for leg in world.journey for w in leg.waypoints or []]
    named += [door.at for door in world.doors if door.at is not None]
    named += [[location.x_m, location.y_m] for location in place.building.locations]
    poses = [place.start, *(kidnap.to for kidnap in place.kidnaps)]
    clear = [[pose.x_m, pose.y_m] for pose in poses]
    return clear + (grid.points_in_grid(named).tolist() if named else [])
