"""Files of memory: round trips, equal bytes, base levels kept, and files that are refused."""

import json
import math
import subprocess
import sys
from dataclasses import MISSING, fields
from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from saved_memories import chunk, landmark, memories, memory

from ssrics_like.errors import MemoryFileError
from ssrics_like.memory import (
    Arc,
    Chunk,
    DeclarativeMemory,
    Landmark,
    MemoryParameters,
    RememberedChunk,
    SavedMemory,
    TopologicalMemory,
    View,
    load_memory_file,
    save_memory_file,
)

ANY = settings(
    suppress_health_check=[HealthCheck.function_scoped_fixture, HealthCheck.too_slow],
    max_examples=60,
    deadline=None,
)


def saved(tmp_path, what=None, name="run.json"):
    path = tmp_path / name
    save_memory_file(what or memory(), path)
    return path


def close(one, other, decimals=6):
    """Equal but for what rounding takes."""
    if isinstance(one, float):
        return math.isclose(one, other, rel_tol=1e-12, abs_tol=0.51 * 10**-decimals)
    if isinstance(one, View):
        # A number of the file is rounded, and once more to the nearest float32.
        return one.name == other.name and np.allclose(
            one.descriptor, other.descriptor, rtol=1.2e-7, atol=5.1e-7
        )
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(
            close(one[key], other[key], decimals) for key in one
        )
    if isinstance(one, tuple):
        return len(one) == len(other) and all(map(close, one, other, [decimals] * len(one)))
    if hasattr(one, "__dataclass_fields__"):
        fields = [{f: getattr(each, f) for f in one.__dataclass_fields__} for each in (one, other)]
        return type(one) is type(other) and close(*fields, decimals)
    return type(one) is type(other) and one == other


@ANY
@given(memory=memories())
def test_what_is_saved_comes_back(tmp_path, memory):
    first = saved(tmp_path, memory, "first.json")
    loaded = load_memory_file(first)
    assert close(memory, loaded)
    for one, other in zip(memory.chunks, loaded.chunks, strict=True):
        assert close(one.ages_s, other.ages_s, 9)
        symbols = [
            {k: v for k, v in each.chunk.slots.items() if isinstance(v, str | int | float)}
            for each in (one, other)
        ]
        assert symbols[0] == symbols[1]
    assert saved(tmp_path, loaded, "second.json").read_bytes() == first.read_bytes()


def test_equal_memories_give_equal_bytes_and_nothing_else_is_left(tmp_path):
    contents = {saved(tmp_path).read_bytes() for _ in range(3)}
    assert len(contents) == 1
    assert [path.name for path in tmp_path.iterdir()] == ["run.json"]


def test_the_file_is_json_with_a_line_for_each_chunk(tmp_path):
    text = saved(tmp_path).read_text()
    data = json.loads(text)
    assert (data["format"], data["version"], data["saved_s"]) == ("ssrics-memory", 3, 100.0)
    assert data["chunks"][0]["ages_s"] == [60.0, 12.5]
    assert data["topology"]["nodes"][0]["origin"] == "run-a/L1"
    assert sum(line.startswith('{"name": "L') for line in text.splitlines()) == 3


def history(parameters, rng, count=200, now_s=500.0):
    """A memory whose chunks were used at random, some of them just now."""
    declarative = DeclarativeMemory(parameters)
    for number in range(count):
        ages_s = np.sort(rng.exponential(20.0, 5))[::-1]
        ages_s[-1] = rng.choice([0.0, 0.05, 0.0507, ages_s[-1]])
        first_s, *later_s = now_s - np.minimum(ages_s, now_s)
        declarative.add(chunk(number).chunk, first_s)
        for t_s in later_s:
            declarative.strengthen(f"L{number}", t_s)
    return declarative


@pytest.mark.parametrize("learning", [False, True, 2])
@pytest.mark.parametrize("decay", [0.1, 0.5, 0.95])
def test_base_levels_after_loading_are_those_before_to_a_millionth(tmp_path, decay, learning):
    parameters = MemoryParameters(decay=decay, optimized_learning=learning)
    before = history(parameters, np.random.default_rng(3))
    kept = taken_down(before, now_s=500.0)
    loaded = load_memory_file(saved(tmp_path, kept))
    after = DeclarativeMemory(parameters)
    loaded.aged(7.0).recall_into(after)  # seven seconds pass, then the new run's clock starts at 0
    assert after.names == before.names
    for later_s in (0.0, 0.05, 100.0):
        np.testing.assert_allclose(
            after.activations(later_s), before.activations(507.0 + later_s), rtol=0, atol=1e-6
        )


def taken_down(declarative, **clock):
    return SavedMemory.of(
        declarative,
        TopologicalMemory(),
        run="a",
        start_s=0.0,
        frame="map",
        **clock,
    )


def test_six_decimals_of_an_age_would_not_do():
    """What the ninth is for: d ln(0.05) at 50 ms grows by d / 0.05 a second."""
    exact = -0.95 * math.log(0.0500004)
    assert abs(exact - -0.95 * math.log(round(0.0500004, 6))) > 1e-6
    assert abs(exact - -0.95 * math.log(round(0.0500004, 9))) < 1e-7


def test_chunks_that_became_equal_stay_two(tmp_path):
    twin = RememberedChunk(Chunk("twin", "landmark", chunk(1).chunk.slots), (3.0,))
    loaded = load_memory_file(saved(tmp_path, memory(1, chunks=(chunk(1), twin))))
    declarative = DeclarativeMemory(MemoryParameters())
    loaded.recall_into(declarative)
    assert declarative.names == ("L1", "twin")
    assert declarative.references("twin").tolist() == [-3.0]


def test_fields_of_arcs_and_landmarks_that_came_later_have_their_defaults(tmp_path):
    path = saved(tmp_path)
    data = json.loads(path.read_bytes())
    lists = {Arc: data["topology"]["edges"], Landmark: data["topology"]["nodes"]}
    for kind, items in lists.items():
        for later in [f.name for f in fields(kind) if f.default is not MISSING]:
            for item in items:
                del item[later]
    path.write_text(json.dumps(data))
    assert load_memory_file(path).arcs == memory().arcs
    assert load_memory_file(path).landmarks == memory().landmarks


@pytest.mark.parametrize(
    ("version", "length", "least", "kept", "length_now"),
    [
        (1, 72, 0.0, 72, 108), (1, 72, -0.5, 72, 72), (1, 36, 0.0, 36, 36),
        (2, 108, 0.0, 72, 108), (2, 108, -0.5, 108, 108), (2, 36, 0.0, 36, 36),
        (3, 108, 0.0, 108, 108),
    ],
)  # fmt: skip
def test_vistas_of_older_versions_are_unknown(tmp_path, version, length, least, kept, length_now):
    path = saved(tmp_path)
    data = json.loads(path.read_bytes())
    data["version"] = version
    numbers = [0.5 * i + least for i in range(length)]
    for each in data["chunks"]:
        for value in each["slots"].values():
            if isinstance(value, dict):
                value["numbers"] = numbers
    path.write_text(json.dumps(data))
    expected = numbers[:kept] + [0.0] * (length_now - kept)
    slots = [value for each in load_memory_file(path).chunks for value in each.chunk.slots.values()]
    views = [value for value in slots if isinstance(value, View)]
    assert views
    assert all(view.descriptor.tolist() == expected for view in views)


def changed(tmp_path, change):
    path = saved(tmp_path)
    data = json.loads(path.read_bytes())
    path.write_text(json.dumps(change(data)))
    return path


def setting(*keys, value):
    def change(data):
        at = data
        for key in keys[:-1]:
            at = at[key]
        at[keys[-1]] = value
        return data

    return change


CHUNK, NODE = ("chunks", 0), ("topology", "nodes", 0)


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda _: [1, 2], "no saved memory: its format is None, expected 'ssrics-memory'"),
        (lambda _: None, "no saved memory: its format is None"),
        (setting("format", value="ssrics-topology"), "its format is 'ssrics-topology'"),
        (setting("version", value=4), "newer ssrics: its version is 4, this one reads up to 3"),
        (setting("version", value=True), "damaged: its version is True"),
        (setting("saved_s", value="now"), "saved_s is 'now', expected a number"),
        (setting("saved_s", value=math.inf), "saved_s is inf"),
        (setting("frame", value=None), "frame is None, expected text"),
        (setting("runs", value={}), "runs is {}, expected a list"),
        (setting("runs", 0, value="a"), "runs: one is 'a'"),
        (setting("runs", 0, "ended_ago_s", value=-1), "run 'run-a': ended_ago_s is -1"),
        (setting("chunks", value=None), "chunks is None, expected a list"),
        (setting(*CHUNK, value=[]), r"chunks: one is \[\], expected its name"),
        (setting(*CHUNK, "name", value=7), "chunks: a name is 7, expected text"),
        (setting(*CHUNK, "name", value="L2"), "chunk 'L2' stands in it twice"),
        (setting(*CHUNK, "type", value=None), "chunk 'L1': type is None"),
        (setting(*CHUNK, "slots", value=[]), "chunk 'L1': slots is"),
        (setting(*CHUNK, "ages_s", value=[]), "chunk 'L1' has no reference"),
        (setting(*CHUNK, "ages_s", value=[1, -2]), "chunk 'L1': an age is -2.0; expected 0 or"),
        (setting(*CHUNK, "ages_s", value=[1, "2"]), "ages_s holds '2', expected finite numbers"),
        (setting(*CHUNK, "ages_s", value=[True]), "ages_s holds True"),
        (setting(*CHUNK, "slots", "id", value=None), "chunk 'L1': id is None, expected text, a"),
        (setting(*CHUNK, "slots", "id", value=math.nan), "chunk 'L1': id is nan"),
        (setting(*CHUNK, "slots", "view", value={"image": 1}), "view is {'image': 1}, expected"),
        (setting(*CHUNK, "slots", "view", "view", value=3), "chunk 'L1': view: view is 3"),
        (setting(*CHUNK, "slots", "view", "numbers", value=[1]), "expected one row of at least 2"),
        (setting(*CHUNK, "slots", "view", "numbers", value=[1, 2]), "views have 2 and 36 numbers"),
        (setting(*CHUNK, "slots", "view", "numbers", 0, value="1"), "numbers holds '1'"),
        (setting(*CHUNK, "slots", "view", "numbers", 0, value=1e300), "holds a value that is not"),
        (setting("topology", value=[]), "topology is"),
        (setting("topology", "nodes", value=3), "topology: nodes is 3"),
        (setting(*NODE, value="L1"), "topology: a landmark is 'L1'"),
        (setting(*NODE, "id", value=None), "topology: a landmark's id is None"),
        (setting(*NODE, "origin", value=7), "landmark 'L1': origin is 7, expected text"),
        (setting(*NODE, "origin", value="run-a/L2"), "origin 'run-a/L2' stands in it twice"),
        (setting(*NODE, "x_m", value="here"), "landmark 'L1': x_m is 'here'"),
        (setting("topology", "graph", "version", value=9), "its version is 9"),
        (setting("topology", "edges", 0, "target", value="L9"), "landmark 'L9': x_m is None"),
    ],
)
def test_damage_is_told_in_one_line(tmp_path, change, message):
    path = changed(tmp_path, change)
    with pytest.raises(MemoryFileError, match=message) as caught:
        load_memory_file(path)
    assert str(caught.value).startswith(str(path))
    assert "\n" not in str(caught.value)


def test_a_file_cut_short_is_damaged_whatever_is_left(tmp_path):
    path = saved(tmp_path)
    whole = path.read_bytes()
    for length in range(0, len(whole.rstrip()), 41):
        path.write_bytes(whole[:length])
        with pytest.raises(MemoryFileError, match=r"run\.json(:\d+)?: damaged"):
            load_memory_file(path)


@ANY
@given(data=st.data())
def test_a_file_of_random_changes_is_read_or_refused_in_a_line(tmp_path, data):
    path = saved(tmp_path, memory(1, 2))
    whole = bytearray(path.read_bytes())
    for _ in range(data.draw(st.integers(1, 3))):
        at = data.draw(st.integers(0, len(whole) - 1))
        whole[at : at + data.draw(st.integers(0, 9))] = data.draw(
            st.sampled_from(
                [b"", b"0", b"-", b'"', b"[", b"}", b"null", b"1e999", b"\x80", b"9" * 5000]
            )
        )
    path.write_bytes(whole)
    said = ""
    try:
        load_memory_file(path)
    except MemoryFileError as error:
        said = str(error)
    assert "\n" not in said


@pytest.mark.parametrize(
    ("content", "message"),
    [
        (b"", "run.json:1: damaged: Expecting value"),
        (b"\x1f\x8b\x08", "damaged: 'utf-8' codec"),
        (b"[" * 100_000, "damaged: nested too deep"),
        (b"<graphml/>", "run.json:1: damaged"),
    ],
)
def test_foreign_files_are_refused(tmp_path, content, message):
    path = tmp_path / "run.json"
    path.write_bytes(content)
    with pytest.raises(MemoryFileError, match=message):
        load_memory_file(path)


def test_what_cannot_be_read_or_written_is_named(tmp_path):
    with pytest.raises(MemoryFileError, match=r"no\.json: cannot be read: No such file"):
        load_memory_file(tmp_path / "no.json")
    (tmp_path / "run.json").mkdir()
    for act in (load_memory_file, lambda path: save_memory_file(memory(), path)):
        with pytest.raises(MemoryFileError, match=r"run\.json: cannot be .*: Is a directory"):
            act(tmp_path / "run.json")
    odd = memory(1, chunks=(chunk(1, x=math.inf),))
    with pytest.raises(MemoryFileError, match="chunks hold a number that is not finite"):
        save_memory_file(odd, tmp_path / "odd.json")
    assert [path.name for path in tmp_path.iterdir()] == ["run.json"]


KILLED = """
import os, sys
from pathlib import Path
sys.path.insert(0, {tests!r})
from saved_memories import memory
from ssrics_like.memory import save_memory_file
path = Path({path!r})
save_memory_file(memory(1), path)
print("begun", flush=True)
while True:
    save_memory_file(memory(*range(1, 200)), path)
    save_memory_file(memory(1), path)
"""


def test_a_file_is_whole_whenever_the_writer_is_killed(tmp_path):
    path = tmp_path / "run.json"
    code = KILLED.format(tests=str(Path(__file__).parent), path=str(path))
    for delay_s in (0.0, 0.03, 0.1):
        writer = subprocess.Popen([sys.executable, "-c", code], stdout=subprocess.PIPE)
        assert writer.stdout.readline() == b"begun\n"
        try:
            writer.wait(delay_s)
        except subprocess.TimeoutExpired:
            writer.kill()
        writer.wait()
        writer.stdout.close()
        assert len(load_memory_file(path).landmarks) in (1, 199)


def test_what_does_not_hang_together_is_no_memory():
    for changes, message in [
        ({"origins": {}}, "landmark 'L1' has no origin"),
        ({"origins": {"L1": "a", "L2": "b", "L3": "c", "L4": "d"}}, "'L4' has an origin but is"),
        ({"landmarks": (landmark(1), landmark(1))}, "landmark 'L1' stands in it twice"),
        ({"landmarks": (landmark(1),), "origins": {"L1": "a"}}, "joins no landmarks"),
        ({"saved_s": math.nan}, "saved_s is nan"),
        ({"chunks": (chunk(1, math.inf),)}, "chunk 'L1': an age is inf"),
        ({"chunks": (chunk(1), chunk(2, beams=5))}, "views have 5 and 36 numbers"),
    ]:
        with pytest.raises(ValueError, match=message):
            memory(**changes)


def test_time_passes_for_all_that_has_a_time():
    later = memory().aged(10.0)
    assert later.chunks[0].ages_s == (70.0, 22.5)
    assert (later.landmarks[0].t_s, later.landmarks[0].last_visit_s) == (-70.0, -22.5)
    assert later.runs[0].ended_ago_s == 10.0
    assert later.topological(1000.0)["L1"].t_s == 930.0
    with pytest.raises(ValueError, match="seconds is -1"):
        memory().aged(-1.0)
