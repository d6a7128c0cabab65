"""What a study file may say: data only."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import Field, field_validator, model_validator

from ssrics_like.scenarios.schema import NAME
from ssrics_like.scenarios.world_settings import PoseList, Strict

INSTRUCTIONS = "instructions"
"""What the step before the first trial is called in the tables."""

Text = Annotated[str, Field(min_length=1)]

OF_WALKS = ("robot", "start", "waypoints", "results", "run", "pausing")
OF_CHECKS = ("key",)
DEFAULT_CONSENT = (
    "Taking part is voluntary. Your marks, their names and their times are stored under an id, "
    "nothing else about you. You may stop at any time."
)
DEFAULT_THANKS = "Everything is saved. You can close this page."


class PlaceCheck(Strict):
    """An attention check in a plan trial: a mark must be set near a named place.

    Attributes
    ----------
    location : str
        Id of a location of the map.
    within_m : float
        How near, metres.
    """

    location: Text
    within_m: Annotated[float, Field(gt=0.0, le=100.0)] = 1.0


class TrialSettings(Strict):
    """One trial.

    Attributes
    ----------
    id : str
        Names it in the tables: letters, digits, dots, dashes.
    kind : {"plan", "walk", "attention"}
        Marks on a floor plan; key presses during the replay of a robot's route; a key to press.
    question : str
        What the participant is asked, Markdown.
    map : str
        A map of the library by its name, or a ROS map yaml relative to the study file. Left out in
        a walk with `results`, it is theirs.
    check : PlaceCheck
        Makes a plan trial an attention check.
    robot : str
        Entry of scenarios/robots, or a path: whose laser is shown, and who drives the waypoints.
    start, waypoints : list
        Where a robot drives, as in a scenario, map frame.
    results, run : str, int
        A results folder relative to the study file, and which of its runs is replayed.
    pausing : bool
        Whether a walk can be paused.
    key : str
        The letter or digit to press.
    """

    id: Text
    kind: Literal["plan", "walk", "attention"]
    question: Text
    map: Text | None = None
    check: PlaceCheck | None = None
    robot: Text = "pioneer-dx"
    start: PoseList | None = None
    waypoints: Annotated[list[PoseList], Field(min_length=1)] | None = None
    results: Text | None = None
    run: Annotated[int, Field(ge=0)] | None = None
    pausing: bool = False
    key: Annotated[str, Field(pattern=r"^[a-z0-9]$")] | None = None

    @field_validator("id")
    @classmethod
    def _names_files(cls, name: str) -> str:
        if not NAME.fullmatch(name) or len(name) > 40:  # noqa: PLR2004
            raise ValueError(f"{name!r}: expected up to 40 letters, digits, dots and dashes")
        if name.casefold() == INSTRUCTIONS:
            raise ValueError(f"{name!r}: is what the step before the first trial is called")
        return name

    @model_validator(mode="after")
    def _of_one_kind(self) -> Self:
        foreign = {"plan": (*OF_WALKS, *OF_CHECKS), "walk": ("check", *OF_CHECKS)}
        others = foreign.get(self.kind, ("map", "check", *OF_WALKS))
        wrong = [
            f"{name} does not go with the kind {self.kind}"
            for name in others
            if name in self.model_fields_set
        ]
        if self.kind == "attention" and self.key is None:
            wrong.append("a trial of the kind attention needs key, a letter or digit")
        if self.kind == "plan" and self.map is None:
            wrong.append("a trial of the kind plan needs map")
        if self.kind == "walk":
            wrong += self._route_problems()
        if wrong:
            raise ValueError("; ".join(wrong))
        return self

    def _route_problems(self) -> list[str]:
        if (self.waypoints is None) == (self.results is None):
            return ["a trial of the kind walk has either waypoints or results"]
        if self.waypoints is not None:
            wrong = ["run goes with results"] if self.run is not None else []
            return wrong + (["a route of waypoints needs map"] if self.map is None else [])
        return ["start goes with waypoints"] if self.start is not None else []


class StudySettings(Strict):
    """A study.

    Attributes
    ----------
    title : str
        Shown on every page.
    seed : int
        With the participant's id it decides the order of the trials.
    consent, instructions, thanks : str
        Markdown; a single word that ends in .md is a file beside the study.
    participant : {"generated", "typed", "url"}
        Where a participant's id comes from: made up, typed on the first page, or the parameter
        ``pid`` of the address.
    order : {"random", "fixed"}
        Of `trials`; practice always comes first, as listed.
    practice, trials : list of TrialSettings
        What participants do.
    next_participant : bool
        Whether the last page offers to begin anew for another person at the same browser.
    participants_max : int
        How many may take part.
    responses_max : int
        How many responses are taken from each.
    """

    title: Text
    seed: Annotated[int, Field(ge=0)] = 2006
    consent: Text = DEFAULT_CONSENT
    instructions: Text
    thanks: Text = DEFAULT_THANKS
    participant: Literal["generated", "typed", "url"] = "generated"
    order: Literal["random", "fixed"] = "random"
    practice: list[TrialSettings] = Field(default_factory=list)
    trials: Annotated[list[TrialSettings], Field(min_length=1)]
    next_participant: bool = False
    participants_max: Annotated[int, Field(ge=1, le=1_000_000)] = 1000
    responses_max: Annotated[int, Field(ge=1, le=1_000_000)] = 5000
