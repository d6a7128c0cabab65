"""A study as a web application: its routes put together, and what it answers to errors."""

from __future__ import annotations

import logging
from pathlib import Path
from typing import Any, cast

from fastapi import FastAPI, Request
from fastapi.exceptions import RequestValidationError
from fastapi.responses import JSONResponse
from sqlalchemy.exc import SQLAlchemyError
from starlette.exceptions import HTTPException
from starlette.staticfiles import StaticFiles

from ssrics_like.study.admin import admin_routes
from ssrics_like.study.conduct import Conduct
from ssrics_like.study.refused import Refused
from ssrics_like.study.routes import NO_STORE, participant_routes
from ssrics_like.study.security import Guard

STATIC = Path(__file__).parent / "static"

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
    app.add_exception_handler(SQLAlchemyError, _unsaved)
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
    message = str(first["msg"])[:200].encode("ascii", "replace").decode()
    where = where.encode("ascii", "replace").decode()
    return _answer(422, f"{where}: {message}")


def _failed(_request: Request, error: Exception) -> JSONResponse:
    failed = cast("HTTPException", error)
    return _answer(failed.status_code, str(failed.detail))


def _unsaved(_request: Request, error: Exception) -> JSONResponse:
    log.error("the database cannot be used: %s", getattr(error, "orig", None) or type(error))
    return _answer(503, "This could not be saved; it will be tried again.")


def _broken(_request: Request, _error: Exception) -> JSONResponse:
    return _answer(500, "Something is wrong here.")
