"""The model as a whole: online, one observation at a time."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

import ssrics_like
from ssrics_like import CognitiveModel, LaserScan, Observation, Pose
from ssrics_like.errors import EngineError
from ssrics_like.library import find
from ssrics_like.memory.profile import MemoryProfile
from ssrics_like.perception.profile import PerceptionProfile
from ssrics_like.productions.rulebook import load_rulebook

BEAMS = 60
# Short intervals that follow one another, so that a handful of scans makes a reflex.
PERCEPTION = PerceptionProfile(
    interval=2, advance="tumbling", mark="every", anchor="newest", repair_window=0, view_beams=12
)
# No noise, no threshold to speak of: what is recalled is decided by place alone.
MEMORY = MemoryProfile(
    retrieval_threshold=-6.5,
    latency_factor=0.001,
    max_difference=-8.0,
    activation_noise=0.0,
    place_sigma_m=0.5,
)


def observe(index, t_s, x_m, view, y_m=0.0, theta_rad=0.0):
    """Return an observation of one of a few views; different views do not correlate."""
    ranges = 2.0 + np.random.default_rng(view).random(BEAMS)
    scan = LaserScan(ranges, -math.pi / 2, math.pi / BEAMS)
    return Observation(index, t_s, Pose(x_m, y_m, theta_rad), scan)


def drive(model, stops):
    """Pass each (x, view, other view): the change between the two is what is novel."""
    decisions = []
    for i, (x_m, view) in enumerate(stops):
        decisions += model.observe(observe(2 * i, 10.0 * i, x_m, view))
        decisions += model.observe(observe(2 * i + 1, 10.0 * i + 1.0, x_m, view + 1000))
    return decisions + model.finish()


def landmark_model(**kwargs):
    return CognitiveModel(
        PERCEPTION, load_rulebook(find("productions", "landmark")), MEMORY, **kwargs
    )


def test_a_place_is_declared_once_and_recognised_when_met_again():
    model = landmark_model()
    decisions = drive(model, [(0.0, 1), (10.0, 2), (0.1, 1), (10.1, 2)])
    assert [d.decision for d in decisions] == ["declared", "declared", "recognised", "recognised"]
    assert [d.landmark for d in decisions] == ["L1", "L2", "L1", "L2"]
    assert [d.rule for d in decisions] == ["declare", "declare", "recognise", "recognise"]
    assert len(model.topological) == 2
    assert {node.id: node.visits for node in model.topological.nodes} == {"L1": 2, "L2": 2}


def test_the_arcs_hold_distance_and_direction_of_each_way_driven():
    model = landmark_model()
    drive(model, [(0.0, 1), (10.0, 2), (0.0, 1), (10.0, 2)])
    there, back = model.topological.arc("L1", "L2"), model.topological.arc("L2", "L1")
    assert (there.traversals, back.traversals) == (2, 1)
    assert there.distance_m == pytest.approx(10.0)
    assert there.path_m == pytest.approx(10.0)
    assert there.bearing_rad == pytest.approx(0.0)
    assert abs(back.bearing_rad) == pytest.approx(math.pi)


def tour(model, poses):
    """Stand at each pose long enough for one novel interval, and for deciding about it."""
    decisions = []
    for i, (x_m, y_m, theta_rad, view) in enumerate(poses):
        for j in (0, 1):
            seen = view + 1000 * j
            decisions += model.observe(observe(2 * i + j, 10.0 * i + j, x_m, seen, y_m, theta_rad))
    return decisions + model.finish()


def test_the_direction_of_an_arc_is_relative_to_the_heading_on_leaving():
    model = landmark_model()
    # Heading north at the origin, the next landmark lies to the east: to the right.
    tour(model, [(0.0, 0.0, math.pi / 2, 1), (5.0, 0.0, math.pi, 2), (5.0, 5.0, 0.3, 3)])
    assert model.topological.arc("L1", "L2").bearing_rad == pytest.approx(-math.pi / 2)
    # Heading west there, the third lies to the north: to the right again.
    assert model.topological.arc("L2", "L3").bearing_rad == pytest.approx(-math.pi / 2)


def test_an_arc_knows_the_way_driven_and_the_straight_line():
    model = landmark_model()
    bored = [(4.0, 0.0), (4.0, 3.0)]  # driven through, but seeing the same all the time
    poses = [(0.0, 0.0, 0.0, 1), *[(x, y, 0.0, 7) for x, y in bored], (0.0, 3.0, 0.0, 2)]
    decisions = []
    for i, (x_m, y_m, theta_rad, view) in enumerate(poses):
        for j in (0, 1):
            seen = view + (1000 * j if view != 7 else 0)
            decisions += model.observe(observe(2 * i + j, 10.0 * i + j, x_m, seen, y_m, theta_rad))
    decisions += model.finish()
    assert [d.decision for d in decisions] == ["declared", "declared"]
    arc = model.topological.arc("L1", "L2")
    assert arc.distance_m == pytest.approx(3.0)
    assert arc.path_m == pytest.approx(4.0 + 3.0 + 4.0)


def test_the_way_driven_is_that_between_the_places_not_between_the_reflexes():
    """With the oldest scan for an anchor a reflex fires one step after its place."""
    late = PERCEPTION.model_copy(update={"anchor": "oldest"})
    model = CognitiveModel(late, load_rulebook(find("productions", "landmark")), MEMORY)
    for i, x_m in enumerate([0.0, 1.0, 10.0, 14.0]):
        model.observe(observe(i, 10.0 * i, x_m, i))
    model.finish()
    assert model.topological.arc("L1", "L2").path_m == pytest.approx(10.0)


def test_a_visit_is_counted_when_the_robot_comes_back_not_while_it_stays():
    model = landmark_model()
    decisions = tour(
        model, [(0, 0, 0, 1), (0.1, 0, 0, 1), (0.2, 0, 0, 1), (9, 0, 0, 2), (0.1, 0, 0, 1)]
    )
    assert [d.landmark for d in decisions] == ["L1", "L1", "L1", "L2", "L1"]
    assert {node.id: node.visits for node in model.topological.nodes} == {"L1": 2, "L2": 1}
    assert len(model.declarative.references("L1")) == 4


@pytest.mark.parametrize(("frame", "decision"), [("odometry", "recognised"), ("map", "declared")])
def test_only_odometry_drifts(frame, decision):
    drifting = MEMORY.model_copy(update={"wheel_bias": 0.05, "retrieval_threshold": -13.0})
    model = CognitiveModel(
        PERCEPTION, load_rulebook(find("productions", "landmark")), drifting, frame=frame
    )
    # 30 m to the other landmark and back: odometry may be off by 3 m, a mark by half a metre.
    (_, _, back) = tour(model, [(0, 0, 0, 1), (30, 0, 0, 2), (3.0, 0, 0, 1)])
    assert back.decision == decision


def test_confidence_is_the_share_of_the_odds():
    noisy = MEMORY.model_copy(update={"activation_noise": 0.5, "retrieval_threshold": -3.0})
    asked = []
    model = CognitiveModel(
        PERCEPTION, load_rulebook(find("productions", "landmark")), noisy, seed=3,
        retrieved=lambda _, retrieval: asked.append(retrieval),
    )  # fmt: skip
    decisions = tour(model, [(0.5 * (i % 5), 0, 0, i % 2) for i in range(24)])
    assert {d.decision for d in decisions} == {"declared", "recognised", "unsure"}
    looks = []
    for decision, retrieval in zip(decisions, asked, strict=True):
        odds = {row.name: math.exp(row.total - row.noise) for row in retrieval.candidates.rows()}
        recalled = retrieval.chunk
        mine = math.exp(-3.0) if recalled is None else odds[recalled.name]
        share = mine / (math.exp(-3.0) + sum(odds.values()))
        found = retrieval.candidates
        now = dict(zip(found.names, found.by_context, strict=True))
        looks.append(now)
        # A robot in doubt that stays in one place takes the mean of its looks there.
        means = [
            np.array([np.mean([look.get(name, now[name]) for look in looks[i:]]) for name in now])
            for i in range(len(looks))
        ]
        in_doubt = [retrieval.share_of(mean, found.threshold_by_context) for mean in means]
        assert decision.confidence in [pytest.approx(each) for each in (share, *in_doubt)]
        sure = decision.confidence > (0.7 if recalled is None else 0.8)
        kind = "declared" if recalled is None else "recognised"
        assert decision.decision == (kind if sure else "unsure")
        best = retrieval.candidates.best
        assert decision.activation == (best.total if best else None)


@pytest.mark.parametrize("rules", ["report", "landmark"])
@pytest.mark.parametrize("step_s", [0.0125, 0.025, 0.05])
def test_scans_may_come_at_the_very_moment_a_rule_fires(rules, step_s):
    """A rule fires 50 ms after a reflex; what it does must be done before the next comes in."""
    model = CognitiveModel(PERCEPTION, load_rulebook(find("productions", rules)), MEMORY)
    decisions = []
    for i in range(200):
        decisions += model.observe(observe(i, step_s * i, 0.1 * i, i))
    decisions += model.finish()
    assert sorted(d.event for d in decisions) == list(range(100))


def test_a_retrieval_may_take_minutes():
    slow = MEMORY.model_copy(update={"retrieval_threshold": -13.0})
    model = CognitiveModel(PERCEPTION, load_rulebook(find("productions", "landmark")), slow)
    (decision,) = drive(model, [(0.0, 1)])
    assert decision.decided_s == pytest.approx(1.1 + 0.001 * math.exp(13.0), abs=1e-3)


def test_a_rule_may_ask_by_the_place_of_a_landmark(tmp_path):
    """The handle of a chunk's place finds that landmark alone, and may be kept in another chunk."""
    text = find("productions", "landmark").read_text()
    before = "      =retrieval>\n          isa landmark\n          id =landmark\n"
    assert text.count(before) == 1
    path = tmp_path / "again.yaml"
    path.write_text(
        text.replace(before, before + "          place =place\n")
        .replace(
            "      +landmark>\n          isa mark\n          outcome recognised",
            "      +imaginal>\n          isa landmark\n          place =place\n"
            "      +landmark>\n          isa mark\n          outcome recognised",
        )
        .replace("harvest: [retrieval, landmark]", "harvest: [retrieval, landmark, imaginal]")
    )
    model = CognitiveModel(PERCEPTION, load_rulebook(path), MEMORY)
    decisions = drive(model, [(0.0, 1), (10.0, 2), (0.0, 1), (10.0, 2)])
    assert [d.decision for d in decisions] == ["declared"] * 2 + ["recognised"] * 2
    kept = [model.declarative[name].slots for name in model.declarative.names]
    assert {"place": "place-of-L1"} in kept


def test_recognising_strengthens_the_landmarks_chunk():
    model = landmark_model()
    drive(model, [(0.0, 1), (10.0, 2), (0.0, 1)])
    assert len(model.declarative.references("L1")) == 2
    assert len(model.declarative.references("L2")) == 1


def test_a_mark_has_the_place_of_perceiving_and_the_time_of_deciding():
    model = landmark_model()
    (decision,) = drive(model, [(3.0, 1)])
    assert (decision.scan, decision.t_s, decision.pose.x_m) == (1, 1.0, 3.0)
    # Attending takes 50 ms, failing to recall latency_factor * exp(6.5) s, declaring 50 ms.
    waited = 0.05 + round(0.001 * math.exp(6.5), 3) + 0.05
    assert decision.decided_s == pytest.approx(1.0 + waited, abs=1e-3)
    assert decision.confidence == 1.0
    assert decision.activation is None


def test_decisions_come_online_not_only_at_the_end():
    model = landmark_model()
    assert model.observe(observe(0, 0.0, 0.0, 1)) == []
    assert model.observe(observe(1, 1.0, 0.0, 1001)) == []
    assert model.decisions_pending == 1
    (decision,) = model.observe(observe(2, 11.0, 5.0, 2))
    assert decision.decision == "declared"
    assert model.decisions_pending == 0


def test_reflexes_that_come_too_fast_overwrite_each_other_and_are_counted():
    model = landmark_model()
    decisions = []
    for i in range(40):  # a reflex every 20 ms, a decision takes seconds
        decisions += model.observe(observe(i, 0.01 * i, 0.0, i))
    decisions += model.finish()
    outcomes = [d.decision for d in decisions]
    assert len(decisions) == 20
    assert outcomes.count("overwritten") == 18
    assert all(d.rule == "" and d.landmark == "" for d in decisions if d.decision == "overwritten")
    assert {d.event for d in decisions} == set(range(20))


RULES = """\
title: Odd
chunk_types:
  reflex: [event]
  mark: [outcome, event, landmark]
  task: [state]
goal: {{isa: task, state: watch}}
harvest: []
rules:
  - name: odd
    why: To see what comes of it.
    rule: |
      =g> isa task state watch
      =orienting> isa reflex event =event
      ==>
{actions}
"""


def odd_model(tmp_path, actions, perception=PERCEPTION):
    path = tmp_path / "odd.yaml"
    path.write_text(RULES.format(actions="".join(f"      {line}\n" for line in actions)))
    return CognitiveModel(perception, load_rulebook(path), MEMORY)


def test_a_reflex_that_was_attended_but_left_in_its_buffer_is_not_overwritten(tmp_path):
    actions = ["=g> isa task state done", "+landmark> isa mark outcome declared event =event"]
    model = odd_model(tmp_path, actions)
    decisions = drive(model, [(0.0, 1), (10.0, 2), (20.0, 3)])
    # The first is decided, the second overwritten by the third, the third never attended to.
    assert [(d.event, d.decision) for d in decisions] == [(0, "declared"), (1, "overwritten")]
    assert model.decisions_pending == 1


def test_a_reflex_overwritten_by_the_last_one_is_reported(tmp_path):
    peaks = PERCEPTION.model_copy(update={"mark": "peak"})
    model = odd_model(tmp_path, ["=g> isa task state done", "~orienting>"], peaks)
    views = [1, 2, 3, 3, 4, 5, 6, 6, 7, 8]  # novel, bored, novel, bored, and novel at the end
    decisions = []
    for i, view in enumerate(views):
        decisions += model.observe(observe(i, float(i), 0.0, view))
    decisions += model.finish()
    # The first was attended to for nothing, the last never.
    assert [(d.event, d.decision) for d in decisions] == [(1, "overwritten")]
    assert model.decisions_pending == 2


@pytest.mark.parametrize(
    ("action", "said"),
    [
        (
            "+landmark> isa mark outcome declared event none",
            "rule 'odd': decides about event 'none'",
        ),
        (
            "+landmark> isa mark outcome recognised event =event landmark L9",
            "rule 'odd': recognises 'L9', which is no landmark",
        ),
    ],
)
def test_a_rule_that_decides_nonsense_is_named(tmp_path, action, said):
    with pytest.raises(EngineError, match=said):
        drive(odd_model(tmp_path, [action, "~orienting>"]), [(0.0, 1)])


def test_report_rules_dismiss_a_novel_interval_in_the_same_sector():
    model = CognitiveModel(
        PERCEPTION.model_copy(update={"sector_rule": "maximum"}),
        load_rulebook(find("productions", "report")),
        MEMORY,
    )
    decisions = drive(model, [(0.0, 1), (10.0, 1), (20.0, 1)])
    assert [d.decision for d in decisions] == ["declared", "dismissed", "dismissed"]
    assert all(d.activation is None and d.confidence is None for d in decisions)
    assert len(model.declarative) == 0


def test_models_with_other_rules_can_take_turns_in_one_process():
    alone = drive(landmark_model(), [(0.0, 1), (10.0, 2), (0.0, 1)])
    model = landmark_model()
    other = CognitiveModel(PERCEPTION, load_rulebook(find("productions", "report")), MEMORY)
    decisions = []
    for i, (x_m, view) in enumerate([(0.0, 1), (10.0, 2), (0.0, 1)]):
        for j in (0, 1):
            observation = observe(2 * i + j, 10.0 * i + j, x_m, view + 1000 * j)
            decisions += model.observe(observation)
            other.observe(observation)
    assert decisions + model.finish() == alone


def test_same_seed_same_decisions():
    noisy = MEMORY.model_copy(update={"activation_noise": 1.0})
    book = load_rulebook(find("productions", "landmark"))
    stops = [(3.0 * (i % 5), i % 4) for i in range(30)]

    def run(seed):
        return drive(CognitiveModel(PERCEPTION, book, noisy, seed=seed), stops)

    assert run(5) == run(5)
    assert run(5) != run(6)


def test_observations_must_not_go_back_in_time():
    model = landmark_model()
    model.observe(observe(0, 5.0, 0.0, 1))
    with pytest.raises(ValueError, match="must come in order of time"):
        model.observe(observe(1, 4.0, 0.0, 1))


def test_finishing_without_any_observation_gives_nothing():
    assert landmark_model().finish() == []


@settings(max_examples=25, deadline=None)
@given(
    st.lists(
        st.tuples(
            st.floats(0.0, 3.0),
            st.floats(-50.0, 50.0),
            st.integers(0, 5),
            st.sampled_from([0.0, math.nan, math.inf, 1.0]),
        ),
        max_size=40,
    )
)
def test_every_reflex_is_decided_exactly_once_whatever_comes(steps):
    model = landmark_model()
    decisions, t_s = [], 0.0
    for i, (pause_s, x_m, view, spoil) in enumerate(steps):
        t_s += pause_s
        observation = observe(i, t_s, x_m, view)
        if spoil != 1.0:
            observation.scan.ranges_m[::3] = spoil
        decisions += model.observe(observation)
    decisions += model.finish()
    assert model.decisions_pending == 0
    assert sorted(d.event for d in decisions) == list(range(len(decisions)))
    for d in decisions:
        assert d.decided_s >= d.t_s
        assert 0.0 <= d.novelty <= 1.0
        assert (d.landmark != "") == (d.decision in ("declared", "recognised"))
    declared = [d.landmark for d in decisions if d.decision == "declared"]
    assert [node.id for node in model.topological.nodes] == declared


def test_public_names_are_what_they_say():
    for name in ssrics_like.__all__:
        assert getattr(ssrics_like, name).__name__ == name
    with pytest.raises(AttributeError, match="no attribute 'nothing'"):
        _ = ssrics_like.nothing
