"""The way module: what rules ask for, what the body is told, what is remembered of it."""

import math

import pytest
from snapshots import seen_in_room

from ssrics_like.errors import EngineError
from ssrics_like.library import find
from ssrics_like.memory import Here, TopologicalMemory, Uncertainty, Whereabouts
from ssrics_like.memory.chunks import View
from ssrics_like.memory.links import Link
from ssrics_like.poses import Pose
from ssrics_like.productions.engine import Engine
from ssrics_like.productions.interface import Recall, StepRequest
from ssrics_like.productions.rulebook import load_rulebook
from ssrics_like.wayfinding import (
    AT_GOAL_M,
    CORRECTIONS,
    LONGER,
    NEAR_M,
    ROUND,
    ROUND_SLACK_M,
    SLACK_M,
    Wayfinder,
)

RULES = load_rulebook(find("productions", "wayfinding"))
PLACES = {"L1": (0.0, 0.0), "L2": (4.0, 0.0), "L3": (4.0, 3.0), "L4": (0.0, 3.0), "L5": (20.0, 0.0)}
WAYS = [("L1", "L2", 4.0), ("L2", "L3", 3.0), ("L3", "L4", 4.0), ("L4", "L1", 3.5)]


class Landmarks:
    """A square of landmarks, of which the robot was last at the first; one lies apart."""

    def __init__(self, *, lost=False, views=None):
        self.topological = TopologicalMemory()
        self._views = views or {}
        self.whereabouts = Whereabouts(
            Uncertainty(0.2, 0.25, 0.02, 0.002, 0.003), self.topological.links
        )
        self.carried = 0
        here = Here(Pose(0.0, 0.0, 0.0), True, 0.0, 0.0)
        for name, (x_m, y_m) in PLACES.items():
            self.topological.add_landmark(name, x_m, y_m, 0.0, 0.0)
        for one, other, path_m in WAYS:
            self.topological.traverse(one, other, path_m, 0.0, path_m)
            (ax, ay), (bx, by) = PLACES[one], PLACES[other]
            self.topological.links.relate(one, other, Link(Pose(bx - ax, by - ay, 0.0), 0.01, 0.01))
        if lost:
            self.whereabouts.lose()
        else:
            self.whereabouts.find("L1", here)

    def view_of(self, landmark):
        return self._views.get(landmark)


class Senses:
    """Where the robot is, as a test says; path integration is wrong by `off`."""

    looks_round = True

    def __init__(self):
        self.here = Pose(0.0, 0.0, 0.0)
        self.carried = 0
        self.off = Pose(0.0, 0.0, 0.0)

    def view_of(self, place, *, far=True):
        del far
        return seen_in_room(Pose(place.x_m - self.off.x_m, place.y_m - self.off.y_m, 0.0))


class Nothing:
    """A declarative memory and a landmark module that are not asked."""

    def recall(self, *_):
        return Recall(None, 0.1)

    def harvest(self, *_):
        pass

    def surprise(self, _):
        return 0.0

    def mark(self, _):
        raise AssertionError("nothing is to be marked")


class Led:
    """A wayfinder with the rules that lead, and a body that a test plays."""

    def __init__(self, **landmarks):
        self.landmarks = Landmarks(**landmarks)
        self.senses = Senses()
        self.t_s = 0.0
        self.way = Wayfinder(self.landmarks, self.senses, self._push)
        self.engine = Engine(RULES, Nothing(), Nothing(), self.way)
        self.way.look(0.0)

    def _push(self, chunk):
        self.engine.push("way", chunk, self.t_s)

    def settle(self):
        """Let the rules answer."""
        self.engine.settle()
        self.t_s = max(self.t_s, self.engine.now_s) + 1.0
        self.way.look(self.t_s)
        self.engine.settle()

    def order(self, errand):
        self.way.order(errand)
        self.settle()

    def tell(self, event, reason="none"):
        self.way.tell(event, reason)
        self.settle()

    def arrive(self):
        """Drive to where the command says, and say so; return where that was."""
        to = self.way.command.to
        self.senses.here = Pose(to.x_m, to.y_m, 0.0)
        self.tell("arrived")
        return round(to.x_m, 6), round(to.y_m, 6)

    @property
    def errand(self):
        return self.way.errands[-1]


def test_it_leads_landmark_by_landmark_along_the_shortest_way():
    led = Led()
    led.order("L3")
    assert [led.arrive(), led.arrive()] == [PLACES["L2"], PLACES["L3"]]  # 7.0 m, by L4 7.5 m
    assert led.way.command is None
    assert (led.errand.outcome, led.errand.visited) == ("reached", ("L2", "L3"))
    assert led.errand.ended_s > led.errand.started_s


def test_a_landmark_that_lies_beside_where_it_is_believed_to_be_is_found_by_its_look():
    seen = View("view-of-L2", seen_in_room(Pose(*PLACES["L2"], 0.0)))
    led = Led(views={"L2": seen})
    led.order("L3")
    led.senses.off = Pose(-1.5, 1.2, 0.0)
    assert led.arrive() == PLACES["L2"]
    assert led.errand.visited == ()  # it is not there
    x_m, y_m = led.arrive()
    assert (x_m, y_m) == pytest.approx((2.5, 1.2), abs=0.35)
    assert led.errand.visited == ("L2",)
    assert led.arrive() == pytest.approx((x_m, y_m + 3.0))  # all else is believed to lie so, too
    assert led.errand.outcome == "reached"


def test_it_does_not_look_for_ever():
    led = Led(views={"L2": View("view-of-L2", seen_in_room(Pose(*PLACES["L2"], 0.0)))})
    led.order("L3")
    for i in range(CORRECTIONS):
        led.senses.off = Pose(-1.5 * (i + 1), 0.0, 0.0)
        led.arrive()
        assert led.errand.visited == ()
    led.senses.off = Pose(0.0, 0.0, 0.0)
    led.arrive()
    assert led.errand.visited == ("L2",)


def test_what_is_near_enough_and_too_long_is_said_with_the_command():
    led = Led()
    led.order("L3")
    assert led.way.command.near_m == NEAR_M
    assert led.way.command.limit_m == LONGER * 4.0 + SLACK_M
    led.senses.here = Pose(3.0, 0.0, 0.0)
    led.tell("arrived")
    assert led.way.command.near_m == AT_GOAL_M
    assert led.way.command.limit_m == LONGER * (3.0 + 1.0) + SLACK_M


def test_a_way_found_shut_is_remembered_and_another_one_taken():
    led = Led()
    led.order("L3")
    led.tell("blocked", "shut")
    assert led.landmarks.topological.arc("L1", "L2").closed == 1
    assert led.arrive() == PLACES["L4"]
    assert led.arrive() == PLACES["L3"]
    assert (led.errand.outcome, led.errand.shut) == ("reached", ("L1-L2",))


def test_where_every_way_is_shut_the_errand_fails_with_its_reason():
    led = Led()
    led.order("L3")
    led.tell("blocked", "shut")
    led.tell("blocked", "shut")
    # A way that was never gone may lead there: it is looked for once.
    assert (led.way.command.to.x_m, led.way.command.to.y_m) == PLACES["L3"]
    assert led.way.command.limit_m == ROUND * 5.0 + ROUND_SLACK_M
    led.tell("blocked", "shut")
    assert led.way.command is None
    assert (led.errand.outcome, led.errand.reason) == ("failed", "no-open-way")
    assert led.errand.shut == ("L1-L2", "L1-L4")


def test_where_the_way_straight_to_the_goal_is_shut_it_is_gone_round():
    led = Led()
    led.order("L2")
    led.tell("blocked", "shut")
    assert [led.arrive() for _ in range(3)] == [PLACES[n] for n in ("L4", "L3", "L2")]
    assert (led.errand.outcome, led.errand.shut) == ("reached", ("L1-L2",))


def test_what_was_found_shut_on_an_earlier_errand_is_tried_when_nothing_else_is_left():
    led = Led()
    for ends in (("L1", "L2"), ("L1", "L4")):
        led.landmarks.topological.close(*ends)
    led.order("L2")
    assert led.arrive() == PLACES["L2"]
    assert led.errand.outcome == "reached"


def test_a_landmark_that_nothing_joins_cannot_be_led_to():
    led = Led()
    led.order("L5")
    assert (led.errand.outcome, led.errand.reason) == ("failed", "no-open-way")


def test_home_is_the_landmark_that_was_met_first():
    led = Led()
    led.order("L2")
    led.arrive()
    led.order("home")
    assert led.arrive() == PLACES["L1"]
    assert led.errand.outcome == "reached"


def test_all_landmarks_are_visited_nearest_first_and_what_cannot_be_got_to_is_left_out():
    led = Led()
    led.order("visit-all")
    assert [led.arrive() for _ in range(4)] == [PLACES[n] for n in ("L1", "L4", "L3", "L2")]
    assert led.errand.visited == ("L1", "L4", "L3", "L2")
    assert (led.errand.outcome, led.errand.reason) == ("failed", "left-out")
    assert led.errand.left_out == ("L5",)


def test_a_name_that_memory_has_not_is_refused_with_the_nearest():
    led = Led()
    led.order("L33")
    assert led.errand.outcome == "failed"
    assert led.errand.reason.startswith("no-such-landmark")
    assert "'L3'" in led.errand.reason


def test_a_robot_that_is_lost_looks_about_until_it_knows():
    led = Led(lost=True)
    led.order("L2")
    assert led.way.command.what == "search"
    led.landmarks.whereabouts.find("L1", Here(Pose(0.0, 0.0, 0.0), True, 0.0, 0.0))
    led.landmarks.whereabouts.hypotheses = led.landmarks.whereabouts.hypotheses[:1]
    led.settle()
    assert led.arrive() == PLACES["L2"]
    assert (led.errand.outcome, led.errand.searches) == ("reached", 1)


def test_a_robot_that_was_carried_does_not_drive_on():
    led = Led()
    led.order("L3")
    assert led.way.command.what == "drive"
    led.senses.carried = 1
    led.settle()
    assert led.way.command.what == "search"


def test_a_search_that_finds_nothing_ends_the_errand():
    led = Led(lost=True)
    led.order("L2")
    led.tell("nowhere", "lost")
    assert (led.errand.outcome, led.errand.reason) == ("failed", "lost")


def test_before_and_after_an_errand_there_is_nothing_to_do():
    led = Led()
    assert led.way.command is None
    led.way.tell("arrived")
    assert led.way.errands == []


@pytest.mark.parametrize(
    ("act", "to", "said"),
    [("plan", "L9", "asks to plan 'L9', which is no landmark")],
)
def test_a_step_that_cannot_be_is_an_error(act, to, said):
    led = Led()
    with pytest.raises(EngineError, match="there is no errand"):
        led.way.step(StepRequest(act, to, "", "", "rule", 0.0))
    led.way.order("L2")
    with pytest.raises(EngineError, match=said):
        led.way.step(StepRequest(act, to, "", "", "rule", 0.0))


def test_an_errand_is_plain_data_for_the_manifest():
    led = Led()
    led.order("L2")
    data = led.errand.as_data()
    assert math.isnan(data["ended_s"])
    assert data["visited"] == []
    assert data["order"] == "L2"
