"""Agreement with ACT-R 7.27.7: its own output where the reference folder is there, and
a few of its numbers, written out below, where it is not."""

import csv
import math
import re
from pathlib import Path
from typing import NamedTuple

import numpy as np
import pytest

from ssrics_like.memory import (
    Chunk,
    DeclarativeMemory,
    FunctionSimilarity,
    MemoryParameters,
    Request,
    TableSimilarity,
    base_level,
)
from ssrics_like.memory.noise import activation_noise
from ssrics_like.memory.spreading import association_strengths

EXACT = {"rel": 1e-9, "abs": 1e-9}
FIELDS = {
    ":bll": "decay",
    ":blc": "base_level_constant",
    ":rt": "retrieval_threshold",
    ":lf": "latency_factor",
    ":le": "latency_exponent",
    ":mp": "mismatch_penalty",
    ":ms": "max_similarity",
    ":md": "max_difference",
    ":mas": "strength_of_association",
}
ORDERS = ("<", "<=", ">", ">=")


# ---------------------------------------------------------------- notation of the files


def number_or_symbol(word):
    """3, 2.5 and 3.0f0 are numbers; crimson is a symbol, 'abc' a text (kept in quotes)."""
    match = re.fullmatch(r"(-?\d+(?:\.\d+)?)(?:f0)?", word)
    return float(match[1]) if match else word


def parameters_of(text):
    words = text.split()
    given = dict(zip(words[::2], words[1::2], strict=True))
    fields = {"source_activation": {"imaginal": 1.0}}
    for name, word in given.items():
        if name in FIELDS:
            fields[FIELDS[name]] = None if word == "nil" else float(word)
        elif name == ":ga":
            fields["source_activation"]["goal"] = float(word)
        elif name == ":imaginal-activation":
            fields["source_activation"]["imaginal"] = float(word)
    if ":ol" in given:
        fields["optimized_learning"] = learning(given[":ol"])
    if given.get(":nsji") == "t":
        fields["association_floor"] = None
    if given.get(":esc") == "nil":
        fields["subsymbolic"] = False
    return MemoryParameters(**fields), given.get(":sim-hook")


def learning(word):
    return {"nil": False, "t": True}[word] if word in ("nil", "t") else int(word)


def slots_of(words):
    pairs = zip(words[::2], words[1::2], strict=True)
    return {slot: number_or_symbol(value) for slot, value in pairs}


def chunks_of(text):
    """Chunk and presentation times of ``a isa item color crimson @ 0.000;3.000 | b ...``."""
    for part in text.split(" | "):
        description, _, times = part.partition(" @ ")
        name, _, kind, *words = description.split()
        yield Chunk(name, kind, slots_of(words)), [float(t) for t in times.split(";")]


def request_of(text):
    _, kind, *words = text.split()
    slots = []
    while words:
        modifier = words.pop(0) if words[0] in ("-", *ORDERS) else "="
        slot, word, *words = words
        value = None if word == "nil" else number_or_symbol(word)
        slots.append((slot, value, {"=": False, "-": True}.get(modifier, modifier)))
    return Request(kind, tuple(slots))


def sources_of(text):
    """Symbols in each buffer: numbers and texts are no chunks, so they spread nothing."""
    sources = {}
    for buffer, words in re.findall(r"\((\w+) \(\w+ isa \w+ ([^()]*)\)\)", text):
        values = slots_of(words.split()).values()
        sources[buffer] = [v for v in values if isinstance(v, str) and "'" not in v]
    return sources


def similarities_of(text, hook):
    if hook:
        return FunctionSimilarity(HOOKS[hook])
    pairs = re.findall(r"\((\w+) (\w+) ([-.\d]+)\)", text)
    return TableSimilarity({(one, other): float(value) for one, other, value in pairs})


def numeric(function):
    """The hooks answer for numbers only; the defaults decide on anything else."""
    return lambda a, b: function(a, b) if isinstance(a, float) and isinstance(b, float) else None


HOOKS = {
    "linear10": numeric(lambda a, b: -abs(a - b) / 10),
    "expsim": numeric(lambda a, b: math.exp(-abs(a - b)) - 1),
    "angular": numeric(lambda a, b: -(1 - math.cos(math.radians(a - b))) / 2),
    "asym": numeric(lambda a, b: -0.1 if a < b else -0.4 if a > b else -0.05),
}


def memory_of(parameters, text, similarity):
    slots = ("color", "shape", "size", "v")
    memory = DeclarativeMemory(parameters, similarities=dict.fromkeys(slots, similarity))
    for chunk, (first, *later) in chunks_of(text):
        memory.add(chunk, first)
        for t_s in later:
            memory.strengthen(chunk.name, t_s)
    return memory


def case_of(params, chunks, similarities="", symbols=()):
    parameters, hook = parameters_of(params)
    memory = memory_of(parameters, chunks, similarities_of(similarities, hook))
    for number, symbol in enumerate(symbols):
        # The symbols themselves as chunks: a number that spreads nothing keeps them apart.
        memory.add(Chunk(symbol, "item", {"symbol": float(number)}), 0.0)
    return memory


# ---------------------------------------------------------------- with the folder


@pytest.fixture(scope="module")
def reference(data_dir):
    folder = Path(data_dir).parent / "reference" / "actr7"
    if not folder.is_dir():
        pytest.skip(f"ACT-R 7 reference numbers not found in {folder}")

    def read(name):
        with (folder / name).open(newline="") as file:
            return list(csv.DictReader(file))

    return read


def test_base_levels_are_those_of_actr(reference):
    rows = reference("base_level.csv")
    errors = []
    for row in rows:
        learn, decay = learning(row["ol"]), float(row["decay"])
        times = [float(t) for t in row["presentations_s"].split(";")]
        kwargs = {"decay": decay, "optimized": learn, "constant": float(row["blc"])}
        if row["actr7_base_level"].startswith("ERROR"):
            errors.append((decay, learn))
            if learn is True:
                with pytest.raises(ValueError, match="decay below 1"):
                    base_level(times, float(row["query_s"]), **kwargs)
            else:
                assert math.isfinite(base_level(times, float(row["query_s"]), **kwargs))
            continue
        found = base_level(times, float(row["query_s"]), **kwargs)
        assert found == pytest.approx(float(row["actr7_base_level"]), **EXACT), row["case"]
    assert len(rows) > 700
    assert all(decay == 1 and learn is not False for decay, learn in errors)


@pytest.mark.parametrize("topic", ["retrieval", "pm", "spread"])
def test_retrievals_are_those_of_actr(reference, topic):
    parts = {}
    for row in reference(f"{topic}_chunks.csv"):
        parts.setdefault(row["case"], []).append(row)
    cases = reference(f"{topic}_cases.csv")
    assert len(cases) > 50
    for case in cases:
        symbols = ()
        if case["note"].endswith("sources in DM"):
            symbols = ("crimson", "circle", "square", "azure", "lonely")
        memory = case_of(case["params"], case["chunks_at_s"], case["similarities"], symbols)
        found = memory.retrieve(
            request_of(case["request"]), float(case["request_s"]), sources_of(case["buffers"])
        )
        name = "FAILURE" if found.chunk is None else found.chunk.name
        assert name == case["actr7_result"], case["case"]
        assert round(1000 * found.latency_s, 9) == float(case["actr7_latency_ms"]), case["case"]
        if memory.parameters.subsymbolic:
            check_terms(found.candidates, parts[case["case"]])


def check_terms(candidates, rows):
    found = {row.name: row for row in candidates.rows()}
    for row in rows:
        where = f"{row['case']} {row['chunk']}"
        assert (row["chunk"] in found) == (row["actr7_considered"] == "yes"), where
        if row["chunk"] in found:
            terms = found[row["chunk"]]
            for column in ("total", "base_level", "spreading", "partial_match"):
                expected = float(row[f"actr7_{column}"] or 0)
                assert getattr(terms, column) == pytest.approx(expected, **EXACT), where


def test_association_strengths_are_those_of_actr(reference):
    cases = {case["case"]: case for case in reference("spread_cases.csv")}
    for row in reference("spread_sji.csv"):
        case = cases[row["case"]]
        memory = case_of(case["params"], case["chunks_at_s"])
        table, index = memory._find(row["chunk_i"])
        strength = association_strengths(
            table.occurrences(row["source_j"]),
            memory._fan_of(row["source_j"]),
            memory.parameters.strength_of_association,
            memory.parameters.association_floor,
        )[index]
        assert strength == pytest.approx(float(row["sji"]), **EXACT), row


def test_noise_varies_as_much_as_in_actr(reference):
    for row in reference("noise_summary.csv"):
        if row["source"] != "ACT-R 7 act-r-noise":
            continue
        scale, variance = float(row["s"]), float(row["variance"])
        drawn = activation_noise(np.random.default_rng(7), scale, 200_000)
        assert drawn.var() == pytest.approx(variance, rel=0.02)
        assert np.abs(drawn).max() == pytest.approx(float(row["max"]), rel=1e-6)


def test_an_orienting_models_retrievals_are_those_of_actr(reference):
    requested = {"1050": "left", "3050": "right", "60050": "right"}
    requests = {}
    for row in reference("topic6_retrievals.csv"):
        requests.setdefault((row["variant"], row["override"], row["request_ms"]), []).append(row)
    for (variant, override, request_ms), rows in requests.items():
        base = ":bll .5 :ol nil :rt -1.0 :lf .1 "
        parameters, _ = parameters_of(base + override)
        memory = DeclarativeMemory(parameters)
        for row in filter(lambda row: row["candidate"], rows):
            first, *later = history(row)
            memory.add(Chunk(row["candidate"], "mark", {"sector": row["sector"]}), first)
            for t_s in later:
                memory.strengthen(row["candidate"], t_s)
        sector = requested.get(request_ms, "left")
        found = memory.retrieve(
            Request("mark", (("sector", sector, False),)), float(request_ms) / 1000
        )
        where = f"{variant} {request_ms}"
        assert (found.chunk.name if found.chunk else "FAILURE") == rows[0]["retrieved"], where
        assert round(1000 * found.latency_s, 9) == float(rows[0]["latency_ms"]), where
        totals = {row.name: row.total for row in found.candidates.rows()}
        for row in filter(lambda row: row["candidate"], rows):
            assert totals[row["candidate"]] == pytest.approx(
                float(row["total_activation"]), **EXACT
            ), where


def test_what_is_left_at_the_end_is_what_actr_has(reference):
    for row in reference("topic6_dm.csv"):
        parameters, _ = parameters_of(
            {"ol_t": ":ol t", "bll0.8": ":bll .8"}.get(row["variant"], "")
        )
        found = base_level(
            history(row),
            float(row["end_ms"]) / 1000,
            decay=parameters.decay,
            optimized=parameters.optimized_learning,
        )
        assert found == pytest.approx(float(row["base_level_at_end"]), **EXACT)


def history(row):
    """Reference times; where ACT-R keeps none (optimized learning), any will do."""
    created = float(row["creation_ms"]) / 1000
    if row["reference_list_ms"]:
        return sorted(float(ms) / 1000 for ms in row["reference_list_ms"].split(";"))
    return [created, *[created + 0.1] * (int(row["reference_count"]) - 1)]


# ---------------------------------------------------------------- without it


@pytest.mark.parametrize(
    "case",
    [
        ([0.0], 0.001, 0.2, False, 0.0, 0.5991464547107982),  # younger than 50 ms
        ([0.0], 0.010, 0.5, True, 0.0, 2.191013317336941),
        ([0.0], 0.010, 1.0, False, 0.0, 2.995732273553991),
        ([0.0, 9.999], 10.0, 0.5, False, 0.0, 1.5661887499350877),
        ([0.0, 1.0, 2.0, 5.0, 10.0], 10.0, 0.8, True, 0.0, 1.3768077504729643),
        ([0.0, 1.0, 2.0, 5.0, 10.0], 11.0, 0.5, 2, 0.0, 0.8956023341998116),
        ([1.622, 5.285, 6.253], 6.253, 0.2, 1, 0.0, 1.297602508786202),
        ([0.0], 10.0, 0.8, 10, 0.0, -1.842068074395237),  # fewer references than are kept
        ([1.622, 5.285, 6.162], 20.05, 0.5, False, 0.0, -0.27242400810742096),
    ],
)
def test_base_levels_of_actr(case):
    times, query, decay, learn, constant, expected = case
    found = base_level(times, query, decay=decay, optimized=learn, constant=constant)
    assert found == pytest.approx(expected, **EXACT)


class Case(NamedTuple):
    """A retrieval; `terms` are total activations."""

    params: str
    chunks: str
    request: str
    t_s: float
    result: str | None
    ms: int
    terms: dict[str, float]
    similarities: str = ""
    buffers: str = ""


CRIMSON = "a isa item color crimson @ 0.0"
TIE = "zz isa item v 1 @ 0.0 | aa isa item v 2 @ 0.0"
THREE = (
    "a isa item color crimson shape circle @ 0.0 | "
    "b isa item color crimson shape square @ 0.0;3.0 | "
    "c isa item color azure shape circle @ 0.0;3.0;4.0"
)
FOUR = (
    "a isa item color crimson shape circle @ 0.0 | b isa item color azure shape circle @ 0.0 | "
    "c isa item color azure shape square @ 0.0 | d isa item color crimson @ 0.0"
)
FIVE = (
    "f1 isa item color crimson shape circle @ 0.0 | f2 isa item color crimson shape square @ 0.0"
    " | f3 isa item color azure shape circle @ 0.0 | f4 isa item color crimson shape crimson @ 0.0"
    " | f5 isa item size crimson @ 0.0"
)
HEADINGS = "h0 isa item v 0 @ 0.0 | h90 isa item v 90 @ 0.0 | h300 isa item v 300 @ 0.0"
RECENT = "near isa item v 3 @ 0.0 | far isa item v 7 @ 0.0;4.0;4.5;4.8"
NUMBERS = (
    "n1 isa item v 1 @ 0 | n2 isa item v 2 @ 0 | n25 isa item v 2.5 @ 0 | n10 isa item v 10 @ 0"
)
SIZES = "lo isa item v 1 @ 0.0 | eq isa item v 3 @ 0.0 | hi isa item v 6 @ 0.0"
PAIRS = "(crimson azure -0.3) (circle square -0.6)"
BOTH = "isa item color crimson shape circle"
FLAT = ":bll nil :rt -20.0 :lf 0.1"

EXACT_MATCHING = [
    Case(":rt -10.0 :lf 0.5 :le 0.5", CRIMSON, "isa item color crimson", 4.0, "a", 707, {}),
    Case(":rt -2.0 :lf 0.1", CRIMSON, "isa item color azure", 1.0, None, 739, {}),
    Case(":rt 0.0 :lf 0.1", CRIMSON, "isa item color crimson", 1.0, "a", 100, {"a": 0.0}),
    # referred to at the very instant: counts as 50 ms old
    Case(":rt -10.0 :lf 0.1", CRIMSON, "isa item", 0.0, "a", 22, {"a": 1.4978661367769954}),
    Case(
        ":rt -5.0 :lf 0.1",
        THREE,
        "isa item - color crimson",
        5.0,
        "c",
        46,
        {"c": 0.7674753033688964},
    ),
    Case(
        ":rt -5.0 :lf 0.1 :blc 1.0",
        THREE,
        "isa item color crimson",
        5.0,
        "b",
        32,
        {"a": 0.1952810437829493, "b": 1.1435117523344362},
    ),
    Case(":rt -5.0 :lf 0.1", TIE, "isa item", 5.0, "aa", 224, {}),
    Case(":esc nil :lf 0.1", CRIMSON, "isa item color azure", 5.0, None, 0, {}),
]
PARTIAL_MATCHING = [
    Case(
        FLAT + " :mp 2.5",
        FOUR,
        BOTH,
        1.0,
        "a",
        100,
        {"a": 0.0, "b": -0.75, "c": -2.25},  # d lacks a slot: no candidate
        similarities=PAIRS,
    ),
    Case(
        FLAT + " :mp 1.0 :ms 1.0 :md -2.0",
        FOUR,
        BOTH,
        1.0,
        "a",
        14,
        {"a": 2.0, "b": -1.0, "c": -4.0},
    ),
    Case(FLAT + " :mp 1.0", NUMBERS, "isa item > v 2", 1.0, "n10", 100, {"n25": 0.0, "n10": 0.0}),
    Case(FLAT + " :mp 1.0", FOUR, "isa item color azure shape nil", 1.0, "d", 272, {"d": -1.0}),
    Case(
        FLAT + " :mp 2.5",
        FOUR,
        "isa item - color crimson",
        1.0,
        "b",
        100,
        {"a": -2.5, "b": 0.0, "c": 0.0, "d": -2.5},
    ),
    Case(
        FLAT + " :mp 1.0 :sim-hook angular",
        HEADINGS,
        "isa item v 330",
        1.0,
        "h300",
        107,
        {"h0": -0.06698729810778081, "h90": -0.7500000000000002, "h300": -0.06698729810778065},
    ),
    Case(
        ":rt -1.0 :lf 0.1 :mp 0.5 :sim-hook linear10",
        RECENT,
        "isa item v 5",
        5.0,
        "far",
        22,
        {"near": -0.9047189562170507, "far": 1.5287492691497533},
    ),
    Case(
        FLAT + " :mp 1.0 :sim-hook asym",
        SIZES,
        "isa item v 3",
        1.0,
        "eq",
        105,
        {"lo": -0.4, "eq": -0.05, "hi": -0.1},
    ),
]
SPREADING = [
    Case(
        FLAT + " :mas 2.0 :ga 1.0",
        FIVE,
        "isa item",
        1.0,
        "f1",
        57,
        {
            "f1": 0.5548141210519176,
            "f2": 0.10412026538597252,
            "f3": 0.4506938556659451,
            "f4": 0.4506938556659451,  # has crimson twice
            "f5": 0.10412026538597252,
        },
        buffers="(goal (g isa x s1 crimson s2 circle))",
    ),
    Case(
        FLAT + " :mas 2.0 :ga 0.0",  # the imaginal buffer spreads 1 unless told
        FIVE,
        "isa item",
        1.0,
        "f4",
        41,
        {
            "f1": 0.20824053077194504,
            "f2": 0.20824053077194504,
            "f3": 0.0,
            "f4": 0.9013877113318902,
            "f5": 0.20824053077194504,
        },
        buffers="(imaginal (i isa x s1 crimson))",
    ),
    Case(
        FLAT + " :mas 2.0 :ga 1.0",
        FIVE,
        "isa item",
        1.0,
        "f1",
        14,
        {"f1": 2.0, "f2": 0.0, "f3": 0.0, "f4": 0.0, "f5": 0.0},
        buffers="(goal (g isa x s1 f1))",
    ),
    Case(
        FLAT + " :mas 1.0 :ga 1.0",  # all strengths would be negative
        FIVE,
        "isa item",
        1.0,
        "f1",
        100,
        {"f1": 0.0, "f2": 0.0, "f3": 0.0, "f4": 0.0, "f5": 0.0},
        buffers="(goal (g isa x s1 crimson))",
    ),
    Case(
        ":bll 0.5 :rt -20.0 :lf 0.1 :mas 2.0 :ga 1.0 :mp 1.0",
        FIVE,
        "isa item color azure shape circle",
        4.0,
        "f3",
        127,
        {
            "f1": -1.1383330595080277,
            "f2": -2.5890269151739727,
            "f3": -0.2424533248940003,
            "f4": -2.2424533248940004,
        },
        buffers="(goal (g isa x s1 crimson s2 circle))",
    ),
]


@pytest.mark.parametrize("case", EXACT_MATCHING + PARTIAL_MATCHING + SPREADING)
def test_retrievals_of_actr(case):
    memory = case_of(case.params, case.chunks, case.similarities)
    found = memory.retrieve(request_of(case.request), case.t_s, sources_of(case.buffers))
    assert (found.chunk.name if found.chunk else None) == case.result
    assert round(1000 * found.latency_s, 9) == case.ms
    if case.terms:
        assert {row.name: row.total for row in found.candidates.rows()} == pytest.approx(
            case.terms, **EXACT
        )
