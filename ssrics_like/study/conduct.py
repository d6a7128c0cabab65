"""How a study is conducted: who may do what, and what is made of it. No HTTP in here."""

from __future__ import annotations

from typing import Any

from ssrics_like.study.events import Incoming, Progress, Response, named
from ssrics_like.study.frames import COLUMNS, RATE_HZ, shown_bearings
from ssrics_like.study.marks import marks_of
from ssrics_like.study.order import order_of
from ssrics_like.study.participant import Participant
from ssrics_like.study.plan_picture import is_on_picture, on_map, on_picture
from ssrics_like.study.refused import Refused
from ssrics_like.study.settings import INSTRUCTIONS
from ssrics_like.study.store import Store, now
from ssrics_like.study.study import Study, Trial
from ssrics_like.study.tokens import digest, new_id, new_token

END_MS = 100.0
"""So near to its end, two of its pictures, a walk is over."""
ANY_KIND = ("begin", "end")
EVENTS = {
    "": ANY_KIND,
    "plan": (*ANY_KIND, "add", "move", "name", "delete"),
    "walk": (*ANY_KIND, "press", "pause", "resume"),
    "attention": (*ANY_KIND, "press"),
}
"""Kind of trial -> what can happen in it; the instructions have none."""


class Conduct:
    """A study that is being conducted.

    Parameters
    ----------
    study : Study
        What participants do.
    store : Store
        Where it is kept.

    Raises
    ------
    StudyError
        The store holds the answers to another study.
    """

    def __init__(self, study: Study, store: Store) -> None:
        self.study = study
        self.store = store
        store.belong_to(study.settings.title, study.outline_text())

    def join(self, wanted: str | None) -> str:
        """Take in a participant who has consented, and return the secret of the session.

        Parameters
        ----------
        wanted : str or None
            The id that was typed or came with the address; None to make one up.

        Raises
        ------
        Refused
            An id is needed, is taken, or all places are.
        """
        said = self.study.settings
        if (said.participant == "generated") != (wanted is None):
            raise Refused(422, "A participant id is missing.")
        name = new_id() if wanted is None else wanted
        trials = [trial.id for trial in self.study.trials]
        order = order_of(trials, said.seed, name, said.order)
        steps = (*(trial.id for trial in self.study.practice), *order)
        token = new_token()
        self.store.join(name, digest(token), steps, said.participants_max)
        return token

    def who(self, token: str | None) -> Participant | None:
        """Return whose session a secret belongs to."""
        return self.store.participant(digest(token)) if token else None

    def take(self, person: Participant, incoming: Incoming) -> Participant:
        """Save a response and return where the participant stands then.

        Raises
        ------
        Refused
            It does not belong to the step that the participant is at.
        """

        def make(at: Participant) -> tuple[Response, bool]:
            if incoming.step != at.position or at.is_done:
                raise Refused(409, "This belongs to another step.")
            return self._response(at, incoming), incoming.event == "end"

        most = self.study.settings.responses_max
        if incoming.event == "end":  # nobody is held up by having said too much
            most += len(person.trials) + 1
        return self.store.append(person.number, incoming.key, most, make)

    def progress(self, person: Participant, progress: Progress) -> None:
        """Note how far the replay of the present step has got."""
        trial = self.trial(person)
        if trial is None or trial.replay is None or progress.step != person.position:
            raise Refused(409, "This belongs to another step.")
        most = 1000 * trial.replay.length_s
        self.store.progress(person.number, person.position, min(progress.replay_ms, most))

    def trial(self, person: Participant) -> Trial | None:
        """Return the trial that a participant is at."""
        return self.study.by_id.get(person.trial) if person.trial is not None else None

    def state(self, person: Participant) -> dict[str, Any]:
        """Return what a browser needs to go on with the present step."""
        trial = self.trial(person)
        found: dict[str, Any] = {
            "step": person.position,
            "steps": len(person.trials),
            "kind": trial.kind if trial else "",
            "participant": person.name,
        }
        if trial is None:
            return found
        kept = self.store.responses(person.number, person.position)
        found["begun"] = any(each.event == "begin" for each in kept)
        if trial.kind == "plan":
            found |= _plan_state(trial, kept)
        elif trial.kind == "walk":
            assert trial.replay is not None
            presses = [each.replay_ms for each in kept if each.event == "press"]
            bearings = shown_bearings(trial.replay.robot.laser)
            found |= {
                "columns": COLUMNS,
                "beams": len(bearings),
                "bearings_rad": bearings.tolist(),
                "length_ms": 1000 * trial.replay.length_s,
                "replay_ms": max([person.replay_ms, *(ms for ms in presses if ms is not None)]),
                "presses": len(presses),
                "pausing": trial.settings.pausing,
                "rate_hz": RATE_HZ,
            }
        else:
            found["key"] = trial.settings.key
        return found

    def _response(self, person: Participant, incoming: Incoming) -> Response:
        trial = self.trial(person)
        kind = trial.kind if trial else ""
        if incoming.event not in EVENTS[kind]:
            raise Refused(422, "This cannot happen in this step.")
        if incoming.event == "end" and trial is not None and trial.replay is not None:
            # Told by the browser, as is all that happens in it; it may have been without us.
            shown_ms = max(person.replay_ms, incoming.replay_ms or 0.0)
            if shown_ms < 1000 * trial.replay.length_s - END_MS:
                raise Refused(422, "The walk is not over yet.")
        x_m, y_m = self._place(trial, incoming)
        return Response(
            participant=person.name,
            trial=trial.id if trial else INSTRUCTIONS,
            kind=kind,
            position=person.position,
            event=incoming.event,
            mark=incoming.mark or "",
            x_m=x_m,
            y_m=y_m,
            label=named(incoming.label or ""),
            pressed=incoming.pressed or "",
            t_ms=incoming.t_ms,
            replay_ms=incoming.replay_ms,
            client_ms=incoming.client_ms,
            server_time=now(),
            key=incoming.key,
        )

    @staticmethod
    def _place(trial: Trial | None, incoming: Incoming) -> tuple[float | None, float | None]:
        """Work out where on the map something happened."""
        if trial is None or trial.building is None:
            return None, None
        if trial.replay is not None and incoming.event == "press":
            if incoming.replay_ms is None or incoming.replay_ms > 1000 * trial.replay.length_s + 1:
                raise Refused(422, "A press needs a time within the replay.")
            x_m, y_m, _ = trial.replay.at(incoming.replay_ms / 1000).tolist()
            return x_m, y_m
        if incoming.event in ("add", "move"):
            assert incoming.right_m is not None
            assert incoming.down_m is not None
            grid = trial.building.grid
            if not is_on_picture(grid, incoming.right_m, incoming.down_m):
                raise Refused(422, "That is off the plan.")
            return on_map(grid, incoming.right_m, incoming.down_m)
        return None, None


def _plan_state(trial: Trial, kept: list[Response]) -> dict[str, Any]:
    assert trial.building is not None
    grid = trial.building.grid
    width_m, height_m = grid.size_m
    marks = []
    for mark in marks_of(kept):
        right_m, down_m = on_picture(grid, mark.x_m, mark.y_m)
        marks.append({"key": mark.key, "label": mark.label, "right_m": right_m, "down_m": down_m})
    return {"width_m": width_m, "height_m": height_m, "marks": marks}
