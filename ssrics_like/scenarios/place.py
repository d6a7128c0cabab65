"""The world of a scenario, read and checked: building, robot, and all that happens there."""

from __future__ import annotations

import hashlib
from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace
from pathlib import Path
from typing import Any

import numpy as np

from ssrics_like.errors import MapError, SettingsError
from ssrics_like.maps import load_building, load_locations
from ssrics_like.perception.observation import Pose
from ssrics_like.scenarios.problems import unknown_location
from ssrics_like.scenarios.world_settings import WorldSettings
from ssrics_like.settings import Key
from ssrics_like.world.building import Building
from ssrics_like.world.buildings.generator import generate
from ssrics_like.world.buildings.plan import build
from ssrics_like.world.disturbances import DoorChange, Kidnap
from ssrics_like.world.doors import door_leaf
from ssrics_like.world.reachable import clearance, roomiest, standing
from ssrics_like.world.robot import RobotProfile


@dataclass(frozen=True, eq=False)
class Place:
    """Where a scenario's runs happen.

    Attributes
    ----------
    name : str
        File name of the map, or a word for a generated building.
    sha256 : str
        Of the floor plan: its cells, their size and origin, and the labelled places.
    building : Building
        As the map shows it.
    robot : RobotProfile
        Who drives.
    start : Pose
        Where, grid frame.
    settings : WorldSettings
        The rest of what the scenario says.
    doors : tuple of DoorChange
        When which cells are filled or cleared.
    kidnaps : tuple of Kidnap
        When the robot is carried where.
    """

    name: str
    sha256: str
    building: Building
    robot: RobotProfile
    start: Pose
    settings: WorldSettings
    doors: tuple[DoorChange, ...]
    kidnaps: tuple[Kidnap, ...]

    def as_data(self) -> dict[str, Any]:
        """Return everything that decides the drives, as plain values for the manifest."""
        start = self.building.grid.pose_in_map(self.start)
        journey = [leg.model_dump(exclude_none=True) for leg in self.settings.journey]
        single = ("explore", "waypoints", "goto", "repeat", "legs", "robot", "start", "map")
        return {
            "map": self.name,
            "robot": {"name": self.settings.robot, **self.robot.model_dump()},
            "start": [start.x_m, start.y_m, start.theta_rad],
            "legs": journey,
            **self.settings.model_dump(exclude=set(single)),
        }


def place_of(
    world: WorldSettings,
    robot: RobotProfile,
    start: Mapping[str, Path],
    where: Callable[[Key], str],
) -> Place:
    """Read a world's map and check every place that the scenario names on it.

    Parameters
    ----------
    world : WorldSettings
        What the scenario says.
    robot : RobotProfile
        Its robot, read.
    start : mapping
        Folder that the paths ``world.map`` and ``world.locations`` start from.
    where : callable
        Gives the place of a key in the scenario's file, ``--set``, or nothing.

    Raises
    ------
    MapError
        The map or the table of locations is wrong.
    SettingsError
        With one line for each place that the robot cannot be at, or door that is none.
    """
    building, name = _building(world, start)
    grid = building.grid
    problems: list[str] = []

    def complain(key: Key, text: str) -> None:
        place, dotted = where(key), ".".join(str(part) for part in key)
        before = "--set " if place == "--set" else f"{place}: " if place else ""
        problems.append(f"{before}{dotted}: {text}")

    fits = clearance(grid) > robot.radius_m
    body = f"the robot (radius {robot.radius_m:g} m)"
    if not fits.any():
        complain(("world", "robot"), f"{body} fits nowhere on {name}")
        raise SettingsError("\n".join(problems))
    begin = roomiest(grid) if world.start is None else grid.pose_in_grid(_pose(world.start))
    if not _is(fits, building, begin):
        text = (
            f"{_said(world.start)}: {body} does not fit there{_nearest_fit(fits, building, begin)}"
        )
        complain(("world", "start"), text)
        begin = roomiest(grid)  # to look at the other places from
    there = standing(grid, begin.x_m, begin.y_m, robot.radius_m)
    for i, leg in enumerate(world.journey):
        above: Key = ("world", "legs", i) if world.legs is not None else ("world",)
        for j, waypoint in enumerate(leg.waypoints or []):
            at = grid.pose_in_grid(_pose(waypoint))
            if not _is(there, building, at):
                text = f"{_said(waypoint)}: {body} cannot get there from its start"
                complain((*above, "waypoints", j), text + _nearest_fit(there, building, at))
    kidnaps = []
    for i, kidnap in enumerate(world.kidnaps):
        to = grid.pose_in_grid(_pose(kidnap.to))
        if not _is(fits, building, to):
            text = f"{_said(kidnap.to)}: {body} does not fit there"
            complain(("world", "kidnaps", i, "to"), text + _nearest_fit(fits, building, to))
        kidnaps.append(Kidnap(kidnap.at_s, to))
    doors = _doors(world, building, complain)
    if problems:
        raise SettingsError("\n".join(problems))
    return Place(
        name, _digest(building), building, robot, begin, world, tuple(doors), tuple(kidnaps)
    )


def _building(world: WorldSettings, start: Mapping[str, Path]) -> tuple[Building, str]:
    """Read the map, or make the building."""
    if world.map is not None:
        path = start["world.map"] / world.map
        building, name = load_building(path), path.name
    else:
        assert world.building is not None
        chosen = world.building
        building = build(generate(np.random.default_rng(chosen.seed), chosen))
        name = f"building-{chosen.seed}"
    if world.locations is not None:
        locations = load_locations(start["world.locations"] / world.locations)
        building = replace(building, locations=locations)
    return building, name


def _doors(
    world: WorldSettings, building: Building, complain: Callable[[Key, str], None]
) -> list[DoorChange]:
    found: list[DoorChange] = []
    known = {location.id: location for location in building.locations}
    for i, door in enumerate(world.doors):
        key: Key = ("world", "doors", i, "location" if door.location is not None else "at")
        if door.location is not None:
            if door.location not in known:
                complain(key, unknown_location(door.location, known))
                continue
            location = known[door.location]
            place = [location.x_m, location.y_m]
        else:
            assert door.at is not None
            place = door.at
        try:
            x_m, y_m = building.grid.points_in_grid([place])[0].tolist()
            leaf = door_leaf(building.grid, x_m, y_m)
        except MapError as e:
            complain(key, f"{_said(place)}: {e}")
            continue
        found.append(DoorChange(door.closes_s, leaf, closed=True))
        if door.opens_s is not None:
            found.append(DoorChange(door.opens_s, leaf, closed=False))
    return found


def _pose(values: list[float]) -> Pose:
    return Pose(values[0], values[1], values[2] if len(values) > 2 else 0.0)  # noqa: PLR2004


def _said(values: list[float] | None) -> str:
    return "[" + ", ".join(f"{v:g}" for v in values or []) + "]"


def _is(cells: np.ndarray[Any, Any], building: Building, pose: Pose) -> bool:
    row, column = building.grid.cell_of(pose.x_m, pose.y_m)
    rows, columns = cells.shape
    return 0 <= row < rows and 0 <= column < columns and bool(cells[row, column])


def _nearest_fit(cells: np.ndarray[Any, Any], building: Building, pose: Pose) -> str:
    """Name the nearest place that would do."""
    grid = building.grid
    places = (np.argwhere(cells)[:, ::-1] + 0.5) * grid.cell_m
    best = places[np.argmin(np.hypot(*(places - [pose.x_m, pose.y_m]).T))]
    x_m, y_m = grid.points_in_map([best])[0]
    return f"; the nearest place where it could be is [{x_m:.2f}, {y_m:.2f}]"


def _digest(building: Building) -> str:
    grid = building.grid
    text = f"{grid.cells.shape} {grid.cell_m!r} {grid.origin!r} {building.locations!r}"
    return hashlib.sha256(text.encode() + grid.cells.tobytes()).hexdigest()
