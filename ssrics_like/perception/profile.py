"""The settings of a perception buffer: how one set-up of the sensor is read."""

from __future__ import annotations

from typing import Annotated, Literal, Self

from pydantic import BaseModel, ConfigDict, Field, field_validator, model_validator

from ssrics_like.perception.conditioning import is_window
from ssrics_like.perception.marking import Mark
from ssrics_like.perception.novelty import (
    REPORT_THRESHOLD,
    Advance,
)
from ssrics_like.perception.sectors import SectorRule

Anchor = Literal["newest", "middle", "oldest"]
Along = Literal["scans", "metres"]
ViewOf = Literal["scan", "surroundings"]
SURROUNDINGS_LENGTH = 108  # of `Surroundings.view_of`, which is compiled and loaded late
EgomotionOf = Literal["odometry", "laser"]
Fraction = Annotated[float, Field(gt=0.0, lt=1.0)]


class PerceptionProfile(BaseModel):
    """Every setting of the reading that a perception buffer takes.

    The defaults are those of the library's profile ``human-like``. Where the
    report leaves a choice open the profile states it.

    Attributes
    ----------
    title, source : str
        What the profile is for, and where its values come from; free text.
    range_cap_m : float
        Metres. Readings from here on, and no-return values, are set to it.
    repair_window : int
        Beams of the median that repairs dropouts, odd; 0 turns repair off.
    along : {"scans", "metres"}
        What intervals count: scans as they come; or places, 0.1 m of path apart, whose scans are
        compensated for turns.
    egomotion : {"odometry", "laser"}
        How the robot knows its way: from its wheels alone, or corrected by matching scans. Poses
        that do not drift are never corrected.
    doorways : str
        The learned cue that tells doorways; empty to perceive none. Needs `along` metres.
    structure : str
        The learned cue that tells openings, junctions, corners, corridors and rooms; empty to tell
        corridors from rooms by their width, and that only beside `doorways`. Needs `along` metres.
    interval : int
        Scans that are correlated with each other (the report's beta).
    gradient : float
        Correlation above which two scans are the same (the report's T).
    threshold : float
        Boredom quotient above which an interval is not novel (the report's B).
    advance : {"sliding", "tumbling"}
        Whether an interval ends at every scan, or intervals do not overlap.
    mark : {"peak", "every", "onset"}
        Which novel intervals fire a reflex.
    prominence : float
        Fall of novelty after which a maximum counts as a peak; used by `mark` peak.
    anchor : {"middle", "newest", "oldest"}
        The interval's scan that gives the time, the pose, the sector and the
        view. Of an even number of scans the middle is the later of the two.
    sector_rule : {"robust", "maximum"}
        Whether a running median or the single largest reading decides the sector.
    view : {"scan", "surroundings"}
        What a place is known again by: the anchor's scan, or what surrounds the place in its own
        frame, the same from either side. The latter needs `along` metres.
    view_beams : int
        Size of the view of a scan.
    """

    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)

    title: str = ""
    source: str = ""
    range_cap_m: Annotated[float, Field(gt=0.0, le=10_000.0)] = 8.0
    repair_window: Annotated[int, Field(ge=0, le=1001)] = 5
    along: Along = "scans"
    egomotion: EgomotionOf = "odometry"
    doorways: str = ""
    structure: str = ""
    interval: Annotated[int, Field(ge=2, le=10_000)] = 20
    gradient: Fraction = 0.9
    threshold: Fraction = REPORT_THRESHOLD
    advance: Advance = "sliding"
    mark: Mark = "peak"
    prominence: Fraction = 0.1
    anchor: Anchor = "middle"
    sector_rule: SectorRule = "robust"
    view: ViewOf = "scan"
    view_beams: Annotated[int, Field(ge=2, le=10_000)] = 36

    @field_validator("repair_window")
    @classmethod
    def _window_is_odd(cls, beams: int) -> int:
        if beams != 0 and not is_window(beams):
            raise ValueError("expected 0 (off) or an odd number of beams, 3 or more")
        return beams

    @model_validator(mode="after")
    def _cues_look_along_the_way(self) -> Self:
        for key in ("doorways", "structure"):
            if getattr(self, key) and self.along != "metres":
                raise ValueError(f"{key}: the cue looks at places along the way; set along: metres")
        if self.view == "surroundings" and self.along != "metres":
            raise ValueError(
                "view: surroundings are those of places along the way; set along: metres"
            )
        return self

    @property
    def view_length(self) -> int:
        """How many numbers a view has."""
        return self.view_beams if self.view == "scan" else SURROUNDINGS_LENGTH
