"""Declarative memory against a slow twin that reads ACT-R's equations word for word."""

import math

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from ssrics_like.memory import (
    Chunk,
    DeclarativeMemory,
    MemoryParameters,
    Request,
    TableSimilarity,
)

SYMBOLS = ["red", "blue", "green", "x1"]
SLOTS = ["colour", "shape", "size"]
TABLE = {("red", "blue"): -0.3, ("green", "green"): -0.2, (1.0, 2.0): -0.1}


class TwinMemory:
    """One chunk, one reference, one test at a time."""

    def __init__(self, parameters):
        self.p = parameters
        self.chunks = []  # [chunk, references]

    def add(self, chunk, t_s):
        for known, references in self.chunks:
            if known.type == chunk.type and known.slots == chunk.slots:
                references.append(t_s)
                return known.name
        self.chunks.append((chunk, [t_s]))
        return chunk.name

    def retrieve(self, request, t_s, sources):
        rows = []
        for chunk, references in self.chunks:
            if self.candidate(chunk, request):
                terms = (
                    self.base_level(references, t_s),
                    self.spreading(chunk, sources),
                    self.partial_match(chunk, request),
                )
                rows.append((chunk.name, *terms, sum(terms)))
        return rows

    def candidate(self, chunk, request):
        if request.type not in (None, chunk.type):
            return False
        partial = self.p.mismatch_penalty is not None
        for slot, value, modifier in request.slots:
            held = chunk.slots.get(slot)
            if value is None:
                fits = (held is not None) == modifier
            elif modifier is False:
                fits = held is not None and (partial or held == value)
            elif modifier is True:
                fits = partial or held != value
            else:
                fits = (
                    isinstance(held, float)
                    and {
                        "<": held < value,
                        "<=": held <= value,
                        ">": held > value,
                        ">=": held >= value,
                    }[modifier]
                )
            if not fits:
                return False
        return True

    def base_level(self, references, t_s):
        if self.p.decay is None:
            return self.p.base_level_constant
        d, k = self.p.decay, self.p.optimized_learning
        ages = sorted(t_s - t for t in references)
        n = len(ages)
        if k is True:
            return self.p.base_level_constant + math.log(n / (1 - d) * max(0.05, ages[-1]) ** -d)
        kept = ages if k is False else ages[:k]
        total = sum(max(0.05, age) ** -d for age in kept)
        if n > len(kept):
            rise = (ages[-1] ** (1 - d) - kept[-1] ** (1 - d)) / (1 - d)
            total += (n - len(kept)) * rise / max(0.05, ages[-1] - kept[-1])
        return self.p.base_level_constant + math.log(total)

    def similarity(self, requested, held):
        for pair in ((requested, held), (held, requested)):
            if pair in TABLE:
                return TABLE[pair]
        return self.p.max_similarity if requested == held else self.p.max_difference

    def partial_match(self, chunk, request):
        total = 0.0
        if self.p.mismatch_penalty is None:
            return total
        for slot, value, modifier in request.slots:
            held = chunk.slots.get(slot)
            if value is None or held is None or not isinstance(modifier, bool):
                continue
            similarity = self.similarity(value, held)
            if modifier is False:
                total += self.p.mismatch_penalty * similarity
            elif similarity == self.p.max_similarity:
                total += self.p.mismatch_penalty * self.p.max_difference
        return total

    def spreading(self, chunk, sources):
        total = 0.0
        if self.p.strength_of_association is None:
            return total
        for buffer, symbols in sources.items():
            for j in symbols:
                fan = 1 + sum(list(c.slots.values()).count(j) for c, _ in self.chunks)
                links = list(chunk.slots.values()).count(j) + (chunk.name == j)
                if links:
                    strength = self.p.strength_of_association - math.log(fan / links)
                    if self.p.association_floor is not None:
                        strength = max(strength, self.p.association_floor)
                    weight = self.p.source_activation.get(buffer, 0.0)
                    total += weight / len(symbols) * strength
        return total


VALUES = st.sampled_from([*SYMBOLS, 1.0, 2.0, 3.5])
CONTENTS = st.tuples(
    st.sampled_from(["mark", "other"]), st.dictionaries(st.sampled_from(SLOTS), VALUES)
)
EVENTS = st.lists(st.tuples(CONTENTS, st.floats(0, 9)), min_size=1, max_size=14)
TESTS = st.one_of(
    st.tuples(st.sampled_from(SLOTS), st.one_of(st.none(), VALUES), st.booleans()),
    st.tuples(
        st.sampled_from(SLOTS), st.sampled_from([1.0, 2.0]), st.sampled_from(["<", ">=", ">"])
    ),
)
REQUESTS = st.builds(
    Request,
    st.sampled_from(["mark", "other", None]),
    st.lists(TESTS, max_size=3).map(tuple),
)
SOURCES = st.dictionaries(
    st.sampled_from(["goal", "imaginal", "other"]),
    st.lists(st.sampled_from([*SYMBOLS, "c0", "nowhere"]), max_size=3),
)
PARAMETERS = st.builds(
    MemoryParameters,
    decay=st.sampled_from([None, 0.2, 0.5, 0.8]),
    base_level_constant=st.sampled_from([0.0, 0.7]),
    optimized_learning=st.sampled_from([False, True, 1, 3]),
    retrieval_threshold=st.sampled_from([-20.0, -1.0, 0.5]),
    latency_factor=st.sampled_from([0.1, 1.0]),
    latency_exponent=st.sampled_from([0.5, 1.0]),
    mismatch_penalty=st.sampled_from([None, 0.5, 2.0]),
    max_similarity=st.sampled_from([0.0, 1.0]),
    max_difference=st.sampled_from([-1.0, -2.0]),
    strength_of_association=st.sampled_from([None, 1.0, 3.0]),
    association_floor=st.sampled_from([0.0, None]),
    source_activation=st.just({"imaginal": 1.0, "goal": 0.6}),
)


@settings(max_examples=250, deadline=None)
@given(PARAMETERS, EVENTS, REQUESTS, SOURCES)
def test_agrees_with_the_literal_twin(parameters, events, request, sources):
    similarity = TableSimilarity(TABLE)
    memory = DeclarativeMemory(parameters, similarities=dict.fromkeys(SLOTS, similarity))
    twin = TwinMemory(parameters)
    for number, ((kind, slots), t_s) in enumerate(events):
        chunk = Chunk(f"c{number}", kind, slots)
        assert memory.add(chunk, t_s) == twin.add(chunk, t_s)
    found = memory.retrieve(request, 10.0, sources)
    expected = twin.retrieve(request, 10.0, sources)
    check(found, expected, parameters)


def check(found, expected, parameters):
    rows = {row.name: row for row in found.candidates.rows()}
    assert set(rows) == {name for name, *_ in expected}
    for name, base, spread, partial, total in expected:
        row = rows[name]
        terms = (row.base_level, row.spreading, row.partial_match, row.total)
        assert terms == pytest.approx((base, spread, partial, total), rel=1e-9, abs=1e-9)
    best = max((total for *_, total in expected), default=-math.inf)
    if abs(best - parameters.retrieval_threshold) < 1e-9:
        return
    if best < parameters.retrieval_threshold:
        assert found.chunk is None
        best = parameters.retrieval_threshold
    else:
        assert found.activation == pytest.approx(best, rel=1e-9, abs=1e-9)
        near = [name for name, *_, total in expected if best - total < 1e-9]
        assert found.chunk.name in near
    latency_ms = parameters.latency_factor * 1000 * math.exp(-parameters.latency_exponent * best)
    assert 1000 * found.latency_s == pytest.approx(latency_ms, abs=0.5 + 1e-6, rel=1e-9)


def test_random_histories_of_many_chunks_agree():
    rng = np.random.default_rng(5)
    parameters = MemoryParameters(mismatch_penalty=1.0, retrieval_threshold=-20.0)
    similarity = TableSimilarity(TABLE)
    memory = DeclarativeMemory(parameters, similarities=dict.fromkeys(SLOTS, similarity))
    twin = TwinMemory(parameters)
    for number, t_s in enumerate(np.sort(rng.uniform(0, 500, 400)).tolist()):
        slots = {slot: str(rng.choice(SYMBOLS)) for slot in SLOTS}
        chunk = Chunk(f"c{number}", "mark", slots)
        assert memory.add(chunk, t_s) == twin.add(chunk, t_s)
    assert len(memory) < 400
    request = Request("mark", (("colour", "red", False), ("shape", "blue", True)))
    check(memory.retrieve(request, 501.0), twin.retrieve(request, 501.0, {}), parameters)
