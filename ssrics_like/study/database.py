"""Connections to a study's database: SQLite in a file, or whatever SQLAlchemy knows by URL."""

from __future__ import annotations

from contextlib import suppress
from functools import partial
from pathlib import Path
from typing import Any

from sqlalchemy import URL, Engine, create_engine, event, make_url
from sqlalchemy.exc import ArgumentError, NoSuchModuleError

from ssrics_like.errors import StudyError
from ssrics_like.study.packages import needed

WAIT_S = 30.0
WRITES = "ssrics_writes"
"""Execution option of connections that are going to write."""


def is_url(name: str) -> bool:
    """Tell a database's URL from a file's name."""
    return "://" in name


def shown(name: str) -> str:
    """Return a database's name without the password in it."""
    return _url(name).render_as_string(hide_password=True) if is_url(name) else name


def _url(name: str) -> URL:
    try:
        return make_url(name) if is_url(name) else URL.create("sqlite", database=name)
    except (ArgumentError, ValueError):
        raise StudyError(
            "database: the URL cannot be read; expected DIALECT://USER:PASSWORD@HOST/NAME"
        ) from None


def engine_of(name: str) -> Engine:
    """Return an engine for a database.

    Parameters
    ----------
    name : str
        A file of SQLite, or a URL of SQLAlchemy.

    Raises
    ------
    StudyError
        The URL is none.
    MissingPackageError
        The driver is not installed.
    """
    url = _url(name)
    if url.drivername in ("postgresql", "postgres"):
        url = url.set(drivername="postgresql+psycopg")
    if url.get_backend_name() == "postgresql":
        needed("psycopg")
    if url.get_backend_name() == "sqlite":
        if not url.database or url.database == ":memory:":
            raise StudyError("database: SQLite needs a file, answers in memory would be lost")
        if not Path(url.database).resolve().parent.is_dir():
            raise StudyError(f"{Path(url.database).parent}: no such folder")
    try:
        if url.get_backend_name() != "sqlite":
            return create_engine(url, pool_pre_ping=True)
        engine = create_engine(url, connect_args={"timeout": WAIT_S})
    except (NoSuchModuleError, ImportError) as e:
        raise StudyError(f"database: no driver for '{url.drivername}' ({e})") from None
    event.listen(engine, "do_connect", partial(_make, Path(str(url.database))))
    event.listen(engine, "connect", _set_up)
    event.listen(engine, "begin", _begin)
    return engine


def identity(engine: Engine) -> tuple[int, int] | None:
    """Return what tells SQLite's file from any other, (0, 0) where it is gone; None on a server."""
    if engine.dialect.name != "sqlite":
        return None
    try:
        found = Path(str(engine.url.database)).stat()
    except FileNotFoundError:
        return 0, 0
    return found.st_dev, found.st_ino


def _make(file: Path, *_: Any) -> None:
    """Make a new file for its owner's eyes; SQLite gives those beside it the same rights."""
    with suppress(OSError):  # what is wrong with it, connecting will say
        file.touch(mode=0o600)


def _set_up(connection: Any, _record: Any) -> None:
    """Let SQLite write ahead, and to the disk before it says that something is saved."""
    connection.isolation_level = None  # transactions begin as `_begin` says
    cursor = connection.cursor()
    for pragma in ("journal_mode=WAL", "synchronous=FULL", "foreign_keys=ON"):
        cursor.execute(f"PRAGMA {pragma}")
    cursor.close()


def _begin(connection: Any) -> None:
    """Take the right to write at once where it will be needed, not halfway through."""
    writes = connection.get_execution_options().get(WRITES)
    connection.exec_driver_sql("BEGIN IMMEDIATE" if writes else "BEGIN")
