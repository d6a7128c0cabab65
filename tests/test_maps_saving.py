"""Buildings written and read again are the same to the last bit, and the same bytes each time."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from PIL import Image

from ssrics_like.errors import MapError
from ssrics_like.maps import load_building, save_building
from ssrics_like.perception.observation import Pose
from ssrics_like.world.building import Building
from ssrics_like.world.grid import FREE, OCCUPIED, UNKNOWN, GridMap
from ssrics_like.world.locations import KINDS, Location

CELLS = np.array([[FREE, OCCUPIED, UNKNOWN], [UNKNOWN, FREE, FREE]], np.uint8)


def same(one, two):
    """Tell whether two buildings are the same in everything."""
    return (
        one.title == two.title
        and one.locations == two.locations
        and one.grid.cell_m == two.grid.cell_m
        and one.grid.origin == two.grid.origin
        and one.grid.cells.dtype == two.grid.cells.dtype
        and np.array_equal(one.grid.cells, two.grid.cells)
    )


def test_a_map_is_written_as_ros_writes_it(tmp_path):
    building = Building("Flat", GridMap(CELLS, 0.05, Pose(1.0, -2.5, math.pi / 3)))
    path = save_building(building, tmp_path / "new" / "folder", "flat")
    assert path == tmp_path / "new" / "folder" / "flat.yaml"
    with Image.open(path.with_suffix(".png")) as picture:
        assert picture.mode == "L"
        assert np.asarray(picture).tolist() == [[205, 254, 254], [254, 0, 205]]
    assert path.read_text() == (
        "title: Flat\nimage: flat.png\nresolution: 0.05\n"
        "origin: [1.0, -2.5, 1.0471975511965976]\n"
        "occupied_thresh: 0.65\nfree_thresh: 0.196\nnegate: 0\n"
    )
    assert same(load_building(path), building)
    before = {p.name: p.read_bytes() for p in path.parent.iterdir()}
    save_building(building, path.parent, "flat")
    assert {p.name: p.read_bytes() for p in path.parent.iterdir()} == before
    assert sorted(before) == ["flat.png", "flat.yaml"]


FINITE = st.floats(-1e9, 1e9)
NAMES = st.text(st.characters(codec="utf-8"), max_size=8)


@pytest.mark.parametrize("title", ["0E0", "1e3", "-2.5E+7", "1_0e1", "yes", "12:30", "null", "~"])
def test_text_that_looks_like_something_else_stays_text(tmp_path, title):
    grid = GridMap(np.full((2, 3), FREE, np.uint8), 0.1)
    place = Location(title, 0.15, 0.1, title)
    again = load_building(save_building(Building(title, grid, (place,)), tmp_path / "map"))
    assert (again.title, again.locations) == (title, (place,))


@given(st.data())
@settings(max_examples=100, deadline=None)
def test_a_building_read_again_is_the_same_to_the_last_bit(tmp_path_factory, data):
    shape = data.draw(st.tuples(st.integers(1, 6), st.integers(1, 6)))
    cells = data.draw(arrays(np.uint8, shape, elements=st.sampled_from([FREE, OCCUPIED, UNKNOWN])))
    cells[data.draw(st.integers(0, shape[0] - 1)), data.draw(st.integers(0, shape[1] - 1))] = FREE
    origin = Pose(*data.draw(st.tuples(FINITE, FINITE, st.floats(-7, 7))))
    grid = GridMap(cells, data.draw(st.floats(1e-3, 10)), origin)
    ids = data.draw(st.lists(NAMES.filter(bool), max_size=3, unique=True))
    middle = np.array(grid.size_m) / 2
    places = tuple(
        Location(
            name, *(float(v) for v in grid.points_in_map([middle])[0]), data.draw(NAMES),
            data.draw(st.sampled_from(KINDS)),
        )
        for name in ids
    )  # fmt: skip
    building = Building(data.draw(NAMES.filter(bool)), grid, places)
    path = save_building(building, tmp_path_factory.mktemp("any"))
    try:
        again = load_building(path)
    except MapError as error:  # the middle, turned far away and back, may miss a tiny grid
        assert "lies off the map" in str(error)  # noqa: PT017
        assert abs(origin.x_m) + abs(origin.y_m) > 1e4 * grid.cell_m
    else:
        assert same(again, building)


def test_where_nothing_can_be_written_is_one_clear_line(tmp_path):
    (tmp_path / "file").write_text("")
    building = Building("x", GridMap(CELLS, 1.0))
    with pytest.raises(MapError, match=r"file/map\.yaml: cannot be written \(.*\)"):
        save_building(building, tmp_path / "file")
    with pytest.raises(MapError, match="cannot be written"):
        save_building(building, tmp_path, "no/folder")
