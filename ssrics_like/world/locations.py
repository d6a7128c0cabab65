"""Places that people named on a map: what a robot's marks are compared with."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Literal, get_args

Kind = Literal["doorway", "opening", "junction", "corner", "other"]

KINDS: tuple[str, ...] = get_args(Kind)


@dataclass(frozen=True, slots=True)
class Location:
    """A labelled place.

    Attributes
    ----------
    id : str
        Its name, unique on the map.
    x_m, y_m : float
        Where it is, in the frame of the map.
    label : str
        What people call it; may be empty.
    kind : {"doorway", "opening", "junction", "corner", "other"}
        A doorway is narrow and framed by walls, an opening is wide or has no frame.
    """

    id: str
    x_m: float
    y_m: float
    label: str = ""
    kind: str = "doorway"
