"""Declarative memory: what is a candidate, what is retrieved, and what is recorded."""

import math
import pickle

import numpy as np
import pytest
from pydantic import ValidationError

import ssrics_like.memory
from ssrics_like.memory import (
    Chunk,
    DeclarativeMemory,
    MemoryParameters,
    Request,
    TableSimilarity,
    View,
    ViewSimilarity,
    base_level,
)


def memory_with(*chunks, similarities=None, **parameters):
    memory = DeclarativeMemory(
        MemoryParameters(**{"retrieval_threshold": -20.0, **parameters}),
        similarities=similarities or {},
    )
    for name, kind, slots in chunks:
        memory.add(Chunk(name, kind, slots), 0.0)
    return memory


def request(kind="mark", **slots):
    return Request(kind, tuple((slot, value, False) for slot, value in slots.items()))


def names(retrieval):
    return retrieval.candidates.names.tolist()


LEFT = ("a", "mark", {"sector": "left"})
RIGHT = ("b", "mark", {"sector": "right"})


def test_public_names_are_there_and_sorted():
    assert all(hasattr(ssrics_like.memory, name) for name in ssrics_like.memory.__all__)
    assert list(ssrics_like.memory.__all__) == sorted(ssrics_like.memory.__all__)


# ---------------------------------------------------------------- content


def test_an_equal_chunk_merges_into_the_one_there():
    memory = memory_with(LEFT, RIGHT)
    assert memory.add(Chunk("c", "mark", {"sector": "left"}), 3.0) == "a"
    assert memory.references("a").tolist() == [0.0, 3.0]
    assert len(memory) == 2
    assert "c" not in memory


def test_a_chunk_of_another_type_or_slots_does_not_merge():
    memory = memory_with(LEFT)
    assert memory.add(Chunk("c", "other", {"sector": "left"}), 3.0) == "c"
    assert memory.add(Chunk("d", "mark", {"sector": "left", "structure": "door"}), 3.0) == "d"
    assert memory.add(Chunk("e", "mark", {"sector": "left", "structure": None}), 4.0) == "a"
    assert memory.names == ("a", "c", "d")


def test_a_name_stands_for_one_content():
    memory = memory_with(LEFT)
    with pytest.raises(ValueError, match="another chunk is called 'a' already"):
        memory.add(Chunk("a", "mark", {"sector": "right"}), 1.0)


def test_chunks_are_found_by_name():
    memory = memory_with(LEFT)
    assert memory["a"] == Chunk("a", "mark", {"sector": "left"})
    assert "a" in memory
    for unknown in (lambda: memory["aa"], lambda: memory.strengthen("aa", 1.0)):
        with pytest.raises(KeyError, match="no chunk 'aa' in declarative memory; did you mean 'a'"):
            unknown()


def test_a_value_that_does_not_suit_leaves_memory_as_it_was():
    memory = memory_with(similarities={"view": ViewSimilarity()})
    memory.add(Chunk("a", "mark", {"view": View("v", np.arange(4)), "sector": "left"}), 0.0)
    with pytest.raises(TypeError, match="slot 'view' takes a View, got 'v'"):
        memory.add(Chunk("b", "mark", {"sector": "front", "view": "v"}), 0.0)
    with pytest.raises(ValueError, match="has 3 numbers, the others have 4"):
        memory.add(Chunk("b", "mark", {"sector": "front", "view": View("w", np.arange(3))}), 0.0)
    assert memory.names == ("a",)
    memory.add(Chunk("b", "mark", {"sector": "front", "view": View("w", np.arange(4))}), 0.0)
    assert names(memory.retrieve(request(sector="front"), 1.0)) == ["b"]


@pytest.mark.parametrize("t_s", [math.nan, math.inf])
def test_times_are_finite(t_s):
    memory = memory_with(LEFT)
    for act in (
        lambda: memory.add(Chunk("z", "mark", {}), t_s),
        lambda: memory.strengthen("a", t_s),
        lambda: memory.retrieve(request(), t_s),
    ):
        with pytest.raises(ValueError, match="expected finite seconds"):
            act()


# ---------------------------------------------------------------- candidates


def test_types_are_kept_apart_unless_none_is_asked_for():
    memory = memory_with(LEFT, ("c", "other", {"sector": "left"}))
    assert names(memory.retrieve(request("mark", sector="left"), 1.0)) == ["a"]
    assert names(memory.retrieve(request(None, sector="left"), 1.0)) == ["a", "c"]
    assert names(memory.retrieve(request("unheard-of"), 1.0)) == []


@pytest.mark.parametrize("penalty", [None, 1.0])
def test_a_chunk_without_the_slot_is_no_candidate(penalty):
    memory = memory_with(LEFT, ("c", "mark", {"structure": "door"}), mismatch_penalty=penalty)
    assert names(memory.retrieve(request(sector="left"), 1.0)) == ["a"]
    assert names(memory.retrieve(request(colour="red"), 1.0)) == []
    assert names(memory.retrieve(request(sector=None), 1.0)) == ["c"]
    assert names(memory.retrieve(Request("mark", (("sector", None, True),)), 1.0)) == ["a"]
    assert names(memory.retrieve(Request("mark", (("colour", None, True),)), 1.0)) == []
    assert names(memory.retrieve(request(colour=None), 1.0)) == ["a", "c"]


def test_a_negated_test_admits_chunks_without_the_slot():
    memory = memory_with(LEFT, RIGHT, ("c", "mark", {"structure": "door"}))
    negated = Request("mark", (("sector", "left", True),))
    assert names(memory.retrieve(negated, 1.0)) == ["b", "c"]


@pytest.mark.parametrize("penalty", [None, 1.0])
def test_numbers_can_be_compared(penalty):
    marks = [(f"m{v}", "mark", {"size": v}) for v in (1, 2.5, 3)]
    memory = memory_with(*marks, RIGHT, mismatch_penalty=penalty)
    for order, expected in {
        "<": ["m1"],
        "<=": ["m1", "m2.5"],
        ">": ["m3"],
        ">=": ["m2.5", "m3"],
    }.items():
        found = memory.retrieve(Request("mark", (("size", 2.5, order),)), 1.0)
        assert names(found) == expected
        assert found.candidates.partial_match.tolist() == [0.0] * len(expected)
    assert names(memory.retrieve(Request("mark", (("depth", 2.5, ">"),)), 1.0)) == []


@pytest.mark.parametrize("test", [("size", 2.5, "=="), ("size", None, "<"), ("size", 1.0, 1)])
def test_an_unknown_modifier_is_refused(test):
    with pytest.raises(ValueError, match="slot 'size': modifier"):
        Request("mark", (test,))


def test_only_what_was_there_by_then_is_found():
    memory = memory_with(LEFT)
    memory.add(Chunk("b", "mark", {"sector": "right"}), 5.0)
    memory.strengthen("a", 6.0)
    found = memory.retrieve(request(), 4.0)
    assert names(found) == ["a"]
    assert found.activation == pytest.approx(base_level([0.0], 4.0))
    assert names(memory.retrieve(request(), 5.0)) == ["a", "b"]


def test_continuous_slots_match_exactly_without_partial_matching():
    view, other = View("v", np.arange(3)), View("w", np.arange(3) ** 2)
    memory = memory_with(
        ("a", "mark", {"view": view}),
        ("b", "mark", {"view": other}),
        ("c", "mark", {"sector": "left"}),
        similarities={"view": ViewSimilarity()},
    )
    assert names(memory.retrieve(request(view=other), 1.0)) == ["b"]
    assert names(memory.retrieve(request(view=view), 1.0)) == ["a"]
    assert names(memory.retrieve(Request("mark", (("view", view, True),)), 1.0)) == ["b", "c"]


# ---------------------------------------------------------------- activation


def test_every_term_of_every_candidate_is_recorded():
    memory = DeclarativeMemory(
        MemoryParameters(
            mismatch_penalty=2.0,
            strength_of_association=3.0,
            source_activation={"goal": 1.0},
            activation_noise=0.2,
            retrieval_threshold=-20.0,
        ),
        np.random.default_rng(0),
        {"sector": TableSimilarity({("left", "right"): -0.4})},
    )
    for name, sector in {"a": "left", "b": "right", "c": "front"}.items():
        memory.add(Chunk(name, "mark", {"sector": sector, "structure": "door"}), 0.0)
    memory.strengthen("b", 3.0)
    found = memory.retrieve(
        request(sector="left"), 4.0, {"goal": ["right", "door"], "other": ["left"]}
    )
    rows = {row.name: row for row in found.candidates.rows()}
    assert [row.base_level for row in rows.values()] == pytest.approx(
        [base_level([0.0], 4.0), base_level([0.0, 3.0], 4.0), base_level([0.0], 4.0)]
    )
    assert [row.partial_match for row in rows.values()] == pytest.approx([0.0, -0.8, -2.0])
    door = (3.0 - math.log(4)) / 2
    assert [row.spreading for row in rows.values()] == pytest.approx(
        [door, door + (3.0 - math.log(2)) / 2, door]
    )
    noise = [row.noise for row in rows.values()]
    assert len(set(noise)) == 3
    assert 0 not in noise
    for row in rows.values():
        total = row.base_level + row.spreading + row.partial_match + row.noise
        assert row.total == pytest.approx(total)
    best = found.candidates.best
    assert best == max(rows.values(), key=lambda row: row.total)
    assert found.chunk == memory[best.name]
    assert found.activation == best.total
    assert found.latency_s == round(1000 * math.exp(-best.total)) / 1000


def test_without_subsymbolic_any_match_comes_at_once():
    memory = memory_with(
        ("b", "mark", {"sector": "left"}),
        ("a", "mark", {"sector": "left", "structure": "door"}),
        ("c", "mark", {"sector": "right"}),
        subsymbolic=False,
        retrieval_threshold=5.0,
        mismatch_penalty=1.0,
    )
    found = memory.retrieve(request(sector="left"), 1.0)
    assert names(found) == ["b", "a"]
    assert (found.chunk.name, found.latency_s, found.activation) == ("a", 0.0, 0.0)
    assert memory.retrieve(request(sector="front"), 1.0).latency_s == 0.0


def test_a_failure_takes_as_long_as_the_threshold_says():
    memory = memory_with(LEFT, retrieval_threshold=1.5, latency_factor=0.8, latency_exponent=0.5)
    for wanted in ("left", "front"):
        found = memory.retrieve(request(sector=wanted), 100.0)
        assert found.chunk is None
        assert math.isnan(found.activation)
        assert found.latency_s == round(800 * math.exp(-0.75)) / 1000
    assert names(memory.retrieve(request(sector="left"), 100.0)) == ["a"]


def test_latencies_are_whole_milliseconds():
    memory = memory_with(LEFT, latency_factor=0.1234)  # counts as 123 ms
    for t_s in (0.3, 1.7, 12.9):
        found = memory.retrieve(request(), t_s)
        assert found.latency_s == round(123 * math.exp(-found.activation)) / 1000


def test_equal_activations_are_decided_by_name_ignoring_case():
    order = ["L_2", "lb", "La", "l10", "l9"]
    memory = memory_with(*((name, "mark", {"id": name}) for name in order))
    assert memory.retrieve(request(), 2.0).chunk.name == "l10"
    memory = memory_with(*((name, "mark", {"id": name}) for name in order[:3]))
    assert memory.retrieve(request(), 2.0).chunk.name == "La"  # a letter comes before _


def test_by_context_all_are_as_familiar_as_each_other():
    memory = memory_with(
        ("a", "mark", {"sector": "left"}),
        ("b", "mark", {"sector": "left", "size": 1.0}),
        retrieval_threshold=-5.0,
        mismatch_penalty=1.0,
    )
    for t_s in range(1, 9):
        memory.strengthen("a", float(t_s))
    found = memory.retrieve(request(sector="left"), 10.0)
    assert found.chunk.name == "a"
    assert found.share > 0.8
    a, b = (math.exp(row.base_level) for row in found.candidates.rows())
    none = math.exp(-5.0) / ((a + b) / 2)
    candidates = found.candidates
    share = found.share_of(candidates.by_context, candidates.threshold_by_context)
    assert share == pytest.approx(1 / (2 + none))
    nothing = memory.retrieve(request("unheard-of"), 10.0)
    assert nothing.share == nothing.share_of(nothing.candidates.by_context, -5.0) == 1.0


def test_a_retrieval_does_not_strengthen():
    memory = memory_with(LEFT)
    memory.retrieve(request(), 1.0)
    assert memory.references("a").tolist() == [0.0]


def test_base_levels_over_time_follow_the_order_of_names():
    memory = memory_with(LEFT, ("o", "other", {"sector": "left"}), RIGHT)
    memory.add(Chunk("late", "other", {"sector": "right"}), 50.0)
    memory.strengthen("o", 3.0)
    assert memory.names == ("a", "o", "b", "late")
    found = memory.activations(10.0)
    assert found.tolist() == [memory.base_level(name, 10.0) for name in memory.names]
    assert found[1] == pytest.approx(base_level([0.0, 3.0], 10.0))
    assert found[3] == -math.inf


def test_noise_needs_a_generator_and_repeats_with_its_seed():
    with pytest.raises(ValueError, match="needs a random generator"):
        memory_with(LEFT, activation_noise=0.5)

    def totals(seed):
        memory = DeclarativeMemory(
            MemoryParameters(activation_noise=0.5), np.random.default_rng(seed)
        )
        for name, kind, slots in (LEFT, RIGHT):
            memory.add(Chunk(name, kind, slots), 0.0)
        return [memory.retrieve(request(), t).candidates.total.tolist() for t in (1.0, 2.0)]

    assert totals(1) == totals(1)
    assert totals(1) != totals(2)


# ---------------------------------------------------------------- landmarks met again


def looks_like(*numbers):
    return View("seen", np.array(numbers, float))


def landmarks():
    memory = memory_with(similarities={"view": ViewSimilarity()}, mismatch_penalty=1.0)
    for name, view in {"L1": looks_like(0, 1, 2), "L2": looks_like(2, 0, 1)}.items():
        memory.add(Chunk(name, "mark", {"id": name, "view": view}), 0.0)
    return memory


def test_the_landmark_that_looks_more_alike_is_retrieved():
    found = landmarks().retrieve(request(view=looks_like(2, 0.2, 1)), 1.0)
    assert found.chunk.name == "L2"


def test_a_view_replaced_is_used_from_then_on_and_is_no_reference():
    memory = landmarks()
    here = looks_like(2, 0.2, 1)
    memory.replace("L1", "view", here)
    assert memory["L1"].slots == {"id": "L1", "view": here}
    assert memory.references("L1").tolist() == [0.0]
    found = memory.retrieve(request(view=here), 1.0)
    assert found.chunk.name == "L1"
    assert found.candidates.partial_match[0] == pytest.approx(0.0, abs=1e-6)


def test_merging_goes_by_the_replaced_value():
    memory = landmarks()
    old, new = memory["L1"].slots["view"], looks_like(1, 1, 0)
    memory.replace("L1", "view", new)
    assert memory.add(Chunk("x", "mark", {"id": "L1", "view": new}), 1.0) == "L1"
    assert memory.add(Chunk("y", "mark", {"id": "L1", "view": old}), 1.0) == "y"


def test_only_continuous_slots_that_are_there_can_be_replaced():
    memory = landmarks()
    with pytest.raises(ValueError, match="only a slot with a continuous similarity"):
        memory.replace("L1", "id", "L3")
    with pytest.raises(ValueError, match="chunk 'L1' has no slot 'back'"):
        memory.replace("L1", "back", looks_like(0, 1, 2))
    with pytest.raises(KeyError, match="no chunk 'L3'"):
        memory.replace("L3", "view", looks_like(0, 1, 2))


def test_memory_can_be_pickled():
    memory = pickle.loads(pickle.dumps(landmarks()))
    found = memory.retrieve(request(view=looks_like(2, 0.2, 1)), 1.0)
    assert pickle.loads(pickle.dumps(found)).chunk == memory["L2"]


# ---------------------------------------------------------------- parameters


def test_the_defaults_are_those_of_actr():
    parameters = MemoryParameters()
    assert parameters.model_dump() == {
        "subsymbolic": True,
        "decay": 0.5,
        "base_level_constant": 0.0,
        "optimized_learning": False,
        "retrieval_threshold": 0.0,
        "latency_factor": 1.0,
        "latency_exponent": 1.0,
        "mismatch_penalty": None,
        "max_similarity": 0.0,
        "max_difference": -1.0,
        "activation_noise": 0.0,
        "strength_of_association": None,
        "association_floor": 0.0,
        "source_activation": {"imaginal": 1.0},
    }


@pytest.mark.parametrize(
    ("wrong", "message"),
    [
        ({"decay": 0.0}, "greater than 0"),
        ({"decay": math.nan}, "finite"),
        ({"decay": 1.0, "optimized_learning": True}, "divides by 1 - decay"),
        ({"optimized_learning": 0}, "optimized_learning"),
        ({"optimized_learning": "yes"}, "optimized_learning"),
        ({"activation_noise": -0.1}, "greater than or equal to 0"),
        ({"max_similarity": -2.0}, "max_difference -1 is above max_similarity -2"),
        ({"retrieval_threshold": -1e4}, "latency that is not finite"),
        ({"decai": 0.5}, "Extra inputs"),
    ],
)
def test_wrong_parameters_are_refused(wrong, message):
    with pytest.raises(ValidationError, match=message):
        MemoryParameters(**wrong)


def test_true_and_one_are_two_kinds_of_optimized_learning():
    assert MemoryParameters(optimized_learning=True).optimized_learning is True
    assert MemoryParameters(optimized_learning=1).optimized_learning is not True
