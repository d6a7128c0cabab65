"""What a scenario may say about its world: building, robot, journey, disturbances."""

from __future__ import annotations

from typing import Annotated, Any, Literal, Self

from pydantic import BaseModel, BeforeValidator, ConfigDict, Field, model_validator

from ssrics_like.errors import choices
from ssrics_like.world.buildings.generator import BuildingSettings

Seconds = Annotated[float, Field(ge=0.0)]
Name = Annotated[str, Field(min_length=1)]
LEGS = ("explore", "waypoints", "wait_s", "goto")
"""What a leg of a journey can be."""


class Strict(BaseModel):
    """Settings that refuse what they do not know."""

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)


def _place(least: int, most: int, what: str) -> BeforeValidator:
    def check(value: Any) -> list[float]:
        numbers = isinstance(value, list | tuple) and all(
            isinstance(v, int | float) and not isinstance(v, bool) and abs(v) < 1e6  # noqa: PLR2004
            for v in value
        )
        if not numbers or not least <= len(value) <= most:
            raise ValueError(f"{value!r}: expected {what}")
        return [float(v) for v in value]

    return BeforeValidator(check)


Point = Annotated[list[float], _place(2, 2, "[x, y] in metres")]
PoseList = Annotated[list[float], _place(2, 3, "[x, y] or [x, y, heading] in metres and radians")]


class BuildingChoice(BuildingSettings):
    """A building made by the generator instead of a map.

    Attributes
    ----------
    seed : int
        Which one.
    """

    seed: Annotated[int, Field(ge=0)] = 0


class LegSettings(Strict):
    """A part of the journey; exactly one of the first three.

    Attributes
    ----------
    explore : {"frontier"}
        Frontier exploration until no frontier is left.
    waypoints : list
        Places to pass, over the known floor plan: [x, y] or [x, y, heading] each.
    wait_s : float
        Stand still, seconds.
    goto : str
        An errand on which the model leads: the name of a landmark, home or visit-all. It needs
        productions that lead, such as wayfinding.
    repeat : int
        How often the waypoints are driven.
    """

    explore: Literal["frontier"] | None = None
    waypoints: Annotated[list[PoseList], Field(min_length=1)] | None = None
    wait_s: Seconds | None = None
    goto: Name | None = None
    repeat: Annotated[int, Field(ge=1, le=10_000)] = 1

    @model_validator(mode="after")
    def _one_thing(self) -> Self:
        given = [n for n in LEGS if getattr(self, n) is not None]
        if len(given) != 1:
            said = " and ".join(given) or "none of them"
            raise ValueError(f"a leg is {choices(LEGS)}, one of them; it has {said}")
        if self.repeat != 1 and self.waypoints is None:
            raise ValueError(f"repeat goes with waypoints, this leg has {given[0]}")
        return self


class DoorSettings(Strict):
    """A door that is closed for a time; exactly one of `location` and `at`.

    Attributes
    ----------
    location : str
        Id of a location of the map.
    at : list
        [x, y] in a doorway, metres, map frame.
    closes_s, opens_s : float
        When it closes, and when it opens again; it stays closed without the latter.
    """

    location: str | None = None
    at: Point | None = None
    closes_s: Seconds = 0.0
    opens_s: Seconds | None = None

    @model_validator(mode="after")
    def _one_place(self) -> Self:
        wrong = []
        if (self.location is None) == (self.at is None):
            wrong.append("a door has either location or at")
        if self.opens_s is not None and self.opens_s <= self.closes_s:
            wrong.append(f"opens_s is {self.opens_s:g}, not after closes_s {self.closes_s:g}")
        if wrong:
            raise ValueError("; ".join(wrong))
        return self


class KidnapSettings(Strict):
    """The robot is carried elsewhere.

    Attributes
    ----------
    at_s : float
        When.
    to : list
        [x, y] or [x, y, heading], map frame.
    """

    at_s: Seconds
    to: PoseList


class PeopleSettings(Strict):
    """People who walk about.

    Attributes
    ----------
    count : int
        How many.
    speed_m_s, radius_m : float
        Of each.
    """

    count: Annotated[int, Field(ge=0, le=200)]
    speed_m_s: Annotated[float, Field(gt=0.0, le=10.0)] = 1.1
    radius_m: Annotated[float, Field(gt=0.0, le=1.0)] = 0.22


class SlipSettings(Strict):
    """Stretches in which the wheels spin.

    Attributes
    ----------
    per_m : float
        How many begin in a metre, on average.
    length_m : float
        How long each is, as the wheels count it.
    share : float
        Share of the wheels' way that is lost there.
    """

    per_m: Annotated[float, Field(ge=0.0, le=100.0)]
    length_m: Annotated[float, Field(gt=0.0, le=100.0)] = 0.5
    share: Annotated[float, Field(ge=0.0, le=1.0)] = 0.5


class FurnitureSettings(Strict):
    """Furniture put into the building besides what its map shows.

    Attributes
    ----------
    pieces : int
        How many; fewer where they find no room.
    moved : bool
        Whether each run has it elsewhere.
    """

    pieces: Annotated[int, Field(ge=0, le=2000)]
    moved: bool = True


class WorldSettings(Strict):
    """A simulated building as the source of observations.

    Attributes
    ----------
    map : str
        ROS map yaml, relative to the scenario file; or `building`.
    building : BuildingChoice
        A generated building instead of a map.
    locations : str
        CSV of labelled places, instead of those of the map.
    robot : str
        Entry of scenarios/robots, or a path.
    start : list
        [x, y] or [x, y, heading], map frame; if left out, the free place with the most clearance,
        heading 0 in the grid.
    explore, waypoints, goto, repeat : as `LegSettings`
        The journey, if it has one leg.
    legs : list of LegSettings
        The journey, if it has several.
    time_limit_s : float
        A run ends after this time at the latest.
    furniture, people, doors, slip, kidnaps
        Disturbances.
    """

    map: str | None = None
    building: BuildingChoice | None = None
    locations: str | None = None
    robot: str = "pioneer-dx"
    start: PoseList | None = None
    explore: Literal["frontier"] | None = None
    waypoints: Annotated[list[PoseList], Field(min_length=1)] | None = None
    goto: Name | None = None
    repeat: Annotated[int, Field(ge=1, le=10_000)] = 1
    legs: Annotated[list[LegSettings], Field(min_length=1)] | None = None
    time_limit_s: Annotated[float, Field(gt=0.0, le=1e6)] = 7200.0
    furniture: FurnitureSettings | None = None
    people: PeopleSettings | None = None
    doors: list[DoorSettings] = Field(default_factory=list)
    slip: SlipSettings | None = None
    kidnaps: list[KidnapSettings] = Field(default_factory=list)

    @model_validator(mode="after")
    def _consistent(self) -> Self:
        if (self.map is None) == (self.building is None):
            raise ValueError("a world has either map or building")
        kinds = ("explore", "waypoints", "goto", "legs")
        journeys = [n for n in kinds if getattr(self, n) is not None]
        if len(journeys) > 1:
            raise ValueError(f"{' and '.join(journeys)} exclude each other; list them in legs")
        if self.repeat != 1 and self.waypoints is None:
            raise ValueError("repeat goes with waypoints")
        return self

    @property
    def journey(self) -> list[LegSettings]:
        """The legs, however they were given; frontier exploration if nothing was."""
        if self.legs is not None:
            return self.legs
        if self.waypoints is not None:
            return [LegSettings(waypoints=self.waypoints, repeat=self.repeat)]
        if self.goto is not None:
            return [LegSettings(goto=self.goto)]
        return [LegSettings(explore="frontier")]
