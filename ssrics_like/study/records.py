"""What a study's database holds, to be read: who took part, and every response."""

from __future__ import annotations

import contextlib
import json
from collections.abc import Iterator
from typing import Any

from sqlalchemy import Connection, Engine, Row, Select, func, inspect, select
from sqlalchemy.exc import DBAPIError

from ssrics_like.errors import StudyError
from ssrics_like.study.database import reader_of, shown
from ssrics_like.study.events import Response
from ssrics_like.study.participant import Participant
from ssrics_like.study.tables import VERSION, metadata, participants, responses, study


class Records:
    """A study's database, for reading only: nothing in it is changed or made.

    Parameters
    ----------
    name : str
        A file of SQLite, or a URL of SQLAlchemy.

    Raises
    ------
    StudyError
        It cannot be opened, is no study's database, or is of a newer version.
    """

    def __init__(self, name: str) -> None:
        self._open(name, reader_of(name))

    def _open(self, name: str, engine: Engine) -> None:
        self.name = shown(name)
        self._engine = engine
        try:
            with self.complaining():
                self._check()
        except StudyError:
            self.close()
            raise

    def close(self) -> None:
        """Close all connections."""
        self._engine.dispose()

    @property
    def title(self) -> str:
        """Title of the study whose answers these are; empty if there is none."""
        kept = self._kept()
        return str(kept.title) if kept is not None else ""

    @property
    def outline(self) -> dict[str, Any]:
        """What the study's `outline` was when it was first served; empty if it never was."""
        kept = self._kept()
        return dict(json.loads(kept.outline)) if kept is not None else {}

    def participant(self, token: str) -> Participant | None:
        """Return who has a secret, by its digest."""
        with self._reading() as connection:
            found = connection.execute(
                select(participants).where(participants.c.token == token)
            ).first()
        return None if found is None else participant_of(found)

    def participants(self) -> list[Participant]:
        """Return all participants, in the order in which they began."""
        with self._reading() as connection:
            return _people(connection)

    def responses(self, number: int | None = None, position: int | None = None) -> list[Response]:
        """Return responses in the order of their saving: all, or one participant's, or a step's."""
        wanted = EVERY_RESPONSE
        if number is not None:
            wanted = wanted.where(responses.c.participant == number)
        if position is not None:
            wanted = wanted.where(responses.c.position == position)
        with self._reading() as connection:
            return _responses(connection, wanted)

    def everything(self) -> tuple[list[Participant], list[Response]]:
        """Return all participants and their responses, both of one moment."""
        with self._reading() as connection:
            people = _people(connection)
            known = {person.name for person in people}  # a server may let newcomers in between
            found = _responses(connection, EVERY_RESPONSE)
        return people, [each for each in found if each.participant in known]

    def counts(self) -> dict[str, int]:
        """Return how many responses each participant has sent, by id."""
        wanted = (
            select(participants.c.name, func.count(responses.c.id))
            .join(responses)
            .group_by(participants.c.name)
        )
        with self._reading() as connection:
            return {str(name): int(count) for name, count in connection.execute(wanted)}

    @contextlib.contextmanager
    def complaining(self) -> Iterator[None]:
        """Turn what the database says into one line.

        Raises
        ------
        StudyError
            It says something.
        """
        try:
            yield
        except DBAPIError as e:
            said = str(e.orig).strip().splitlines()
            raise StudyError(
                f"{self.name}: the database cannot be used ({said[0] if said else 'no reason'})"
            ) from None

    @contextlib.contextmanager
    def _reading(self) -> Iterator[Connection]:
        with self._engine.connect() as connection:
            yield connection

    def _check(self) -> None:
        """Check that the database is empty, or a study's: nobody else's is touched.

        Raises
        ------
        StudyError
            It is another program's, or of a newer version of this one.
        """
        there = inspect(self._engine)
        names = set(there.get_table_names())
        ours = names & metadata.tables.keys()
        # On a server, others may have tables beside these; a file of SQLite is for one program.
        foreign = self._engine.dialect.name == "sqlite" and bool(names) and not ours
        for name in ours:
            columns = {column["name"] for column in there.get_columns(name)}
            foreign |= not columns >= set(metadata.tables[name].columns.keys())
        if foreign or 0 < len(ours) < len(metadata.tables):
            raise StudyError(
                f"{self.name}: holds another program's tables; expected a study's, or none"
            )
        self._is_empty = not ours
        kept = self._kept()
        if kept is not None and kept.version > VERSION:
            raise StudyError(
                f"{self.name}: answers of version {kept.version}, this program reads up to "
                f"{VERSION}"
            )

    def _kept(self) -> Row[Any] | None:
        if self._is_empty:
            return None
        with self._reading() as connection:
            return connection.execute(select(study)).first()


def participant_of(row: Row[Any]) -> Participant:
    """Return a participant as the database's row says."""
    return Participant(
        row.id, row.name, tuple(json.loads(row.trials)), row.position, row.replay_ms,
        row.began, row.finished,
    )  # fmt: skip


EVERY_RESPONSE: Select[Any] = (
    select(responses, participants.c.name).join(participants).order_by(responses.c.id)
)
OF_A_RESPONSE = [name for name in Response.__slots__ if name != "participant"]


def _people(connection: Connection) -> list[Participant]:
    rows = connection.execute(select(participants).order_by(participants.c.id)).all()
    return [participant_of(row) for row in rows]


def _responses(connection: Connection, wanted: Select[Any]) -> list[Response]:
    rows = connection.execute(wanted).all()
    return [
        Response(row.name, **{name: getattr(row, name) for name in OF_A_RESPONSE}) for row in rows
    ]
