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
WAL_FORMAT = b"\x02\x02"  # bytes 18 and 19 of a file that writes ahead
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
    """Return an engine that reads and writes a database; SQLite's file is made if it is not there.

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
    if url.get_backend_name() != "sqlite":
        return _engine_of_server(url)
    file = _file(url)
    if not file.resolve().parent.is_dir():
        raise StudyError(f"{file.parent}: no such folder")
    engine = create_engine(url, connect_args={"timeout": WAIT_S})
    event.listen(engine, "do_connect", partial(_make, file))
    event.listen(engine, "connect", _set_up)
    event.listen(engine, "begin", _begin)
    return engine


def reader_of(name: str) -> Engine:
    """Return an engine that only reads: SQLite's file stays byte for byte as it is.

    Parameters
    ----------
    name : str
        As of `engine_of`, which tells what is raised.
    """
    url = _url(name)
    if url.get_backend_name() != "sqlite":
        return _engine_of_server(url)
    file = _file(url)
    if not file.is_file():
        raise StudyError(f"{file}: {'is a folder' if file.is_dir() else 'no such file'}")
    # In a folder that cannot be written to, SQLite reads a file that writes ahead only if it
    # is told that nobody writes. Nobody does where nothing has been written ahead.
    how = {"immutable": "1"} if _is_at_rest(file) else {"mode": "ro"}
    address = URL.create("sqlite", database=file.resolve().as_uri(), query={"uri": "true", **how})
    engine = create_engine(address, connect_args={"timeout": WAIT_S})
    event.listen(engine, "connect", _begin_as_told)
    event.listen(engine, "begin", _begin)
    return engine


def is_there(name: str) -> bool:
    """Tell whether a database exists; one on a server is taken to."""
    url = _url(name)
    return url.get_backend_name() != "sqlite" or _file(url).exists()


def _file(url: URL) -> Path:
    if not url.database or url.database == ":memory:":
        raise StudyError("database: SQLite needs a file, answers in memory would be lost")
    return Path(url.database)


def _engine_of_server(url: URL) -> Engine:
    if url.drivername in ("postgresql", "postgres"):
        url = url.set(drivername="postgresql+psycopg")
    if url.get_backend_name() == "postgresql":
        needed("psycopg")
    try:
        return create_engine(url, pool_pre_ping=True)
    except NoSuchModuleError:
        raise StudyError(f"database: no driver for '{url.drivername}'") from None
    except ImportError as e:
        raise StudyError(
            f"database: the driver for '{url.drivername}' needs the module {e.name}"
        ) from None


def _is_at_rest(file: Path) -> bool:
    """Tell whether a file of SQLite writes ahead, and nothing has been."""
    kept = file.resolve()  # what is written ahead lies beside the file, not beside a link to it
    ahead = kept.with_name(kept.name + "-wal")
    try:
        with file.open("rb") as opened:
            head = opened.read(20)
        return head[18:20] == WAL_FORMAT and not (ahead.exists() and ahead.stat().st_size)
    except OSError:  # what is wrong with it, connecting will say
        return False


def identity(engine: Engine) -> tuple[int, int] | None:
    """Return what tells SQLite's file from any other, (0, 0) where it is gone; None on a server."""
    if engine.dialect.name != "sqlite":
        return None
    try:
        found = Path(str(engine.url.database)).stat()
    except OSError:
        return 0, 0
    return found.st_dev, found.st_ino


def _make(file: Path, *_: Any) -> None:
    """Make a new file for its owner's eyes; SQLite gives those beside it the same rights."""
    with suppress(OSError):  # what is wrong with it, connecting will say
        file.touch(mode=0o600)


def _set_up(connection: Any, _record: Any) -> None:
    """Let SQLite write ahead, and to the disk before it says that something is saved."""
    _begin_as_told(connection, _record)
    cursor = connection.cursor()
    for pragma in ("journal_mode=WAL", "synchronous=FULL", "foreign_keys=ON"):
        cursor.execute(f"PRAGMA {pragma}")
    cursor.close()


def _begin_as_told(connection: Any, _record: Any) -> None:
    """Leave the beginning of transactions to `_begin`."""
    connection.isolation_level = None


def _begin(connection: Any) -> None:
    """Take the right to write at once where it will be needed, not halfway through."""
    writes = connection.get_execution_options().get(WRITES)
    connection.exec_driver_sql("BEGIN IMMEDIATE" if writes else "BEGIN")
