"""Two memories made one: joined by origin, references counted once, the rest side by side."""

from dataclasses import replace

import pytest
from hypothesis import given
from saved_memories import arc, chunk, landmark, memories, memory

from ssrics_like.memory import Chunk, PastRun, RememberedChunk
from ssrics_like.memory.merging import merge


def gone_on(before, run, lasted_s, *numbers, uses=None):
    """A run that began with a memory, used some of it, and declared landmarks."""
    uses = uses or {}
    aged = before.aged(lasted_s)
    chunks = [
        replace(each, ages_s=(*each.ages_s, *uses.get(each.chunk.name, ()))) for each in aged.chunks
    ]
    return replace(
        aged,
        runs=(*aged.runs, PastRun(run, 0.0)),
        chunks=(*chunks, *(chunk(n, 4.0) for n in numbers)),
        landmarks=(*aged.landmarks, *(landmark(n) for n in numbers)),
        origins={**aged.origins, **{f"L{n}": f"{run}/L{n}" for n in numbers}},
    )


def ages(merged):
    return {each.chunk.name: each.ages_s for each in merged.memory.chunks}


def test_a_landmark_that_both_have_is_one_with_the_references_of_both():
    common = memory(1, 2)
    one = gone_on(common, "b", 100.0, uses={"L1": (30.0,)})
    other = gone_on(common, "c", 500.0, uses={"L1": (70.0, 20.0)})
    merged = merge(one, other)
    assert merged.joined == {"L1": "L1", "L2": "L2"}
    assert merged.renamed == {}
    # 60 s and 12.5 s before the end of the common run, 100 s ago: once, as the first has them.
    assert ages(merged)["L1"] == (160.0, 112.5, 70.0, 30.0, 20.0)
    assert ages(merged)["L2"] == (160.0, 112.5)


def test_references_of_the_last_common_run_are_told_from_new_ones_of_the_same_age():
    common = memory(1)
    one = gone_on(common, "b", 100.0)
    other = gone_on(common, "c", 200.0, uses={"L1": (160.0,)})  # the age that `one` knows
    assert ages(merge(one, other))["L1"] == (160.0, 160.0, 112.5)


def test_landmarks_of_another_origin_get_the_next_numbers_and_stay_apart():
    other = memory(1, 2, run="run-b")
    merged = merge(memory(1, 2, 3), other)
    assert merged.renamed == {"L1": "L4", "L2": "L5"}
    assert [node.id for node in merged.memory.landmarks] == ["L1", "L2", "L3", "L4", "L5"]
    ends = [(way.from_id, way.to_id) for way in merged.memory.arcs]
    assert ends == [("L1", "L2"), ("L2", "L3"), ("L4", "L5")]
    assert merged.memory.origins["L4"] == "run-b/L1"
    held = {each.chunk.name: each.chunk for each in merged.memory.chunks}
    assert held["L4"].slots["id"] == "L4"
    assert held["L4"].slots["view"] == other.chunks[0].chunk.slots["view"]


def test_handles_follow_the_name_of_their_landmark():
    other = memory(1, run="b", chunks=(chunk(1, place="place-of-L1", note="place-of-L12"),))
    slots = merge(memory(1, 2), other).memory.chunks[-1].chunk.slots
    assert (slots["place"], slots["note"]) == ("place-of-L3", "place-of-L12")


def test_names_that_are_taken_by_anything_are_passed_over():
    odd = RememberedChunk(Chunk("L4", "task", {"state": "watch"}), (1.0,))
    other = memory(1, run="run-b", chunks=(odd, chunk(1)))
    merged = merge(memory(1, 2, 3), other)
    assert merged.renamed == {"L1": "L5"}
    assert [each.chunk.name for each in merged.memory.chunks][-2:] == ["L4", "L5"]


def test_an_arc_that_both_have_keeps_the_estimate_that_was_gone_more_often():
    common = memory(1, 2)
    more = replace(gone_on(common, "c", 5.0), arcs=(arc(1, 2, 3, 2.5), arc(2, 1, 1)))
    for one, other in [(common, more), (more, common)]:
        arcs = merge(one, other).memory.arcs
        assert [(way.from_id, way.traversals) for way in arcs] == [("L1", 3), ("L2", 1)]


def test_the_newer_visit_has_the_last_word():
    common = memory(1)
    new = replace(gone_on(common, "c", 5.0), landmarks=(landmark(1, visits=4, last_visit_s=-1.0),))
    for one, other in [(common, new), (new, common)]:
        (node,) = merge(one, other).memory.landmarks
        assert (node.visits, node.last_visit_s) == (4, -1.0)


def test_what_one_missed_before_the_other_saw_it_counts_as_before():
    common = memory(1)
    last_s = common.landmarks[0].last_visit_s - 5.0

    def merged(one, other):
        """Both ways round: misses before the last visit and since."""
        mine, yours = (
            replace(gone_on(common, run, 5.0), landmarks=(landmark(1, **changes),))
            for run, changes in (("b", one), ("c", other))
        )
        found = [merge(*both).memory.landmarks for both in ((mine, yours), (yours, mine))]
        assert found[0] == found[1]
        return found[0][0].missed, found[0][0].missed_since

    unseen = {"last_visit_s": last_s, "missed": 1, "missed_since": 4}
    seen = {"last_visit_s": -1.0, "visits": 4, "missed": 2, "missed_since": 1}
    assert merged(unseen, seen) == (5, 1)
    assert merged({**unseen, "missed_since": 0}, seen) == (2, 1)
    # Neither has seen it since they parted; how much of what they missed is common is not known.
    assert merged(unseen, {**unseen, "missed": 2, "missed_since": 1}) == (2, 4)


def test_other_chunks_are_joined_if_they_are_equal_or_from_a_common_run():
    task = RememberedChunk(Chunk("task-0", "task", {"state": "watch"}), (9.0,))
    common = memory(1, chunks=(chunk(1), task))
    again = merge(gone_on(common, "b", 100.0), gone_on(common, "c", 50.0))
    assert ages(again)["task-0"] == (109.0,)
    stranger = memory(1, run="d", chunks=(replace(task, ages_s=(2.0,)),))
    assert ages(merge(common, stranger))["task-0"] == (9.0, 2.0)
    unlike = replace(task, chunk=Chunk("task-0", "task", {"state": "store", "last": "L1"}))
    merged = merge(common, memory(1, run="d", chunks=(unlike,)))
    new = merged.memory.chunks[-1].chunk
    assert (new.name, new.slots["last"]) == ("task-1", "L2")  # its L1 is called L2 now


def test_all_runs_are_remembered_so_that_a_third_memory_can_be_joined():
    common = memory(1)
    b, c = gone_on(common, "b", 100.0, 2), gone_on(common, "c", 50.0, 2)
    both = merge(b, c).memory
    assert [run.id for run in both.runs] == ["run-a", "b", "c"]
    d = gone_on(c, "d", 10.0, uses={"L2": (3.0,)})
    merged = merge(both, d)
    assert merged.joined == {"L1": "L1", "L2": "L3"}
    assert ages(merged)["L3"] == (4.0, 3.0)


@given(memories())
def test_a_memory_merged_with_itself_is_itself(any_memory):
    shared = replace(any_memory, runs=(PastRun("a", 0.0), *any_memory.runs[:0]))
    merged = merge(shared, shared)
    assert merged.renamed == {}
    assert merged.memory.landmarks == shared.landmarks
    assert merged.memory.arcs == shared.arcs
    assert {each.chunk.name: sorted(each.ages_s) for each in merged.memory.chunks} == {
        each.chunk.name: sorted(each.ages_s) for each in shared.chunks
    }


@given(memories(), memories())
def test_nothing_is_lost(one, other):
    if one.frame != other.frame or None not in {one.view_length, other.view_length}:
        return
    other = replace(
        other, runs=(), origins={name: f"other/{origin}" for name, origin in other.origins.items()}
    )
    merged = merge(one, other).memory
    assert len(merged.landmarks) == len(one.landmarks) + len(other.landmarks)
    assert len(merged.arcs) == len(one.arcs) + len(other.arcs)
    uses = [sum(len(each.ages_s) for each in each_.chunks) for each_ in (one, other, merged)]
    assert uses[2] == uses[0] + uses[1]


def test_what_cannot_be_compared_is_not_merged():
    with pytest.raises(ValueError, match="its positions are in the frame 'odometry'"):
        merge(memory(frame="map"), memory(run="b"))
    with pytest.raises(ValueError, match="its views have 8 numbers, the others 36"):
        merge(memory(1), memory(1, run="b", chunks=(chunk(1, beams=8),)))
