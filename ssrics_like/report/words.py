"""Numbers and perceptions for reading."""

from __future__ import annotations

import math
from dataclasses import dataclass

MINUTE_S = 60.0
HOUR_S = 3600.0


@dataclass(frozen=True)
class Clock:
    """A unit of time that suits a duration."""

    unit: str
    seconds: float

    def label(self) -> str:
        """Return the label of a time axis."""
        return f"time since the start, {self.unit}"


def clock(duration_s: float) -> Clock:
    """Choose seconds, minutes or hours for an axis of a duration."""
    if duration_s < 3 * MINUTE_S:
        return Clock("s", 1.0)
    return Clock("min", MINUTE_S) if duration_s < 3 * HOUR_S else Clock("h", HOUR_S)


def time_text(t_s: float) -> str:
    """Return a time since the start for reading: ``42.1 s``, ``12:05``, ``1:02:30``."""
    if abs(t_s) < MINUTE_S:
        return f"{t_s:.1f} s"
    sign, whole = ("-" if t_s < 0 else ""), round(abs(t_s))
    minutes, seconds = divmod(whole, 60)
    hours, minutes = divmod(minutes, 60)
    if hours:
        return f"{sign}{hours}:{minutes:02d}:{seconds:02d}"
    return f"{sign}{minutes}:{seconds:02d}"


def number_text(value: float, decimals: int) -> str:
    """Return a number with a true minus sign, and no minus before zero."""
    text = f"{value:.{decimals}f}"
    if float(text) == 0:
        text = text.removeprefix("-")
    return text.replace("-", "−")


def fraction_text(value: float, decimals: int = 4) -> str:
    """Return a fraction as the report writes it: ``.75``."""
    text = number_text(value, decimals)
    if "." in text:
        text = text.rstrip("0").rstrip(".")
    sign = "−" if text.startswith("−") else ""
    return f"{sign}{text.removeprefix(sign).removeprefix('0') or '0'}"


def percent_text(share: float, decimals: int = 0) -> str:
    """Return a share as a percentage; a dash for one that cannot be said."""
    return "–" if math.isnan(share) else f"{number_text(100 * share, decimals)} %"


def figure_text(value: float, decimals: int = 2) -> str:
    """Return a figure; a dash for one that cannot be said."""
    return "–" if math.isnan(value) else number_text(value, decimals)


def interval_text(interval: tuple[float, float]) -> str:
    """Return an interval of a share in per cent: ``33–79 %``."""
    low, high = interval
    if math.isnan(low) or math.isnan(high):
        return "–"
    return f"{100 * low:.0f}–{100 * high:.0f} %"


def place_text(name: str, label: str) -> str:
    """Return what a labelled place is called: its label alone, where that holds the id."""
    if name in label.split():
        return label
    return f"{name}  {label}".strip()


def seen_text(sector: str, structure: str) -> str:
    """Return what was perceived; nothing is said of a structure that was not recognised."""
    return ", ".join(word for word in (sector, structure) if word not in ("", "unknown"))
