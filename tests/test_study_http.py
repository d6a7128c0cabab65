"""The interface of a study's pages: who may do what, and what happens to everything else."""

import io
import json
import zipfile

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from studies import STUDY, TOKEN, World, write_study

from ssrics_like.study import read_study
from ssrics_like.study.security import BODY_MAX

BEARER = {"Authorization": f"Bearer {TOKEN}"}


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    return read_study(write_study(tmp_path_factory.mktemp("study")))


@pytest.fixture
def world(study, tmp_path):
    made = World(study, tmp_path)
    yield made
    made.close()


@pytest.fixture(scope="module")
def lasting(study, tmp_path_factory):
    made = World(study, tmp_path_factory.mktemp("lasting"))
    yield made
    made.close()


def test_a_whole_study(world):
    client = world.client()
    assert "Begin" in client.get("/").text
    client.join()
    assert "Mark what you <em>like</em>." in client.get("/").text
    client.go_to(2)
    added = client.send("add", right_m=5.75, down_m=2.25, key="mark-one")
    assert added.json() == {"step": 2}
    client.send("add", right_m=1.0, down_m=1.0, key="mark-two")
    client.send("name", mark="mark-one", label="  <b>door</b> ")
    client.send("move", mark="mark-one", right_m=6.0, down_m=2.5)
    client.send("delete", mark="mark-two")
    assert client.state()["marks"] == [
        {"key": "mark-one", "label": "<b>door</b>", "right_m": 6.0, "down_m": 2.5}
    ]
    assert client.get("/api/plan/2").content[:4] == b"\x89PNG"
    client.go_to(3)
    state = client.state()
    frames = client.get("/api/walk/3").content
    assert len(frames) % (2 * (2 * state["columns"] + state["beams"]) + state["columns"]) == 0
    assert client.send("press", replay_ms=1500.0).status_code == 200
    assert client.post("/api/progress", {"step": 3, "replay_ms": 2500.0}).status_code == 200
    assert client.state()["replay_ms"] == 2500.0
    client.go_to(4)
    client.send("press", pressed="k")
    client.send("end")
    assert "Thank you" in client.get("/").text
    tables = exported(client)
    name = client.get("/").text.split('class="id">')[1].split("<")[0]
    lines = tables["choices.csv"].splitlines()
    assert lines[:2] == [
        "participant,landmark,x_m,y_m,label,t_s",
        f"{name},plan-1,6,8.5,<b>door</b>,",
    ]
    assert lines[2].startswith(f"{name},walk-1,")
    assert lines[2].endswith(",,1.5")
    assert tables["participants.csv"].splitlines()[1].endswith(",4,try plan walk awake,1,1")
    assert client.post("/api/leave").status_code == 200
    assert "Begin" in client.get("/").text


def exported(client):
    answer = client.get("/admin/export.zip", headers=BEARER)
    assert answer.status_code == 200
    archive = zipfile.ZipFile(io.BytesIO(answer.content))
    return {name: archive.read(name).decode() for name in archive.namelist()}


def test_a_press_lies_where_the_robot_was(world, study):
    client = world.client().join().go_to(3)
    client.send("press", replay_ms=2345.0)
    client.send("press", replay_ms=0.0)
    expected = study.by_id["walk"].replay.at([2.345, 0.0])
    rows = exported(client)["choices-walk.csv"].splitlines()[1:]
    found = [[float(cell) for cell in row.split(",")[2:4]] for row in rows]
    assert found[0] == pytest.approx(expected[0, :2], abs=1e-6)
    assert found[1] == pytest.approx([9.02, 1.1], abs=1e-6)  # the laser sits 2 cm ahead


@pytest.mark.parametrize(
    ("step", "said", "status"),
    [
        (2, {"event": "add", "right_m": 18.1, "down_m": 1.0}, 422),
        (2, {"event": "add", "right_m": 1.0}, 422),
        (2, {"event": "press", "replay_ms": 1.0}, 422),
        (2, {"event": "name", "mark": "mark-one", "label": "x" * 201}, 422),
        (2, {"event": "name", "mark": "mark-one", "label": "a\x00b"}, 422),
        (2, {"event": "explode"}, 422),
        (2, {"event": "add", "right_m": 1.0, "down_m": 1.0, "step": 1}, 409),
        (2, {"event": "end", "step": 3}, 409),
        (3, {"event": "press"}, 422),
        (3, {"event": "press", "replay_ms": 3.6e6}, 422),
        (3, {"event": "add", "right_m": 1.0, "down_m": 1.0}, 422),
        (4, {"event": "press", "pressed": "kk"}, 422),
    ],
)
def test_what_does_not_belong_here_is_refused_and_not_kept(world, step, said, status):
    client = world.client().join().go_to(step)
    before = len(world.store.responses())
    event = said.pop("event")
    answer = client.send(event, **said)
    assert (answer.status_code, set(answer.json())) == (status, {"detail"})
    assert len(world.store.responses()) == before


def test_a_mark_of_somebody_else_cannot_be_touched(world):
    one, two = world.client().join().go_to(2), world.client().join().go_to(2)
    one.send("add", right_m=1.0, down_m=1.0, key="mark-of-one")
    two.send("delete", mark="mark-of-one")
    two.send("move", mark="mark-of-one", right_m=9.0, down_m=9.0)
    two.send("add", right_m=2.0, down_m=2.0, key="mark-of-one")  # the same key is no clash
    assert [m["right_m"] for m in one.state()["marks"]] == [1.0]
    assert [m["right_m"] for m in two.state()["marks"]] == [2.0]


def test_a_session_is_needed_and_cannot_be_guessed(world):
    world.client().join()
    stranger = world.client()
    for token in (b"", b"x", b"1", b"0" * 32, "ü".encode(), b"x" * 5000, b'"\\'):
        cookie = {"Cookie": b"ssrics_study=" + token}
        assert stranger.get("/api/state", headers=cookie).status_code == 401


@pytest.mark.parametrize("path", ["/admin", "/admin/export.zip"])
def test_the_experimenters_pages_need_the_token(world, path):
    client = world.client().join()
    assert client.get(path).status_code == 401
    for wrong in ("Bearer x", f"Basic {TOKEN}", TOKEN, f"Bearer {TOKEN}x", "Bearer"):
        assert client.get(path, headers={"Authorization": wrong}).status_code == 401
    client.cookies.set("ssrics_admin", TOKEN)
    assert client.get(path).status_code == 401
    client.cookies.clear()
    assert client.get(path, headers=BEARER).status_code == 200
    assert client.post("/admin/login", {"token": TOKEN}).status_code == 200
    assert client.get(path).status_code == 200
    assert TOKEN not in str(client.cookies)


def test_tokens_cannot_be_tried_without_end(world):
    client = world.client()
    tried = [client.post("/admin/login", {"token": f"wrong-{i}"}).status_code for i in range(30)]
    assert set(tried) == {403, 429}
    assert client.post("/admin/login", {"token": TOKEN}).status_code == 200


def test_names_are_shown_as_text(world, tmp_path):
    text = STUDY.replace("seed: 7", "seed: 7\nparticipant: typed")
    other = World(read_study(write_study(tmp_path, text)), tmp_path)
    client = other.client()
    assert client.post("/api/join", {}).status_code == 422
    assert client.post("/api/join", {"participant": "<script>"}).status_code == 422
    client.join(participant="p.1")
    assert client.post("/api/join", {"participant": "p.2"}).status_code == 200  # goes on as p.1
    assert client.state()["participant"] == "p.1"
    again = other.client().post("/api/join", {"participant": "p.1"})
    assert again.status_code == 409
    assert "p.1" in other.client().get("/admin", headers=BEARER).text
    other.close()


def test_every_answer_carries_the_headers(world):
    client = world.client()
    for path in ("/", "/declined", "/static/study.css", "/api/state", "/nowhere", "/admin"):
        headers = client.get(path).headers
        assert headers["content-security-policy"].startswith("default-src 'self';")
        assert headers["x-content-type-options"] == "nosniff"
        assert headers["x-frame-options"] == "DENY"


def test_pages_ask_nobody_else(world):
    client = world.client().join()
    pages = [client.get("/").text, client.get("/admin", headers=BEARER).text]
    for step in range(1, 5):
        client.go_to(step)
        pages.append(client.get("/").text)
    for page in pages:
        assert "http:" not in page
        assert "https:" not in page
        assert "//" not in page.replace("<!DOCTYPE html>", "")


@pytest.mark.parametrize(
    "path",
    ["/static/../app.py", "/static/..%2fapp.py", "/static/%2e%2e/app.py", "/static//etc/passwd",
     "/api/plan/../../x", "/openapi.json", "/docs", "/static/", "/static"],
)  # fmt: skip
def test_no_path_leads_elsewhere(world, path):
    answer = world.client().join().get(path)
    assert answer.status_code in (401, 404, 405, 307)
    assert "import" not in answer.text


def test_long_bodies_are_refused_unread(world):
    client = world.client().join()

    async def endless():
        for _ in range(BODY_MAX // 1000 + 2):
            yield b"x" * 1000

    headers = {"Content-Type": "application/json"}
    for content in (b"x" * (BODY_MAX + 1), endless()):
        answer = client.request("POST", "/api/responses", content=content, headers=headers)
        assert answer.status_code == 413
        assert answer.headers["x-frame-options"] == "DENY"


def test_responses_come_as_json_only(world):
    client = world.client().join()
    said = json.dumps({"key": "k" * 9, "step": 0, "event": "end", "t_ms": 0.0, "client_ms": 0.0})
    for kind in ("text/plain", "application/x-www-form-urlencoded"):  # what a foreign page can send
        answer = client.request(
            "POST", "/api/responses", content=said, headers={"Content-Type": kind}
        )
        assert answer.status_code == 422
    assert client.state()["step"] == 0


def test_too_many_requests_at_once_are_refused(world):
    client = world.client().join()
    statuses = {client.get("/api/state").status_code for _ in range(130)}
    assert statuses == {200, 429}


def test_who_has_said_too_much_can_still_go_on(tmp_path):
    text = STUDY.replace("seed: 7", "seed: 7\nresponses_max: 3")
    other = World(read_study(write_study(tmp_path, text)), tmp_path)
    client = other.client().join().go_to(2)
    adding = {"right_m": 1.0, "down_m": 1.0}
    statuses = [client.send("add", **adding).status_code for _ in range(2)]
    assert statuses == [200, 403]
    client.go_to(5)
    assert "Thank you" in client.get("/").text
    other.close()


def test_pages_and_what_they_show_are_not_cached(world):
    client = world.client().join().go_to(2)
    for path in ("/", "/api/state", "/api/plan/2"):
        assert client.get(path).headers["cache-control"] == "no-store"


# --- fuzz

ODD = st.one_of(
    st.none(), st.booleans(), st.integers(-(10**30), 10**30), st.floats(), st.text(max_size=300),
    st.sampled_from(["end", "add", "press", "x" * 70_000, "\x00", "\ud800", "../..", "1e400"]),
    st.lists(st.integers(), max_size=3), st.dictionaries(st.text(max_size=5), st.integers(), max_size=3),
)  # fmt: skip
FIELDS = (
    "key", "step", "event", "mark", "right_m", "down_m", "label", "pressed", "t_ms", "replay_ms",
    "client_ms", "participant", "token",
)  # fmt: skip
RIGHT = {
    "key": st.text("abc-_09", min_size=8, max_size=9), "step": st.integers(0, 5),
    "event": st.sampled_from(["begin", "add", "move", "name", "delete", "press", "pause", "end"]),
    "mark": st.just("mark-of-victim"), "right_m": st.floats(-1, 20), "down_m": st.floats(-1, 20),
    "label": st.text(max_size=200), "pressed": st.text(max_size=1), "t_ms": st.floats(0, 1e6),
    "replay_ms": st.floats(0, 1e5), "client_ms": st.floats(0, 1e13),
}  # fmt: skip
NEARLY = st.fixed_dictionaries(
    {name: st.one_of(RIGHT[name], RIGHT[name], ODD) for name in ("key", "step", "event", "t_ms", "client_ms")},
    optional={name: st.one_of(RIGHT.get(name, ODD), ODD) for name in FIELDS if name not in
              ("key", "step", "event", "t_ms", "client_ms")},
)  # fmt: skip
BODIES = st.one_of(NEARLY, st.dictionaries(st.sampled_from(FIELDS), ODD, max_size=8), ODD)
POSTS = (
    "/api/responses",
    "/api/progress",
    "/api/join",
    "/api/leave",
    "/admin/login",
    "/admin/logout",
)
PATHS = st.one_of(
    st.sampled_from(POSTS),
    st.builds("/api/{}/{}".format, st.sampled_from(["plan", "walk"]), st.integers(-9, 10**25)),
    st.text(st.characters(min_codepoint=32, max_codepoint=126, exclude_characters="?#\\"), max_size=20)
    .map(lambda t: "/" + t.lstrip("/")),  # two slashes begin a host
)  # fmt: skip
WRONG = st.one_of(
    st.none(), st.text(st.characters(min_codepoint=33, max_codepoint=126), max_size=50)
)


def encoded(body):
    # As a browser would never send it: NaN, lone surrogates and huge numbers go through.
    return json.dumps(body).encode("utf-8", "surrogatepass")


@pytest.fixture(scope="module")
def victim(lasting):
    client = lasting.client().join().go_to(2)
    client.send("add", right_m=1.0, down_m=1.0, key="mark-of-victim")
    client.send("name", mark="mark-of-victim", label="mine")
    return client


@settings(
    max_examples=200, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(
    method=st.sampled_from(["POST", "POST", "POST", "GET", "PUT", "DELETE"]),
    path=PATHS, body=BODIES, session=WRONG, bearer=WRONG, own=st.booleans(),
)  # fmt: skip
def test_nothing_that_is_sent_breaks_the_server_or_touches_another(
    lasting, victim, method, path, body, session, bearer, own
):
    known = [p for p in lasting.store.participants() if p.name == victim.state_name]
    before = lasting.store.responses(known[0].number)
    client = lasting.attacker if own else lasting.stranger
    headers = {"Content-Type": "application/json"}
    if bearer is not None:
        headers["Authorization"] = f"Bearer {bearer}"
    if not own and session is not None:
        headers["Cookie"] = f"ssrics_study={session}; ssrics_admin={session}"
    answer = client.request(method, path, content=encoded(body), headers=headers)
    assert answer.status_code < 500, answer.text
    assert "Traceback" not in answer.text
    after = [p for p in lasting.store.participants() if p.name == victim.state_name]
    assert lasting.store.responses(known[0].number) == before
    assert after == known


@settings(max_examples=30, deadline=None)
@given(content=st.binary(max_size=200))
def test_bytes_that_are_no_json_are_refused(lasting, content):
    for path in POSTS[:5]:
        headers = {"Content-Type": "application/json"}
        answer = lasting.stranger.request("POST", path, content=content, headers=headers)
        assert answer.status_code < 500


@pytest.fixture(scope="module", autouse=True)
def _people(lasting, victim):
    victim.state_name = victim.state()["participant"]
    lasting.attacker = lasting.client().join()
    lasting.stranger = lasting.client()
