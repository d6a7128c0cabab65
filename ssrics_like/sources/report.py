"""What reading a log met: counts, the first complaints, and how times came about."""

from __future__ import annotations

from dataclasses import dataclass, field

from ssrics_like.sources.timing import TimingSummary

MAX_EXAMPLES = 5


@dataclass
class ReadReport:
    """Live counts of one pass over a log, final when the pass has ended.

    Attributes
    ----------
    lines : int
        Lines read so far; the reader looks up to 500 scans ahead.
    scans : int
        Observations handed out.
    readings, no_return : int
        Beams of those scans, and how many of them were no-return values.
    malformed : int
        Lines left out because they could not be understood.
    examples : list of str
        The first few complaints as ``file:line: reason``.
    truncated_last_line : bool
        The file ends in the middle of a record, or its gzip stream was cut.
    truncation : str
        Where and how it was cut, as ``file:line: reason``, else empty.
    skipped : dict
        Kinds of records that were left alone on purpose, with their counts.
    timing : TimingSummary
        Where the times come from.
    notes : list of str
        What else the format or the readings call for.
    """

    lines: int = 0
    scans: int = 0
    readings: int = 0
    no_return: int = 0
    malformed: int = 0
    examples: list[str] = field(default_factory=list)
    truncated_last_line: bool = False
    truncation: str = ""
    skipped: dict[str, int] = field(default_factory=dict)
    timing: TimingSummary = field(default_factory=TimingSummary)
    notes: list[str] = field(default_factory=list)

    @property
    def no_return_share(self) -> float:
        """Share of the readings that were no-return values, 0 without readings."""
        return self.no_return / self.readings if self.readings else 0.0

    def example(self, text: str) -> None:
        """Keep a complaint if it is among the first."""
        if len(self.examples) < MAX_EXAMPLES:
            self.examples.append(text)

    def warnings(self) -> list[str]:
        """Return, for a manifest, what a user should know: plain sentences."""
        found = []
        if self.malformed:
            shown = "; ".join(self.examples)
            found.append(f"{_many(self.malformed, 'malformed line')} left out: {shown}.")
        if self.truncated_last_line:
            found.append(f"The log is cut off; it was read up to there: {self.truncation}.")
        found += self._timing_warnings()
        for kind, number in sorted(self.skipped.items()):
            found.append(f"{_many(number, kind + ' record')} skipped.")
        return found + self.notes

    def _timing_warnings(self) -> list[str]:
        timing = self.timing
        if not self.scans:
            return []
        if not timing.usable:
            why = "cannot be used" if timing.column else "are not given"
            rate = (
                f"The log's times {why}: the scans are timed at "
                f"{timing.fallback_rate_hz:g} per second in the order of the file."
            )
            return [rate]
        found = []
        if timing.repaired:
            found.append(
                f"{_many(timing.repaired, 'time stamp')} out of order or missing: "
                "replaced by times that follow the one before."
            )
        if timing.resets:
            found.append(
                f"The log's clock was set anew {_many(timing.resets, 'time')}; "
                "times after that are shifted to go on."
            )
        return found


def _many(number: int, what: str) -> str:
    return f"{number} {what}{'' if number == 1 else 's'}"
