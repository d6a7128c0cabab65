"""The maps that come with the project, and real ones."""

from itertools import combinations
from math import hypot

import numpy as np
import pytest
from PIL import Image

from ssrics_like.library import folder
from ssrics_like.maps import load_building, load_locations, load_plan, save_building
from ssrics_like.world.buildings.plan import build, draw, window
from ssrics_like.world.grid import FREE, OCCUPIED
from ssrics_like.world.reachable import reachable, roomiest, standing

MAPS = folder("scenarios") / "maps"
STARTS = {"simple": (1.2, 3.2), "complex": (1.6, 1.0)}
PIONEER_M = 0.27


@pytest.mark.parametrize("name", STARTS)
def test_a_shipped_map_is_what_its_plan_draws(tmp_path, name):
    building = build(load_plan(MAPS / f"{name}.plan.yaml"))
    path = save_building(building, tmp_path, name)
    assert path.read_text() == (MAPS / f"{name}.yaml").read_text()
    with Image.open(tmp_path / f"{name}.png") as new, Image.open(MAPS / f"{name}.png") as shipped:
        assert np.array_equal(np.asarray(new), np.asarray(shipped))
    loaded = load_building(MAPS / f"{name}.yaml")
    assert np.array_equal(loaded.grid.cells, building.grid.cells)
    assert loaded.locations == building.locations
    assert loaded.title == building.title


@pytest.mark.parametrize("name", STARTS)
def test_a_robot_gets_everywhere_on_a_shipped_map(name):
    plan = load_plan(MAPS / f"{name}.plan.yaml")
    grid = draw(plan)
    for radius_m in (PIONEER_M, 0.35):
        there = standing(grid, *STARTS[name], radius_m)
        for space in plan.spaces:
            assert there[window(space, 0.05)].any(), space.id
        for place in plan.locations:
            assert there[grid.cell_of(place.x_m, place.y_m)], place.id
    covered = reachable(grid, *STARTS[name], PIONEER_M)
    assert covered.sum() > 0.95 * (grid.cells == FREE).sum()
    rows, columns = grid.cells.shape
    edge = np.ones((rows, columns), bool)
    edge[1:-1, 1:-1] = False
    assert (grid.cells[edge] == OCCUPIED).all()


def test_complex_has_six_doorways_and_other_places_to_judge_by():
    building = load_building(MAPS / "complex.yaml")
    kinds = {place.id: place.kind for place in building.locations}
    assert [name for name, kind in kinds.items() if kind == "doorway"] == list("123456")
    assert set(kinds.values()) == {"doorway", "opening", "junction", "corner"}
    assert [place.label for place in building.locations[:6]] == [
        f"Location {i}" for i in range(1, 7)
    ]
    apart = min(hypot(a.x_m - b.x_m, a.y_m - b.y_m) for a, b in combinations(building.locations, 2))
    assert apart > 1.5
    plan = load_plan(MAPS / "complex.plan.yaml")
    assert len([space for space in plan.spaces if space.kind == "room"]) == 7
    assert all(0.9 <= p.width_m <= 1.1 for p in plan.passages if p.kind == "doorway")


def test_simple_has_the_reports_three_locations():
    building = load_building(MAPS / "simple.yaml")
    assert [(place.id, place.label) for place in building.locations] == [
        (str(i), f"Location {i}") for i in (1, 2, 3)
    ]


def test_all_eight_real_plans_are_read_furnished_and_not(data_dir):
    paths = sorted((data_dir / "maps").glob("*/map*.yaml"))
    assert len(paths) == 16
    for path in paths:
        building = load_building(path)
        with Image.open(path.with_suffix(".png")) as picture:
            greys = np.asarray(picture)[::-1]
        # These pictures hold 0, 205 and 254 only.
        assert np.array_equal(building.grid.cells == FREE, greys == 254)
        assert np.array_equal(building.grid.cells == OCCUPIED, greys == 0)
        doors = load_locations(path.parent / "doors.csv")
        assert {door.kind for door in doors} <= {"doorway", "other"}
        start = roomiest(building.grid)
        there = reachable(building.grid, start.x_m, start.y_m, PIONEER_M)
        assert there.sum() > 0.9 * (building.grid.cells == FREE).sum(), path
        near = [there[building.grid.cell_of(door.x_m, door.y_m)] for door in doors]
        assert np.mean(near) > 0.6, path
