"""``ssrics train``: what it prints and writes, and what it refuses before it begins."""

import json
import sys

import pytest

from ssrics_like.cli import main
from ssrics_like.cues import read_cue
from ssrics_like.training import drives, training


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


@pytest.mark.parametrize(
    ("arguments", "complaint"),
    [
        (("windows", "-o", "a.json"), "doorways"),
        (("doorways",), "--out"),
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
    monkeypatch.chdir(tmp_path)
    status, said, complained = run(capsys, "train", *arguments)
    assert (status, said) == (1, "")
    assert complaint in complained
    assert len(complained.splitlines()) == 1
    assert list(tmp_path.iterdir()) == []


def test_without_scikit_learn_it_says_how_to_get_it(capsys, tmp_path, monkeypatch):
    monkeypatch.setitem(sys.modules, "sklearn.ensemble", None)
    status, _, complained = run(capsys, "train", "doorways", "-o", tmp_path / "a.json")
    assert status == 1
    assert complained == (
        "ssrics: training needs the package scikit-learn; pip install 'ssrics-like[learn]'\n"
    )
