"""A model that goes on from what an earlier run remembered."""

import math

import pytest
from saved_memories import memory
from test_model import MEMORY, PERCEPTION, drive, landmark_model, observe

from ssrics_like import CognitiveModel
from ssrics_like.library import find
from ssrics_like.memory import load_memory_file, save_memory_file
from ssrics_like.productions.rulebook import load_rulebook

STOPS = [(0.0, 1), (10.0, 2), (0.0, 1), (10.0, 2)]
# So far off that a robot that does not know where it is has to find out that it was never there.
ELSEWHERE = [(500.0 + 17.0 * i + i * i, 11 + i) for i in range(9)]


def first_run():
    model = landmark_model()
    drive(model, STOPS)
    return model


def later(model, *, pause_s=0.0, tmp_path=None):
    """What a file would hold of a model, some time later."""
    saved = model.saved_memory("one")
    if tmp_path is not None:
        save_memory_file(saved, tmp_path / "run.json")
        saved = load_memory_file(tmp_path / "run.json")
    return saved.aged(pause_s)


def test_the_second_run_knows_the_landmarks_of_the_first_and_counts_on(tmp_path):
    first = first_run()
    model = landmark_model(remembered=later(first, tmp_path=tmp_path))
    assert [node.id for node in model.topological.nodes] == ["L1", "L2"]
    assert model.declarative.names == first.declarative.names
    assert [(way.from_id, way.to_id) for way in model.topological.arcs] == [
        (way.from_id, way.to_id) for way in first.topological.arcs
    ]
    declared = [d.landmark for d in drive(model, ELSEWHERE) if d.decision == "declared"]
    assert declared == [f"L{number}" for number in range(3, 3 + len(declared))]
    assert declared


@pytest.mark.parametrize("pause_s", [0.0, 3600.0])
def test_base_levels_go_on_from_where_they_were(tmp_path, pause_s):
    first = first_run()
    second = landmark_model(remembered=later(first, pause_s=pause_s, tmp_path=tmp_path))
    for name in ("L1", "L2"):
        for t_s in (0.0, 0.05, 60.0):
            before = first.declarative.base_level(name, first.now_s + pause_s + t_s)
            assert second.declarative.base_level(name, t_s) == pytest.approx(before, abs=1e-6)
    # The first references are those of the first run; they are older than this run.
    assert (second.declarative.references("L1") < 0).all()


def test_a_use_in_the_second_run_adds_to_those_of_the_first():
    """B = ln(sum of age^-d) over the references of both runs."""
    kept = later(first_run(), pause_s=50.0)
    model = landmark_model(remembered=kept)
    model.declarative.strengthen("L1", 4.0)
    ages_s = [*(age_s + 10.0 for age_s in kept.chunks[0].ages_s), 6.0]
    expected = math.log(sum(age_s**-0.5 for age_s in ages_s))
    assert model.declarative.base_level("L1", 10.0) == pytest.approx(expected)


def test_landmarks_have_their_times_on_the_clock_of_the_new_source():
    first = first_run()  # its last scan is at 31 s; L1 was marked in the first interval
    marked_s = first.topological["L1"].t_s
    second = landmark_model(remembered=later(first, pause_s=100.0))
    second.observe(observe(0, 5000.0, 10.0, 2))
    assert second.topological["L1"].t_s == pytest.approx(5000.0 - 100.0 - (first.now_s - marked_s))


def test_landmarks_know_the_run_that_declared_them_however_often_they_are_saved():
    second = landmark_model(remembered=later(first_run()))
    drive(second, ELSEWHERE)
    saved = second.saved_memory("two")
    new = [node.id for node in second.topological.nodes][2:]
    assert saved.origins == {"L1": "one/L1", "L2": "one/L2", **{n: f"two/{n}" for n in new}}
    assert new
    assert [run.id for run in saved.runs] == ["one", "two"]
    assert saved.runs[0].ended_ago_s == pytest.approx(second.now_s)
    with pytest.raises(ValueError, match="run 'one' stands in it twice"):
        second.saved_memory("one")


def test_saving_at_once_loses_nothing(tmp_path):
    kept = later(first_run(), tmp_path=tmp_path)
    again = landmark_model(remembered=kept).saved_memory("two")
    assert (again.landmarks, again.chunks, again.origins) == (
        kept.landmarks, kept.chunks, kept.origins,
    )  # fmt: skip


def test_names_go_on_from_the_highest_number_whatever_is_missing():
    model = landmark_model(remembered=memory(2, 9, chunks=()))
    assert [d.landmark for d in drive(model, [(500.0, 1)])] == ["L10"]


def test_a_memory_of_another_sense_or_frame_is_refused():
    with pytest.raises(ValueError, match="its views have 36 numbers, those of this model 12"):
        landmark_model(remembered=memory())
    with pytest.raises(ValueError, match="in the frame 'map', those of this run in 'odometry'"):
        landmark_model(remembered=memory(chunks=(), frame="map"))


def test_a_rule_set_without_declarative_memory_keeps_its_graph():
    book = load_rulebook(find("productions", "report"))
    first = CognitiveModel(PERCEPTION, book, MEMORY)
    drive(first, STOPS)
    saved = first.saved_memory("one")
    assert len(saved.landmarks) == len(first.topological) > 0
    assert saved.chunks == ()
    second = CognitiveModel(PERCEPTION, book, MEMORY, remembered=saved)
    assert [node.id for node in second.topological.nodes] == list(saved.origins)


def test_a_model_that_saw_nothing_has_a_memory_all_the_same():
    saved = landmark_model().saved_memory("one")
    assert (saved.chunks, saved.landmarks, saved.saved_s) == ((), (), 0.0)
