"""When the arcs came: from the marks that follow one another."""

from viewer_runs import results

from ssrics_like.memory.landmark import Arc
from ssrics_like.memory.store import load_topology
from ssrics_like.results.reading import read_records
from ssrics_like.results.records import Reflex
from ssrics_like.viewer.arcs import Came, came


def mark(t_s, landmark, decision="recognised"):
    return Reflex(0, t_s - 1, t_s, 0.0, 0.0, 0.9, "left", "doorway", decision, landmark, "r")


def arc(start, end):
    return Arc(start, end, 1, 1.0, 0.0, 0.0, 0.0, 1.0, 0.0)


def test_an_arc_comes_when_its_landmarks_were_first_marked_one_after_the_other():
    marks = [
        mark(1.0, "L1", "declared"),
        mark(2.0, "", "dismissed"),
        mark(3.0, "L2", "declared"),
        mark(4.0, "", "unsure"),
        mark(5.0, "L1"),
        mark(6.0, "L2"),
    ]
    assert came([arc("L2", "L1"), arc("L1", "L2")], marks) == [
        Came("L1", "L2", 3.0, True),
        Came("L2", "L1", 5.0, True),
    ]


def test_of_an_arc_that_the_marks_do_not_tell_only_the_ends_are_known():
    marks = [mark(1.0, "L1", "declared"), mark(3.0, "L2", "declared"), mark(9.0, "L3", "declared")]
    assert came([arc("L1", "L3"), arc("L0", "L1")], marks) == [
        Came("L0", "L1", 1.0, False),
        Came("L1", "L3", 9.0, False),
    ]


def test_in_a_real_run_nearly_all_arcs_are_known_and_none_comes_before_its_landmarks():
    folder = results("errand")
    run = read_records(folder).runs[0]
    found = came(load_topology(folder / "topology" / "run-000.json").arcs, run.reflexes)
    declared = {r.landmark: r.decided_s for r in run.reflexes if r.decision == "declared"}
    assert all(a.t_s >= max(declared[a.from_id], declared[a.to_id]) for a in found)
    assert sum(a.is_known for a in found) >= 0.8 * len(found) > 0
