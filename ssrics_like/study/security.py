"""What every answer carries and every request must keep to, as a layer around the app."""

from __future__ import annotations

import json
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from starlette.types import ASGIApp, Message, Receive, Scope, Send

BODY_MAX = 64 * 1024
PASSED_OVER_MAX = 16 * 1024 * 1024
"""So much of a body that is too long is read, so that its sender comes to read the answer."""
HEADERS = {
    "Content-Security-Policy": (
        "default-src 'self'; frame-ancestors 'none'; base-uri 'none'; form-action 'self'; "
        "object-src 'none'"
    ),
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Permissions-Policy": "camera=(), microphone=(), geolocation=()",
}


class Guard:
    """Adds security headers, and refuses bodies that are too long before they are read.

    Parameters
    ----------
    app : ASGI application
        What is guarded.
    """

    def __init__(self, app: ASGIApp) -> None:
        self._app = app
        self._headers = [(name.lower().encode(), value.encode()) for name, value in HEADERS.items()]

    async def __call__(self, scope: Scope, receive: Receive, send: Send) -> None:
        """Serve one request."""
        if scope["type"] != "http":
            await self._app(scope, receive, send)
            return
        declared = dict(scope["headers"]).get(b"content-length", b"0")
        if not declared.isdigit() or len(declared) > 12 or int(declared) > BODY_MAX:  # noqa: PLR2004
            await self._refuse(scope, receive, send)
            return
        taken = 0
        begun = False

        async def counted() -> Message:
            nonlocal taken
            message = await receive()
            taken += len(message.get("body", b""))
            if taken > BODY_MAX:
                raise TooLongError(is_all=not message.get("more_body", False))
            return message

        async def guarded(message: Message) -> None:
            nonlocal begun
            if message["type"] == "http.response.start":
                begun = True
                own = {name for name, _ in self._headers}
                kept = [item for item in message["headers"] if item[0].lower() not in own]
                message["headers"] = [*kept, *self._headers]
            await send(message)

        try:
            await self._app(scope, counted, guarded)
        except TooLongError as e:
            if begun:
                raise
            await self._refuse(scope, receive, send, is_all=e.is_all)

    async def _refuse(
        self, scope: Scope, receive: Receive, send: Send, *, is_all: bool = False
    ) -> None:
        if not is_all and b"expect" not in dict(scope["headers"]):  # which waits to be told
            await _pass_over(receive)
        body = json.dumps({"detail": "The request is too long."}).encode()
        headers: list[Any] = [(b"content-type", b"application/json"), *self._headers]
        headers += [(b"content-length", str(len(body)).encode()), (b"connection", b"close")]
        await send({"type": "http.response.start", "status": 413, "headers": headers})
        await send({"type": "http.response.body", "body": body})


async def _pass_over(receive: Receive) -> None:
    """Read what is being sent and throw it away: closing amid it would reset the connection."""
    taken, more = 0, True
    while more and taken < PASSED_OVER_MAX:
        message = await receive()
        more = message.get("more_body", False)  # not there where the sender has gone
        taken += len(message.get("body", b""))


class TooLongError(BaseException):
    """A body that was not declared turned out too long; nothing inside is to catch this.

    Parameters
    ----------
    is_all : bool
        Whether its end has been read.
    """

    def __init__(self, *, is_all: bool) -> None:
        super().__init__()
        self.is_all = is_all
