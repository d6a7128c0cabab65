"""A small study, its server without a network, and one in a process of its own."""

import asyncio
import os
import re
import subprocess
import sys
from pathlib import Path

import httpx

from ssrics_like.study.app import make_app
from ssrics_like.study.conduct import Conduct
from ssrics_like.study.store import Store

TOKEN = "a-token-for-tests-only"

STUDY = """\
title: A small study
seed: 7
instructions: Mark what you *like*.
order: fixed
next_participant: true
practice:
  - {id: try, kind: plan, map: simple, question: Try it.}
trials:
  - {id: plan, kind: plan, map: simple, question: Mark landmarks.}
  - id: walk
    kind: walk
    map: simple
    start: [9.0, 1.1, 0.0]
    waypoints: [[9.8, 1.1], [10.9, 1.1]]
    question: Press at landmarks.
  - {id: awake, kind: attention, key: k, question: Press K.}
"""


def write_study(folder, text=STUDY):
    path = Path(folder) / "small.yaml"
    path.write_text(text)
    return path


class Client:
    """A browser without a page: keeps cookies, speaks to the application directly."""

    def __init__(self, app, runner):
        self._runner = runner
        # What the application fails to catch is answered with 500, as by a server.
        transport = httpx.ASGITransport(app=app, raise_app_exceptions=False)
        self._client = httpx.AsyncClient(transport=transport, base_url="http://study")
        self._made = 0
        self.cookies = self._client.cookies

    def request(self, method, path, **kwargs):
        return self._runner.run(self._client.request(method, path, **kwargs))

    def get(self, path, **kwargs):
        return self.request("GET", path, **kwargs)

    def post(self, path, json=None, **kwargs):
        return self.request("POST", path, json={} if json is None else json, **kwargs)

    def join(self, **said):
        assert self.post("/api/join", said).status_code == 200
        return self

    def state(self):
        return self.get("/api/state").json()

    def send(self, event, **more):
        self._made += 1
        step = more.pop("step", None)
        said = {
            "key": f"key-{id(self):x}-{self._made}",
            "step": self.state()["step"] if step is None else step,
            "event": event,
            "t_ms": 10.0 * self._made,
            "client_ms": 1.7e12 + self._made,
            **more,
        }
        return self.post("/api/responses", said)

    def go_to(self, trial_step):
        while (state := self.state())["step"] < trial_step:
            if state["kind"] == "walk":  # it has been shown to its end
                said = {"step": state["step"], "replay_ms": state["length_ms"]}
                assert self.post("/api/progress", said).status_code == 200
            assert self.send("end").status_code == 200
        return self

    def close(self):
        self._runner.run(self._client.aclose())


class World:
    """A study that is being served, and its clients."""

    def __init__(self, study, folder):
        self.database = folder / "answers.sqlite"
        self.store = Store(str(self.database))
        self.app = make_app(Conduct(study, self.store), TOKEN)
        self.runner = asyncio.Runner()
        self.clients = []

    def client(self):
        self.clients.append(Client(self.app, self.runner))
        return self.clients[-1]

    def close(self):
        for client in self.clients:
            client.close()
        self.runner.close()
        self.store.close()


class Server:
    """``ssrics study serve`` in a process of its own."""

    def __init__(self, study, database, *more):
        self.arguments = ["study", "serve", str(study), "--database", str(database), *more]
        self.start()

    def start(self, port=0):
        command = [sys.executable, "-m", "ssrics_like", *self.arguments]
        command += ["--port", str(port), "--admin-token", TOKEN]
        self.process = subprocess.Popen(
            command, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True,
            env={**os.environ, "PYTHONUNBUFFERED": "1"},
        )  # fmt: skip
        said = [self.process.stdout.readline() for _ in range(3)]
        found = re.search(r"http://127\.0\.0\.1:(\d+)/", said[0])
        assert found, "".join(said) + self.process.stdout.read()
        self.port = int(found[1])
        self.address = f"http://127.0.0.1:{self.port}"

    def kill(self):
        self.process.kill()
        self.process.wait()
        self.process.stdout.close()

    def restart(self):
        self.start(self.port)
