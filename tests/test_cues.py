"""Files of cues: what is written is read again, and what is damaged is refused in one line."""

import json
import math

import numpy as np
import pytest

from ssrics_like.cues import read_cue, write_cue
from ssrics_like.errors import CueError
from ssrics_like.library import entries, find_cue
from ssrics_like.perception.doorways import DoorwayCue
from ssrics_like.perception.gap import FEATURES, MEASURES
from ssrics_like.perception.trees import BoostedTrees

ABOUT = {"title": "two small trees", "source": {"command": "by hand", "seed": 3}}


def small_cue():
    """Two trees: width <= 1.2345678901 ? (second measure <= 0.3 ? 2 : -1) : -3; a lone leaf."""
    trees = BoostedTrees(
        baseline=-0.123456789,
        roots=np.array([0, 5], np.int32),
        feature=np.array([0, 1, -1, -1, -1, -1], np.int32),
        threshold=np.array([1.2345678901, 0.3, 0, 0, 0, 0]),
        left=np.array([1, 2, -1, -1, -1, -1], np.int32),
        right=np.array([4, 3, -1, -1, -1, -1], np.int32),
        value=np.array([0, 0, 2.0, -1.0, -3.0, 0.25]),
    )
    return DoorwayCue(trees, 0.31)


@pytest.fixture
def written(tmp_path):
    path = tmp_path / "cue.json"
    write_cue(path, small_cue(), ABOUT)
    return path


def measures(width, second):
    return [width, second, *[0.0] * (len(FEATURES) - 2)]


def test_what_is_written_is_read_again(written):
    cue = read_cue(written)
    assert cue.threshold == 0.31
    for width, second, leaf in [(1.0, 0.2, 2.0), (1.0, 0.4, -1.0), (2.0, 0.2, -3.0)]:
        expected = 1 / (1 + math.exp(0.123456789 - leaf - 0.25))
        assert cue.trees.probability(measures(width, second)) == pytest.approx(expected, abs=1e-6)
    assert cue.trees.roots.tolist() == [0, 5]
    assert cue.trees.feature.dtype == np.int32


def test_a_cue_that_was_read_is_written_as_it_was(written, tmp_path):
    write_cue(tmp_path / "again.json", read_cue(written), ABOUT)
    assert (tmp_path / "again.json").read_bytes() == written.read_bytes()


def test_a_file_says_where_it_comes_from_and_has_an_array_a_line(written):
    document = json.loads(written.read_text())
    assert (document["title"], document["source"]) == (ABOUT["title"], ABOUT["source"])
    assert document["features"] == list(FEATURES)
    assert document["trees"][0]["threshold"][0] == 1.234568
    lines = written.read_text().splitlines()
    assert lines[3] == '"title": "two small trees",'
    assert '{"feature":[0,1,-1,-1,-1],' in lines
    assert all(line.count("[") <= 1 for line in lines)


def at(*keys, value):
    """Return a change of a document: the value at a path of keys."""

    def change(document):
        for key in keys[:-1]:
            document = document[key]
        if value is None:
            del document[keys[-1]]
        else:
            document[keys[-1]] = value

    return change


TREE = ("trees", 0)


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        (at("format", value="a map"), "format: 'a map', expected 'ssrics-like doorway cue'"),
        (at("version", value=1), "version: 1; this version of ssrics reads 2"),
        (at("measures", value=1), f"measures: 1; this version of ssrics makes {MEASURES}: train the cue"),
        (at("threshold", value=None), "threshold: is missing"),
        (at("source", value=None), "source: is missing"),
        (at("threshold", value=0), "threshold: 0, expected more than 0 and at most 1"),
        (at("threshold", value="0.3"), "threshold: '0.3', expected a number"),
        (at("baseline", value=math.nan), "baseline: nan, expected a number"),
        (at("baseline", value=True), "baseline: True, expected a number"),
        (at("baseline", value=10**400), "expected a number"),
        (at("features", 7, value="width"),
         f"features[7]: 'width', expected '{FEATURES[7]}'; train the cue anew"),
        (at("features", value=list(FEATURES[:-1])),
         f"features[{len(FEATURES) - 1}]: missing, expected '{FEATURES[-1]}'"),
        (at("features", value=[*FEATURES, "more"]),
         f"features[{len(FEATURES)}]: 'more', expected no more measures"),
        (at("features", value="all"), "features: 'all', expected a list of"),
        (at("trees", value=[]), "trees: expected a list of trees, at least one"),
        (at("trees", value=[3]), "trees[0]: 3, expected a tree with feature, threshold, left"),
        (at(*TREE, "left", value=None), "trees[0].left: nothing, expected a list of numbers"),
        (at(*TREE, "value", value=[1.0]), "trees[0].value: 1 numbers, expected 5, one a node"),
        (at(*TREE, "feature", 1, value=len(FEATURES)),
         f"trees[0].feature[1]: {len(FEATURES)}, expected a whole number from -1 to"),
        (at(*TREE, "feature", 1, value=0.5), "trees[0].feature[1]: 0.5, expected a whole number"),
        (at(*TREE, "left", 1, value=0), "trees[0].left[1]: 0, expected a whole number from 2 to 4"),
        (at(*TREE, "right", 0, value=5), "trees[0].right[0]: 5, expected a whole number from 1"),
        (at(*TREE, "right", 4, value=1), "trees[0].right[4]: 1, expected -1"),
        (at(*TREE, "feature", 4, value=2), "trees[0].left[4]: -1, expected a node behind its"),
        (at(*TREE, "value", 2, value=None), "trees[0].value: 4 numbers, expected 5"),
        (at(*TREE, "value", 2, value="x"), "trees[0].value[2]: 'x', expected a number"),
    ],
)  # fmt: skip
def test_damage_is_refused_with_its_place(written, change, complaint):
    document = json.loads(written.read_text())
    change(document)
    written.write_text(json.dumps(document))
    with pytest.raises(CueError) as refused:
        read_cue(written)
    assert str(refused.value).startswith(f"{written}: ")
    assert complaint in str(refused.value)
    assert "\n" not in str(refused.value)


@pytest.mark.parametrize(
    ("content", "complaint"),
    [
        (b"", ":1:1: not valid JSON"),
        (b"[1, 2]", ": format: nothing, expected 'ssrics-like doorway cue'"),
        (b'{"format": "ssrics-like doorway cue",\n"version"', ":2:10: not valid JSON"),
        (b"\xff\xfe", ": is not UTF-8"),
        (b"[" * 100_000, ": not a cue"),
        (b'{"format": ' + b"1" * 10_000 + b"}", ": not a cue"),
    ],
)
def test_other_files_are_refused(tmp_path, content, complaint):
    path = tmp_path / "cue.json"
    path.write_bytes(content)
    with pytest.raises(CueError) as refused:
        read_cue(path)
    assert str(refused.value).startswith(f"{path}{complaint}")


def test_a_file_cut_off_anywhere_is_refused(written):
    whole = written.read_bytes()
    for end in range(0, len(whole) - 2, 97):
        written.write_bytes(whole[:end])
        with pytest.raises(CueError):
            read_cue(written)


def test_missing_files_and_folders_are_refused(tmp_path):
    for path, why in [(tmp_path / "none.json", "no such file"), (tmp_path, "cannot be read")]:
        with pytest.raises(CueError, match=why):
            read_cue(path)


def test_a_write_that_fails_leaves_the_file_as_it_was(written):
    before = written.read_bytes()
    with pytest.raises(TypeError):
        write_cue(written, small_cue(), {"title": "t", "source": {"seed": object()}})
    assert written.read_bytes() == before
    assert [path.name for path in written.parent.iterdir()] == ["cue.json"]


def test_the_shipped_cue_is_whole_and_says_how_to_train_it_again():
    path = find_cue("doorways")
    assert path.stat().st_size < 300_000
    assert 0.0 < read_cue(path).threshold < 1.0
    source = json.loads(path.read_text())["source"]
    assert source["command"].startswith("ssrics train doorways --buildings")
    assert {"seed", "buildings", "scikit-learn"} <= set(source)


def test_a_cue_is_no_profile():
    assert "doorways" not in entries("perception")
