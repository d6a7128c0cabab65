"""From a store to tables: people's choices, every response, who took part."""

from __future__ import annotations

from collections import defaultdict
from collections.abc import Iterable
from dataclasses import astuple, dataclass, fields
from typing import Any

from ssrics_like.errors import StudyError, choices, nearest
from ssrics_like.results.files import csv_text
from ssrics_like.study.events import Response
from ssrics_like.study.marks import Mark, marks_of
from ssrics_like.study.participant import Participant
from ssrics_like.study.records import Records

CHOICES = ("participant", "landmark", "x_m", "y_m", "label", "t_s")
PARTICIPANTS = (
    "participant",
    "began",
    "finished",
    "steps_done",
    "trials",
    "checks",
    "checks_passed",
)


@dataclass(frozen=True)
class Answers:
    """Everything that a study's database holds, as values.

    Attributes
    ----------
    trials : dict
        Id of a trial -> what the study's outline says of it.
    participants : list of Participant
        In the order in which they began.
    responses : list of Response
        In the order of their saving.
    """

    trials: dict[str, dict[str, Any]]
    participants: list[Participant]
    responses: list[Response]

    @property
    def designated(self) -> list[str]:
        """The trials that ask for landmarks: no practice, no attention checks."""
        return [
            name
            for name, trial in self.trials.items()
            if trial["kind"] in ("plan", "walk") and not trial["practice"] and not trial["check"]
        ]

    def of_finished(self) -> Answers:
        """Return the answers of those who did the whole study."""
        people = [person for person in self.participants if person.is_done]
        names = {person.name for person in people}
        kept = [each for each in self.responses if each.participant in names]
        return Answers(self.trials, people, kept)

    def by_step(self) -> dict[tuple[str, str], list[Response]]:
        """Return the responses of each participant in each trial."""
        found: dict[tuple[str, str], list[Response]] = defaultdict(list)
        for each in self.responses:
            found[each.participant, each.trial].append(each)
        return found


def read_answers(records: Records) -> Answers:
    """Read all that a study's database holds.

    Raises
    ------
    StudyError
        No study has been served with it.
    """
    outline = records.outline
    if not outline:
        raise StudyError(f"{records.name}: holds no study's answers")
    listed = {name: outline["trials"][name] for name in outline["listed"]}
    return Answers(listed, *records.everything())


def tables_of(answers: Answers, wanted: Iterable[str] = ()) -> dict[str, str]:
    """Return the exported files: name -> text.

    ``choices.csv`` holds the marks of all trials that ask for landmarks, or of those that are
    wanted, if these are on one map; ``choices-TRIAL.csv`` those of one trial. ``responses.csv``
    has a row for each response, ``participants.csv`` one for each participant.

    Parameters
    ----------
    answers : Answers
        What was answered.
    wanted : iterable of str
        Ids of trials; all that ask for landmarks if there are none.

    Raises
    ------
    StudyError
        There is no such trial.
    """
    chosen = list(wanted) or answers.designated
    for name in chosen:
        if name not in answers.designated:
            known = answers.designated
            raise StudyError(
                f"no trial '{name}' that asks for landmarks{nearest(name, known)}; "
                f"there are {choices(known) or 'none'}"
            )
    files = {f"choices-{name}.csv": choices_text(answers, [name]) for name in chosen}
    if len({answers.trials[name]["map"] for name in chosen}) == 1:
        files["choices.csv"] = choices_text(answers, chosen)
    files["responses.csv"] = responses_text(answers)
    files["participants.csv"] = participants_text(answers)
    return dict(sorted(files.items()))


def outdated(answers: Answers, files: Iterable[str]) -> set[str]:
    """Return the names of tables that an earlier export may have left and this one lacks."""
    names = {"choices.csv", *(f"choices-{name}.csv" for name in answers.designated)}
    return names - set(files)


def choices_text(answers: Answers, trials: Iterable[str]) -> str:
    """Return people's marks in some trials as a table of choices.

    Landmarks are numbered in each trial in the order in which they were made. The time is that
    of the replay, seconds from its beginning; marks on a plan have none.
    """
    steps = answers.by_step()
    rows = []
    for person in answers.participants:
        for trial in trials:
            for number, mark in enumerate(marks_of(steps.get((person.name, trial), ())), 1):
                t_s = None if mark.replay_ms is None else mark.replay_ms / 1000
                name = f"{trial}-{number}"
                rows.append((person.name, name, mark.x_m, mark.y_m, mark.label, t_s))
    return csv_text(CHOICES, rows)


def responses_text(answers: Answers) -> str:
    """Return every response, by participant, in the order of its saving."""
    header = [field.name for field in fields(Response)]
    rank = {person.name: i for i, person in enumerate(answers.participants)}
    ordered = sorted(answers.responses, key=lambda each: rank[each.participant])
    return csv_text(header, (astuple(each) for each in ordered))


def participants_text(answers: Answers) -> str:
    """Return who took part: when, in which order of trials, and how attentively."""
    steps = answers.by_step()
    checks = [name for name, trial in answers.trials.items() if trial["check"]]
    rows = []
    for person in answers.participants:
        done = set(person.trials[: max(person.position - 1, 0)])
        passed = [
            passes(answers.trials[name], steps.get((person.name, name), []))
            for name in checks
            if name in done
        ]
        order = " ".join(person.trials)
        rows.append(
            (
                person.name, person.began, person.finished, max(person.position - 1, 0), order,
                len(passed), sum(passed),
            )
        )  # fmt: skip
    return csv_text(PARTICIPANTS, rows)


def passes(trial: dict[str, Any], responses: list[Response]) -> bool:
    """Tell whether an attention check was passed: the last key, or any mark near the place."""
    check = trial["check"]
    if trial["kind"] == "attention":
        pressed = [each.pressed for each in responses if each.event == "press"]
        return bool(pressed) and pressed[-1] == check["key"]
    return any(_is_near(mark, check) for mark in marks_of(responses))


def _is_near(mark: Mark, check: dict[str, Any]) -> bool:
    x_m, y_m = mark.x_m - check["x_m"], mark.y_m - check["y_m"]
    return bool((x_m * x_m + y_m * y_m) ** 0.5 <= check["within_m"])
