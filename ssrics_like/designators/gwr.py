"""A Grow-When-Required network as a novelty filter."""

from __future__ import annotations

import math
from typing import TYPE_CHECKING, Annotated, ClassVar

import numpy as np
from pydantic import Field

from ssrics_like.designators.peaks import Peaks, ScoredDesignator
from ssrics_like.designators.readings import SUMMARY, ReadingSettings, summary

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.designators.protocol import DesignatorSettings, Grid
    from ssrics_like.perception.observation import Observation

ALPHA = 1.05  # with a stimulus of 1, firing falls from 1 to 1 - 1 / alpha = .05
TAU_WINNER, TAU_NEIGHBOUR = 3.33, 14.3  # stimuli: how slowly the winner and its neighbours tire
LEARN_WINNER, LEARN_NEIGHBOUR = 0.1, 0.01  # share of the way to the input, times firing
OLDEST_EDGE = 50  # stimuli of one of its nodes
FRESH = 1.0  # firing of a node that never met a stimulus


def habituated(firing: float, tau: float, stimuli: int = 1) -> float:
    """Return the firing of a node after further stimuli.

    The exact solution of tau dh/dt = alpha (1 - h) - 1 over so many units of time: from
    fresh, h = 1 - (1 - exp(-alpha n / tau)) / alpha.
    """
    tired = FRESH - 1.0 / ALPHA
    return tired + (firing - tired) * math.exp(-ALPHA * stimuli / tau)


class GrowingNetwork:
    """Nodes that stand for what was met, and tire of it.

    Parameters
    ----------
    activity : float
        An input whose best node is less active, a = exp(-distance), is not known well.
    tired : float
        A node that fires less is trained; only such a one lets the network grow.
    nodes_max : int
        The network grows no larger.

    Attributes
    ----------
    weights : ndarray, shape (nodes, features)
        What each node stands for; the first two come with the first two inputs.
    firing : list of float
        How fresh each node is, 1 to .05.

    References
    ----------
    Marsland, Shapiro & Nehmzow (2002), "A self-organising network that grows when
    required", Neural Networks 15.
    """

    def __init__(self, activity: float, tired: float, nodes_max: int) -> None:
        self._activity = activity
        self._tired = tired
        self._nodes_max = nodes_max
        self.weights: NDArray[np.float64] = np.empty((0, 0))
        self.firing: list[float] = []
        self._edges: dict[tuple[int, int], int] = {}  # lower and higher node -> age

    def meet(self, x: NDArray[np.float64]) -> float:
        """Take one input, shape (features,); return its novelty.

        That is the firing of its best node before it tires of the input, and 1 for an
        input that has a node made for it.
        """
        if len(self.firing) < 2:  # noqa: PLR2004 - a best node and a second best
            self.weights = np.vstack([self.weights.reshape(-1, x.size), x])
            self.firing.append(FRESH)
            return FRESH
        far = np.sqrt(((self.weights - x) ** 2).sum(axis=1))
        best, second = (int(node) for node in np.argsort(far, kind="stable")[:2])
        self._edges[min(best, second), max(best, second)] = 0
        novelty = self.firing[best]
        grows = len(self.firing) < self._nodes_max
        if grows and math.exp(-far[best]) < self._activity and novelty < self._tired:
            novelty = FRESH
            self._grow(x, best, second)
        else:
            self._learn(x, best)
        self._tire(best)
        self._prune()
        return novelty

    def _neighbours(self, node: int) -> list[int]:
        return [a + b - node for a, b in self._edges if node in (a, b)]

    def _grow(self, x: NDArray[np.float64], best: int, second: int) -> None:
        new = len(self.firing)
        self.weights = np.vstack([self.weights, 0.5 * (self.weights[best] + x)])
        self.firing.append(FRESH)
        del self._edges[min(best, second), max(best, second)]
        self._edges[best, new] = self._edges[second, new] = 0

    def _learn(self, x: NDArray[np.float64], best: int) -> None:
        self.weights[best] += LEARN_WINNER * self.firing[best] * (x - self.weights[best])
        for node in self._neighbours(best):
            self.weights[node] += LEARN_NEIGHBOUR * self.firing[node] * (x - self.weights[node])

    def _tire(self, best: int) -> None:
        for edge in self._edges:
            self._edges[edge] += best in edge
        self.firing[best] = habituated(self.firing[best], TAU_WINNER)
        for node in self._neighbours(best):
            self.firing[node] = habituated(self.firing[node], TAU_NEIGHBOUR)

    def _prune(self) -> None:
        """Remove old edges, and the nodes that then have none."""
        old = [edge for edge, age in self._edges.items() if age > OLDEST_EDGE]
        if not old:
            return
        for edge in old:
            del self._edges[edge]
        kept = sorted({node for edge in self._edges for node in edge})
        number = {node: i for i, node in enumerate(kept)}
        self.weights = self.weights[kept]
        self.firing = [self.firing[node] for node in kept]
        self._edges = {(number[a], number[b]): age for (a, b), age in self._edges.items()}


class GwrSettings(ReadingSettings):
    """Settings of `Gwr`.

    Attributes
    ----------
    activity : float
        Least activity of a node that knows an input; higher makes more nodes.
    tired : float
        Firing below which a node counts as trained.
    nodes_max : int
        Most nodes of the network.
    threshold : float
        Least novelty, 0 to 1.
    apart_m : float
        Least distance between two marks, metres of path.
    """

    activity: Annotated[float, Field(gt=0.0, lt=1.0)] = 0.7
    tired: Annotated[float, Field(gt=0.0, lt=1.0)] = 0.3
    nodes_max: Annotated[int, Field(ge=2, le=10_000)] = 200
    threshold: Annotated[float, Field(gt=0.0, le=1.0)] = 0.9
    apart_m: Annotated[float, Field(gt=0.0, le=100.0)] = 1.5


class Gwr(ScoredDesignator):
    """Marks what the network has not met yet, or has not met often.

    Each 0.1 m of path the network meets the features of `readings.summary`, their distance
    being the root mean square of their differences. The strength is the novelty, 0 to 1:
    how fresh the node is that knows the scan best. Nodes do not recover, so that the second
    passage of a place is hardly novel.

    Parameters
    ----------
    settings : GwrSettings
        The network and the threshold.

    References
    ----------
    Marsland, Shapiro & Nehmzow (2002), "A self-organising network that grows when
    required", Neural Networks 15; as a robot's novelty filter: Marsland, Nehmzow & Shapiro
    (2005), "On-line novelty detection for autonomous mobile robots", Robotics and
    Autonomous Systems 51. The features, and that the first inputs begin the network: ours.
    """

    Settings: ClassVar[type[DesignatorSettings]] = GwrSettings
    GRID: ClassVar[Grid] = {
        "activity": (0.4, 0.55, 0.7),
        "threshold": (0.1, 0.25, 0.5, 0.75),
        "apart_m": (0.5, 1.0, 2.0, 4.0),
    }
    source: ClassVar[str] = "Marsland, Shapiro & Nehmzow 2002"

    def __init__(self, settings: GwrSettings) -> None:
        super().__init__(Peaks(settings.threshold, settings.apart_m))
        self._settings = settings
        self._network = GrowingNetwork(settings.activity, settings.tired, settings.nodes_max)

    def score(self, observation: Observation) -> float:
        """Return the novelty of a scan; NaN for one without an answer."""
        features = summary(observation.scan, self._settings)
        if features is None:
            return math.nan
        return self._network.meet(features / math.sqrt(len(SUMMARY)))
