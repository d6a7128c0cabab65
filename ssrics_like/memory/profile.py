"""A memory set-up as users name it: ACT-R's parameters and those of the continuous slots."""

from __future__ import annotations

import itertools
from typing import Annotated, Literal

from pydantic import Field

from ssrics_like.memory.parameters import MemoryParameters
from ssrics_like.memory.similarity import SlotSimilarity, TableSimilarity, ViewSimilarity
from ssrics_like.memory.surroundings_similarity import SurroundingsSimilarity

SECTORS = ("left", "front", "right")


class MemoryProfile(MemoryParameters):
    """An entry of the library's memory folder.

    The defaults are those of the library's profile ``act-r``, which says why.

    Attributes
    ----------
    title, source : str
        What it is, and where its values come from.
    sector_difference : float
        Similarity of two different sectors. Sectors are egocentric, turning on the spot changes
        them, so that a different sector says less than a different place.
    view_difference : float
        Similarity of two views that do not correlate. A view is egocentric too: a place looks
        another from the other side.
    surroundings_difference : float
        Similarity of two places whose surroundings agree no more than those of any two.
    vista_difference : float
        How much less that is where what is seen in the distance contradicts.
    place_sigma_m, direction_sigma_rad : float
        Standard deviations, metres and radians, of where a landmark is perceived from one visit to
        the next, and of the direction of a doorway, where its view does not tell how the robot is
        turned.
    place_drift : float
        Standard deviation of path integration after one metre, metres; it grows with the square
        root of the way.
    swerve_drift_rad, turn_drift_rad : float
        Of its heading: after one metre of path, and after turning by one radian.
    wheel_bias : float
        Share by which wheels mismeasure ways and turns, where perception does not correct them.
    lasting_s : float
        A landmark that was seen once lasts so long or longer half of the time, seconds (see
        `worth.permanence`).
    """

    title: str = ""
    source: str = ""
    retrieval_threshold: float = -13.0
    latency_factor: Annotated[float, Field(ge=0, le=1e6)] = 0.001
    mismatch_penalty: float | None = 1.0
    activation_noise: Annotated[float, Field(ge=0)] = 0.1
    source_activation: dict[Literal["g", "imaginal"], float] = Field(  # type: ignore[assignment]
        default={"imaginal": 1.0}
    )
    sector_difference: Annotated[float, Field(le=0)] = 0.0
    view_difference: Annotated[float, Field(le=0)] = -2.0
    surroundings_difference: Annotated[float, Field(le=0)] = -7.0
    vista_difference: Annotated[float, Field(le=0)] = -4.5
    place_sigma_m: Annotated[float, Field(ge=1e-3, le=1e6)] = 0.1
    direction_sigma_rad: Annotated[float, Field(ge=1e-3, le=1e3)] = 0.25
    place_drift: Annotated[float, Field(ge=0, le=1e3)] = 0.01
    swerve_drift_rad: Annotated[float, Field(ge=0, le=10)] = 0.001
    turn_drift_rad: Annotated[float, Field(ge=0, le=10)] = 0.001
    wheel_bias: Annotated[float, Field(ge=0, le=1)] = 0.02
    lasting_s: Annotated[float, Field(ge=1e-3, le=1e9)] = 60.0

    def similarities(self, *, surroundings: bool) -> dict[str, SlotSimilarity]:
        """Return how the slots of landmarks compare, their places aside.

        Parameters
        ----------
        surroundings : bool
            Whether views are of what surrounds a place, and not of a scan.
        """
        pairs = itertools.combinations(SECTORS, 2)
        return {
            "sector": TableSimilarity(dict.fromkeys(pairs, self.sector_difference)),
            "view": self.surroundings if surroundings else ViewSimilarity(self.view_difference),
        }

    @property
    def surroundings(self) -> SurroundingsSimilarity:
        """How what surrounds two places compares."""
        return SurroundingsSimilarity(
            self.surroundings_difference, self.vista_difference, self.max_similarity
        )
