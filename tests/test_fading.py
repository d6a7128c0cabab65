"""What is never confirmed fades by decay; what lasts gains permanence.

With the shipped profile and rules. A doorway that looks another (-7) and is perceived astray, so far
as counts for exp(-2.75), must have a base level of -3.25 to be recalled at the threshold of -13: seen
once, it has that for e^6.5 s, 11 minutes, since B = -d ln t: longer than the ten minutes for which the
others are met.
"""

import math

import numpy as np
import pytest

from ssrics_like.library import find
from ssrics_like.memory.measurement import ASTRAY, ASTRAY_M, BOTH
from ssrics_like.modules import LandmarkModules
from ssrics_like.perception.reflex import Reflex
from ssrics_like.poses import Pose
from ssrics_like.productions.engine import Engine
from ssrics_like.productions.rulebook import load_rulebook
from ssrics_like.scenarios.modules import load_memory

STILL = {"activation_noise": 0.0, "place_drift": 0.0, "swerve_drift_rad": 0.0,
         "turn_drift_rad": 0.0, "wheel_bias": 0.0}  # fmt: skip
PROFILE = load_memory("act-r").model_copy(update=STILL)
PLACES = {"L1": (0.0, 0.0), "L2": (20.0, 0.0), "L3": (0.0, 20.0)}
LENGTHS_M = {"L1": 1.0, "L2": 2.0, "L3": 4.0}
STRANGE_M = 5.9


class Mind:
    """Memories and rules that meet the doorways that a test says."""

    def __init__(self, look=lambda _: np.zeros(108, np.float32)):
        self.decisions, self.retrievals = [], []
        self.modules = LandmarkModules(
            PROFILE, np.random.default_rng(0), self.decisions.append,
            lambda _, retrieval: self.retrievals.append(retrieval), look=look,
        )  # fmt: skip
        self.engine = Engine(
            load_rulebook(find("productions", "landmark")), self.modules, self.modules
        )
        self.events = 0

    def meet(self, landmark, t_s, astray_m=0.0, length_m=None, vista_m=0.0):
        """Meet a doorway; return what was decided about it."""
        x_m, y_m = PLACES[landmark]
        here = Pose(x_m + astray_m, y_m, 0.0)
        view = self.view(length_m or LENGTHS_M[landmark], vista_m)
        reflex = Reflex(
            event=self.events, scan=self.events, t_s=t_s, pose=here, true_pose=None,
            perceived_s=t_s, travelled_m=20.0 * self.events, modality="laser", novelty=0.9,
            sector="front", structure="doorway", place=here, directed=True, turned_rad=0.0,
            carried=0, view=view,
        )  # fmt: skip
        self.events += 1
        self.engine.push("orienting", self.modules.admit(reflex), t_s)
        self.engine.settle()
        made = self.decisions[-1]
        return made.decision, made.landmark

    @staticmethod
    def view(length_m, vista_m=0.0):
        return np.repeat([length_m, 0.0, vista_m], 36).astype(np.float32)

    def strangely(self, landmark, t_s):
        """Meet a doorway that looks another, as far astray as counts for exp(-2.75)."""
        astray_m = ASTRAY_M * math.sqrt(2 * (2.75 + math.log(ASTRAY + BOTH)))
        return self.meet(landmark, t_s, astray_m, STRANGE_M)


def mind():
    """L1 and L3 met in turns for ten minutes, L2 once in the second."""
    made = Mind()
    times_s = range(0, 601, 60)
    names = ["L1", "L2", *["L3", "L1"] * 5][: len(times_s)]
    for name, t_s in zip(names, times_s, strict=True):
        what = "declared" if name not in made.modules.topological else "recognised"
        assert made.meet(name, float(t_s)) == (what, name)
    return made


def test_what_is_recognised_again_and_again_stays_and_gains_permanence():
    modules = mind().modules
    assert [node.visits for node in modules.topological.nodes] == [5, 1, 5]
    for later_s in (700.0, 3600.0, 86400.0):
        levels = [modules.declarative.base_level(name, later_s) for name in ("L1", "L2")]
        assert levels[0] > levels[1]
        assert modules.appraisal.permanence("L1", later_s) > modules.appraisal.permanence(
            "L2", later_s
        )
    # It has lasted nine minutes and will probably last as many more; the other was there once.
    assert modules.appraisal.permanence("L1", 1080.0) > 0.5
    assert modules.appraisal.permanence("L2", 1080.0) == pytest.approx(60 / (60 + 1020), abs=1e-3)


def test_what_is_seen_more_of_a_landmark_is_remembered_where_the_robot_knows_to_be():
    made = mind()
    for vista_m in (20.0, 15.0):
        assert made.meet("L1", 700.0 + vista_m, vista_m=vista_m) == ("recognised", "L1")
    assert made.modules.view_of("L1").descriptor == pytest.approx(made.view(1.0, 15.0))
    assert made.modules.view_of("L3").descriptor == pytest.approx(made.view(4.0))
    made.modules.whereabouts.lose()  # what it takes for L1 may be another place
    made.meet("L1", 800.0, vista_m=30.0)
    assert made.modules.view_of("L1").descriptor == pytest.approx(made.view(1.0, 15.0))


def last_term(made, landmark):
    """The terms of a landmark in the last retrieval."""
    (row,) = (row for row in made.retrievals[-1].candidates.rows() if row.name == landmark)
    return row


@pytest.fixture(scope="module")
def strangeness():
    """How much is taken from L2's activation where it is met strangely."""
    made = mind()
    made.strangely("L2", 1000.0)
    mismatch = -last_term(made, "L2").partial_match
    # Where L2 lies is known to a few centimetres only, so that being astray counts a little less.
    assert 9.5 < mismatch < 10.0
    return mismatch


@pytest.mark.parametrize(("share", "recalled"), [(0.95, True), (1.05, False)])
def test_seen_once_and_never_confirmed_it_is_forgotten_when_the_formula_says(
    strangeness, share, recalled
):
    made = mind()
    (stored_s,) = made.modules.declarative.references("L2")
    age_s = share * math.exp(2 * (13 - strangeness))
    made.strangely("L2", stored_s + age_s)
    # A retrieval begins 50 ms after a doorway is met.
    assert last_term(made, "L2").base_level == pytest.approx(-0.5 * math.log(age_s), abs=1e-3)
    assert (made.retrievals[-1].chunk is not None) == recalled


def test_forgotten_for_good_it_is_declared_anew_where_what_lasted_is_known_again(strangeness):
    # Nothing is recalled with .7 of the odds: A < -13 - ln(7/3).
    age_s = 1.05 * math.exp(2 * (13 - strangeness + math.log(7 / 3)))
    assert mind().strangely("L2", 60.0 + age_s) == ("declared", "L4")
    made = mind()
    made.strangely("L1", 600.0 + age_s)
    assert made.retrievals[-1].chunk.name == "L1"


def test_where_it_was_and_as_it_looked_it_is_known_for_years():
    assert mind().meet("L2", 1e8) == ("recognised", "L2")  # three years


def test_who_goes_through_a_landmark_and_does_not_see_it_trusts_it_less(monkeypatch):
    monkeypatch.setitem(PLACES, "L2", (6.0, 0.0))  # near enough to be known well
    mind = Mind()
    for i, name in enumerate(["L1", "L2"] * 3 + ["L1"]):
        assert mind.meet(name, 20.0 * i)[1] == name
    # Seen at 20, 60 and 100 s: it has lasted 80 s, and none of its two later chances was missed.
    permanence = mind.modules.appraisal.permanence
    assert permanence("L2", 150.0) == pytest.approx(140.0 / (140.0 + 50.0))
    for step in range(120):  # from L1 along the way, and past where L2 was
        mind.modules.go(Pose(0.1 * step, 0.0, 0.0), 140.0 + 0.1 * step)
    node = mind.modules.topological["L2"]
    assert (node.missed, node.missed_since) == (0, 1)
    assert permanence("L2", 150.0) == pytest.approx(140.0 / 4 / (140.0 / 4 + 50.0))
    mind.meet("L2", 160.0)
    node = mind.modules.topological["L2"]
    assert (node.missed, node.missed_since) == (1, 0)


@pytest.mark.parametrize("length_m", [LENGTHS_M["L2"], STRANGE_M])
def test_a_doorway_perceived_beside_where_it_was_is_known_by_what_surrounds_that_place(length_m):
    looked = []
    made = Mind(lambda place: looked.append(place) or Mind.view(length_m))
    for i, name in enumerate(["L1", "L2", "L1", "L2"]):
        assert made.meet(name, 20.0 * i)[1] == name
    assert not looked  # they were where they had been
    known = made.meet("L2", 100.0, 0.7, STRANGE_M)
    assert {(round(place.x_m, 2), round(place.y_m, 2)) for place in looked} == {(20.0, 0.0)}
    assert (known == ("recognised", "L2")) == (length_m == LENGTHS_M["L2"])
