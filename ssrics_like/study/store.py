"""What is kept of a study: participants and their responses, each committed before it is answered.

One row a response, never changed. Marks are worked out from them, so that nothing
that a participant did is lost, and the newest state is found after any crash.
"""

from __future__ import annotations

import contextlib
import datetime as dt
import json
import threading
from collections.abc import Callable, Iterator
from dataclasses import asdict, replace
from typing import Any

from sqlalchemy import Connection, Row, case, func, insert, inspect, select, update
from sqlalchemy.exc import DBAPIError, IntegrityError, OperationalError

from ssrics_like.errors import StudyError
from ssrics_like.results.manifest import difference
from ssrics_like.study.database import WRITES, engine_of, identity, shown
from ssrics_like.study.events import Response
from ssrics_like.study.participant import Participant
from ssrics_like.study.refused import Refused
from ssrics_like.study.tables import VERSION, metadata, participants, responses, study


class Store:
    """A study's database.

    Parameters
    ----------
    name : str
        A file of SQLite, or a URL of SQLAlchemy.

    Raises
    ------
    StudyError
        It cannot be opened, is no database, or is of a newer version.
    """

    def __init__(self, name: str) -> None:
        self.name = shown(name)
        self._engine = engine_of(name)
        self._sqlite = self._engine.dialect.name == "sqlite"
        self._turn = threading.Lock()  # SQLite has one writer; to wait here is fairer than there
        self._identity: tuple[int, int] | None = None
        try:
            self._check_tables()
            with self._complaining(), self._writing() as connection:
                metadata.create_all(connection)
        except StudyError:
            self.close()
            raise
        self._identity = identity(self._engine)
        kept = self._kept()
        if kept is not None and kept.version > VERSION:
            self.close()
            raise StudyError(
                f"{self.name}: answers of version {kept.version}, this program reads up to "
                f"{VERSION}"
            )

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

    def belong_to(self, title: str, outline: str) -> None:
        """Note whose answers these are.

        Raises
        ------
        StudyError
            They are another study's, or the study's trials have changed.
        """
        with self._complaining(), self._writing() as connection:
            kept = connection.execute(select(study)).first()
            if kept is None:
                connection.execute(
                    insert(study).values(id=1, version=VERSION, title=title, outline=outline)
                )
            elif kept.outline != outline:
                what = difference(json.loads(kept.outline), json.loads(outline))
                raise StudyError(
                    f"{self.name}: holds answers to other trials ({what}); "
                    "name another --database, or undo the change"
                )
            else:
                connection.execute(update(study).values(title=title))

    def join(self, name: str, token: str, trials: tuple[str, ...], most: int) -> Participant:
        """Take in a new participant.

        Parameters
        ----------
        name : str
            The id; nobody else has it.
        token : str
            Digest of the secret that the browser shows from now on.
        trials : tuple of str
            In the order of this participant.
        most : int
            How many participants there may be.

        Raises
        ------
        Refused
            The id is taken, or all places are.
        """
        with self._writing() as connection:
            count = connection.execute(select(func.count()).select_from(participants)).scalar_one()
            if count >= most:
                raise Refused(403, "This study has all the participants that it needs.")
            values = {
                "name": name, "token": token, "trials": json.dumps(trials), "position": 0,
                "replay_ms": 0.0, "began": now(), "finished": "",
            }  # fmt: skip
            try:
                connection.execute(insert(participants).values(**values))
            except IntegrityError:
                raise Refused(
                    409, "Somebody has begun with this id already, perhaps in another browser."
                ) from None
            return _participant(_by(connection, participants.c.token, token))

    def participant(self, token: str) -> Participant | None:
        """Return who has a secret, by its digest."""
        with self._engine.connect() as connection:
            found = connection.execute(
                select(participants).where(participants.c.token == token)
            ).first()
        return None if found is None else _participant(found)

    def append(
        self,
        number: int,
        key: str,
        most: int,
        make: Callable[[Participant], tuple[Response, bool]],
    ) -> Participant:
        """Save a response, once, and return where the participant stands then.

        Parameters
        ----------
        number : int
            Of the participant.
        key : str
            Of the response; if one is there already, nothing is changed.
        most : int
            How many responses a participant may send.
        make : callable
            Returns the response, and whether the step is done with it.

        Raises
        ------
        Refused
            There are too many, or `make` refuses it.
        """
        with self._writing() as connection:
            # The row is locked, where the database can: a participant's responses queue up.
            person = _participant(_by(connection, participants.c.id, number))
            is_it = case((responses.c.key == key, 1), else_=0)
            wanted = select(func.count(), func.coalesce(func.sum(is_it), 0))
            mine = responses.c.participant == number
            count, known = connection.execute(wanted.where(mine)).one()
            if known:
                return person
            if count >= most:
                raise Refused(403, "No more responses are taken from you.")
            response, done = make(person)
            values = {**asdict(response), "participant": number}
            connection.execute(insert(responses).values(**values))
            if not done:
                return person
            finished = now() if person.position == len(person.trials) else ""
            after = replace(person, position=person.position + 1, replay_ms=0.0, finished=finished)
            connection.execute(
                update(participants)
                .where(participants.c.id == number)
                .values(position=after.position, replay_ms=0.0, finished=finished)
            )
            return after

    def progress(self, number: int, position: int, replay_ms: float) -> None:
        """Note how far a replay has got; it never goes back."""
        mine = participants.c
        with self._writing() as connection:
            connection.execute(
                update(participants)
                .where(mine.id == number, mine.position == position, mine.replay_ms < replay_ms)
                .values(replay_ms=replay_ms)
            )

    def participants(self) -> list[Participant]:
        """Return all participants, in the order in which they began."""
        with self._engine.connect() as connection:
            found = connection.execute(select(participants).order_by(participants.c.id)).all()
        return [_participant(row) for row in found]

    def responses(self, number: int | None = None, position: int | None = None) -> list[Response]:
        """Return responses in the order of their saving: all, or one participant's, or a step's."""
        wanted = select(responses, participants.c.name).join(participants)
        if number is not None:
            wanted = wanted.where(responses.c.participant == number)
        if position is not None:
            wanted = wanted.where(responses.c.position == position)
        with self._engine.connect() as connection:
            rows = connection.execute(wanted.order_by(responses.c.id)).all()
        names = [name for name in Response.__slots__ if name != "participant"]
        return [Response(row.name, **{name: getattr(row, name) for name in names}) for row in rows]

    def counts(self) -> dict[str, int]:
        """Return how many responses each participant has sent, by id."""
        wanted = (
            select(participants.c.name, func.count(responses.c.id))
            .join(responses)
            .group_by(participants.c.name)
        )
        with self._engine.connect() as connection:
            return {str(name): int(count) for name, count in connection.execute(wanted)}

    def _check_tables(self) -> None:
        """Check that the database is empty, or a study's: nobody's else is touched.

        Raises
        ------
        StudyError
            It is another program's.
        """
        with self._complaining():
            there = inspect(self._engine)
            names = set(there.get_table_names())
            foreign = self._sqlite and bool(names) and not names & metadata.tables.keys()
            for name in names & metadata.tables.keys():
                columns = {column["name"] for column in there.get_columns(name)}
                foreign |= not columns >= set(metadata.tables[name].columns.keys())
        if foreign:
            raise StudyError(
                f"{self.name}: holds another program's tables; expected a study's, or none"
            )

    def _kept(self) -> Row[Any] | None:
        with self._complaining(), self._engine.connect() as connection:
            return connection.execute(select(study)).first()

    @contextlib.contextmanager
    def _writing(self) -> Iterator[Connection]:
        """Open a transaction that is committed at the end; one at a time on SQLite."""
        if self._identity is not None and identity(self._engine) != self._identity:
            # SQLite would go on in a file that nobody can find any more.
            raise OperationalError("", None, OSError(f"{self.name} is not there any more"))
        turn = self._turn if self._sqlite else contextlib.nullcontext()
        with (
            turn,
            self._engine.connect().execution_options(**{WRITES: True}) as connection,
            connection.begin(),
        ):
            yield connection

    @contextlib.contextmanager
    def _complaining(self) -> Iterator[None]:
        """Turn what the database says into one line."""
        try:
            yield
        except DBAPIError as e:
            said = str(e.orig).strip().splitlines()
            raise StudyError(
                f"{self.name}: the database cannot be used ({said[0] if said else 'no reason'})"
            ) from None


def now() -> str:
    """Return the time, UTC, to the millisecond."""
    return dt.datetime.now(dt.UTC).isoformat(timespec="milliseconds")


def _by(connection: Connection, column: Any, value: Any) -> Row[Any]:
    wanted = select(participants).where(column == value).with_for_update()
    return connection.execute(wanted).one()


def _participant(row: Row[Any]) -> Participant:
    return Participant(
        row.id, row.name, tuple(json.loads(row.trials)), row.position, row.replay_ms,
        row.began, row.finished,
    )  # fmt: skip
