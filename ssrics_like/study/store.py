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

from sqlalchemy import Connection, Row, case, func, insert, select, update
from sqlalchemy.exc import IntegrityError, OperationalError

from ssrics_like.errors import StudyError
from ssrics_like.results.manifest import difference
from ssrics_like.study.database import WRITES, engine_of, identity, is_there
from ssrics_like.study.events import Response
from ssrics_like.study.participant import Participant
from ssrics_like.study.records import Records, participant_of
from ssrics_like.study.refused import Refused
from ssrics_like.study.tables import VERSION, metadata, participants, responses, study


class Store(Records):
    """A study's database, into which answers are written; its tables are made if it has none.

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
        self._turn = threading.Lock()  # SQLite has one writer; to wait here is fairer than there
        self._identity: tuple[int, int] | None = None
        if is_there(name):
            Records(name).close()  # what is somebody else's is refused before it is touched
        self._open(name, engine_of(name))
        self._identity = identity(self._engine)

    def _check(self) -> None:
        with self._writing() as connection:
            metadata.create_all(connection)
        super()._check()

    def belong_to(self, title: str, outline: str) -> None:
        """Note whose answers these are.

        Raises
        ------
        StudyError
            They are another study's, or the study's trials have changed.
        """
        with self.complaining(), self._writing() as connection:
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
            return participant_of(_by(connection, participants.c.token, token))

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
            person = participant_of(_by(connection, participants.c.id, number))
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

    @contextlib.contextmanager
    def _reading(self) -> Iterator[Connection]:
        self._check_identity()
        with super()._reading() as connection:
            yield connection

    @contextlib.contextmanager
    def _writing(self) -> Iterator[Connection]:
        """Open a transaction that is committed at the end; one at a time on SQLite."""
        self._check_identity()
        turn = self._turn if self._engine.dialect.name == "sqlite" else contextlib.nullcontext()
        with (
            turn,
            self._engine.connect().execution_options(**{WRITES: True}) as connection,
            connection.begin(),
        ):
            yield connection
        self._check_identity()  # what was committed to a file that is gone is not saved

    def _check_identity(self) -> None:
        """Complain, as a database would, where SQLite would go on in a file that nobody can find.

        Raises
        ------
        OperationalError
            The file was removed, or another one put in its place.
        """
        if self._identity is not None and identity(self._engine) != self._identity:
            raise OperationalError("", None, OSError("its file was removed or replaced"))


def now() -> str:
    """Return the time, UTC, to the millisecond."""
    return dt.datetime.now(dt.UTC).isoformat(timespec="milliseconds")


def _by(connection: Connection, column: Any, value: Any) -> Row[Any]:
    wanted = select(participants).where(column == value).with_for_update()
    return connection.execute(wanted).one()
