"""Saved memories for tests: one written out, and any at all."""

import itertools

import numpy as np
from hypothesis import strategies as st

from ssrics_like.memory import (
    Arc,
    Chunk,
    Home,
    Landmark,
    PastRun,
    RememberedChunk,
    SavedMemory,
    View,
)

BEAMS = 36
TEXT = st.text(min_size=1, max_size=5).filter(str.isprintable)
NUMBERS = st.floats(-1e6, 1e6)
AGES = st.floats(0, 1e9)


def chunk(number, *ages_s, beams=BEAMS, **slots):
    rng = np.random.default_rng(number)
    name = f"L{number}"
    filled = {
        "id": name,
        "sector": "left",
        "structure": "doorway",
        "view": View(f"view-{number}", rng.normal(0, 1, beams)),
        "place": f"place-of-{name}",
        **slots,
    }
    return RememberedChunk(Chunk(name, "landmark", filled), ages_s or (60.0, 12.5))


def landmark(number, **changes):
    values = {
        "x_m": 2.0 * number,
        "y_m": -1.0,
        "theta_rad": 0.5,
        "t_s": -60.0,
        "last_visit_s": -12.5,
        "visits": 2,
        "labels": {"sector": "left", "structure": "doorway", "novelty": 0.75},
    }
    return Landmark(id=f"L{number}", **{**values, **changes})


def arc(one, other, traversals=1, distance_m=2.0):
    return Arc(f"L{one}", f"L{other}", traversals, distance_m, 0.0, 0.25, 0.0, 2.5, 0.0)


def memory(*numbers, run="run-a", **changes):
    """A memory of landmarks in a row, joined one to the next."""
    numbers = numbers or (1, 2, 3)
    values = {
        "saved_s": 100.0,
        "frame": "odometry",
        "runs": (PastRun(run, 0.0),),
        "chunks": tuple(chunk(n) for n in numbers),
        "landmarks": tuple(landmark(n) for n in numbers),
        "arcs": tuple(arc(*ends) for ends in itertools.pairwise(numbers)),
        "origins": {f"L{n}": f"{run}/L{n}" for n in numbers},
    }
    return SavedMemory(**{**values, **changes})


@st.composite
def values(draw, beams):
    kind = draw(st.sampled_from(["text", "number", "view"]))
    if kind == "text":
        return draw(st.text(max_size=5))
    if kind == "number":
        return draw(st.one_of(NUMBERS, st.integers(-1000, 1000)))
    numbers = draw(st.lists(st.floats(-100, 100, width=32), min_size=beams, max_size=beams))
    return View(draw(TEXT), np.array(numbers, np.float32))


@st.composite
def memories(draw):
    """Any memory: chunks of any type and slots, and a graph that need not fit to them."""
    beams = draw(st.integers(2, 5))
    slots = st.dictionaries(st.sampled_from(["id", "view", "place", "x"]), values(beams))
    ages = st.lists(AGES, min_size=1, max_size=4).map(tuple)
    chunks = tuple(
        RememberedChunk(Chunk(name, draw(st.sampled_from(["landmark", "task"])), draw(slots)), aged)
        for name, aged in draw(st.dictionaries(st.text(max_size=5), ages, max_size=5)).items()
    )
    names = draw(st.lists(TEXT, unique=True, max_size=4))
    labels = st.dictionaries(st.sampled_from(["sector", "novelty"]), st.one_of(TEXT, NUMBERS))
    landmarks = tuple(
        Landmark(
            name,
            *draw(st.tuples(*[NUMBERS] * 5)),
            draw(st.integers(1, 99)),
            draw(labels),
            *draw(st.tuples(*[st.integers(0, 9)] * 2)),
        )
        for name in names
    )
    ends = st.tuples(st.sampled_from(names), st.sampled_from(names)) if names else st.just(None)
    lengths = st.floats(0, 1e3)
    arcs = tuple(
        Arc(*pair, draw(st.integers(1, 9)), draw(lengths), 0.0, 0.5, 0.0, draw(lengths), 0.0)
        for pair in sorted(  # a graph has them by the order of their first landmark
            draw(st.lists(ends, unique=True, max_size=4 if names else 0)),
            key=lambda pair: names.index(pair[0]),
        )
    )
    runs = draw(st.dictionaries(TEXT, AGES, max_size=3))
    spread = st.floats(0.001, 1e3)
    homes = st.builds(Home, st.sampled_from(names), *[NUMBERS] * 3, spread, spread)
    return SavedMemory(
        saved_s=draw(NUMBERS),
        frame=draw(st.sampled_from(["odometry", "map"])),
        runs=tuple(PastRun(*run) for run in runs.items()),
        chunks=chunks,
        landmarks=landmarks,
        arcs=arcs,
        origins={name: f"run/{number}" for number, name in enumerate(names)},
        home=draw(st.none() | homes) if names else None,
    )
