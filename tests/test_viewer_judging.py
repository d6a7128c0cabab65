"""Why a rule does not match: hand-made buffers, and the engine itself as the twin."""

from pathlib import Path

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from ssrics_like.library import entries
from ssrics_like.productions import EngineParameters, Rule, Rulebook, load_rulebook
from ssrics_like.productions.engine import Engine
from ssrics_like.productions.interface import BufferChunk, Recall
from ssrics_like.productions.syntax import parse_rule
from ssrics_like.viewer.judging import (
    BUSY,
    ERROR,
    FAILS,
    FREE,
    HOLDS,
    UNKNOWN,
    Standing,
    Verdict,
    judge,
)

LANDMARK = {rule.name: rule for rule in load_rulebook(entries("productions")["landmark"]).rules}
WATCH = Standing({"isa": "task", "state": "watch", "event": "none", "last": "none"})
RECALL = Standing({"isa": "task", "state": "recall", "event": "4", "last": "none"})
DOORWAY = Standing(
    {
        "isa": "reflex",
        "event": "4",
        "sector": "front",
        "structure": "doorway",
        "novelty": "0.9",
        "view": "view-4",
        "place": "place-4",
    }
)
L1 = {"isa": "landmark", "id": "L1"}


def rule(text, name="r", utility=0.0):
    return Rule(name, "", parse_rule(text), text, utility, 1)


def of(text, **buffers):
    return judge(rule(f"{text}\n==>\n~g>"), buffers)


def test_every_condition_of_attend_holds_when_a_doorway_is_seen():
    assert judge(LANDMARK["attend"], {"g": WATCH, "orienting": DOORWAY}) == Verdict(HOLDS)


@pytest.mark.parametrize(
    ("name", "buffers", "condition", "found"),
    [
        ("attend", {"g": WATCH}, "=orienting>", "the buffer is empty"),
        ("attend", {"g": RECALL, "orienting": DOORWAY}, "=g> state watch", "it holds recall"),
        (
            "attend",
            {"g": WATCH, "orienting": DOORWAY, "retrieval": Standing(state=BUSY)},
            "?retrieval> state free",
            "its module is busy",
        ),
        (
            "pass-room",
            {"g": WATCH, "orienting": DOORWAY},
            "=orienting> structure room",
            "it holds doorway",
        ),
        ("recognise", {"g": RECALL}, "=retrieval>", "the buffer is empty"),
        (
            "hesitate",
            {"g": RECALL, "retrieval": Standing(L1, FREE, True, {"confidence": 0.93})},
            "?retrieval> confidence_below 0.8",
            "confidence is 0.93",
        ),
        (
            "declare",
            {"g": RECALL},
            "?retrieval> buffer failure",
            "nothing was asked for in vain",
        ),
        (
            "wonder",
            {"g": RECALL, "retrieval": Standing(None, ERROR, True, {"confidence": 0.71})},
            "?retrieval> confidence_below 0.7",
            "confidence is 0.71",
        ),
    ],
)
def test_the_first_condition_that_fails_is_named(name, buffers, condition, found):
    assert judge(LANDMARK[name], buffers) == Verdict(FAILS, condition, found)


def test_a_confidence_that_was_not_recorded_is_not_guessed():
    buffers = {"g": RECALL, "retrieval": Standing(L1, FREE, True)}
    for name in ("recognise", "hesitate"):
        verdict = judge(LANDMARK[name], buffers)
        assert verdict.kind == UNKNOWN
        assert verdict.found == "the trace does not record confidence"


def test_a_number_as_near_to_the_limit_as_it_was_rounded_is_not_guessed():
    near = Standing(L1, FREE, True, {"confidence": 0.8})
    assert judge(LANDMARK["recognise"], {"g": RECALL, "retrieval": near}).kind == UNKNOWN
    off = Standing(L1, FREE, True, {"confidence": 0.800001})
    assert judge(LANDMARK["recognise"], {"g": RECALL, "retrieval": off}).kind == HOLDS


def test_a_condition_that_fails_settles_it_behind_one_that_cannot_be_judged():
    text = "?orienting> salience_above 2\n=g> isa task\nstate recall"
    verdict = of(text, g=WATCH, orienting=DOORWAY)
    assert (verdict.kind, verdict.condition) == (FAILS, "=g> state recall")
    assert of("?orienting> salience_above 2", orienting=DOORWAY).kind == UNKNOWN


def test_numbers_that_do_not_exist_make_both_comparisons_wrong():
    for side in ("above", "below"):
        query = f"confidence_{side} 0.5"
        assert of(f"?retrieval> {query}").kind == FAILS
        assert of(f"?retrieval> {query}", retrieval=Standing(None, BUSY, True)).kind == FAILS
        assert of(f"?orienting> novelty_{side} 0.5").kind == FAILS


def test_novelty_is_compared_as_it_stands_in_the_chunk():
    assert of("?orienting> novelty_above 0.9", orienting=DOORWAY).kind == FAILS
    assert of("?orienting> novelty_below 0.9", orienting=DOORWAY).kind == HOLDS
    assert of("?orienting> novelty_above 0.8", orienting=DOORWAY).kind == HOLDS


def test_a_failure_leaves_a_module_free_and_the_goal_cannot_fail():
    failed = Standing(None, ERROR)
    assert of("?retrieval> state free", retrieval=failed).kind == HOLDS
    assert of("?retrieval> state error", retrieval=failed).kind == HOLDS
    assert of("?retrieval> buffer failure", retrieval=failed).kind == HOLDS
    assert of("?imaginal> buffer failure").kind == FAILS
    assert of("?g> buffer full", g=WATCH).kind == HOLDS
    assert of("?g> buffer empty", g=WATCH) == Verdict(
        FAILS, "?g> buffer empty", "the buffer is full"
    )


def test_variables_bind_across_buffers_and_exclude():
    way = Standing({"isa": "way", "goal": "L4", "at": "L3"})
    assert of("=way> isa way\ngoal =goal\nat =goal", way=way) == Verdict(
        FAILS, "=way> at =goal", "it holds L3, but =goal is L4"
    )
    assert of("=way> isa way\ngoal =goal\nat ~=goal", way=way).kind == HOLDS
    same = Standing({"isa": "way", "goal": "L4", "at": "L4"})
    assert of("=way> isa way\nat ~=goal\ngoal =goal", way=same).kind == FAILS
    assert of("=way> isa way\nreason =reason", way=way) == Verdict(
        FAILS, "=way> reason =reason", "it holds nothing"
    )


class Nothing:
    """Modules that are never asked."""

    def recall(self, *_):
        return Recall(None, 0.0)

    def harvest(self, *_):
        pass

    def surprise(self, _view):
        return 1.0

    def mark(self, _request):
        return None


WORDS = st.sampled_from(["a", "b", "c"])
SLOTS = ("one", "two", "three")
CHUNK = st.dictionaries(st.sampled_from(SLOTS), WORDS)
PAIR = st.tuples(
    st.sampled_from(SLOTS), st.sampled_from(["", "=", "~", "~="]), st.sampled_from(["a", "b", "c"])
)
QUERY = st.sampled_from(
    ["", "?g> buffer full", "?orienting> buffer empty", "?retrieval> state free",
     "?retrieval> buffer failure", "?retrieval> confidence_above 0.5",
     "?orienting> novelty_above 0.5", "?orienting> novelty_below 0.5"]
)  # fmt: skip


@settings(max_examples=250, deadline=None)
@given(
    goal=CHUNK,
    seen=st.none() | st.tuples(WORDS, st.floats(0.0, 1.0)),
    tests=st.lists(PAIR, max_size=5),
    looked=st.lists(
        st.tuples(st.just("sector"), st.sampled_from(["", "=", "~", "~="]), WORDS), max_size=2
    ),
    query=QUERY,
)
@example(goal={}, seen=None, tests=[("one", "~=", "a")], looked=[], query="")
@example(goal={}, seen=None, tests=[("one", "~", "a")], looked=[], query="")
@example(
    goal={"one": "b"}, seen=None, tests=[("one", "", "a"), ("one", "", "b")], looked=[], query=""
)
@example(
    goal={"one": "b"}, seen=None, tests=[("one", "=", "a"), ("one", "=", "b")], looked=[], query=""
)
@example(
    goal={"one": "b"}, seen=None, tests=[("one", "~=", "a"), ("one", "=", "a")], looked=[], query=""
)
@example(
    goal={"one": "a"},
    seen=("a", 0.75),
    tests=[("one", "=", "a")],
    looked=[("sector", "=", "a")],
    query="?orienting> novelty_above 0.5",
)
def test_the_engine_fires_exactly_where_no_condition_fails(goal, seen, tests, looked, query):
    lines = ["=g>", "isa task"] + [f"{slot} {sign}{word}" for slot, sign, word in tests]
    if looked:
        lines += ["=orienting>", "isa reflex"]
        lines += [f"{slot} {sign}{word}" for slot, sign, word in looked]
    lines += [query, "==>", "~g>"]
    tried = rule("\n".join(lines))
    book = Rulebook(
        path=Path("twin.yaml"),
        title="",
        source="",
        chunk_types={"task": SLOTS, "reflex": ("sector", "novelty", "view")},
        goal={"isa": "task", **goal},
        harvest=(),
        parameters=EngineParameters(),
        rules=(tried,),
    )
    engine = Engine(book, Nothing(), Nothing())
    buffers = {"g": Standing({"isa": "task", **goal})}
    if seen is not None:
        slots = {"sector": seen[0], "novelty": f"{seen[1]:.6f}", "view": "view-0"}
        engine.settle()
        fired_before = engine.firings
        if not fired_before:
            engine.push("orienting", BufferChunk("reflex", slots), 1.0)
            buffers["orienting"] = Standing({"isa": "reflex", **slots})
    engine.settle()
    assert (engine.firings > 0) is (judge(tried, buffers).kind == HOLDS)
