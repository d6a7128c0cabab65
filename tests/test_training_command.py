"""``ssrics train``: what it prints and writes, and what it refuses before it begins."""

import json
import sys

import pytest

from ssrics_like.cli import main
from ssrics_like.cues import read_cue, read_structure_cue
from ssrics_like.training import drives, structure_training, training
from ssrics_like.training.fitting import Size


def run(capsys, *arguments):
    """Return exit status, standard output and standard error of a command."""
    with pytest.raises(SystemExit) as stopped:
        main([str(argument) for argument in arguments])
    captured = capsys.readouterr()
    return stopped.value.code, captured.out, captured.err


def test_a_small_training_writes_the_same_cue_each_time(capsys, tmp_path, monkeypatch):
    pytest.importorskip("sklearn")
    monkeypatch.setattr(drives, "LIMIT_S", 100.0)
    small = ("--buildings", 2, "--held-out", 1, "--seed", 5, "--jobs", 1)
    one, other = tmp_path / "one.json", tmp_path / "other.json"
    status, said, complained = run(capsys, "train", "doorways", "-o", one, *small)
    assert (status, complained) == (0, "")
    lines = said.splitlines()
    assert lines[0] == "seed 5: 2 of 2 training drives"
    assert lines[1].startswith("seed 5: growing trees on ")
    assert lines[2] == "seed 5: 1 of 1 held-out drives"
    assert lines[3].startswith("seed 5: threshold 0.")
    assert "marks at a label (precision)" in said
    assert lines[-1].startswith(f"{one}: ")
    cue = read_cue(one)
    assert f" {cue.threshold:.2f}" in said
    source = json.loads(one.read_text())["source"]
    assert source["command"] == "ssrics train doorways --buildings 2 --held-out 1 --seed 5"
    assert (source["seed"], source["buildings"]) == (5, 2)

    status, said, _ = run(capsys, "train", "doorways", "-o", other, *small, "--repeats", 2)
    assert status == 0
    assert "seed 6" in said
    assert "spread" in said
    assert other.read_bytes() == one.read_bytes()
    second = tmp_path / "other-6.json"  # those that follow lie beside the first
    read_cue(second)
    assert json.loads(second.read_text())["source"]["command"].endswith("--seed 6")


def test_a_small_training_of_structure_writes_the_same_cue_each_time(capsys, tmp_path, monkeypatch):
    pytest.importorskip("sklearn")
    monkeypatch.setattr(drives, "LIMIT_S", 300.0)
    monkeypatch.setattr(structure_training, "SIZE", Size(trees=4, leaves=4))
    small = ("--buildings", 6, "--held-out", 3, "--seed", 3, "--jobs", 1)
    one, other = tmp_path / "one.json", tmp_path / "other.json"
    status, said, complained = run(capsys, "train", "structure", "-o", one, *small)
    assert (status, complained) == (0, "")
    lines = said.splitlines()
    assert lines[0] == "seed 3: 6 of 6 training drives"
    assert [line.split()[5] for line in lines[1:5]] == ["opening", "junction", "corner", "hallway"]
    assert lines[5:7] == ["seed 3: 3 of 3 held-out drives", "seed 3: 3 of 3 unseen drives"]
    assert "plain, junction: passages" in said
    assert "cluttered, room: places" in said
    cue = read_structure_cue(one)
    assert f"threshold: corner {cue.thresholds['corner']:.2f}" in " ".join(said.split())
    source = json.loads(one.read_text())["source"]
    assert source["command"] == "ssrics train structure --buildings 6 --held-out 3 --seed 3"
    found = source["figures"]["plain"]["places"]["room"]
    assert found["n"] > 0
    assert f"called so (recall) {found['recall']:.3f}" in " ".join(said.split())
    status, _, _ = run(capsys, "train", "structure", "-o", other, *small, "--quiet")
    assert status == 0
    assert other.read_bytes() == one.read_bytes()


def test_drives_that_pass_nothing_teach_nothing(capsys, tmp_path, monkeypatch):
    pytest.importorskip("sklearn")
    monkeypatch.setattr(drives, "LIMIT_S", 10.0)
    out = tmp_path / "a.json"
    small = ("--buildings", 1, "--held-out", 1, "--jobs", 1, "--quiet")
    status, _, complained = run(capsys, "train", "structure", "-o", out, *small)
    assert status == 1
    assert "every place on the drives, or none, lies in an opening; expected more" in complained
    assert len(complained.splitlines()) == 1
    assert not out.exists()


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (("windows", "-o", "a.json"), "doorways"),
        (("windows", "-o", "a.json"), "structure"),
        (("doorways",), "--out"),
        (("structure", "-o", "."), ".: is a folder, expected a file for the cue"),
        (("structure", "-o", "a.json", "--held-out", 0), "train: held_out: 0: expected"),
        (("doorways", "-o", "."), ".: is a folder, expected a file for the cue"),
        (("doorways", "-o", "a.yaml"), "a.yaml: expected a file's name that ends in .json"),
        (("doorways", "-o", "none/a.json"), "none: no such folder"),
        (("doorways", "-o", "a.json", "--buildings", 0), "train: buildings: 0: expected"),
        (("doorways", "-o", "a.json", "--held-out", 0), "train: held_out: 0: expected"),
        (("doorways", "-o", "a.json", "--seed", -1), "train: seed: -1: expected"),
        (("doorways", "-o", "a.json", "--repeats", 101), "train: repeats: 101: expected"),
        (("doorways", "-o", "a.json", "--buildings", 1.5), "'1.5': expected a whole number"),
        (("doorways", "-o", "a.json", "--jobs", 0), "--jobs"),
    ],
)
def test_wrong_inputs_are_refused_in_one_line_before_anything_is_driven(
    capsys, tmp_path, monkeypatch, arguments, complaint
):
    def driven(*_):
        raise AssertionError("a drive began")

    monkeypatch.setattr(training, "example", driven)
    monkeypatch.setattr(structure_training, "structure_example", driven)
    monkeypatch.chdir(tmp_path)
    status, said, complained = run(capsys, "train", *arguments)
    assert (status, said) == (1, "")
    assert complaint in complained
    assert len(complained.splitlines()) == 1
    assert list(tmp_path.iterdir()) == []


@pytest.mark.parametrize("what", ["doorways", "structure"])
def test_without_scikit_learn_it_says_how_to_get_it(capsys, tmp_path, monkeypatch, what):
    monkeypatch.setitem(sys.modules, "sklearn.ensemble", None)
    status, _, complained = run(capsys, "train", what, "-o", tmp_path / "a.json")
    assert status == 1
    assert complained == (
        "ssrics: training needs the package scikit-learn; pip install 'ssrics-like[learn]'\n"
    )
