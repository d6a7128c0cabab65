"""A results folder as values: typed, sorted by run, time from zero."""

from __future__ import annotations

import math
from collections import Counter
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray

DECISIONS = ("declared", "recognised", "unsure", "dismissed", "overwritten")
"""Every decision, in the order in which figures and tables show them."""

TIME_STEP_S = 1e-6
MARKS = ("declared", "recognised", "unsure")
"""The decisions that call a place a landmark; `unsure` leaves open which."""


@dataclass(frozen=True, slots=True)
class Reflex:
    """One row of decisions.csv: a reflex and what became of it.

    Attributes
    ----------
    event : int
        Its number.
    t_s, decided_s : float
        When it was perceived and decided, seconds since the start of the run.
    x_m, y_m : float
        Where the robot was: the simulator's true position where there is one.
    novelty : float
        1 - boredom quotient.
    sector, structure, decision, landmark, rule : str
        As in the file; `landmark` and `rule` may be empty.
    """

    event: int
    t_s: float
    decided_s: float
    x_m: float
    y_m: float
    novelty: float
    sector: str
    structure: str
    decision: str
    landmark: str
    rule: str


@dataclass(frozen=True, slots=True)
class Landmark:
    """One row of landmarks.csv.

    Attributes
    ----------
    name : str
        Its name.
    t_s : float
        When it was marked, seconds since the start of the run.
    x_m, y_m, theta_rad : float
        Pose of the robot then, as it believed.
    drawn_x_m, drawn_y_m : float
        Where it is shown: the true position in simulation, else the same.
    sector, structure : str
        What was perceived there.
    salience : float or None
        How surprising its view is, bits; None where memory holds no view of it.
    relevance : float
        Entropy of the ways at it, bits, times how much they are used.
    permanence : float or None
        How probable it is, at the end, that it is still there; None in results of a version that
        wrote its activation there, where memory did not hold it.
    visits : int
        The marking included.
    """

    name: str
    t_s: float
    x_m: float
    y_m: float
    theta_rad: float
    drawn_x_m: float
    drawn_y_m: float
    sector: str
    structure: str
    salience: float | None
    relevance: float
    permanence: float | None
    visits: int


@dataclass(frozen=True, eq=False)
class Run:
    """One run of a results folder.

    Attributes
    ----------
    number : int
        Its number.
    entry : dict
        Its entry in the manifest.
    start_s : float
        Time of its first observation on the source's own clock.
    path : ndarray, shape (poses, 3)
        Time since the start and position: t_s, x_m, y_m.
    is_true : bool
        Whether positions are the simulator's true ones.
    reflexes : tuple of Reflex
        In order of the file.
    landmarks : tuple of Landmark
        In order of their making.
    carried_s : tuple of float
        When the robot was carried elsewhere, seconds since the start; simulated runs only.
    """

    number: int
    entry: dict[str, Any]
    start_s: float
    path: NDArray[np.float64]
    is_true: bool
    reflexes: tuple[Reflex, ...]
    landmarks: tuple[Landmark, ...]
    carried_s: tuple[float, ...] = ()

    @property
    def landings(self) -> NDArray[np.int64]:
        """Indices of the poses of the path at which the robot was put down."""
        # The tables' times are rounded.
        at = np.searchsorted(self.path[:, 0], np.array(self.carried_s) - TIME_STEP_S)
        return np.unique(at[(at > 0) & (at < len(self.path))])

    @property
    def name(self) -> str:
        """Name of its files: ``run-000``."""
        return f"run-{self.number:03d}"

    @property
    def duration_s(self) -> float:
        """Seconds from the first observation to the last."""
        return float(self.entry["duration_s"])

    @property
    def length_m(self) -> float:
        """Metres driven."""
        return float(self.entry["path_length_m"])

    @property
    def decided(self) -> Counter[str]:
        """How often each decision was taken."""
        return Counter(reflex.decision for reflex in self.reflexes)

    @property
    def coverage(self) -> float | None:
        """Share of the reachable free space that was seen; None for a log."""
        value = self.entry.get("coverage")
        return None if value is None else float(value)

    @property
    def marks_per_100_m(self) -> float:
        """Declared and recognised reflexes per 100 m driven; NaN for a robot that stood still."""
        marks = sum(self.decided[kind] for kind in MARKS)
        return 100.0 * marks / self.length_m if self.length_m > 0 else math.nan


@dataclass(frozen=True, eq=False)
class Records:
    """The tables and the manifest of a results folder.

    Attributes
    ----------
    folder : Path
        Where it is.
    manifest : dict
        manifest.json.
    runs : tuple of Run
        All complete runs; at least one.
    """

    folder: Path
    manifest: dict[str, Any]
    runs: tuple[Run, ...]

    @property
    def scenario(self) -> dict[str, Any]:
        """The scenario as it was resolved."""
        resolved: dict[str, Any] = self.manifest["scenario"]
        return resolved
