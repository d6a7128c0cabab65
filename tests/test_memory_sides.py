"""From which side a landmark looks like what is seen, and how turned, counts where one is lost."""

import math

import pytest

from ssrics_like.memory import Here, Uncertainty, Whereabouts
from ssrics_like.memory.cases import TURNED_RAD, UNDIRECTED_RAD2, cases_anywhere, cases_near
from ssrics_like.memory.hypotheses import ANYWHERE, Hypothesis
from ssrics_like.memory.links import Link, Links
from ssrics_like.memory.sides import EITHER, Side, Sides, unseen
from ssrics_like.poses import Pose

LESS = -4.0
AHEAD, BEHIND = Sides(Side(0.0, 0.1), Side(LESS)), Sides(Side(LESS), Side(0.0, 0.1))
SD = Uncertainty(0.15, 0.25, 0.0, 0.0, 0.0)


def here(x_m, theta_rad=0.0, *, directed=True):
    return Here(Pose(x_m, 0.0, theta_rad), directed, x_m, 0.0)


def corridor():
    whereabouts = Whereabouts(SD, Links())
    for i in range(4):
        whereabouts.find(f"L{i + 1}", here(5.0 * i))
    return whereabouts


def near(seen, theta_rad=0.0, **how):
    """Return the case that L3 is met again from L4, as it looks like that from one side."""
    whereabouts = corridor()
    at = here(10.1, theta_rad, **how)
    found = cases_near(
        whereabouts.hypotheses, whereabouts._links.seen_from, at, SD, lambda _: {"L3": seen}
    )
    return next(case for case in found if case.landmark == "L3")


@pytest.mark.parametrize(
    ("theta_rad", "right", "wrong"), [(0.0, AHEAD, BEHIND), (3.1, BEHIND, AHEAD)]
)
def test_a_landmark_met_from_the_side_from_which_it_does_not_look_like_that_is_less_probable(
    theta_rad, right, wrong
):
    either = near(Sides(Side(0.0, 0.1), Side(0.0, 0.1)), theta_rad).nats
    assert near(right, theta_rad).nats == pytest.approx(either, abs=0.2)
    unturned = near(EITHER, theta_rad).nats
    assert near(wrong, theta_rad).nats == pytest.approx(unturned - LESS, abs=0.2)


def test_without_a_direction_no_side_is_told():
    assert near(BEHIND, directed=False).nats == near(AHEAD, directed=False).nats


@pytest.mark.parametrize("theta_rad", [0.1, 0.1 - math.pi])
def test_how_what_is_seen_is_turned_is_taken_off_the_direction_perceived(theta_rad):
    turned = Sides(Side(0.0, 0.1), Side(0.0, 0.1))
    case = near(turned, theta_rad)
    assert case.fix.pose.theta_rad == pytest.approx(0.0, abs=1e-9)
    straight = Sides(Side(0.0, 0.0), Side(0.0, 0.0))
    assert case.nats == pytest.approx(near(straight, theta_rad - 0.1).nats, abs=1e-9)


@pytest.mark.parametrize("turn_rad", [0.0, 0.1, -0.15])
def test_a_frame_that_was_believed_to_be_turned_otherwise_changes_no_link(turn_rad):
    """Both place and direction say that the frame is turned, so the way between is as it was."""
    at = Here(Pose(0.0, 0.0, 0.0), True, 0.0, 0.0)
    before = Hypothesis("L1", Link(at.place, 0.0, 0.2**2), at, 0.0)
    link = Link(Pose(5.0, 1.0, 0.4), 0.02**2, 0.005**2)
    seen = Pose(0.0, 0.0, turn_rad).onward(link.pose)
    (case,) = cases_near(
        [before], lambda _: {"L2": link}, Here(seen, True, 5.0, 0.0), SD, lambda _: {}
    )
    assert case.turned_rad == pytest.approx(turn_rad, abs=0.01)
    learned = case.link(Link(Pose(0.0, 0.0, 0.0), 0.0, 0.0))
    assert learned.pose.distance_m(link.pose) < 0.02
    assert learned.pose.theta_rad == pytest.approx(0.4, abs=0.005)


def test_a_robot_that_may_be_anywhere_came_from_the_side_that_fits():
    seen = {"L1": AHEAD, "L2": BEHIND}
    found = cases_anywhere([ANYWHERE], here(0.0, 1.0), ["L1", "L2", "L3"], 3, SD, lambda _: seen)
    told = [(c.landmark, round(c.fix.pose.theta_rad, 2), round(c.nats, 3)) for c in found]
    even, odd = round(math.log(6), 3), round(math.log(6) - LESS, 3)
    back = round(1.0 - math.pi, 2)
    assert told == [
        ("L1", 0.9, even), ("L1", back, odd),
        ("L2", 1.0, odd), ("L2", round(0.9 - math.pi, 2), even),
        ("L3", 1.0, even), ("L3", back, even),
    ]  # fmt: skip
    exact, by_jambs = found[0].fix.variance_rad2, found[1].fix.variance_rad2
    assert (exact, by_jambs) == (TURNED_RAD**2, SD.direction_rad**2)


def test_a_robot_that_may_be_anywhere_knows_nothing_of_a_direction_where_there_is_none():
    at = here(0.0, directed=False)
    (only,) = cases_anywhere([ANYWHERE], at, ["L1"], 1, SD, unseen)
    assert (only.nats, only.fix.variance_rad2) == (0.0, UNDIRECTED_RAD2)
    assert cases_anywhere(corridor().hypotheses, at, ["L1"], 1, SD, unseen) == []


def test_lost_between_doorways_that_look_alike_the_side_decides():
    whereabouts = corridor()
    names = ["L1", "L2", "L3", "L4"]
    whereabouts.lose()
    at = here(100.0)
    sides = {"L1": AHEAD, "L2": BEHIND, "L3": AHEAD, "L4": BEHIND}
    whereabouts.expect(at, names, lambda asked: {name: sides[name] for name in asked})
    whereabouts.doubt(at, dict.fromkeys(names, 0.0), -20.0)
    ahead = {
        h.landmark for h in whereabouts.hypotheses
        if h.weight > -1.0 and math.cos(h.fix.pose.theta_rad) > 0.0
    }  # fmt: skip
    assert ahead == {"L1", "L3"}
