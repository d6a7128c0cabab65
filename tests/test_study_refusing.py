"""What a study's server does not take, and that nothing of it is called saved."""

import pytest
from studies import STUDY, TOKEN, World, write_study

from ssrics_like.study import read_study

BEARER = {"Authorization": f"Bearer {TOKEN}"}
PLACE = {"right_m": 1.0, "down_m": 1.0}


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    return read_study(write_study(tmp_path_factory.mktemp("study")))


@pytest.fixture
def world(study, tmp_path):
    made = World(study, tmp_path)
    yield made
    made.close()


def test_a_clock_that_is_far_off_is_no_reason_to_lose_an_answer(world):
    client = world.client().join().go_to(2)
    assert client.send("add", **PLACE, t_ms=1e14, client_ms=0.0).status_code == 200
    assert client.send("add", **PLACE, t_ms=0.0, client_ms=1e14).status_code == 200
    assert client.send("add", **PLACE, t_ms=1.1e14).status_code == 422
    assert len(client.state()["marks"]) == 2


# --- the database


def everything(client, stranger):
    """Statuses of all that is kept or read."""
    return {
        "save": client.send("add", step=2, **PLACE).status_code,
        "progress": client.post("/api/progress", {"step": 2, "replay_ms": 1.0}).status_code,
        "state": client.get("/api/state").status_code,
        "page": client.get("/").status_code,
        "plan": client.get("/api/plan/2").status_code,
        "join": stranger.post("/api/join").status_code,
        "admin": client.get("/admin", headers=BEARER).status_code,
        "export": client.get("/admin/export.zip", headers=BEARER).status_code,
    }


@pytest.mark.parametrize("replaced", [False, True])
def test_without_its_file_nothing_is_called_saved_and_nothing_read(world, replaced, caplog):
    client, stranger = world.client().join().go_to(2), world.client()
    client.send("add", **PLACE)
    aside = world.database.with_name("aside.sqlite")
    world.database.rename(aside)
    if replaced:
        world.database.write_bytes(aside.read_bytes())
    assert set(everything(client, stranger).values()) == {503}
    assert "cannot be reached at the moment" in client.get("/").text
    said = "the database cannot be used (its file was removed or replaced)"
    assert [said in record.getMessage() for record in caplog.records] == [True]  # not for each
    aside.replace(world.database)
    assert len(client.state()["marks"]) == 1  # nothing of what was refused
    assert len(world.store.participants()) == 1
    assert client.send("add", **PLACE).status_code == 200
    assert stranger.post("/api/join").status_code == 200


def test_what_was_committed_as_the_file_went_is_not_called_saved(world, monkeypatch):
    client = world.client().join().go_to(2)
    conducted = type(world.store).append

    def append(store, number, key, most, make):
        def late(person):
            made = make(person)
            world.database.rename(world.database.with_name("aside.sqlite"))
            return made

        return conducted(store, number, key, most, late)

    monkeypatch.setattr(type(world.store), "append", append)
    assert client.send("add", step=2, **PLACE).status_code == 503


# --- walks


def test_a_walk_cannot_be_left_before_it_was_shown_to_its_end(world, study):
    client = world.client().join().go_to(3)
    length_ms = 1000 * study.by_id["walk"].replay.length_s
    for more in ({}, {"replay_ms": length_ms - 101.0}):
        refused = client.send("end", **more)
        assert (refused.status_code, refused.json()) == (
            422,
            {"detail": "The walk is not over yet."},
        )
    client.post("/api/progress", {"step": 3, "replay_ms": length_ms - 200.0})
    assert client.send("end").status_code == 422
    assert client.state()["step"] == 3
    assert client.send("end", replay_ms=length_ms).json() == {"step": 4}


def test_progress_to_the_end_lets_a_walk_be_left(world, study):
    client = world.client().join().go_to(3)
    length_ms = 1000 * study.by_id["walk"].replay.length_s
    client.post("/api/progress", {"step": 3, "replay_ms": 1e7})
    assert client.state()["replay_ms"] == length_ms
    assert client.send("end").json() == {"step": 4}


def test_a_press_lies_within_the_walk(world, study):
    client = world.client().join().go_to(3)
    length_ms = 1000 * study.by_id["walk"].replay.length_s
    assert client.send("press", replay_ms=length_ms).status_code == 200
    assert client.send("press", replay_ms=length_ms + 1.5).status_code == 422


# --- names


@pytest.mark.parametrize(
    ("given", "kept"),
    [
        ("=HYPERLINK(1)", "HYPERLINK(1)"),
        (" + - @=cmd", "cmd"),
        ("＝１+1", "１+1"),
        ("a=b-c", "a=b-c"),
        ("--", ""),
        ("„Tür“ – links", "„Tür“ – links"),
    ],
)
def test_no_name_of_a_mark_is_a_formula(world, given, kept):
    client = world.client().join().go_to(2)
    client.send("add", **PLACE, label=given, key="mark-one")
    assert client.state()["marks"][0]["label"] == kept
    client.send("name", mark="mark-one", label=given)
    assert client.state()["marks"][0]["label"] == kept


@pytest.mark.parametrize(
    ("name", "status"),
    [
        ("p-1", 200),
        (".1", 200),
        ("me@x", 200),
        ("-1", 422),
        ("@x", 422),
        ("=1", 422),
        ("a" * 65, 422),
    ],
)
def test_no_id_of_a_participant_is_a_formula(tmp_path, name, status):
    text = STUDY.replace("seed: 7", "seed: 7\nparticipant: typed")
    world = World(read_study(write_study(tmp_path, text)), tmp_path)
    assert world.client().post("/api/join", {"participant": name}).status_code == status
    world.close()


def test_no_key_is_a_formula(world):
    client = world.client().join().go_to(2)
    assert client.send("add", **PLACE, key="-1234567").status_code == 422


# --- words


@pytest.mark.parametrize(
    ("said", "detail"),
    [
        ({"key": 5}, "body.key: is not what was expected"),
        ({"label": "x" * 201}, "body.label: is not what was expected"),
        ({"label": "a\0b"}, "body.label: expected text without control characters"),
        ({"right_m": None}, "body: add needs right_m and down_m"),
        ({"colour": "red"}, "body.colour: is not known here"),
    ],
)
def test_what_is_wrong_is_said_in_our_own_words(world, said, detail):
    client = world.client().join().go_to(2)
    answer = client.send("add", **{**PLACE, **said})
    assert (answer.status_code, answer.json()) == (422, {"detail": detail})
