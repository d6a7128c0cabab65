"""Generated buildings: as asked for, different, whole, and true."""

from dataclasses import replace

import numpy as np
import pytest
from pydantic import ValidationError

from ssrics_like.world.buildings.generator import PROMISED_M, BuildingSettings, generate
from ssrics_like.world.buildings.hallways import Sizes, lay_out
from ssrics_like.world.buildings.interior import BODY_M
from ssrics_like.world.buildings.layout import FEWEST, INNER, SHAPES, Box
from ssrics_like.world.buildings.plan import CELL_M, Rectangle, draw, window
from ssrics_like.world.buildings.rooms import shared_out
from ssrics_like.world.buildings.turning import Turning
from ssrics_like.world.grid import FREE
from ssrics_like.world.reachable import standing

SEEDS = range(24)


def made(seed, **settings):
    return generate(np.random.default_rng(seed), BuildingSettings(**settings))


def rooms(plan):
    return [space for space in plan.spaces if space.kind == "room"]


@pytest.mark.parametrize("seed", SEEDS)
def test_a_disc_gets_into_every_room_whatever_stands_there(seed):
    plan = made(seed, rooms=2 + seed, clutter=(0.0, 0.5, 1.0)[seed % 3])
    grid = draw(plan)
    bare = draw(replace(plan, furniture=()))
    x_m, y_m = plan.spaces[0].middle
    for radius_m in (PROMISED_M, BODY_M):
        there = standing(grid, x_m, y_m, radius_m)
        for space in plan.spaces:
            fits = standing(bare, x_m, y_m, radius_m)[window(space, CELL_M)].any()
            assert fits or space.kind == "hallway", space.id  # a shallow niche holds no disc
            assert there[window(space, CELL_M)].any() == fits, space.id
        for place in plan.locations:
            assert there[grid.cell_of(place.x_m, place.y_m)], place.id


@pytest.mark.parametrize("seed", SEEDS)
def test_the_truth_is_true(seed):
    plan = made(seed, rooms=3 + seed // 2)
    grid = draw(replace(plan, furniture=()))
    assert len(rooms(plan)) == 3 + seed // 2
    ids = [place.id for place in plan.locations]
    assert len(set(ids)) == len(ids)
    letters = {"doorway": "D", "opening": "O", "junction": "J", "corner": "C"}
    for kind, letter in letters.items():
        found = [place for place in plan.locations if place.kind == kind]
        assert [place.id for place in found] == [
            f"{letter}{i:02d}" for i in range(1, len(found) + 1)
        ]
        assert found == sorted(found, key=lambda place: (-place.y_m, place.x_m))
    for passage in plan.passages:
        wide = passage.width_m
        assert wide >= 0.85 - 1e-9
        assert (passage.kind == "opening") == (wide > 1.2)
        cut = passage.cut
        # The gap is free, and there is a jamb of wall on both sides of it.
        assert (grid.cells[window(cut, CELL_M)] == FREE).all()
        if passage.axis == "x":
            sides = [(cut.x_m, (y, y + CELL_M)) for y in (cut.y_m[0] - CELL_M, cut.y_m[1])]
        else:
            sides = [((x, x + CELL_M), cut.y_m) for x in (cut.x_m[0] - CELL_M, cut.x_m[1])]
        for x_m, y_m in sides:
            assert (grid.cells[window(Rectangle(x_m=x_m, y_m=y_m), CELL_M)] != FREE).all()


def test_the_same_seed_makes_the_same_building_and_another_seed_another():
    assert made(5) == made(5)
    plans = [made(seed) for seed in range(12)]
    assert len({(plan.width_m, plan.height_m) for plan in plans}) == 12
    assert len({plan.title for plan in plans}) >= 4
    areas = [room.area_m2 for plan in plans for room in rooms(plan)]
    assert min(areas) < 9
    assert max(areas) > 30


@pytest.mark.parametrize(
    ("hallways", "kind", "count"),
    [("straight", "corner", 0), ("L", "corner", 1), ("T", "junction", 1), ("X", "junction", 1),
     ("U", "corner", 2), ("ring", "corner", 4)],
)  # fmt: skip
def test_hallways_run_as_asked(hallways, kind, count):
    for seed in range(3):
        plan = made(seed, rooms=10, hallways=hallways)
        assert sum(place.kind == kind for place in plan.places) == count
        assert sum(place.kind != kind for place in plan.places) == 0


def test_shares_reach_from_none_to_all():
    for seed in range(4):
        doors = made(seed, openings=0.0, connecting=0.0, suites=0.0, clutter=0.0, leaves=0.0)
        assert {passage.kind for passage in doors.passages} == {"doorway"}
        assert doors.furniture == ()
        leaves = made(seed, clutter=0.0, leaves=1.0)
        assert {piece.kind for piece in leaves.furniture} == {"box"}
        count = sum(passage.kind == "doorway" for passage in leaves.passages)
        assert count / 2 < len(leaves.furniture) <= count
        full = made(seed, clutter=1.0, openings=1.0)
        assert sum(passage.kind == "opening" for passage in full.passages) >= 4
        assert len(full.furniture) > 10
        assert {piece.kind for piece in full.furniture} >= {"box"}


def test_widths_stay_within_their_ranges():
    plan = made(3, doorway_m=(1.0, 1.2), hallway_m=(3.0, 3.5), rooms=12)
    widths = {passage.width_m for passage in plan.passages if passage.kind == "doorway"}
    assert 1.0 - 1e-9 <= min(widths) <= max(widths) <= 1.2 + 1e-9
    halls = [space for space in plan.spaces if space.kind == "hallway"]
    assert all(min(s.x_m[1] - s.x_m[0], s.y_m[1] - s.y_m[0]) < 3.6 for s in halls)
    small, large = made(1, scale=(0.7, 0.7)), made(1, scale=(2.0, 2.0))
    assert large.width_m * large.height_m > 2 * small.width_m * small.height_m


def test_rooms_that_are_reached_through_another_have_a_doorway_to_it():
    plan = made(2, rooms=16, suites=1.0, connecting=0.0, openings=0.0, scale=(1.3, 1.3))
    halls = draw(
        replace(
            plan,
            spaces=tuple(s for s in plan.spaces if s.kind == "hallway"),
            furniture=(),
            passages=(),
            walls=(),
        )
    )
    inner = 0
    for passage in plan.passages:
        ends = [
            (passage.x_m + s * 0.3, passage.y_m)
            if passage.axis == "x"
            else (passage.x_m, passage.y_m + s * 0.3)
            for s in (-1, 1)
        ]
        inner += not any(halls.is_free(*end) for end in ends)
    assert inner >= 4


@pytest.mark.parametrize("hallways", FEWEST)
def test_extreme_settings_make_buildings_too(hallways):
    for extra, scale, wide in [(0, 0.7, 1.2), (7, 0.7, 6.0), (0, 3.0, 6.0), (2, 3.0, 1.2)]:
        count = FEWEST[hallways] + extra
        plan = made(
            extra, rooms=count, hallways=hallways, scale=(scale, scale), hallway_m=(wide, wide),
            doorway_m=(1.6, 1.6), suites=1.0, clutter=0.2,
        )  # fmt: skip
        assert len(rooms(plan)) == count


@pytest.mark.parametrize(
    ("settings", "said"),
    [
        ({"rooms": 1}, "greater than or equal to 2"),
        ({"rooms": 6, "hallways": "ring"}, "rooms: 6: expected at least 7"),
        ({"hallways": "S"}, "'straight', 'L'"),
        ({"doorway_m": (0.8, 1.0)}, "within 0.85 and 1.8"),
        ({"doorway_m": (1.0, 0.9)}, "rising"),
        ({"scale": [1.0]}, "expected two numbers"),
        ({"clutter": 1.5}, "less than or equal to 1"),
        ({"cluter": 1.0}, "cluter"),
    ],
)
def test_settings_that_make_no_building_are_refused(settings, said):
    with pytest.raises(ValidationError, match=said):
        BuildingSettings(**settings)


def overlap(one, other, apart=0):
    return (
        one.x0 < other.x1 + apart and other.x0 < one.x1 + apart
        and one.y0 < other.y1 + apart and other.y0 < one.y1 + apart
    )  # fmt: skip


@pytest.mark.parametrize("shape", SHAPES)
def test_blocks_keep_a_wall_apart_from_hallways_and_each_other(shape):
    for seed in range(20):
        sizes = Sizes(np.random.default_rng(seed), (1.6, 2.4), (4.2, 6.8))
        layout = lay_out(shape, sizes, 300 + 50 * seed)
        inside = Box(0, 0, layout.width, layout.height)
        for i, block in enumerate(layout.blocks):
            assert inside.x0 < block.box.x0 < block.box.x1 < inside.x1
            assert inside.y0 < block.box.y0 < block.box.y1 < inside.y1
            assert not any(overlap(block.box, hall, INNER) for hall in layout.halls)
            assert not any(overlap(block.box, b.box, INNER) for b in layout.blocks[i + 1 :])
            for front in block.fronts:
                edge = {
                    "bottom": Box(front.low, block.box.y0 - INNER - 1, front.high, block.box.y0),
                    "top": Box(front.low, block.box.y1, front.high, block.box.y1 + INNER + 1),
                    "left": Box(block.box.x0 - INNER - 1, front.low, block.box.x0, front.high),
                    "right": Box(block.box.x1, front.low, block.box.x1 + INNER + 1, front.high),
                }[front.side]
                assert any(overlap(edge, hall) for hall in layout.halls)
        assert layout.frontage >= 300 + 50 * seed
        assert len(layout.blocks) <= FEWEST[shape]


def test_rooms_are_shared_out_in_proportion_and_one_each_at_least():
    sizes = Sizes(np.random.default_rng(0), (1.6, 2.4), (4.2, 6.8))
    blocks = lay_out("T", sizes, 600).blocks
    for columns in (3, 5, 9):
        counts = shared_out(blocks, columns)
        assert sum(counts) == columns
        assert min(counts) >= 1
    lengths = [block.front.length for block in blocks]
    assert int(np.argmax(shared_out(blocks, 9))) == int(np.argmax(lengths))


def test_eight_turnings_are_eight_buildings():
    seen = set()
    for flips in range(8):
        turning = Turning(10, 6, bool(flips & 1), bool(flips & 2), bool(flips & 4))
        seen.add((turning.box(Box(1, 2, 4, 3)), turning.way((1, 0)), turning.way((0, 1))))
        assert turning.size() == ((6, 10) if flips & 4 else (10, 6))
        x, y = turning.point(1, 2)
        assert (x, y) in {
            (turning.box(Box(1, 2, 4, 3))[i], turning.box(Box(1, 2, 4, 3))[j])
            for i in (0, 2)
            for j in (1, 3)
        }
    assert len(seen) == 8
