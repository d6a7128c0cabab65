"""Databases that are somebody else's, damaged, or only to be read."""

import json
import os
import shutil
import sqlite3
import tempfile
from pathlib import Path

import pytest
from sqlalchemy import event

from ssrics_like.cli import main
from ssrics_like.errors import StudyError
from ssrics_like.study.database import reader_of
from ssrics_like.study.events import Response
from ssrics_like.study.records import Records
from ssrics_like.study.store import Store

TRIAL = {"kind": "plan", "map": "m", "practice": False, "check": None}
OUTLINE = json.dumps({"listed": ["plan"], "trials": {"plan": TRIAL}})
NOBODY = 65_534


def run(*arguments):
    with pytest.raises(SystemExit) as stop:
        main([str(each) for each in arguments])
    return stop.value.code


def foreign(path, script):
    connection = sqlite3.connect(path)
    connection.executescript(script)
    connection.close()
    return path


@pytest.fixture(
    params=["CREATE TABLE notes (x)", "CREATE TABLE ssrics_participants (id, note)",
            "PRAGMA journal_mode=WAL; CREATE TABLE notes (x)", "text"],
)  # fmt: skip
def theirs(request, tmp_path):
    path = tmp_path / "theirs.sqlite"
    if request.param == "text":
        path.write_text("This is no database, but it is long enough to be one. " * 9)
        return path
    return foreign(path, request.param)


def test_what_is_not_ours_is_refused_and_stays_as_it_is(theirs, tmp_path, capsys):
    before = theirs.read_bytes()
    with pytest.raises(StudyError, match=r"theirs\.sqlite: ") as caught:
        Store(str(theirs))
    assert len(str(caught.value).splitlines()) == 1
    assert run("study", "export", theirs, "-o", tmp_path / "out") == 1
    assert len(capsys.readouterr().err.splitlines()) == 1
    assert run("study", "serve", "complex", "--port", 0, "--database", theirs) == 1
    assert len(capsys.readouterr().err.splitlines()) == 1
    assert theirs.read_bytes() == before
    assert [path.name for path in tmp_path.iterdir()] == ["theirs.sqlite"]


def test_exporting_makes_no_tables(tmp_path, capsys):
    empty = tmp_path / "empty.sqlite"
    empty.touch()
    assert run("study", "export", empty, "-o", tmp_path / "out") == 1
    assert "empty.sqlite: holds no study's answers" in capsys.readouterr().err
    assert empty.read_bytes() == b""


def test_a_damaged_database_is_one_line(tmp_path, capsys):
    path = tmp_path / "answers.sqlite"
    served(path).close()
    size = path.stat().st_size
    with path.open("r+b") as file:  # all but the first page, which tells what there is
        file.seek(4096)
        file.write(b"\xff" * (size - 4096))
    assert run("study", "export", path, "-o", tmp_path / "out") == 1
    error = capsys.readouterr().err
    assert "answers.sqlite: the database cannot be used (" in error
    assert len(error.splitlines()) == 1


def served(path):
    """A store with one participant, as `serve` leaves it."""
    store = Store(str(path))
    store.belong_to("A study", OUTLINE)
    store.join("p", "digest", ("plan",), 9)
    return store


@pytest.fixture
def sealed():
    """A folder that nobody can write to once it was sealed, not even root; and one for tables."""
    root = Path(tempfile.mkdtemp())
    kept, out = root / "kept", root / "out"
    root.chmod(0o755)
    kept.mkdir()
    out.mkdir()
    out.chmod(0o777)
    user = os.geteuid()

    def seal():
        for path in kept.iterdir():
            path.chmod(0o444)
        kept.chmod(0o555)
        if user == 0:
            os.seteuid(NOBODY)

    yield kept, out, seal
    os.seteuid(user)
    kept.chmod(0o755)
    shutil.rmtree(root)


@pytest.mark.parametrize("state", ["ended", "serving", "linked", "killed"])
def test_export_only_reads(sealed, capsys, state):
    kept, out, seal = sealed
    store = served(kept / "a.sqlite")
    if state == "ended":
        store.close()
    elif state == "killed":  # what was written ahead is in a file beside, and nobody has it open
        for path in list(kept.iterdir()):
            shutil.copy(path, kept / path.name.replace("a.", "b."))
    name = kept / ("b.sqlite" if state == "killed" else "a.sqlite")
    if state == "linked":
        name = out / "linked.sqlite"
        name.symlink_to(kept / "a.sqlite")
    before = {path.name: path.read_bytes() for path in kept.glob("*.sqlite")}
    seal()
    assert run("study", "export", name, "-o", out) == 0
    assert "1 participant, 0 finished, 0 responses\n" in capsys.readouterr().out
    assert (out / "participants.csv").read_text().splitlines()[1].startswith("p,")
    assert {path.name: path.read_bytes() for path in kept.glob("*.sqlite")} == before
    store.close()


def test_a_reader_leaves_nothing_beside_a_file_at_rest_and_cannot_write(tmp_path):
    served(tmp_path / "a.sqlite").close()
    records = Records(str(tmp_path / "a.sqlite"))
    assert [person.name for person in records.participants()] == ["p"]
    records.close()
    engine = reader_of(str(tmp_path / "a.sqlite"))
    with pytest.raises(Exception, match="readonly"), engine.connect() as connection:
        connection.exec_driver_sql("DELETE FROM ssrics_participants")
    engine.dispose()
    assert [path.name for path in tmp_path.iterdir()] == ["a.sqlite"]


def test_an_export_is_of_one_moment(tmp_path):
    store = served(tmp_path / "a.sqlite")
    records = Records(str(tmp_path / "a.sqlite"))
    newcomers = []

    def come_in(_connection, _cursor, said, *_more):
        if "FROM ssrics_participants" in said and not newcomers:
            newcomers.append(store.join("q", "digest-2", ("plan",), 9))
            begin = Response(
                "q", "plan", "plan", 0, "begin", "", None, None, "", "", 0, None, 0, "", "k"
            )
            store.append(newcomers[0].number, "k", 9, lambda _: (begin, False))

    event.listen(records._engine, "after_cursor_execute", come_in)
    people, responses = records.everything()
    assert [person.name for person in people] == ["p"]
    assert responses == []
    assert len(newcomers) == 1
    assert [each.participant for each in records.everything()[1]] == ["q"]
    records.close()
    store.close()


@pytest.mark.parametrize("name", ["a b%41?#.sqlite", "Türen&x=y.sqlite"])
def test_a_file_of_any_name_is_read(tmp_path, name):
    served(tmp_path / name).close()
    records = Records(str(tmp_path / name))
    assert [person.name for person in records.participants()] == ["p"]
    records.close()
    assert [path.name for path in tmp_path.iterdir()] == [name]
