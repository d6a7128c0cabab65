"""The engine: its trace against ACT-R 7, its buffers, its refusals."""

import csv
from collections import defaultdict
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from ssrics_like.errors import EngineError
from ssrics_like.library import find
from ssrics_like.memory.profile import MemoryProfile
from ssrics_like.modules import LandmarkModules
from ssrics_like.productions import engine as engine_module
from ssrics_like.productions.engine import Engine
from ssrics_like.productions.interface import BufferChunk, MarkRequest, Recall, TraceEvent
from ssrics_like.productions.rulebook import load_rulebook

RULES = Path(__file__).parent / "rules"
PERCEPTS = ((1, "left"), (3, "right"), (5, "left"), (6, "left"), (20, "left"), (60, "right"))
BASE = {
    "decay": 0.5,
    "retrieval_threshold": -1.0,
    "latency_factor": 0.1,
    "mismatch_penalty": None,
    "activation_noise": 0.0,
    "sector_difference": -1.0,  # ACT-R's default for any two values
}
VARIANTS = {
    "base": {},
    "rt-2.5": {"retrieval_threshold": -2.5},
    "bll0.8": {"decay": 0.8},
    "pm": {"mismatch_penalty": 1.0},
    "ol_t": {"optimized_learning": True},
}
# (request, latency) of each retrieval in whole ms, from the reference traces of ACT-R 7.27.7;
# those that end in a failure are negative.
LATENCIES = {
    "base": [-272, -272, 185, 62, 131, -272],
    "rt-2.5": [-1218, -1218, 158, 60, 130, 745],
    "bll0.8": [-272, -272, 268, 60, -272, -272],
    "pm": [-272, -272, 185, 62, 131, -272],
    "ol_t": [-272, -272, 93, 53, 72, -272],
}


class NoMemory:
    """Recalls nothing, after a set time; keeps what it was asked and given."""

    def __init__(self, latency_s=0.1, confidence=1.0, surprises=None, **numbers):
        self.latency_s = latency_s
        self.confidence = confidence
        self.surprises = surprises or {}
        self.numbers = numbers
        self.asked = []
        self.harvested = []

    def recall(self, chunk_type, tests, t_s, sources):
        self.asked.append((chunk_type, tuple(tests), t_s, sources))
        return Recall(None, self.latency_s, self.confidence, self.numbers.get)

    def harvest(self, chunk, t_s):
        self.harvested.append((chunk, t_s))

    def surprise(self, view):
        return self.surprises.get(view, 0.0)


class Marks:
    """Notes decisions; a declared landmark gets a chunk."""

    def __init__(self):
        self.requests: list[MarkRequest] = []

    def mark(self, request):
        self.requests.append(request)
        if request.outcome != "declared":
            return None
        slots = {"id": f"L{len(self.requests)}", "sector": "left"}
        return BufferChunk("landmark", slots, slots["id"])


def reflex(event, sector, novelty=0.5):
    slots = {
        "event": str(event), "modality": "laser", "sector": sector, "structure": "unknown",
        "novelty": str(novelty), "view": f"view-{event}", "place": f"place-{event}",
    }  # fmt: skip
    return BufferChunk("reflex", slots)


def orienting_trace(**parameters) -> list[TraceEvent]:
    trace: list[TraceEvent] = []
    modules = LandmarkModules(
        MemoryProfile(**{**BASE, **parameters}),
        np.random.default_rng(0),
        decided=lambda _: None,
        retrieved=lambda _time, _retrieval: None,
    )
    engine = Engine(load_rulebook(RULES / "orienting.yaml"), modules, modules, trace=trace.append)
    for event, (t_s, sector) in enumerate(PERCEPTS):
        chunk = BufferChunk("reflex", {"sector": sector, "event": "e"})
        assert engine.push("orienting", chunk, t_s) is None, event
    engine.settle()
    return trace


def canonical(event: TraceEvent) -> tuple[int, str, str]:
    """Time in ms, module, and what happened, in the words of the reference."""
    name = {"g": "goal"}.get(event.name, event.name)
    action = event.action
    if event.module == "goal":
        return 0, "goal", "set-buffer-chunk goal"
    if event.module == "orienting":
        assert event.chunk is not None
        return round(event.t_s * 1000), "orienting", f"give-percept {event.chunk['sector']}"
    if event.module == "declarative":
        name = "retrieval" if action == "set-buffer-chunk" else ""
    return round(event.t_s * 1000), event.module, f"{action} {name}".strip()


@pytest.mark.parametrize("variant", VARIANTS)
def test_trace_agrees_event_by_event_with_act_r_7(variant, data_dir):
    reference = data_dir.parent / "reference" / "actr7" / "topic6_events.csv"
    if not reference.is_file():
        pytest.skip(f"{reference} is not there")
    expected = defaultdict(list)
    with reference.open() as file:
        for row in csv.DictReader(file):
            words = row["event"].lower().split()
            if row["module"] == "------":
                continue
            if words[0] in ("retrieved-chunk", "start-retrieval", "retrieval-failure"):
                words = words[:1]
            elif words[0].startswith("set-buffer-chunk"):
                words = words[:2]
            expected[row["variant"]].append(
                (round(float(row["time_s"]) * 1000), row["module"], " ".join(words))
            )
    assert [canonical(event) for event in orienting_trace(**VARIANTS[variant])] == expected[variant]


@pytest.mark.parametrize("variant", VARIANTS)
def test_retrievals_take_as_long_as_in_act_r_7(variant):
    taken, started = [], 0.0
    for event in orienting_trace(**VARIANTS[variant]):
        if event.action == "start-retrieval":
            started = event.t_s
        elif event.action in ("retrieved-chunk", "retrieval-failure"):
            ms = round((event.t_s - started) * 1000)
            taken.append(ms if event.action == "retrieved-chunk" else -ms)
    assert taken == LATENCIES[variant]


def make(rules, memory=None, trace=lambda _: None, **kwargs):
    marks = Marks()
    memory = memory or NoMemory()
    path = find("productions", rules) if isinstance(rules, str) else rules
    return Engine(load_rulebook(path), memory, marks, trace=trace, **kwargs), marks, memory


def test_report_rules_declare_only_when_the_sector_changes():
    engine, marks, _ = make("report")
    for i, sector in enumerate(["left", "left", "front", "right", "right", "front"]):
        engine.push("orienting", reflex(i, sector), 1.0 + i)
    engine.settle()
    assert [r.outcome for r in marks.requests] == [
        "declared", "dismissed", "declared", "declared", "dismissed", "declared",
    ]  # fmt: skip
    assert [r.event for r in marks.requests] == list("012345")
    assert marks.requests[0].t_s == pytest.approx(1.05)
    assert {r.rule for r in marks.requests} == {"new-area", "same-area"}


def test_landmark_rules_ask_memory_with_everything_perceived():
    engine, marks, memory = make("landmark")
    engine.push("orienting", reflex(7, "right"), 2.0)
    engine.settle()
    ((chunk_type, tests, t_s, _),) = memory.asked
    assert chunk_type == "landmark"
    assert t_s == pytest.approx(2.05)
    assert {test.slot: test.value for test in tests} == {
        "sector": "right", "structure": "unknown", "view": "view-7", "place": "place-7",
    }  # fmt: skip
    (request,) = marks.requests
    assert (request.outcome, request.rule, request.event) == ("declared", "declare", "7")
    assert request.t_s == pytest.approx(2.05 + 0.1 + 0.05)
    ((landmark, stored_s),) = memory.harvested
    assert landmark.name == "L1"
    assert stored_s == pytest.approx(request.t_s + 0.05)


def test_a_variable_matches_only_a_slot_that_holds_something(tmp_path):
    text = (RULES / "two-ways.yaml").read_text().replace("task: [state]", "task: [state, last]")
    guarded = text.replace("    rule: |\n", "    rule: |\n      =g> isa task last =last\n", 1)
    path = tmp_path / "guarded.yaml"
    path.write_text(guarded)
    engine, marks, _ = make(path)
    engine.push("orienting", reflex(0, "left"), 1.0)
    engine.settle()
    assert [r.rule for r in marks.requests] == ["that"]  # the goal has no `last`


def test_a_variable_may_be_called_like_a_buffer():
    trace = []
    engine, _, _ = make("landmark", trace=trace.append)
    engine.push("orienting", reflex(0, "left"), 1.0)
    engine.settle()
    goals = [e.chunk["last"] for e in trace if e.action == "mod-buffer-chunk" and e.name == "g"]
    assert goals == ["none", "none", "L1"]


def test_a_reflex_that_nobody_attended_is_handed_back_when_overwritten():
    engine, marks, _ = make("landmark", NoMemory(latency_s=1.0))
    assert engine.push("orienting", reflex(0, "left"), 1.0) is None
    # The first is attended at 1.05 and being recalled; the second waits; the third overwrites it.
    assert engine.push("orienting", reflex(1, "left"), 1.2) is None
    overwritten = engine.push("orienting", reflex(2, "left"), 1.4)
    assert overwritten is not None
    assert overwritten.slots["event"] == "1"
    engine.settle()
    assert [r.event for r in marks.requests] == ["0", "2"]


def test_time_passes_only_where_something_happens():
    engine, _, _ = make("landmark")
    engine.advance(0.01)
    assert engine.idle
    engine.advance(1000.0)
    assert engine.now_s < 1.0
    engine.push("orienting", reflex(0, "left"), 1000.0)
    assert engine.now_s == pytest.approx(1000.0)


@pytest.mark.parametrize(
    ("confidence", "outcome", "rule"), [(0.95, "declared", "declare"), (0.5, "unsure", "wonder")]
)
def test_a_model_that_is_not_sure_says_so(confidence, outcome, rule):
    engine, marks, _ = make("landmark", NoMemory(confidence=confidence))
    engine.push("orienting", reflex(0, "left"), 1.0)
    engine.settle()
    (request,) = marks.requests
    assert (request.outcome, request.rule) == (outcome, rule)


def test_before_memory_was_asked_no_confidence_is_above_or_below(tmp_path):
    text = find("productions", "report").read_text()
    for query in ("confidence_above 0.0", "confidence_below 1.0"):
        path = tmp_path / "asks.yaml"
        path.write_text(
            text.replace(
                "      =orienting>\n", f"      ?retrieval>\n          {query}\n      =orienting>\n"
            )
        )
        engine, marks, _ = make(path)
        engine.push("orienting", reflex(0, "left"), 1.0)
        engine.settle()
        assert marks.requests == []


def test_numeric_queries_compare_the_novelty_of_the_reflex(tmp_path):
    text = find("productions", "report").read_text()
    strict = text.replace(
        "      =orienting>\n", "      ?orienting>\n          novelty_above 0.7\n      =orienting>\n"
    )
    path = tmp_path / "strict.yaml"
    path.write_text(strict)
    engine, marks, _ = make(path)
    engine.push("orienting", reflex(0, "left", novelty=0.5), 1.0)
    engine.settle()
    assert marks.requests == []
    assert engine.waiting("orienting") is not None
    assert engine.push("orienting", reflex(1, "left", novelty=0.9), 2.0) is not None
    engine.settle()
    assert [r.event for r in marks.requests] == ["1"]


@pytest.mark.parametrize(
    ("query", "marked"),
    [("salience_above 1.5", [1]), ("salience_below 1.5", [0, 2]), ("salience_above 0", [0, 1])],
)
def test_rules_ask_how_surprising_the_view_of_a_reflex_is(tmp_path, query, marked):
    text = find("productions", "report").read_text()
    path = tmp_path / "picky.yaml"
    path.write_text(
        text.replace(
            "      =orienting>\n", f"      ?orienting>\n          {query}\n      =orienting>\n"
        )
    )
    memory = NoMemory(surprises={"view-0": 1.5, "view-1": 3.2, "view-2": 0.0})
    engine, marks, _ = make(path, memory)
    for event in range(3):
        engine.push("orienting", reflex(event, "left"), 1.0 + event)
        engine.settle()
    assert [r.event for r in marks.requests] == [str(event) for event in marked]


@pytest.mark.parametrize(
    ("query", "fires"),
    [
        ("salience_above 2", True),
        ("salience_below 2", False),
        ("salience_above 2.5", False),
        ("salience_below 2.5", True),  # what is not above is below
        ("relevance_above 0", False),  # a number that there is not is neither
        ("relevance_below 1000", False),
        ("permanence_below 0.5", True),
    ],
)
def test_rules_ask_what_the_landmark_recalled_is_worth(tmp_path, query, fires):
    text = find("productions", "landmark").read_text()
    path = tmp_path / "asks.yaml"
    path.write_text(text.replace("          confidence_above 0.7\n", f"          {query}\n"))
    engine, marks, _ = make(path, NoMemory(salience=2.5, permanence=0.25))
    engine.push("orienting", reflex(0, "left"), 1.0)
    engine.settle()
    assert [r.outcome for r in marks.requests] == (["declared"] if fires else [])


def test_rules_that_never_come_to_rest_are_stopped(tmp_path):
    path = tmp_path / "loop.yaml"
    path.write_text(
        "title: Loop\nchunk_types: {task: [state]}\ngoal: {isa: task, state: go}\nrules:\n"
        "  - name: again\n    why: for ever\n"
        "    rule: =g> isa task state go ==> =g> isa task state go\n"
    )
    engine, _, _ = make(path)
    with pytest.raises(EngineError, match=r"loop\.yaml: rule 'again'.*must change what it tests"):
        engine.settle()


def test_another_version_of_pyactr_is_refused(monkeypatch):
    monkeypatch.setattr(engine_module, "version", lambda _: "0.4.0")
    with pytest.raises(EngineError, match=r"pyactr 0\.4\.0 is installed.*exactly 0\.3\.2"):
        make("report")


def test_utility_noise_repeats_with_its_seed_and_leaves_the_global_generator_alone():
    def outcomes(seed):
        book = load_rulebook(RULES / "two-ways.yaml")
        book = replace(book, parameters=book.parameters.model_copy(update={"utility_noise": 1.0}))
        marks = Marks()
        engine = Engine(book, NoMemory(), marks, seed=seed)
        for i in range(20):
            engine.push("orienting", reflex(i, "left"), 1.0 + i)
        engine.settle()
        return [r.outcome for r in marks.requests]

    np.random.seed(1)  # noqa: NPY002
    before = np.random.random()  # noqa: NPY002
    np.random.seed(1)  # noqa: NPY002
    first = outcomes(3)
    assert np.random.random() == before  # noqa: NPY002
    assert first == outcomes(3)
    assert first != outcomes(4)
    assert set(first) == {"declared", "dismissed"}


STOCK = {"retrieval_threshold": -1.0, "latency_factor": 0.1, "decay": 0.5}


def test_cached_rules_and_own_memory_decide_as_stock_pyactr_does():
    """Over the cases where pyactr 0.3.2 has no deviation: same productions at the same times."""

    def firings(stock):
        trace = []
        modules = LandmarkModules(
            MemoryProfile(**BASE), np.random.default_rng(0), lambda _: None, lambda *_: None
        )
        engine = Engine(
            load_rulebook(RULES / "parity.yaml"), modules, modules, trace=trace.append,
            stock=STOCK if stock else None,
        )  # fmt: skip
        for t_s, sector in PERCEPTS:
            engine.push("orienting", BufferChunk("reflex", {"sector": sector, "event": "e"}), t_s)
        engine.settle()
        return [(e.t_s, e.name) for e in trace if e.action == "production-fired"]

    own, stock = firings(stock=False), firings(stock=True)
    assert [name for _, name in own] == [name for _, name in stock]
    # ACT-R's latencies are whole milliseconds, pyactr's are not.
    assert [t for t, _ in own] == pytest.approx([t for t, _ in stock], abs=2e-3)
