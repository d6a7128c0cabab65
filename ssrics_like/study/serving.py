"""Serving a study: sockets, addresses, the end."""

from __future__ import annotations

import asyncio
import contextlib
import errno
import ipaddress
import logging
import signal
import socket
from collections.abc import Iterator

import uvicorn
from fastapi import FastAPI

from ssrics_like.errors import StudyError


def is_loopback(host: str) -> bool:
    """Tell whether only this machine can reach a host's address."""
    if host == "localhost":
        return True
    try:
        return ipaddress.ip_address(host).is_loopback
    except ValueError:
        return False


def bound(host: str, port: int) -> socket.socket:
    """Return a socket that listens.

    Parameters
    ----------
    host : str
        Address or name to bind to.
    port : int
        0 for any that is free.

    Raises
    ------
    StudyError
        It cannot be had.
    """
    try:
        family, kind, protocol, _, address = socket.getaddrinfo(
            host, port, type=socket.SOCK_STREAM, flags=socket.AI_PASSIVE
        )[0]
        found = socket.socket(family, kind, protocol)
    except (OSError, UnicodeError, OverflowError) as e:
        why = getattr(e, "strerror", None) or "it is no name of a host"
        raise StudyError(f"--host {host}: cannot be bound to ({why})") from None
    try:
        found.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        found.bind(address)
        found.listen(128)
    except (OSError, OverflowError) as e:
        found.close()
        why = getattr(e, "strerror", None) or e
        if getattr(e, "errno", None) == errno.EADDRNOTAVAIL:
            raise StudyError(f"--host {host}: is no address of this machine ({why})") from None
        raise StudyError(f"--port {port}: cannot be had on {host} ({why})") from None
    return found


def address_of(listening: socket.socket, host: str) -> str:
    """Return the address to open in a browser; with the machine's name if it is bound to all."""
    shown = socket.gethostname() if host in ("0.0.0.0", "::", "") else host  # noqa: S104
    if ":" in shown and not shown.startswith("["):
        shown = f"[{shown}]"
    return f"http://{shown}:{listening.getsockname()[1]}/"


@contextlib.contextmanager
def until_interrupted() -> Iterator[None]:
    """Take Ctrl-C, and SIGTERM, by which a service is ended, for the ordinary end of what is done.

    Nothing is lost by it: every response has been saved before it was answered.
    """
    # uvicorn stops at both in order, and then hands them on to whoever had them before.
    before = signal.signal(signal.SIGTERM, signal.default_int_handler)
    try:
        with contextlib.suppress(KeyboardInterrupt):
            yield
    finally:
        signal.signal(signal.SIGTERM, before)


def serve(app: FastAPI, listening: socket.socket) -> None:
    """Serve until interrupted; nothing about requests is logged."""
    config = uvicorn.Config(
        app, log_level="warning", access_log=False, server_header=False, date_header=True,
        timeout_graceful_shutdown=2, lifespan="off", proxy_headers=True,
    )  # fmt: skip
    logging.getLogger("uvicorn.error").addFilter(_is_bug)
    serving = uvicorn.Server(config).serve(sockets=[listening])
    try:
        asyncio.run(serving)
    finally:
        serving.close()  # an interrupt may come before it has begun


def _is_bug(record: logging.LogRecord) -> bool:
    """Tell whether a message is of a bug here.

    Others are of what strangers send to any port, and of requests that the end cut off.
    """
    kind = record.exc_info[0] if record.exc_info else None
    return kind is not None and not issubclass(kind, asyncio.CancelledError)
