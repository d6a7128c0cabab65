"""The experimenter's pages: how far participants are, and the tables. All of it needs the token."""

from __future__ import annotations

import io
import zipfile
from typing import Annotated, Any

from fastapi import APIRouter, Cookie, Header, Request, Response
from fastapi.responses import HTMLResponse, JSONResponse
from pydantic import BaseModel, ConfigDict, Field

from ssrics_like.study.conduct import Conduct
from ssrics_like.study.export import read_answers, tables_of
from ssrics_like.study.limits import RateLimit
from ssrics_like.study.pages import page
from ssrics_like.study.refused import Refused
from ssrics_like.study.tokens import digest, same

COOKIE = "ssrics_admin"
DAY_S = 86_400
TRIES_PER_S, TRIES_AT_ONCE = 0.5, 20
EPOCH = (1980, 1, 1, 0, 0, 0)  # the earliest that a zip file knows


class Login(BaseModel):
    """What the login sends."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True)

    token: str = Field(max_length=500)


def admin_routes(conduct: Conduct, token: str) -> APIRouter:
    """Return the routes below ``/admin``.

    Parameters
    ----------
    conduct : Conduct
        The study.
    token : str
        Opens them, as ``Authorization: Bearer TOKEN`` or after a login.
    """
    router = APIRouter(prefix="/admin")
    wrong_tries = RateLimit(TRIES_PER_S, TRIES_AT_ONCE)
    ticket = digest(f"admin cookie {token}")  # the token itself stays out of the browser's store

    def is_admin(cookie: str | None, authorization: str | None) -> bool:
        if cookie is not None and same(cookie, ticket):
            return True
        if authorization is None:
            return False
        scheme, _, given = authorization.partition(" ")
        right = scheme.lower() == "bearer" and same(given.strip(), token)
        if not right and not wrong_tries.allows("all"):
            raise Refused(429, "Too many wrong tokens; wait a minute.")
        return right

    @router.get("", response_class=HTMLResponse)
    def overview(
        ssrics_admin: Annotated[str | None, Cookie()] = None,
        authorization: Annotated[str | None, Header()] = None,
    ) -> HTMLResponse:
        if not is_admin(ssrics_admin, authorization):
            return HTMLResponse(page("login", conduct.study), 401)
        return HTMLResponse(page("admin", conduct.study, **_overview(conduct)))

    @router.post("/login")
    def login(request: Request, said: Login) -> Response:
        if not same(said.token, token):
            if not wrong_tries.allows("all"):
                raise Refused(429, "Too many wrong tokens; wait a minute.")
            raise Refused(403, "That is not the token.")
        answer = JSONResponse({})
        answer.set_cookie(
            COOKIE, ticket, max_age=DAY_S, path="/admin", httponly=True, samesite="strict",
            secure=request.url.scheme == "https",
        )  # fmt: skip
        return answer

    @router.post("/logout")
    def logout() -> Response:
        answer = JSONResponse({})
        answer.delete_cookie(COOKIE, path="/admin")
        return answer

    @router.get("/export.zip")
    def export(
        ssrics_admin: Annotated[str | None, Cookie()] = None,
        authorization: Annotated[str | None, Header()] = None,
    ) -> Response:
        if not is_admin(ssrics_admin, authorization):
            raise Refused(401, "The token is needed.")
        tables = tables_of(read_answers(conduct.store))
        return Response(
            zipped(tables),
            media_type="application/zip",
            headers={"Content-Disposition": 'attachment; filename="study-export.zip"'},
        )

    return router


def zipped(files: dict[str, str]) -> bytes:
    """Return files as a zip archive, the same bytes for the same content."""
    stream = io.BytesIO()
    with zipfile.ZipFile(stream, "w", zipfile.ZIP_DEFLATED) as archive:
        for name, text in files.items():
            archive.writestr(zipfile.ZipInfo(name, EPOCH), text, zipfile.ZIP_DEFLATED)
    return stream.getvalue()


def _overview(conduct: Conduct) -> dict[str, Any]:
    counts = conduct.store.counts()
    people = conduct.store.participants()
    rows = [
        {
            "name": person.name,
            "began": person.began[:19].replace("T", " "),
            "finished": person.finished[:19].replace("T", " "),
            "done": max(person.position - 1, 0),
            "of": len(person.trials),
            "at": "finished" if person.is_done else person.trial or "instructions",
            "responses": counts.get(person.name, 0),
        }
        for person in people
    ]
    return {
        "people": rows,
        "done": sum(person.is_done for person in people),
        "responses": sum(counts.values()),
        "database": conduct.store.name,
    }
