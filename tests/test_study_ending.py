"""A server of a study as its neighbours see it: the port, the end, what it says to a terminal."""

import contextlib
import itertools
import signal
import socket
import sqlite3
import time

import httpx
import pytest
from studies import Server, write_study

from ssrics_like.study.security import PASSED_OVER_MAX

HEAD = "POST /api/responses HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\n"


@pytest.fixture
def server(tmp_path):
    made = Server(write_study(tmp_path), tmp_path / "answers.sqlite")
    made.folder = tmp_path
    yield made
    made.kill()


def connected(server, text):
    client = socket.create_connection(("127.0.0.1", server.port), timeout=10)
    client.sendall(text.encode("latin-1"))
    return client


def ended(server, how=signal.SIGINT):
    """Exit status, and all that was said after the addresses."""
    server.process.send_signal(how)
    status = server.process.wait(timeout=30)
    return status, server.process.stdout.read()


@contextlib.contextmanager
def joined(server):
    with httpx.Client(base_url=server.address) as client:
        assert client.post("/api/join", json={}).status_code == 200
        yield client


def test_sigterm_is_an_ordinary_end_that_leaves_one_file(server):
    with joined(server):
        assert (server.folder / "answers.sqlite-wal").stat().st_size > 0
        assert ended(server, signal.SIGTERM) == (0, "")
    assert {path.name for path in server.folder.iterdir()} == {"answers.sqlite", "small.yaml"}
    kept = sqlite3.connect(server.folder / "answers.sqlite")
    assert kept.execute("SELECT count(*) FROM ssrics_participants").fetchone() == (1,)
    kept.close()


@pytest.mark.parametrize("how", [signal.SIGINT, signal.SIGTERM])
def test_the_end_may_follow_the_addresses_at_once(tmp_path, how):
    server = Server(write_study(tmp_path), tmp_path / "answers.sqlite")
    assert ended(server, how) == (0, "")
    server.kill()
    assert not (tmp_path / "answers.sqlite-wal").exists()


def test_a_request_that_is_half_sent_does_not_disturb_the_end(server):
    with joined(server) as client:
        cookie = f"Cookie: ssrics_study={client.cookies['ssrics_study']}\r\n"
        half = [
            connected(server, HEAD + cookie + 'Content-Length: 500\r\n\r\n{"key": '),
            connected(server, HEAD + "Content-Length: 900000\r\n\r\nxxx"),
            connected(server, HEAD),
        ]
        assert client.get("/api/state").status_code == 200
        time.sleep(0.2)  # until the server has them
        assert ended(server) == (0, "")
        for each in half:
            each.close()


def test_what_strangers_send_to_the_port_is_not_told(server):
    for text in ("\x16\x03\x01\x02\0\x01", "GET\r\n\r\n", "GET / HTTP/9.9\r\n\r\n", "x" * 70_000):
        with connected(server, text) as client:
            client.recv(1000)
    with connected(server, "GET / HTTP/1.1\r\nHost: x\r\nUpgrade: websocket\r\nConnection: Upgrade\r\n"
                   "Sec-WebSocket-Version: 13\r\nSec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\n\r\n") as client:  # fmt: skip
        client.recv(1000)
    assert httpx.get(f"{server.address}/").status_code == 200
    assert ended(server) == (0, "")


def test_who_sends_too_much_gets_to_read_why(server):
    # Not by httpx, which reads the answer even where it could not send all of its request.
    for size in (100_000, 10_000_000, PASSED_OVER_MAX):
        chunk = b"c350\r\n" + b"x" * 50_000 + b"\r\n"
        chunks = itertools.chain(itertools.repeat(chunk, size // 50_000), [b"0\r\n\r\n"])
        for length, parts in (
            (f"Content-Length: {size}", [b"x" * size]),
            ("Transfer-Encoding: chunked", chunks),
        ):
            with joined(server) as client:
                cookie = f"Cookie: ssrics_study={client.cookies['ssrics_study']}"
            with connected(server, f"{HEAD}{cookie}\r\n{length}\r\n\r\n") as sender:
                for part in parts:
                    sender.sendall(part)
                answer = sender.makefile("rb").read()
            assert answer.startswith(b"HTTP/1.1 413 ")
            assert answer.endswith(b'{"detail": "The request is too long."}')


def test_who_asks_before_sending_too_much_is_told_at_once(server):
    with connected(
        server, HEAD + "Expect: 100-continue\r\nContent-Length: 900000\r\n\r\n"
    ) as client:
        assert client.recv(1000).startswith(b"HTTP/1.1 413 ")
