"""Fifty people at a study at once: how long a response takes, and that none is lost.

    python benchmarks/bench_study.py [--people 50] [--responses 40] [--database FILE_OR_URL]

A server is started in a process of its own. All people join, go to the plan, and set marks, each
waiting for the answer before the next; then the server is killed without warning, started
again, and what every person has been told is saved is looked for.
"""

from __future__ import annotations

import argparse
import asyncio
import re
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import httpx
import numpy as np

STUDY = """\
title: Load
instructions: Mark.
trials:
  - {id: plan, kind: plan, map: simple, question: Mark.}
"""
TOKEN = "only-for-the-benchmark"
PAUSE_S = 0.5  # between two responses of a person: faster than anybody clicks for long


def started(folder: Path, database: str, port: int = 0) -> tuple[subprocess.Popen[str], str]:
    """Start a server and return it and its address."""
    command = [sys.executable, "-u", "-m", "ssrics_like", "study", "serve"]
    command += [str(folder / "load.yaml"), "--database", database, "--port", str(port)]
    command += ["--admin-token", TOKEN]
    server = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)
    assert server.stdout is not None
    found = re.search(r"http://\S+/", server.stdout.readline())
    assert found is not None, "the server did not start"
    return server, found[0].rstrip("/")


def said(key: str, step: int, event: str, **more: float) -> dict[str, object]:
    """Return a response as a browser sends it."""
    return {"key": key, "step": step, "event": event, "t_ms": 0.0, "client_ms": 0.0, **more}


async def take_part(
    client: httpx.AsyncClient, number: int, responses: int, pause_s: float
) -> tuple[list[float], list[str]]:
    """Join, go to the plan, set marks; return how long each took, and which were acknowledged."""
    (await client.post("/api/join", json={})).raise_for_status()
    end = said(f"end-{number:05d}", 0, "end")
    (await client.post("/api/responses", json=end)).raise_for_status()
    took, saved = [], []
    for i in range(responses):
        await asyncio.sleep(pause_s)
        key = f"mark-{number:05d}-{i:05d}"
        began = time.perf_counter()
        answer = await client.post(
            "/api/responses", json=said(key, 1, "add", right_m=1.0 + i / 100, down_m=2.0)
        )
        took.append(time.perf_counter() - began)
        if answer.status_code == 200:
            saved.append(key)
    return took, saved


async def missing(client: httpx.AsyncClient, saved: list[str]) -> int:
    """Return how many acknowledged marks a person does not find again."""
    state = (await client.get("/api/state")).json()
    return len(set(saved) - {mark["key"] for mark in state["marks"]})


async def measured(arguments: argparse.Namespace, folder: Path) -> None:
    """Put the load on and print a table."""
    (folder / "load.yaml").write_text(STUDY)
    database = arguments.database or str(folder / "load.sqlite")
    server, address = started(folder, database)
    clients = [httpx.AsyncClient(base_url=address, timeout=60.0) for _ in range(arguments.people)]
    began = time.perf_counter()
    try:
        found = await asyncio.gather(
            *(
                take_part(client, i, arguments.responses, arguments.pause)
                for i, client in enumerate(clients)
            )
        )
        seconds = time.perf_counter() - began
        server.kill()
        server.wait()
        server, _ = started(folder, database, int(address.rsplit(":", 1)[1]))
        lost = await asyncio.gather(
            *(missing(client, saved) for client, (_, saved) in zip(clients, found, strict=True))
        )
    finally:
        server.kill()
        server.wait()
        for client in clients:
            await client.aclose()
    took = np.concatenate([times for times, _ in found])
    acknowledged = sum(len(saved) for _, saved in found)
    median, high, top = np.quantile(took, [0.5, 0.95, 1.0]) * 1000
    names = "people, responses, acknowledged, lost after kill -9, s, median ms, p95 ms, max ms"
    print(f"| {names.replace(', ', ' | ')} |")
    print("|---" * 8 + "|")
    print(
        f"| {arguments.people} | {len(took)} | {acknowledged} | {sum(lost)} | {seconds:.1f} "
        f"| {median:.1f} | {high:.1f} | {top:.1f} |"
    )


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--people", type=int, default=50)
    parser.add_argument("--responses", type=int, default=40)
    parser.add_argument("--pause", type=float, default=PAUSE_S, help="seconds between two")
    parser.add_argument("--database", help="file or URL that holds nothing yet")
    arguments = parser.parse_args()
    with tempfile.TemporaryDirectory() as folder:
        asyncio.run(measured(arguments, Path(folder)))


if __name__ == "__main__":
    main()
