"""Running estimates: mean and spread of what is measured again and again."""

from __future__ import annotations

import math
from dataclasses import dataclass

UNDIRECTED = 1e-12  # a resultant this short has no direction but that of rounding errors


def wrapped(angle_rad: float) -> float:
    """Return the same angle within (-pi, pi]."""
    angle = math.remainder(angle_rad, 2 * math.pi)
    return math.pi if angle == -math.pi else angle


@dataclass(frozen=True, slots=True)
class RunningMean:
    """Mean and sum of squared deviations of the values so far.

    Attributes
    ----------
    n : int
        Number of values.
    mean : float
        Their mean; 0 without any.
    squares : float
        Sum of the squared deviations from the mean.

    References
    ----------
    Welford (1962), "Note on a method for calculating corrected sums of squares and
    products", Technometrics 4.
    """

    n: int = 0
    mean: float = 0.0
    squares: float = 0.0

    def with_value(self, value: float) -> RunningMean:
        """Return the estimate with one more value."""
        n = self.n + 1
        mean = self.mean + (value - self.mean) / n
        return RunningMean(n, mean, self.squares + (value - self.mean) * (value - mean))

    @property
    def deviation(self) -> float:
        """Standard deviation (n - 1); 0 for fewer than two values."""
        return math.sqrt(self.squares / (self.n - 1)) if self.n > 1 else 0.0

    @classmethod
    def of(cls, n: int, mean: float, deviation: float) -> RunningMean:
        """Rebuild an estimate from what is reported of it."""
        return cls(n, mean, deviation**2 * (n - 1))


@dataclass(frozen=True, slots=True)
class RunningDirection:
    """Mean direction and mean resultant length of the angles so far.

    Attributes
    ----------
    n : int
        Number of angles.
    mean_rad : float
        Direction of the sum of the unit vectors, within (-pi, pi]. Where they cancel
        out, and no direction is better than another, the last one that was defined.
    resultant : float
        Length R of that sum over n: 1 when all agree, 0 when they cancel out.

    References
    ----------
    Mardia & Jupp (2000), Directional Statistics, sections 2.2 and 2.3.
    """

    n: int = 0
    mean_rad: float = 0.0
    resultant: float = 0.0

    def with_value(self, angle_rad: float) -> RunningDirection:
        """Return the estimate with one more angle, in radians."""
        length = self.n * self.resultant
        x = length * math.cos(self.mean_rad) + math.cos(angle_rad)
        y = length * math.sin(self.mean_rad) + math.sin(angle_rad)
        total = math.hypot(x, y)
        mean_rad = wrapped(math.atan2(y, x)) if total > UNDIRECTED else self.mean_rad
        return RunningDirection(self.n + 1, mean_rad, min(1.0, total / (self.n + 1)))

    @property
    def deviation(self) -> float:
        """Angular deviation ``sqrt(2 (1 - R))`` in radians, from 0 to sqrt(2)."""
        return math.sqrt(2 * (1 - self.resultant)) if self.n > 0 else 0.0

    @classmethod
    def of(cls, n: int, mean_rad: float, deviation: float) -> RunningDirection:
        """Rebuild an estimate from what is reported of it."""
        return cls(n, mean_rad, max(0.0, 1 - deviation**2 / 2))
