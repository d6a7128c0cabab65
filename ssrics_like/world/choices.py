"""Places that people chose as landmarks, each with who chose it."""

from __future__ import annotations

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class Choice:
    """One person's landmark.

    Attributes
    ----------
    participant : str
        Who chose it.
    landmark : str
        What that person's landmark is named.
    x_m, y_m : float
        Where it is, in the frame of the map.
    label : str
        What the person called it; may be empty.
    t_s : float or None
        When it was chosen, where that is known.
    """

    participant: str
    landmark: str
    x_m: float
    y_m: float
    label: str = ""
    t_s: float | None = None
