"""The report's rule in its readings."""

from __future__ import annotations

from typing import TYPE_CHECKING, Annotated, ClassVar, Literal

from pydantic import Field

from ssrics_like.designators.protocol import DesignatorSettings, Grid, Mark
from ssrics_like.perception.novelty import (
    REPORT_GRADIENT,
    REPORT_INTERVAL,
    REPORT_THRESHOLD,
)
from ssrics_like.perception.profile import PerceptionProfile
from ssrics_like.perception.reflex import PerceptionBuffer

if TYPE_CHECKING:
    from ssrics_like.perception.observation import Observation
    from ssrics_like.perception.reflex import Reflex

Fraction = Annotated[float, Field(gt=0.0, lt=1.0)]


class ReportRuleSettings(DesignatorSettings):
    """Settings of `ReportRule`; the defaults are those of the profile ``report``.

    Attributes
    ----------
    advance : {"tumbling", "sliding"}
        Whether intervals follow one another or end at every scan.
    mark : {"every", "onset", "peak"}
        Which novel intervals are marked.
    sector_check : bool
        Whether a place is passed over whose widest sector is that of the last mark.
    interval, gradient, threshold
        beta, T and B of the report.
    range_cap_m : float
        Metres.
    """

    advance: Literal["tumbling", "sliding"] = "tumbling"
    mark: Literal["every", "onset", "peak"] = "every"
    sector_check: bool = True
    interval: Annotated[int, Field(ge=2, le=10_000)] = REPORT_INTERVAL
    gradient: Fraction = REPORT_GRADIENT
    threshold: Fraction = REPORT_THRESHOLD
    range_cap_m: Annotated[float, Field(gt=0.0, le=10_000.0)] = 8.0


class ReportRule:
    """Marks novel intervals whose sector differs from that of the mark before.

    It counts scans, as the report does, and looks at every one. The strength is the
    novelty, 1 - tau. Tuning chooses among the readings that the report's text leaves open;
    its three values stay.

    Parameters
    ----------
    settings : ReportRuleSettings
        The reading.

    References
    ----------
    Kelley & McGhee, "Navigating Like a Human", US Army Research Laboratory, sections 2.1
    (novelty), 2.2 (values) and 4 (sector check).
    """

    Settings: ClassVar[type[DesignatorSettings]] = ReportRuleSettings
    GRID: ClassVar[Grid] = {
        "advance": ("tumbling", "sliding"),
        "mark": ("every", "onset", "peak"),
        "sector_check": (True, False),
    }
    hindsight: ClassVar[bool] = False
    source: ClassVar[str] = "Kelley & McGhee, the report"

    def __init__(self, settings: ReportRuleSettings) -> None:
        self._buffer = PerceptionBuffer(
            PerceptionProfile(
                range_cap_m=settings.range_cap_m,
                repair_window=0,
                interval=settings.interval,
                gradient=settings.gradient,
                threshold=settings.threshold,
                advance=settings.advance,
                mark=settings.mark,
                anchor="newest",
                sector_rule="maximum",
            )
        )
        self._checks = settings.sector_check
        self._last = ""
        self._newest = 0

    def update(self, observation: Observation) -> list[Mark]:
        """Take the next observation; see `Designator`.

        Raises
        ------
        ScanError
            The scan has no beams.
        """
        self._newest = observation.index
        return self._decide(self._buffer.update(observation))

    def flush(self) -> list[Mark]:
        """End the drive; see `Designator`."""
        return self._decide(self._buffer.flush())

    def _decide(self, reflexes: list[Reflex]) -> list[Mark]:
        marks = []
        for reflex in reflexes:
            if not self._checks or reflex.sector != self._last:
                marks.append(Mark(reflex.scan, self._newest, reflex.novelty))
                self._last = reflex.sector
        return marks
