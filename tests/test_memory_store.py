"""Saved topological memories: round trips, equal bytes, and files that cannot be read."""

import json
import math
import re

import networkx as nx
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from ssrics_like.errors import MemoryFileError
from ssrics_like.memory import TopologicalMemory, load_topology, save_topology

ENDINGS = [".json", ".graphml"]
TEXT = st.text(min_size=1, max_size=6).filter(str.isprintable)
NUMBERS = st.floats(-1e6, 1e6)
LABELS = st.dictionaries(
    st.sampled_from(["sector", "structure", "novelty", "label", "type", "source", "key", "name"]),
    st.one_of(TEXT, NUMBERS, st.integers(-1000, 1000), st.booleans()),
    max_size=3,
)


@st.composite
def memories(draw):
    memory = TopologicalMemory()
    names = draw(st.lists(TEXT, unique=True, max_size=5))
    for name in names:
        memory.add_landmark(name, *draw(st.tuples(*[NUMBERS] * 4)), **draw(LABELS))
    for _ in range(draw(st.integers(0, 8)) if names else 0):
        ends = draw(st.tuples(st.sampled_from(names), st.sampled_from(names)))
        measured = draw(st.tuples(st.floats(0, 1e3), st.floats(-9, 9), st.floats(0, 1e3)))
        memory.traverse(*ends, *measured)
        memory.miss(ends[0])
        memory.visit(ends[1], draw(NUMBERS))
    return memory


def example():
    memory = TopologicalMemory()
    memory.add_landmark("L1", 1.23456789, -2.0, 0.5, 3.0, sector="left", novelty=0.1234567)
    memory.add_landmark('Tür <2> & "co"', 4.0, 0.0, 0.0, 9.5, sector="front", gate=True)
    memory.traverse("L1", 'Tür <2> & "co"', 3.1, 0.25, 4.7)
    memory.traverse("L1", 'Tür <2> & "co"', 3.3, -0.25, 4.9)
    return memory


def close(one, other):
    """Equal but for what rounding to 6 decimals takes."""
    if isinstance(one, float):
        return math.isclose(one, other, rel_tol=0, abs_tol=5.1e-7)
    if isinstance(one, dict):
        return one.keys() == other.keys() and all(close(one[key], other[key]) for key in one)
    return type(one) is type(other) and one == other


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=60)
@pytest.mark.parametrize("ending", ENDINGS)
@given(memory=memories())
def test_what_is_saved_comes_back(tmp_path, ending, memory):
    first, second = tmp_path / f"first{ending}", tmp_path / f"second{ending}"
    save_topology(memory, first)
    loaded = load_topology(first)
    for ours, theirs in [(memory.nodes, loaded.nodes), (memory.arcs, loaded.arcs)]:
        assert len(ours) == len(theirs)
        for one, other in zip(ours, theirs, strict=True):
            assert close(vars(one), vars(other))
    save_topology(loaded, second)
    assert second.read_bytes() == first.read_bytes()


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=20)
@given(memory=memories())
def test_both_formats_hold_the_same(tmp_path, memory):
    paths = [tmp_path / f"memory{ending}" for ending in ENDINGS]
    for path in paths:
        save_topology(memory, path)
    one, other = map(load_topology, paths)
    assert one.nodes == other.nodes
    assert one.arcs == other.arcs


@pytest.mark.parametrize("ending", ENDINGS)
def test_the_same_memory_gives_the_same_bytes_and_leaves_nothing_else(tmp_path, ending):
    path = tmp_path / f"run{ending}"
    contents = set()
    for _ in range(3):
        save_topology(example(), path)
        contents.add(path.read_bytes())
    assert len(contents) == 1
    assert list(tmp_path.iterdir()) == [path]


def test_numbers_have_six_decimals_at_most(tmp_path):
    path = tmp_path / "run.json"
    save_topology(example(), path)
    node = json.loads(path.read_bytes())["nodes"][0]
    assert (node["x_m"], node["novelty"]) == (1.234568, 0.123457)


def test_other_tools_read_both_files(tmp_path):
    for ending in ENDINGS:
        save_topology(example(), tmp_path / f"run{ending}")
    graphs = [
        nx.read_graphml(tmp_path / "run.graphml"),
        nx.node_link_graph(json.loads((tmp_path / "run.json").read_bytes()), edges="edges"),
    ]
    for graph in graphs:
        assert graph.graph.items() >= {"format": "ssrics-topology", "version": 1}.items()
        assert graph.nodes["L1"]["sector"] == "left"
        assert [data["traversals"] for *_, data in graph.edges(data=True)] == [2]


def test_a_file_that_cannot_be_written_is_named(tmp_path):
    (tmp_path / "file").touch()
    for path in (tmp_path / "no" / "run.json", tmp_path / "file" / "run.json"):
        with pytest.raises(MemoryFileError, match=r"run\.json: cannot be written: "):
            save_topology(example(), path)
    (tmp_path / "run.json").mkdir()
    with pytest.raises(MemoryFileError, match="cannot be written"):
        save_topology(example(), tmp_path / "run.json")
    assert sorted(path.name for path in tmp_path.iterdir()) == ["file", "run.json"]


def test_an_unknown_ending_is_refused(tmp_path):
    for act in (lambda p: save_topology(example(), p), load_topology):
        with pytest.raises(MemoryFileError, match=r"ending '\.yaml' names no format; expected"):
            act(tmp_path / "run.yaml")


@pytest.mark.parametrize("ending", ENDINGS)
def test_a_missing_file_is_named(tmp_path, ending):
    with pytest.raises(MemoryFileError, match="cannot be read: No such file"):
        load_topology(tmp_path / f"run{ending}")


@pytest.mark.parametrize("ending", ENDINGS)
def test_a_file_cut_short_is_damaged_whatever_is_left(tmp_path, ending):
    path = tmp_path / f"run{ending}"
    save_topology(example(), path)
    whole = path.read_bytes()
    for length in range(0, len(whole.rstrip()), 37):
        path.write_bytes(whole[:length])
        with pytest.raises(MemoryFileError, match=rf"run{ending}(:\d+)?: "):
            load_topology(path)


@pytest.mark.parametrize("ending", ENDINGS)
def test_a_file_of_random_changes_is_read_or_refused(tmp_path, ending):
    path = tmp_path / f"run{ending}"
    save_topology(example(), path)
    whole = path.read_bytes()
    refusals = []
    for position in range(0, len(whole), 11):
        for byte in b'0"<\x80':
            path.write_bytes(whole[:position] + bytes([byte]) + whole[position + 1 :])
            try:
                load_topology(path)
            except MemoryFileError as error:
                refusals.append(str(error))
    assert refusals
    assert not any("\n" in refusal for refusal in refusals)


def changed(tmp_path, change):
    path = tmp_path / "run.json"
    save_topology(example(), path)
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


@pytest.mark.parametrize(
    ("change", "message"),
    [
        (lambda _: [1, 2], "no topological memory: its format is None"),
        (lambda _: {}, "expected 'ssrics-topology'"),
        (setting("graph", "format", value="maze"), "its format is 'maze'"),
        (setting("graph", "version", value=2), "newer ssrics: its version is 2, this one reads up"),
        (setting("graph", "version", value="1"), "damaged: its version is '1'"),
        (setting("directed", value=False), "have no direction"),
        (
            setting("nodes", 0, "x_m", value="here"),
            "landmark 'L1': x_m is 'here', expected a finite",
        ),
        (setting("nodes", 0, "x_m", value=math.nan), "x_m is nan"),
        (setting("nodes", 0, "x_m", value=10**400), "x_m is 1000"),
        (setting("nodes", 0, "visits", value=0), "visits is 0, expected a count"),
        (setting("nodes", 0, "visits", value=1.5), "visits is 1.5, expected a count"),
        (setting("nodes", 0, "sector", value=None), "sector is None, expected text"),
        (setting("nodes", 0, "id", value=7), "landmark is called 7"),
        (setting("nodes", 0, "id", value="L9"), "landmark 'L1': x_m is None"),
        (setting("edges", 0, "target", value="L9"), "landmark 'L9': x_m is None"),
        (setting("edges", 0, "path_m", value=True), "arc from 'L1' to .*: path_m is True"),
        (setting("edges", value=[{}]), "damaged: KeyError"),
        (lambda data: data | {"nodes": data["nodes"] * 2}, "stands in it twice"),
    ],
)
def test_damage_is_told_in_one_line(tmp_path, change, message):
    path = changed(tmp_path, change)
    with pytest.raises(MemoryFileError, match=message) as caught:
        load_topology(path)
    assert str(caught.value).startswith(str(path))
    assert "\n" not in str(caught.value)


def test_foreign_graphml_is_refused(tmp_path):
    path = tmp_path / "run.graphml"
    nx.write_graphml_xml(nx.path_graph(3), path)
    with pytest.raises(MemoryFileError, match="no topological memory: its format is None"):
        load_topology(path)
    path.write_text("<html><body>no graph</body></html>")
    with pytest.raises(MemoryFileError, match=r"run\.graphml: "):
        load_topology(path)


@pytest.mark.parametrize("ending", ["json", "graphml"])
def test_ways_found_shut_are_kept(tmp_path, ending):
    memory = TopologicalMemory()
    for name in ("L1", "L2"):
        memory.add_landmark(name, 0.0, 0.0, 0.0, 0.0)
    memory.traverse("L1", "L2", 1.0, 0.0, 1.0)
    memory.close("L1", "L2")
    save_topology(memory, tmp_path / f"m.{ending}")
    assert load_topology(tmp_path / f"m.{ending}").arc("L1", "L2").closed == 1


@pytest.mark.parametrize("ending", ["json", "graphml"])
def test_misses_are_kept_and_a_file_from_before_they_were_counted_has_none(tmp_path, ending):
    path = tmp_path / f"m.{ending}"
    memory = TopologicalMemory()
    memory.add_landmark("L1", 0.0, 0.0, 0.0, 0.0, salience=0.5)  # what novelty was called
    memory.miss("L1")
    memory.visit("L1", 1.0)
    memory.miss("L1")
    save_topology(memory, path)
    assert load_topology(path).nodes == memory.nodes
    text = path.read_text()
    for name in ("missed_since", "missed"):
        if ending == "json":
            text = text.replace(f'"{name}": 1,', "")
        else:
            number = re.search(rf'<key id="(d\d+)" for="node" attr.name="{name}"', text)[1]
            text = re.sub(rf'<(key id|data key)="{number}"[^\n]*\n', "", text)
    path.write_text(text)
    (old,) = load_topology(path).nodes
    assert (old.visits, old.missed, old.missed_since) == (2, 0, 0)
    assert old.labels == {"salience": 0.5}


@pytest.mark.parametrize("wrong", ["-1", "0.5", '"often"'])
def test_a_count_of_closings_that_is_none_is_refused(tmp_path, wrong):
    memory = TopologicalMemory()
    for name in ("L1", "L2"):
        memory.add_landmark(name, 0.0, 0.0, 0.0, 0.0)
    memory.traverse("L1", "L2", 1.0, 0.0, 1.0)
    path = tmp_path / "m.json"
    save_topology(memory, path)
    path.write_text(path.read_text().replace('"closed": 0', f'"closed": {wrong}'))
    with pytest.raises(MemoryFileError, match="arc from 'L1' to 'L2': closed is"):
        load_topology(path)
    save_topology(memory, path)
    path.write_text(path.read_text().replace('"missed": 0', f'"missed": {wrong}'))
    with pytest.raises(MemoryFileError, match="landmark 'L1': missed is"):
        load_topology(path)
