"""Files of structure cues: what is written is read again, and what is damaged is refused."""

import json

import numpy as np
import pytest
from test_cues import ABOUT, at, small_cue

from ssrics_like.cues import read_any_cue, read_cue, read_structure_cue, write_cue
from ssrics_like.cues import write_structure_cue as write
from ssrics_like.errors import CueError
from ssrics_like.library import find_cue
from ssrics_like.perception.doorways import DoorwayCue
from ssrics_like.perception.layout import LAYOUT, REVISION
from ssrics_like.perception.structure import KINDS, StructureCue
from ssrics_like.scenarios.checking import check_file


def small_structure():
    """The same two trees for each kind, with thresholds of their own."""
    trees = small_cue().trees
    return StructureCue(
        dict.fromkeys(KINDS, trees), {kind: 0.1 * (i + 1) for i, kind in enumerate(KINDS)}
    )


@pytest.fixture
def written(tmp_path):
    path = tmp_path / "structure.json"
    write(path, small_structure(), ABOUT)
    return path


def test_what_is_written_is_read_again(written, tmp_path):
    cue = read_structure_cue(written)
    assert list(cue.thresholds.values()) == pytest.approx([0.1, 0.2, 0.3, 0.4])
    rng = np.random.default_rng(0)
    for _ in range(20):
        measures = rng.uniform(0.0, 2.0, len(LAYOUT))
        expected = small_structure().probabilities(measures)
        assert cue.probabilities(measures) == pytest.approx(expected, abs=1e-6)
    write(tmp_path / "again.json", cue, ABOUT)
    assert (tmp_path / "again.json").read_bytes() == written.read_bytes()


def test_a_file_has_an_array_a_line(written):
    document = json.loads(written.read_text())
    assert document["features"] == list(LAYOUT)
    assert list(document["kinds"]) == list(KINDS)
    lines = written.read_text().splitlines()
    assert '{"feature":[0,1,-1,-1,-1],' in lines
    assert all(line.count("[") <= 1 for line in lines)


JUNCTION = ("kinds", "junction")


@pytest.mark.parametrize(
    ("change", "complaint"),
    [
        (at("format", value="ssrics-like doorway cue"),
         "format: 'ssrics-like doorway cue', expected 'ssrics-like structure cue'"),
        (at("version", value=2), "version: 2; this version of ssrics reads 1: train the cue anew"),
        (at("layout", value=0), f"layout: 0; this version of ssrics makes {REVISION}: train the cue"),
        (at("layout", value=None), "layout: is missing"),
        (at("features", 0, value="ray"), f"features[0]: 'ray', expected '{LAYOUT[0]}'; train"),
        (at("kinds", value=[1]), "kinds: [1], expected a mapping"),
        (at(*JUNCTION, value=None), "kinds.junction: is missing"),
        (at(*JUNCTION, value=3), "kinds.junction: 3, expected a mapping"),
        (at(*JUNCTION, "threshold", value=None), "kinds.junction.threshold: is missing"),
        (at(*JUNCTION, "threshold", value=2), "kinds.junction.threshold: 2, expected more than 0"),
        (at(*JUNCTION, "baseline", value="x"), "kinds.junction.baseline: 'x', expected a number"),
        (at(*JUNCTION, "trees", value=[]), "kinds.junction.trees: expected a list of trees"),
        (at(*JUNCTION, "trees", 0, "feature", 1, value=len(LAYOUT)),
         f"kinds.junction.trees[0].feature[1]: {len(LAYOUT)}, expected a whole number from -1 to 84"),
    ],
)  # fmt: skip
def test_damage_is_refused_with_its_place(written, change, complaint):
    document = json.loads(written.read_text())
    change(document)
    written.write_text(json.dumps(document))
    with pytest.raises(CueError) as refused:
        read_structure_cue(written)
    assert str(refused.value).startswith(f"{written}: ")
    assert complaint in str(refused.value)
    assert "\n" not in str(refused.value)


def test_a_file_cut_off_anywhere_is_refused(written):
    whole = written.read_bytes()
    for end in range(0, len(whole) - 2, 197):
        written.write_bytes(whole[:end])
        with pytest.raises(CueError):
            read_structure_cue(written)


def test_one_kind_of_cue_is_not_the_other_and_a_check_knows_both(written, tmp_path):
    doorways = tmp_path / "doorways.json"
    write_cue(doorways, small_cue(), ABOUT)
    with pytest.raises(CueError, match="expected 'ssrics-like doorway cue'"):
        read_cue(written)
    with pytest.raises(CueError, match="expected 'ssrics-like structure cue'"):
        read_structure_cue(doorways)
    assert isinstance(read_any_cue(doorways), DoorwayCue)
    assert isinstance(read_any_cue(written), StructureCue)
    assert check_file(doorways) == "doorway cue, threshold 0.31"
    assert check_file(written) == (
        "structure cue, thresholds 0.1 for opening, 0.2 for junction, 0.3 for corner, "
        "0.4 for hallway"
    )
    neither = tmp_path / "neither.json"
    neither.write_text("{}")
    with pytest.raises(CueError, match="'ssrics-like doorway cue' or 'ssrics-like structure cue'"):
        read_any_cue(neither)


def test_the_shipped_cue_is_whole_and_says_how_good_it_is_and_how_to_train_it_again():
    path = find_cue("structure")
    assert path.stat().st_size < 300_000
    assert set(read_structure_cue(path).thresholds) == set(KINDS)
    source = json.loads(path.read_text())["source"]
    assert source["command"].startswith("ssrics train structure --buildings")
    for where in ("held_out", "cluttered", "plain"):
        assert 0.0 < source["figures"][where]["passages"]["junction"]["recall"] <= 1.0
