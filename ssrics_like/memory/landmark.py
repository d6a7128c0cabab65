"""What topological memory is made of: landmarks and arcs, and what they may be called."""

from __future__ import annotations

import math
import re
from collections.abc import Mapping
from dataclasses import dataclass, field, fields
from typing import TypeAlias

import numpy as np

Label: TypeAlias = str | int | float | bool

LAYOUT_LABELS = ("layout_x_m", "layout_y_m", "layout_theta_rad", "component")
"""What an exported graph says of a landmark beside what is remembered of it: where it lies in a
common frame, and in which part of the graph (`layout`). It is reckoned, and so not read again."""
RESERVED_LABELS = frozenset({"closed", "same_as", "origin", *LAYOUT_LABELS})
"""`same_as` is kept for what later versions will say of a landmark: the same place met from another
side. `origin` is said in files of memory: where a landmark was declared."""


@dataclass(frozen=True)
class Landmark:
    """A node: a place worth remembering.

    Attributes
    ----------
    id : str
        Unique name.
    x_m, y_m, theta_rad : float
        Pose of the robot when it first marked the place, as estimated then, in the frame
        of whoever added it. Radians within (-pi, pi], counter-clockwise.
    t_s, last_visit_s : float
        When it was marked, and last seen to be there; seconds.
    visits : int
        Number of visits, the marking included.
    labels : mapping of str to str, int, float or bool
        What is known of it (sector, structure, novelty ...).
    missed, missed_since : int
        How often the robot came by where it is expected and did not mark it: before the last
        visit, and since.
    """

    id: str
    x_m: float
    y_m: float
    theta_rad: float
    t_s: float
    last_visit_s: float
    visits: int
    labels: Mapping[str, Label] = field(default_factory=dict)
    missed: int = 0
    missed_since: int = 0


@dataclass(frozen=True)
class Arc:
    """A way from one landmark to the next, as remembered from going it.

    Attributes
    ----------
    from_id, to_id : str
        Where it begins and ends. The way back is another arc.
    traversals : int
        How often it was gone.
    distance_m, distance_sd_m : float
        Straight distance: mean, and standard deviation over the traversals (0 for one).
    bearing_rad, bearing_sd_rad : float
        Where the destination lies, seen on leaving: the angle from the robot's heading
        at departure to the straight line, positive to the left, within (-pi, pi].
        Circular mean, and angular deviation (0 to sqrt(2)).
    path_m, path_sd_m : float
        Length of the path driven: mean and standard deviation.
    x_m, y_m, theta_rad : float
        Pose of the destination in the frame of the landmark where the arc begins: its origin is
        that landmark, its x axis the direction in which it was declared.
    position_sd_m, direction_sd_rad : float
        How uncertain that is, standard deviations; 0 if it was not measured.
    closed : int
        How often the way was found shut since it was last gone, either way; 0 for an open one.
    """

    from_id: str
    to_id: str
    traversals: int
    distance_m: float
    distance_sd_m: float
    bearing_rad: float
    bearing_sd_rad: float
    path_m: float
    path_sd_m: float
    x_m: float = 0.0
    y_m: float = 0.0
    theta_rad: float = 0.0
    position_sd_m: float = 0.0
    direction_sd_rad: float = 0.0
    closed: int = 0


GIVEN_NAME = re.compile(r"L([0-9]{1,9})")
NOT_LABELS = frozenset(f.name for f in fields(Landmark))


def number_of(landmark: str) -> int:
    """Return the number in a name that the model gives, L7; 0 for any other name."""
    found = GIVEN_NAME.fullmatch(landmark)
    return int(found[1]) if found else 0


def checked_labels(labels: Mapping[str, Label | None]) -> dict[str, Label]:
    """Return the labels worth keeping: neither None nor empty text.

    Raises
    ------
    ValueError
        For a label that is reserved, not printable or not finite.
    TypeError
        For a label that is neither text nor a number.
    """
    kept: dict[str, Label] = {}
    for name, given in labels.items():
        value = given.item() if isinstance(given, np.generic) else given
        if value is None or value == "":
            continue
        if name in RESERVED_LABELS | NOT_LABELS:
            raise ValueError(f"label '{name}' is reserved")
        if not name.isprintable() or (isinstance(value, str) and not value.isprintable()):
            raise ValueError(f"label {name!r} is {value!r}; expected printable text")
        if not isinstance(value, str | int | float):
            raise TypeError(f"label '{name}' is {value!r}; expected text, a number or a boolean")
        kept[name] = finite(name, value) if isinstance(value, float) else value
    return kept


def finite(name: str, value: float) -> float:
    """Return a finite number, or raise ValueError under the name given."""
    if not math.isfinite(value):
        raise ValueError(f"{name} is {value!r}; expected a finite number")
    return float(value)


def length(name: str, value: float) -> float:
    """Return a finite number of 0 or more, or raise ValueError under the name given."""
    if not (math.isfinite(value) and value >= 0):
        raise ValueError(f"{name} is {value!r}; expected a length of 0 or more")
    return float(value)
