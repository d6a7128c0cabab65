"""A study as a web application: its routes put together, and what it answers to errors."""

from __future__ import annotations

import logging
from collections.abc import Callable
from pathlib import Path
from typing import Any, cast

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import HTMLResponse, JSONResponse, Response
from sqlalchemy.exc import SQLAlchemyError
from starlette.exceptions import HTTPException
from starlette.staticfiles import StaticFiles

from ssrics_like.study.admin import admin_routes
from ssrics_like.study.conduct import Conduct
from ssrics_like.study.limits import RateLimit
from ssrics_like.study.pages import page
from ssrics_like.study.refused import Refused
from ssrics_like.study.routes import NO_STORE, participant_routes
from ssrics_like.study.security import Guard

STATIC = Path(__file__).parent / "static"
PAGES = ("/", "/admin")
TOLD_PER_S = 1 / 60  # browsers try again and again; the experimenter is told once a minute
WRONG = {
    "missing": "is missing",
    "extra_forbidden": "is not known here",
    "json_invalid": "is no JSON",
}
"""Kind of error -> what is said of it; of others, that the value was not expected."""

log = logging.getLogger("ssrics_like.study")


def make_app(conduct: Conduct, admin_token: str) -> FastAPI:
    """Return the application of a study.

    Parameters
    ----------
    conduct : Conduct
        The study and its store.
    admin_token : str
        Opens the experimenter's pages.
    """
    app = FastAPI(docs_url=None, redoc_url=None, openapi_url=None)
    app.include_router(participant_routes(conduct))
    app.include_router(admin_routes(conduct, admin_token))
    app.mount("/static", StaticFiles(directory=STATIC), name="static")
    app.add_exception_handler(Refused, _refused)
    app.add_exception_handler(RequestValidationError, _invalid)
    app.add_exception_handler(HTTPException, _failed)
    app.add_exception_handler(SQLAlchemyError, _unusable(conduct))
    app.add_exception_handler(Exception, _broken)
    app.add_middleware(Guard)
    return app


def _answer(status: int, why: str) -> JSONResponse:
    return JSONResponse({"detail": why}, status, headers=NO_STORE)


def _refused(_request: Request, error: Exception) -> JSONResponse:
    refused = cast("Refused", error)
    return _answer(refused.status, refused.why)


def _invalid(_request: Request, error: Exception) -> JSONResponse:
    """Name what is wrong, not what was sent: it may be anything."""
    first: dict[str, Any] = cast("RequestValidationError", error).errors()[0]
    where = ".".join(str(part) for part in first["loc"])[:100]
    own = first.get("ctx", {}).get("error")  # of a check of ours
    said = str(own) if own else WRONG.get(first["type"], "is not what was expected")
    return _answer(422, f"{where}: {said}".encode("ascii", "replace").decode())


def _failed(_request: Request, error: Exception) -> JSONResponse:
    failed = cast("HTTPException", error)
    return _answer(failed.status_code, str(failed.detail))


def _unusable(conduct: Conduct) -> Callable[[Request, Exception], Response]:
    """Return what answers while the database cannot be used: nothing is called saved then."""
    told = RateLimit(TOLD_PER_S, 1)

    def unusable(request: Request, error: Exception) -> Response:
        why = str(getattr(error, "orig", None) or type(error).__name__)
        if told.allows(why):
            log.error("ssrics: %s: the database cannot be used (%s)", conduct.store.name, why)
        if request.method == "GET" and request.url.path in PAGES:
            return HTMLResponse(page("unavailable", conduct.study), 503, headers=NO_STORE)
        return _answer(
            503, "The study cannot be reached at the moment. Please try again in a while."
        )

    return unusable


def _broken(_request: Request, _error: Exception) -> JSONResponse:
    return _answer(500, "Something is wrong here.")
