"""The server as a process: killed without warning, bound, asked for by the command line."""

import csv
import signal
import socket
import stat
import sys
import threading
import time

import httpx
import pytest
from studies import STUDY, TOKEN, Server, write_study

from ssrics_like.cli import main
from ssrics_like.study.serving import address_of, bound, is_loopback
from ssrics_like.study.store import Store


@pytest.fixture(scope="module")
def server(tmp_path_factory):
    folder = tmp_path_factory.mktemp("server")
    made = Server(write_study(folder), folder / "answers.sqlite")
    made.folder = folder
    yield made
    made.kill()


def said(key, step, event="add", **more):
    if event == "add":
        more = {"right_m": 1.0, "down_m": 1.0, **more}
    return {"key": key, "step": step, "event": event, "t_ms": 0.0, "client_ms": 0.0, **more}


def test_kill_9_amid_responses_loses_none_that_was_acknowledged(server):
    people = []
    for _ in range(3):
        client = httpx.Client(base_url=server.address)
        assert client.post("/api/join", json={}).status_code == 200
        client.post("/api/responses", json=said("end-of-0", 0, "end"))
        people.append(client)
    saved = [[] for _ in people]

    def press(i):
        for number in range(5000):
            key = f"key-{i}-{number}"
            try:
                answer = people[i].post("/api/responses", json=said(key, 1))
            except httpx.HTTPError:
                return
            if answer.status_code == 200:
                saved[i].append(key)
            time.sleep(0.002)

    threads = [threading.Thread(target=press, args=(i,)) for i in range(len(people))]
    for thread in threads:
        thread.start()
    while sum(map(len, saved)) < 60:
        time.sleep(0.01)
    server.kill()
    for thread in threads:
        thread.join()
    server.restart()
    for i, client in enumerate(people):
        state = client.get("/api/state").json()
        kept = [mark["key"] for mark in state["marks"]]
        assert state["step"] == 1
        assert kept[: len(saved[i])] == saved[i]
        assert len(kept) <= len(saved[i]) + 1  # one may have been saved and not answered
        # What was sent last is sent again, and taken once.
        client.post("/api/responses", json=said(kept[-1], 1))
        assert [m["key"] for m in client.get("/api/state").json()["marks"]] == kept
        client.close()
    store = Store(str(server.folder / "answers.sqlite"))
    assert sum(each.event == "add" for each in store.responses()) >= sum(map(len, saved))
    store.close()


def test_a_killed_replay_goes_on_from_where_it_was(server):
    with httpx.Client(base_url=server.address) as client:
        client.post("/api/join", json={})
        for step in range(3):
            client.post("/api/responses", json=said(f"end-of-{step}", step, "end"))
        client.post("/api/responses", json=said("press-one", 3, "press", replay_ms=1200.0))
        client.post("/api/progress", json={"step": 3, "replay_ms": 2000.0})
        server.kill()
        server.restart()
        state = client.get("/api/state").json()
        assert (state["step"], state["replay_ms"], state["presses"]) == (3, 2000.0, 1)


def test_ctrl_c_is_the_ordinary_end(server):
    server.process.send_signal(signal.SIGINT)
    assert server.process.wait(timeout=20) == 0
    assert server.process.stdout.read() == ""
    server.process.stdout.close()
    server.restart()


def run(*arguments):
    with pytest.raises(SystemExit) as stop:
        main([str(each) for each in arguments])
    return stop.value.code


@pytest.fixture
def here(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    return tmp_path


def test_export_writes_what_the_server_has_taken(server, here, capsys):
    with httpx.Client(base_url=server.address) as client:
        client.post("/api/join", json={})
        for step in range(2):
            client.post("/api/responses", json=said(f"end-of-{step}", step, "end"))
        client.post("/api/responses", json=said("mark-one", 2, right_m=5.75, down_m=2.25))
    answers = server.folder / "answers.sqlite"
    assert run("study", "export", answers, "-o", "out") == 0  # while it is being served
    names = sorted(path.name for path in (here / "out").iterdir())
    assert names == [
        "choices-plan.csv", "choices-walk.csv", "choices.csv", "participants.csv", "responses.csv",
    ]  # fmt: skip
    with (here / "out" / "choices-plan.csv").open() as lines:
        (row,) = csv.DictReader(lines)
    assert (row["landmark"], row["x_m"], row["y_m"]) == ("plan-1", "5.75", "8.75")
    assert " 0 finished, " in capsys.readouterr().out
    assert run("study", "export", answers, "-o", "done", "--finished") == 0
    assert (here / "done" / "participants.csv").read_text().count("\n") == 1  # nobody has
    before = (here / "out" / "responses.csv").read_bytes()
    assert run("study", "export", answers, "-o", "out") == 0
    assert (here / "out" / "responses.csv").read_bytes() == before
    assert run("study", "export", answers, "-o", "out", "--trial", "wlk") == 1
    assert "no trial 'wlk' that asks for landmarks; did you mean 'walk'?" in capsys.readouterr().err


def test_new_writes_a_study_that_can_be_served(here, capsys):
    assert run("study", "new", "mine") == 0
    assert "ssrics study serve mine.yaml" in capsys.readouterr().out
    assert "attention" in (here / "mine.yaml").read_text()
    assert run("study", "new", "mine") == 1
    assert "mine.yaml: is there already" in capsys.readouterr().err
    assert run("study", "new", "../mine") == 1


@pytest.mark.parametrize(
    ("arguments", "said"),
    [
        (["study", "serve", "nothing"], "no study 'nothing'; the library has complex"),
        (["study", "serve", "none.yaml"], "none.yaml: no such file"),
        (["study", "serve", "small.yaml", "--port", "70000"], "--port 70000: expected 0 to 65535"),
        (["study", "serve", "small.yaml", "--admin-token", "short"], "--admin-token: expected 12"),
        (["study", "serve", "small.yaml", "--host", "203.0.113.7"], "--host 203.0.113.7: is no address"),
        (["study", "serve", "small.yaml", "--port", "0", "--database", "none/a.sqlite"], "none: no s"),
        (["study", "export", "none.sqlite", "-o", "out"], "none.sqlite: no such file"),
        (["study", "export", "complex", "-o", "out"], "complex.sqlite: no such file; name the"),
        (["study", "export", "empty.sqlite", "-o", "out"], "empty.sqlite: holds no study's answers"),
    ],
)  # fmt: skip
def test_a_mistake_is_one_line(here, capsys, arguments, said):
    write_study(here, STUDY)
    (here / "empty.sqlite").touch()
    assert run(*arguments) == 1
    error = capsys.readouterr().err
    assert said in error
    assert len(error.splitlines()) == 1
    assert not (here / "out").exists()


@pytest.mark.parametrize(
    ("module", "package"),
    [("fastapi", "fastapi"), ("sqlalchemy", "SQLAlchemy"), ("markdown_it", "markdown-it-py")],
)
def test_a_package_that_is_missing_is_told(here, capsys, monkeypatch, module, package):
    monkeypatch.setitem(sys.modules, module, None)
    assert run("study", "serve", "complex") == 1
    said = f"ssrics: a study needs the package {package}; pip install 'ssrics-like[study]'\n"
    assert capsys.readouterr().err == said


def test_a_port_that_is_taken_is_told(server, here, capsys):
    write_study(here)
    assert run("study", "serve", "small.yaml", "--port", server.port) == 1
    assert f"--port {server.port}: cannot be had on 127.0.0.1" in capsys.readouterr().err


def test_an_export_leaves_no_table_of_a_larger_one(server, here):
    answers = server.folder / "answers.sqlite"
    (here / "out").mkdir()
    for name in ("choices-walk.csv", "choices-mine.csv"):
        (here / "out" / name).write_text("of before\n")
    assert run("study", "export", answers, "-o", "out", "--trial", "plan") == 0
    left = {path.name for path in (here / "out").glob("choices*")}
    assert left == {"choices.csv", "choices-plan.csv", "choices-mine.csv"}


def test_who_is_bound_to_all_addresses_gives_the_machines_name():
    with bound("127.0.0.1", 0) as listening:
        port = listening.getsockname()[1]
        assert address_of(listening, "0.0.0.0") == f"http://{socket.gethostname()}:{port}/"
        assert address_of(listening, "localhost") == f"http://localhost:{port}/"
        assert address_of(listening, "::1") == f"http://[::1]:{port}/"


def test_changed_trials_are_not_mixed_with_old_answers(server, here, capsys):
    answers = server.folder / "answers.sqlite"
    (here / "small.yaml").write_text(STUDY.replace("id: awake", "id: wake"))
    assert run("study", "serve", "small.yaml", "--port", 0, "--database", answers) == 1
    assert "holds answers to other trials (listed was" in capsys.readouterr().err


def test_the_token_is_kept_for_its_owner_only(tmp_path):
    from ssrics_like.errors import StudyError
    from ssrics_like.study.tokens import kept_token

    file = tmp_path / "a.sqlite.token"
    token = kept_token(file)
    assert stat.S_IMODE(file.stat().st_mode) == 0o600
    assert kept_token(file) == token
    assert token != TOKEN
    file.write_text("short\n")
    with pytest.raises(StudyError, match="holds no token"):
        kept_token(file)


@pytest.mark.parametrize(
    ("host", "alone"),
    [
        ("127.0.0.1", True), ("127.8.8.8", True), ("::1", True), ("localhost", True),
        ("0.0.0.0", False), ("::", False), ("192.168.0.7", False), ("lab.example", False),
    ],
)  # fmt: skip
def test_hosts_that_only_this_machine_reaches_are_known(host, alone):
    assert is_loopback(host) == alone
