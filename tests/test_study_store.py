"""The store: saved once, found again, kept apart. On SSRICS_TEST_DATABASE too, if that is set."""

import os
import sqlite3
import threading

import pytest
from sqlalchemy import text

from ssrics_like.errors import StudyError
from ssrics_like.study.database import engine_of, shown
from ssrics_like.study.events import Response
from ssrics_like.study.refused import Refused
from ssrics_like.study.store import Store
from ssrics_like.study.tables import metadata

OUTLINE = '{"listed": ["plan"], "trials": {"plan": {"kind": "plan", "map": "m"}}}'
URL = os.environ.get("SSRICS_TEST_DATABASE")


@pytest.fixture(params=["sqlite", "url"])
def store(request, tmp_path):
    if request.param == "url" and not URL:
        pytest.skip("SSRICS_TEST_DATABASE names no database")
    name = URL if request.param == "url" else str(tmp_path / "answers.sqlite")
    if request.param == "url":
        engine = engine_of(name)
        metadata.drop_all(engine)
        engine.dispose()
    made = Store(name)
    made.belong_to("A study", OUTLINE)
    yield made
    made.close()


def answer(key, event="add", x=1.0, label="", position=0):
    return Response(
        "p", "plan", "plan", position, event, "", x, 2.0, label, "", 1.5, None, 1e12, "now", key
    )


def save(store, person, key, *, done=False, most=100, **more):
    return store.append(person.number, key, most, lambda _: (answer(key, **more), done))


def test_a_response_is_saved_once_whatever_is_sent_again(store):
    person = store.join("p", "digest", ("plan",), 10)
    save(store, person, "one", x=1.25)
    save(store, person, "one", x=9.0)
    save(store, person, "two", label="Tür „ä“ 🚪")
    kept = store.responses(person.number)
    assert [(r.key, r.x_m, r.label) for r in kept] == [
        ("one", 1.25, ""),
        ("two", 1.0, "Tür „ä“ 🚪"),
    ]
    assert store.counts() == {"p": 2}


def test_the_end_of_a_step_and_its_response_are_saved_together(store):
    person = store.join("p", "digest", ("plan",), 10)
    store.progress(person.number, 0, 500.0)
    assert store.participant("digest").replay_ms == 500.0
    person = save(store, person, "end-0", event="end", done=True)
    assert (person.position, person.trial, person.is_done, person.replay_ms) == (
        1,
        "plan",
        False,
        0,
    )
    save(store, person, "end-0", event="end", done=True)  # sent again: no step further
    assert store.participant("digest").position == 1
    person = save(store, person, "end-1", event="end", done=True)
    assert person.is_done
    assert person.finished


def test_progress_never_goes_back_and_belongs_to_its_step(store):
    person = store.join("p", "digest", ("plan",), 10)
    for position, ms in ((0, 900.0), (0, 300.0), (1, 5000.0)):
        store.progress(person.number, position, ms)
    assert store.participant("digest").replay_ms == 900.0


def test_an_id_is_given_once_and_places_are_counted(store):
    store.join("p", "digest-1", (), 2)
    with pytest.raises(Refused, match="this id already") as caught:
        store.join("p", "digest-2", (), 2)
    assert caught.value.status == 409
    store.join("q", "digest-3", (), 2)
    with pytest.raises(Refused, match="all the participants"):
        store.join("r", "digest-4", (), 2)
    assert [person.name for person in store.participants()] == ["p", "q"]
    assert store.participant("digest-2") is None


def test_no_more_responses_than_allowed_are_taken(store):
    person = store.join("p", "digest", (), 10)
    for i in range(3):
        save(store, person, f"key-{i}", most=3)
    with pytest.raises(Refused) as caught:
        save(store, person, "key-3", most=3)
    assert caught.value.status == 403
    save(store, person, "key-2", most=3)  # sent again: it is there


def test_what_is_refused_leaves_nothing(store):
    person = store.join("p", "digest", (), 10)

    def refuse(_):
        raise Refused(409, "no")

    with pytest.raises(Refused):
        store.append(person.number, "key", 10, refuse)
    assert store.responses() == []


def test_threads_that_write_at_once_lose_nothing(store):
    people = [store.join(f"p{i}", f"digest-{i}", (), 10) for i in range(4)]
    threads = [
        threading.Thread(target=lambda p=p: [save(store, p, f"{p.name}-{i}") for i in range(20)])
        for p in people
    ]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert [len(store.responses(p.number)) for p in people] == [20] * 4


def test_answers_to_other_trials_are_not_mixed_with_these(store):
    store.belong_to("Another title", OUTLINE)
    with pytest.raises(StudyError, match=r'trials\.plan\.map was "m", now it is "n"'):
        store.belong_to("A study", OUTLINE.replace('"m"', '"n"'))


def test_a_store_is_found_again(tmp_path):
    name = str(tmp_path / "answers.sqlite")
    for key in ("one", "two"):
        store = Store(name)
        store.belong_to("A study", OUTLINE)
        person = store.participant("digest") or store.join("p", "digest", ("plan",), 10)
        save(store, person, key)
        store.close()
    assert sqlite3.connect(name).execute("select count(*) from ssrics_responses").fetchone() == (2,)


def test_answers_are_for_the_eyes_of_who_serves_the_study(tmp_path):
    made = Store(str(tmp_path / "answers.sqlite"))
    made.belong_to("A study", OUTLINE)
    files = list(tmp_path.iterdir())
    assert len(files) > 1
    assert {file.stat().st_mode & 0o777 for file in files} == {0o600}
    made.close()


def test_sqlite_writes_ahead_and_to_the_disk(tmp_path):
    engine = engine_of(str(tmp_path / "answers.sqlite"))
    with engine.connect() as connection:
        assert connection.execute(text("pragma journal_mode")).scalar() == "wal"
        assert connection.execute(text("pragma synchronous")).scalar() == 2  # FULL
    engine.dispose()


@pytest.mark.parametrize(
    ("name", "said"),
    [
        ("{tmp}/none/a.sqlite", "none: no such folder"),
        ("{tmp}", "is a folder"),
        ("{tmp}/text.sqlite", "the database cannot be used \\(file is not a database\\)"),
        ("sqlite://", "SQLite needs a file"),
        ("nosuch://host/x", "no driver for 'nosuch'"),
        ("postgresql://:bad", "the URL cannot be read"),
        ("postgresql://me:secret@127.0.0.1:1/x?connect_timeout=2", "me:\\*\\*\\*@127.0.0.1:1/x"),
    ],
)
def test_what_is_no_database_is_told_in_one_line(tmp_path, name, said):
    (tmp_path / "text.sqlite").write_text(
        "This is no database, but it is long enough to be one. " * 9
    )
    with pytest.raises(StudyError, match=said) as caught:
        Store(name.format(tmp=tmp_path))
    assert len(str(caught.value).splitlines()) == 1
    assert "secret" not in str(caught.value)


def test_passwords_are_not_shown():
    assert shown("postgresql://me:secret@host/x") == "postgresql://me:***@host/x"
