"""``ssrics bench``, used as a user would, mistakes included."""

import json

import pytest

from ssrics_like.cli import main


def run(capsys, *arguments):
    """Return exit status, standard output and standard error of a command."""
    with pytest.raises(SystemExit) as stopped:
        main(["bench", "designators", *[str(argument) for argument in arguments]])
    captured = capsys.readouterr()
    return stopped.value.code, captured.out, captured.err


def test_it_tunes_prints_a_table_writes_files_and_reads_its_tuning_back(capsys, tmp_path):
    chosen = (
        "--seeds",
        "1",
        "--jobs",
        "1",
        "--only",
        "every-metres",
        "report",
        "--courses",
        "generated",
    )
    status, said, complained = run(capsys, *chosen, "--tuning", "1", "-o", tmp_path / "one")
    assert (status, complained) == (0, "")
    lines = said.splitlines()
    assert lines[0].startswith("tuned every-metres: every_m ")
    assert "1 of 1 drives" in lines
    assert "generated: generated buildings, furnished, 1 drive, within 1 m" in said
    assert sum(line.strip().startswith("every-metres ") for line in lines) == 1
    assert lines[-1] == str(tmp_path / "one" / "tuned.json")
    tuned = json.loads((tmp_path / "one" / "tuned.json").read_text())
    assert tuned["designators"]["report"]["tried"] == 12

    status, said, _ = run(
        capsys, *chosen, "-o", tmp_path / "two", "--tuned", tmp_path / "one" / "tuned.json"
    )
    assert status == 0
    assert "tuned every-metres" not in said
    names = ("designators.csv", "designators.md", "tuned.json", "designators.json")
    for name in names:
        one, two = ((tmp_path / folder / name).read_bytes() for folder in ("one", "two"))
        assert one == two, name


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["--only", "doorway-gab"], "no candidate 'doorway-gab'; did you mean 'doorway-gap'?"),
        (["--courses", "generate"], "no course 'generate'; did you mean 'generated'?"),
        (["--courses", "logs"], "course 'logs' needs data: --log LOG TRUTH"),
        (["--seeds", "0"], "--seeds: 0: input should be greater than or equal to 1"),
        (["--radius", "-1"], "--radius: -1.0: input should be greater than 0"),
        (["--maps", "nowhere"], "nowhere: no such folder"),
        (["--log", "none.log", "labels"], "none.log: no such file"),
        (["--tuned", "t.json", "--tuning", "3"], "--tuning tunes anew, --tuned does not"),
        (["--tuned", "none.json"], "none.json: cannot be read (No such file or directory)"),
    ],
)
def test_a_mistake_is_one_line_and_status_one(capsys, arguments, said):
    status, printed, complained = run(capsys, *arguments, "--quiet")
    assert (status, printed) == (1, "")
    assert complained.startswith(f"ssrics: {said}")
    assert len(complained.splitlines()) == 1


def test_a_file_where_a_folder_is_to_be_shows_before_any_drive(capsys, tmp_path):
    (tmp_path / "out").write_text("")
    status, _, complained = run(capsys, "-o", tmp_path / "out")
    assert (status, complained) == (
        1,
        f"ssrics: {tmp_path / 'out'}: is a file, expected a folder\n",
    )
