"""Choices from tables of other programs, by the command line."""

import pytest

from ssrics_like.cli import main
from ssrics_like.maps import load_choices


def run(*arguments):
    with pytest.raises(SystemExit) as stop:
        main([str(each) for each in arguments])
    return stop.value.code


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


PSYCHOPY = """\
participant,trial,mouse.x,mouse.y,mouse.time,name,extra
p1,instructions,,,,,
p1,map,0.5,-0.25,1500,"a ""red"" door",x
p1,map,1,1,,,x
p2,map,0,0,20,Eingang,x
"""


def test_import_takes_places_from_a_foreign_table(here, capsys):
    (here / "raw.csv").write_text(PSYCHOPY)
    columns = "participant=participant,x_m=mouse.x,y_m=mouse.y"
    assert (
        run(
            "study", "import", "raw.csv", "--columns", columns, "--columns", "label=name,t_s=mouse.time",
            "-o", "choices.csv", "--scale", 10, -8, "--offset", 1, 2, "--milliseconds",
        )
        == 0
    )  # fmt: skip
    assert (here / "choices.csv").read_text().splitlines() == [
        "participant,landmark,x_m,y_m,label,t_s",
        'p1,L1,6,4,"a ""red"" door",1.5',
        "p1,L2,11,-6,,",
        "p2,L1,1,2,Eingang,0.02",
    ]
    assert "choices.csv: 3 choices" in capsys.readouterr().out


def test_import_takes_pixels_of_a_map(here):
    (here / "raw.csv").write_text("pid,px,py\np1,0,0\np1,360,220\np1,100,20\n")
    columns = "participant=pid,x_m=px,y_m=py"
    arguments = ["study", "import", "raw.csv", "--columns", columns, "-o", "c.csv"]
    assert run(*arguments, "--map", "simple") == 0  # 18 x 11 m in cells of 5 cm
    rows = (here / "c.csv").read_text().splitlines()[1:]
    assert rows == ["p1,L1,0,11,,", "p1,L2,18,0,,", "p1,L3,5,10,,"]


@pytest.mark.parametrize(
    ("columns", "said"),
    [
        ("participant=participant,x_m=mouse.x", "--columns: y_m missing"),
        ("participant", "--columns participant: expected OURS=THEIRS"),
        ("participnt=a,x_m=b,y_m=c", "no column 'participnt'; did you mean 'participant'?"),
        ("x_m=a,x_m=b", "--columns x_m=b: x_m stands twice"),
        (
            "participant=participant,x_m=mouse.x,y_m=mouse.z",
            "raw.csv:1: column 'mouse.z' is missing",
        ),
        ("participant=extra,x_m=mouse.x,y_m=mouse.y", None),
        ("participant=name,x_m=mouse.x,y_m=mouse.y", "raw.csv:4: name: is empty"),
        ("participant=participant,x_m=trial,y_m=mouse.y", "raw.csv:2: x_m: 'instructions' where a"),
    ],
)
def test_a_mapping_that_does_not_fit_is_told(here, capsys, columns, said):
    (here / "raw.csv").write_text(PSYCHOPY)
    code = run("study", "import", "raw.csv", "--columns", columns, "-o", "c.csv")
    assert code == (0 if said is None else 1)
    if said:
        assert not (here / "c.csv").exists()
        error = (
            capsys.readouterr().err.replace("mouse.y: ''", "").replace("trial: 'inst", "x_m: 'inst")
        )
        assert said in error


PLAIN = "participant=pid,x_m=px,y_m=py"


@pytest.mark.parametrize(
    ("row", "more", "said"),
    [
        ("p,1,2", ("-o", "raw.csv"), "raw.csv: is the table itself; name another file"),
        ("p,1,2", ("-o", "../here/raw.csv"), "is the table itself"),
        ("p,1,2", ("--scale", 0, 1), "--scale: 0 would put everybody in one place"),
        ("p,1,2", ("--scale", "inf", 1), "--scale, --offset: expected finite numbers"),
        ("p,10,2", ("--scale", 1e308, 1e308), "raw.csv:2: the place is not finite; see --scale"),
        ("p,361,2", ("--map", "simple"), "raw.csv:2: pixel 361, 2 is not on the map's picture"),
        ("p,-1,2", ("--map", "simple"), "raw.csv:2: pixel -1, 2 is not on the map's picture"),
        ("p,1_0,2", (), "raw.csv:2: px: '1_0' where a number was expected"),
        ("p,1,\u0661\u0662", (), "raw.csv:2: py: '\u0661\u0662' where a number was expected"),
        ("p,1,0x10", (), "raw.csv:2: py: '0x10' where a number was expected"),
        ("p,1,1e999", (), "raw.csv:2: py: '1e999' where a number was expected"),
        ("a\0b,1,2", (), "raw.csv:2: pid: 'a\\x00b' has control characters"),
        ('"a\nb",1,2', (), "raw.csv:2: pid: 'a\\nb' has control characters"),
    ],
)
def test_what_cannot_be_is_one_line_and_nothing_is_written(
    tmp_path, monkeypatch, capsys, row, more, said
):
    folder = tmp_path / "here"
    folder.mkdir()
    monkeypatch.chdir(folder)
    before = f"pid,px,py\n{row}\n".encode()
    (folder / "raw.csv").write_bytes(before)
    arguments = ["study", "import", "raw.csv", "--columns", PLAIN, *more]
    assert run(*arguments, *(() if "-o" in more else ("-o", "c.csv"))) == 1
    error = capsys.readouterr().err
    assert said in error
    assert len(error.splitlines()) == 1
    assert (folder / "raw.csv").read_bytes() == before
    assert [path.name for path in folder.iterdir()] == ["raw.csv"]


def test_choices_are_counted_not_lines(here, capsys):
    (here / "raw.csv").write_text('pid,px,py,say\np,1,2,"two\nlines"\n')
    columns = f"{PLAIN},label=say"
    assert run("study", "import", "raw.csv", "--columns", columns, "-o", "c.csv") == 0
    assert capsys.readouterr().out == "c.csv: 1 choice\n"
    assert [choice.label for choice in load_choices(here / "c.csv")] == ["two\nlines"]
