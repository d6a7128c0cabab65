"""Home: a robot that is put down where its first run began knows where it is."""

import json
import math
from dataclasses import replace

import pytest
from saved_memories import memory
from test_model import drive, landmark_model

from ssrics_like.errors import MemoryFileError
from ssrics_like.memory import Home, Link, load_memory_file, save_memory_file
from ssrics_like.memory.home import PUT_DOWN_M, PUT_DOWN_RAD
from ssrics_like.memory.merging import merge
from ssrics_like.poses import Pose

STOPS = [(0.0, 1), (10.0, 2), (0.0, 1), (10.0, 2)]
HOME = Home("L1", 1.0, 2.0, math.pi / 2, 0.3, 0.02)


def test_the_landmark_lies_where_the_way_back_leads():
    # From home, which looks to the left of the landmark's x axis, it lies 2 m behind, 1 m left.
    there = HOME.landmark_from(Pose(0.0, 0.0, 0.0))
    assert (there.pose.x_m, there.pose.y_m) == pytest.approx((-2.0, 1.0))
    assert there.pose.theta_rad == pytest.approx(-math.pi / 2)
    length2_m2 = 2.0**2 + 1.0**2
    assert there.variance_m2 == pytest.approx(0.3**2 + PUT_DOWN_M**2 + PUT_DOWN_RAD**2 * length2_m2)
    assert there.variance_rad2 == pytest.approx(0.02**2 + PUT_DOWN_RAD**2)
    start = Pose(7.0, -3.0, 0.4)
    again = Home.of("L1", Link(start.seen_from(HOME.landmark_from(start).pose), 0.09, 0.0004))
    assert (again.x_m, again.y_m, again.theta_rad) == pytest.approx((1.0, 2.0, math.pi / 2))


def test_a_first_run_remembers_where_it_began(tmp_path):
    model = landmark_model()
    drive(model, STOPS)
    saved = model.saved_memory("one")
    first = saved.landmarks[0]
    pose = Pose(first.x_m, first.y_m, first.theta_rad)
    at = pose.onward(Pose(saved.home.x_m, saved.home.y_m, saved.home.theta_rad))
    assert (saved.home.landmark, at.x_m, at.y_m) == ("L1", pytest.approx(0.0), pytest.approx(0.0))
    save_memory_file(saved, tmp_path / "run.json")
    assert load_memory_file(tmp_path / "run.json").home.landmark == "L1"
    # A later run that marks others has the same home.
    later = landmark_model(remembered=saved)
    drive(later, [(500.0, 7), (520.0, 8)])
    assert later.saved_memory("two").home == saved.home


def test_from_home_the_first_landmark_is_known_at_once():
    model = landmark_model()
    drive(model, STOPS)
    saved = model.saved_memory("one").aged(3600.0)
    found = {
        at_home: drive(landmark_model(remembered=saved, at_home=at_home), STOPS[:2])
        for at_home in (False, True)
    }
    assert (found[True][0].decision, found[True][0].landmark) == ("recognised", "L1")
    assert found[False][0].decision == "unsure"


def test_a_memory_without_home_is_refused_by_a_model_that_begins_there():
    for remembered in (None, replace(memory(chunks=()), home=None)):
        with pytest.raises(ValueError, match="remembers no home"):
            landmark_model(remembered=remembered, at_home=True)


def test_a_merged_memory_keeps_the_home_of_the_first_or_takes_that_of_the_second():
    one, other = memory(1, 2), replace(memory(1, 2, run="run-b"), home=HOME)
    assert merge(one, other).memory.home == replace(HOME, landmark="L3")
    assert merge(other, one).memory.home == HOME
    mine = replace(HOME, landmark="L2")
    assert merge(replace(one, home=mine), other).memory.home == mine


@pytest.mark.parametrize(
    ("changed", "said"),
    [
        ({"landmark": "L9"}, "home: landmark 'L9' is not there"),
        ({"landmark": 3}, "home: landmark is 3, expected text"),
        ({"position_sd_m": 0.0}, "home: position_sd_m is 0.0; expected more than 0"),
        ({"y_m": "far"}, "home: y_m is 'far', expected a number"),
        (None, "home is None, expected its landmark and pose"),
    ],
)
def test_a_damaged_home_is_one_line(tmp_path, changed, said):
    path = tmp_path / "run.json"
    save_memory_file(replace(memory(), home=HOME), path)
    data = json.loads(path.read_text())
    data["home"] = None if changed is None else {**data["home"], **changed}
    path.write_text(json.dumps(data))
    with pytest.raises(MemoryFileError) as caught:
        load_memory_file(path)
    assert str(caught.value) == f"{path}: damaged: {said}"


def test_a_home_that_is_no_place_is_refused():
    with pytest.raises(ValueError, match="home: x_m"):
        replace(HOME, x_m=math.inf)
