"""Whereabouts: what is expected where, one hypothesis or several."""

import math
from dataclasses import replace

import numpy as np
import pytest

from ssrics_like import load_memory
from ssrics_like.memory.base_level import base_level
from ssrics_like.memory.expectation import FAR, Expected, Uncertainty
from ssrics_like.memory.hypotheses import BELOW, Here, Hypothesis, likely
from ssrics_like.memory.links import Link, Links
from ssrics_like.memory.measurement import (
    ASKEW,
    ASKEW_RAD,
    ASTRAY,
    ASTRAY_M,
    BOTH,
    measured,
)
from ssrics_like.memory.whereabouts import SURE, Whereabouts
from ssrics_like.poses import Pose

CERTAIN = Uncertainty(0.25, 0.2, 0.0, 0.0, 0.0)
DRIFTING = Uncertainty(0.25, 0.2, 0.05, 0.01, 0.01)


def here(x_m, y_m, theta_rad=0.0, travelled_m=0.0, *, directed=True, turned_rad=0.0):
    return Here(Pose(x_m, y_m, theta_rad), directed, travelled_m, turned_rad)


def corridor(uncertainty=CERTAIN, doors=4, apart_m=4.0):
    """Find doors along a corridor."""
    whereabouts = Whereabouts(uncertainty, Links())
    for i in range(doors):
        whereabouts.find(f"L{i + 1}", here(apart_m * i, 0.0, 0.0, apart_m * i))
    return whereabouts, [f"L{i + 1}" for i in range(doors)]


def density(off_m, known_m2, sd_m):
    return sd_m**2 / (known_m2 + sd_m**2) * math.exp(-0.5 * off_m**2 / (known_m2 + sd_m**2))


def test_without_drift_a_place_is_as_probable_as_two_gaussians_have_it():
    whereabouts, names = corridor()
    for off_m in (0.0, 0.2, 0.7):
        nats = whereabouts.expect(here(4.0 + off_m, 0.0, 0.0, 20.0), names)
        link_m2 = 2 * 0.02**2  # back along two links, as certain as a link can be
        turn_m2 = 0.005**2 * 16.0
        known_m2 = link_m2 + turn_m2
        hit, astray = (density(off_m, known_m2, sd_m) for sd_m in (0.25, ASTRAY_M))
        often = ASTRAY + BOTH
        expected = -math.log((1 - often) * hit + often * astray)
        assert nats["L2"] == pytest.approx(expected, rel=0.02, abs=1e-3)
        assert nats["L4"] > 15.0


def test_a_doorway_is_the_same_from_the_other_side_and_no_other_way():
    whereabouts, names = corridor()
    straight, back, across = (
        whereabouts.expect(here(4.0, 0.0, turn, 20.0), names)["L2"]
        for turn in (0.0, math.pi, math.pi / 2)
    )
    assert straight == pytest.approx(back, abs=1e-6)
    # As improbable as a landmark whose direction was mismeasured, from either of two sides.
    askew = -math.log(2.0 * (ASKEW + BOTH)) + 0.5 * (math.pi / 2 / ASKEW_RAD) ** 2
    assert across == pytest.approx(straight + askew, abs=0.01)
    # Both ways through count, each as perceiving the landmark there, so turned, has it.
    before, onward = whereabouts.hypotheses[0].fix, whereabouts._links.seen_from("L4")["L2"]
    drift, place = Link(Pose(0.0, 0.0, 0.0), 0.0, 0.0), Pose(4.0, 0.0, 0.0)
    through, reverse = (
        measured(before, onward, drift, Pose(4.0, 0.0, turn), 0.25, 0.2).nats
        for turn in (0.0, math.pi)
    )
    assert straight == pytest.approx(-np.logaddexp(-through, -reverse), abs=1e-9)
    undirected = here(4.0, 0.0, math.pi / 2, 20.0, directed=False)
    nothing_told = whereabouts.expect(undirected, names)["L2"]
    assert nothing_told == pytest.approx(
        measured(before, onward, drift, place, 0.25).nats, abs=1e-9
    )


def test_the_longer_the_way_the_less_a_distance_counts():
    counts = []
    for travelled_m in (15.0, 60.0, 240.0):
        whereabouts, names = corridor(DRIFTING)
        near, off = (
            whereabouts.expect(here(x_m, 0.0, 0.0, travelled_m), names)["L2"] for x_m in (4.0, 5.0)
        )
        counts.append(off - near)
    assert counts == sorted(counts, reverse=True)
    assert counts[-1] < counts[0] / 3


def test_recognising_a_landmark_corrects_where_the_robot_believes_to_be():
    whereabouts, names = corridor(DRIFTING)
    # Odometry says 1 m more, after 60 m; L1 is recognised, and with it all others lie there.
    whereabouts.expect(here(1.0, 0.0, 0.0, 60.0), names)
    before = whereabouts.recognise("L1", here(1.0, 0.0, 0.0, 60.0), {}, 0.0)
    assert before.landmark == "L4"
    nats = whereabouts.expect(here(5.0, 0.0, 0.0, 64.0), names)
    assert nats["L2"] < 1.5
    assert min(nats.nats, key=nats.__getitem__) == "L2"


def test_drift_is_absorbed_by_the_link_that_closes_a_loop():
    links = Links()
    whereabouts = Whereabouts(DRIFTING, links)
    corners = [(0.0, 0.0), (10.0, 0.0), (10.0, 10.0), (0.0, 10.0)]
    for i, (x_m, y_m) in enumerate(corners):
        whereabouts.find(f"L{i + 1}", here(x_m, y_m, 0.0, 10.0 * i))
    kept = {pair: links.between(*pair) for pair in (("L1", "L2"), ("L2", "L3"), ("L3", "L4"))}
    again = here(0.4, -0.3, 0.0, 40.0)
    whereabouts.expect(again, ["L1", "L2", "L3", "L4"])
    whereabouts.recognise("L1", again, {}, 0.0)
    assert {pair: links.between(*pair) for pair in kept} == kept
    closing = links.between("L4", "L1").pose
    assert closing.distance_m(Pose(0.0, -10.0, 0.0)) < 0.6


def test_of_two_hypotheses_the_next_landmark_tells_which():
    """Doors 3 m apart after 5 m of drift: only the gap between the next two is different."""
    links = Links()
    whereabouts = Whereabouts(Uncertainty(0.25, 0.2, 0.0, 0.0, 0.0, bias=0.05), links)
    at_m = [0.0, 3.0, 6.0, 14.0, 17.0]
    names = [f"L{i + 1}" for i in range(len(at_m))]
    for name, x_m in zip(names, at_m, strict=True):
        whereabouts.find(name, here(x_m, 0.0, 0.0, x_m))
    evidence = dict.fromkeys(names, 0.0)
    # Really at L2, after 60 m, and odometry is 1.5 m off: L1 or L2.
    first = here(1.5, 0.0, 0.0, 77.0)
    nats = whereabouts.expect(first, names)
    assert abs(nats["L1"] - nats["L2"]) < 0.5
    whereabouts.doubt(first, evidence, -10.0)
    assert {h.landmark for h in whereabouts.hypotheses} >= {"L1", "L2"}
    second = here(4.5, 0.0, 0.0, 80.0)
    whereabouts.expect(second, names)
    whereabouts.doubt(second, evidence, -10.0)
    third = here(12.5, 0.0, 0.0, 88.0)  # 8 m on: only from L3 to L4
    nats = whereabouts.expect(third, names)
    assert min(nats.nats, key=nats.__getitem__) == "L4"
    assert sorted(nats.nats.values())[1] > nats["L4"] + 3.0


def test_a_robot_that_is_lost_finds_itself_by_the_gaps_between_landmarks():
    links = Links()
    whereabouts = Whereabouts(CERTAIN, links)
    places = {"L1": (0.0, 0.0), "L2": (3.0, 0.0), "L3": (3.0, 5.0), "L4": (-4.0, 5.0)}
    for i, (name, place) in enumerate(places.items()):
        whereabouts.find(name, here(*place, 0.0, 5.0 * i))
    whereabouts.lose()
    evidence = dict.fromkeys(places, 0.0)
    frame = Pose(50.0, -20.0, 2.0)  # where the robot, set down anew, believes the origin to be
    for name in ("L2", "L3"):
        seen = frame.onward(Pose(*places[name], 0.0))
        at = Here(seen, True, 0.0 if name == "L2" else 5.0, 0.0)
        nats = whereabouts.expect(at, places)
        if name == "L2":
            assert nats == Expected({}, pytest.approx(math.log(4)))
            whereabouts.doubt(at, evidence, -10.0)
    assert min(nats.nats, key=nats.__getitem__) == "L3"
    whereabouts.recognise("L3", at, evidence, -10.0)
    nats = whereabouts.expect(Here(frame.onward(Pose(-4.0, 5.0, 0.0)), True, 12.0, 0.0), places)
    assert min(nats.nats, key=nats.__getitem__) == "L4"
    assert nats["L4"] < 4.0  # what two landmarks say of the direction is not very certain


def test_a_lost_robot_must_be_sure_until_enough_landmarks_have_fitted():
    whereabouts, names = corridor(doors=9)
    assert whereabouts.settled("L2", 0.0)
    whereabouts.lose()
    assert whereabouts.settled(None, 0.0)  # where nothing is known here, this is new
    evidence = dict.fromkeys(names, 0.0)
    for i, name in enumerate(names[:8]):
        at = here(4.0 * i, 0.0, 0.0, 4.0 * i)
        whereabouts.expect(at, names)
        needed = 0.0 if i + 1 == 8 else SURE[min(i, len(SURE) - 1)]
        assert whereabouts.settled(name, needed)
        assert needed == 0.0 or not whereabouts.settled(name, needed - 0.01)
        whereabouts.doubt(at, evidence, -10.0)
        assert whereabouts.settled(None, 1.0) == (i >= 2)
        assert (whereabouts.known is not None) == (i >= 2)


def test_a_robot_that_recognises_nothing_gives_up_in_the_end():
    whereabouts, names = corridor()
    whereabouts.lose()
    whereabouts.expect(here(0.0, 0.0), names)
    whereabouts.doubt(here(0.0, 0.0), dict.fromkeys(names, 0.0), -10.0)
    for i in range(1, 6):
        assert not whereabouts.settled(None, 1.0)
        far = here(100.0 * i, 0.0, 0.0, 100.0 * i)
        whereabouts.expect(far, names)
        whereabouts.doubt(far, {}, -10.0)
    assert whereabouts.settled(None, 1.0)
    assert whereabouts.find("L9", far) is None  # it is not joined to anything


def test_what_a_place_looks_like_counts_once_however_often_the_robot_turns_in_it():
    whereabouts, names = corridor()
    whereabouts.lose()
    looks = {"L1": -1.0, "L2": -4.0, "L3": -6.0, "L4": -6.0}

    def weights():
        return {h.landmark: h.weight for h in reversed(whereabouts.hypotheses)}  # the likeliest

    for travelled_m in (0.0, 3.0, 6.0):  # in and out of a room
        at = here(0.2, 0.0, 0.0, travelled_m)
        nats = whereabouts.expect(at, names)
        assert nats["L1"] == pytest.approx(nats["L2"], abs=0.01)
        assert not whereabouts.settled("L1", SURE[0] - 0.01)
        whereabouts.doubt(at, looks, -10.0)
        assert weights()["L1"] - weights()["L2"] == pytest.approx(3.0, abs=0.05)
    next_door = here(4.2, 0.0, 0.0, 10.0)
    nats = whereabouts.expect(next_door, names)
    assert min(nats.nats, key=nats.__getitem__) == "L2"
    assert whereabouts.settled("L2", SURE[1])


def test_a_landmark_is_never_recalled_elsewhere_however_often_it_was_recognised():
    """A landmark that is recalled everywhere would grow stronger each time."""
    profile = load_memory("act-r")
    strongest = base_level(-20.0 * np.arange(1, 100_001), 0.0, decay=profile.decay)
    assert strongest - FAR < profile.retrieval_threshold
    whereabouts, names = corridor()
    for x_m in (2.0, 30.0):
        nats = whereabouts.expect(here(x_m, 5.0, 0.0, 20.0), names)
        assert all(nats[name] == FAR for name in names)


def test_before_the_first_landmark_nothing_is_expected():
    whereabouts = Whereabouts(CERTAIN, Links())
    assert whereabouts.expect(here(0.0, 0.0), []) == Expected()
    assert whereabouts.find("L1", here(0.0, 0.0)) is None


def test_before_the_first_landmark_there_is_nothing_to_be_in_doubt_about():
    whereabouts = Whereabouts(CERTAIN, Links())
    whereabouts.doubt(here(0.0, 0.0), {}, -10.0)
    assert whereabouts.hypotheses == ()


def test_a_robot_that_may_be_anywhere_is_in_doubt_and_one_that_knows_where_it_is_is_not():
    whereabouts, names = corridor()
    whereabouts.expect(here(4.0, 0.0), names)
    assert not whereabouts.in_doubt
    whereabouts.lose()
    whereabouts.expect(here(4.0, 0.0), names)
    assert whereabouts.in_doubt


def anywhere_in(hypotheses):
    return [h.weight for h in hypotheses if h.landmark is None]


def test_a_robot_that_turns_in_a_place_unknown_to_it_may_still_be_anywhere():
    whereabouts, names = corridor()
    whereabouts.lose()
    like_none = dict.fromkeys(names, -9.0)
    seen = []
    for travelled_m in (0.0, 3.0, 6.0, 9.0):
        at = here(50.0, 20.0, 0.0, travelled_m)
        whereabouts.expect(at, names)
        whereabouts.doubt(at, like_none, -13.0)
        seen.append(anywhere_in(whereabouts.hypotheses))
    assert seen[0]
    assert seen == [seen[0]] * 4


def test_a_robot_that_took_a_place_for_its_lookalike_finds_out_where_the_likeness_ends():
    """Nine doors and, far from them, ten: the robot is at these, which look a bit less alike."""
    whereabouts, _ = corridor(doors=9)
    for i in range(10):
        whereabouts.find(f"M{i + 1}", here(1000.0 + 4.0 * i, 0.0, 0.0, 1000.0 + 4.0 * i))
    names = [*(f"L{i + 1}" for i in range(9)), *(f"M{i + 1}" for i in range(10))]
    whereabouts.lose()
    for i in range(10):
        at = here(4.0 * i, 50.0, 0.0, 4.0 * i)
        evidence = dict.fromkeys(names, -6.0) | {f"L{i + 1}": -0.7, f"M{i + 1}": -1.0}
        nats = whereabouts.expect(at, names)
        likeliest = min(names, key=lambda name: nats[name] - evidence[name])
        if i < 9:
            assert likeliest == f"L{i + 1}"
            whereabouts.recognise(likeliest, at, evidence, -10.0)
    assert likeliest == "M10"
    assert nats["M10"] - evidence["M10"] < 5.0  # a new place would cost 10
    whereabouts.recognise("M10", at, evidence, -10.0)
    assert whereabouts.known.landmark == "M10"


def test_hypotheses_that_agree_are_one():
    at = here(3.0, 0.0)
    one = Hypothesis("L1", Link(Pose(3.0, 0.0, 0.0), 0.01, 0.01), at, -1.0, 3)
    near = replace(one, fix=one.fix._replace(pose=Pose(3.2, 0.1, 0.1)), weight=-2.0, met=2)
    turned = replace(one, fix=one.fix._replace(pose=Pose(3.0, 0.0, math.pi)), weight=-3.0)
    elsewhere = replace(one, landmark="L2", weight=-4.0)
    hopeless = replace(one, landmark="L3", weight=-2.0 - BELOW)
    kept = likely([hopeless, turned, near, elsewhere, one])
    both = math.log(math.exp(-1.0) + math.exp(-2.0))
    assert [(h.landmark, h.met) for h in kept] == [("L1", 3), ("L1", 3), ("L2", 3)]
    assert [h.weight for h in kept] == pytest.approx([0.0, -3.0 - both, -4.0 - both])
    assert kept[0].fix == one.fix


def test_a_robot_that_is_not_where_it_was_said_to_begin_finds_out():
    whereabouts, names = corridor(DRIFTING, doors=8)
    whereabouts.begin("L1", Link(Pose(0.0, 0.0, 0.0), 0.04, 0.01), here(0.5, 0.0, directed=False))
    assert whereabouts.expect(here(4.0, 0.0, 0.0, 3.5), names)["L2"] < 2.0
    # It began 12 m further on; the doors look like those there, a hundred times to one.
    for i in range(4):
        place = here(4.0 * i, 0.0, 0.0, 4.0 * i + 0.5)
        whereabouts.expect(place, names)
        looks = {name: 0.0 if name == f"L{i + 4}" else -math.log(100.0) for name in names}
        whereabouts.doubt(place, looks, -math.log(100.0))
    assert whereabouts.hypotheses[0].landmark == "L7"


@pytest.mark.parametrize(("off_m", "astray"), [(0.2, []), (0.4, ["L3"]), (0.8, ["L3"]), (0.9, [])])
def test_what_is_perceived_beside_a_landmark_may_be_that_landmark(off_m, astray):
    whereabouts, names = corridor(doors=4)
    whereabouts.expect(here(8.0, off_m, 0.0, 16.0), names)
    places = whereabouts.astray()
    assert list(places) == astray
    for place in places.values():
        assert (place.x_m, place.y_m) == pytest.approx((8.0, 0.0))
    whereabouts.lose()
    whereabouts.expect(here(8.0, off_m, 0.0, 16.0), names)
    assert whereabouts.astray() == {}


def test_where_a_landmark_lies_must_be_known_well_for_something_to_be_beside_it():
    whereabouts, names = corridor(DRIFTING)
    for travelled_m, astray in ((16.0, ["L3"]), (400.0, [])):
        whereabouts.expect(here(8.0, 0.6, 0.0, travelled_m), names)
        assert list(whereabouts.astray()) == astray
