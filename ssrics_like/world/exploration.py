"""Frontier exploration: drive to where the known free space borders on the unknown.

References
----------
Yamauchi (1997), "A frontier-based approach for autonomous exploration"; (1998), "Frontier-based
exploration using multiple robots", which the report used. As there, the robot goes to the nearest
frontier that it can get to. Other than there, it turns to another as soon as this one has been
looked across, need not drive all the way, and looks at the frontier rather than all around.
"""

from __future__ import annotations

from typing import TYPE_CHECKING

import numpy as np

from ssrics_like.world import frontier_kernels, way_kernels
from ssrics_like.world.motion_kernels import ARRIVED
from ssrics_like.world.navigation import Errand
from ssrics_like.world.occupancy import SQUEEZE, TIGHT

if TYPE_CHECKING:
    from numpy.typing import NDArray

    from ssrics_like.world.navigation import Surveyor

LEAST_M = 0.3  # a shorter frontier is a gap between beams or noise
PEEK_M = 0.35  # from this near a frontier can be looked across
TRIES = 2  # a frontier that was gone to in vain so often is left
SET_ASIDE_M = 0.5  # what is left, around where the robot looked
HOLD_S = 0.5  # between choices, or the robot could waver
CHECK_S = 0.5  # between looks at whether the way is still open
FORGETS = 10  # how often it looks again behind what has come to stand in the way
PATIENCE_S = 10.0  # for a way to open, before what is left is given up
RETRY_S = 1.0
LOOKS = 2  # scans taken at a frontier; if the next still shows it, it is set aside


class Exploration:
    """The leg ``explore: frontier``: it ends when no frontier is left that can be reached."""

    ending = "no frontier left"

    def __init__(self) -> None:
        self.notes: list[str] = []
        self.set_aside = 0
        self._target: tuple[int, int] | None = None
        self._chosen_s = 0.0
        self._checked_s = 0.0
        self._looks = 0
        self._forgets = 0
        self._left = False
        self._waiting_s: float | None = None

    def begin(self, navigator: Surveyor, t_s: float) -> None:
        """Make room for planning."""
        shape = navigator.explored.evidence.shape
        self._tried = np.zeros(shape, np.uint8)
        self._goals = np.empty(shape, np.int32)
        self._distance = np.empty(shape, np.int32)
        self._parent = np.empty(shape, np.int32)
        self._chosen_s = self._checked_s = t_s

    def next(self, navigator: Surveyor, t_s: float, *, stuck: bool) -> Errand | None:
        """Go on to the frontier, or choose another."""
        errand = navigator.errand
        if self._waiting_s is not None and t_s - self._checked_s < RETRY_S:
            return errand
        if self._target is None or navigator.moved_away:
            return self._choose(navigator, t_s)
        if not self._is_frontier(navigator, self._target):
            if t_s - self._chosen_s >= HOLD_S or errand.status == ARRIVED:
                return self._choose(navigator, t_s)
        elif errand.status == ARRIVED:
            self._looks += 1
            if self._looks > LOOKS:
                return self._set_aside(navigator, t_s)
        elif stuck:
            return self._set_aside(navigator, t_s)
        elif t_s - self._checked_s >= CHECK_S:
            self._checked_s = t_s
            if not navigator.explored.is_open(errand.way, errand.at):
                return self._choose(navigator, t_s)
        return errand

    def _set_aside(self, navigator: Surveyor, t_s: float) -> Errand | None:
        """Leave the frontier for later: others come first."""
        assert self._target is not None
        evidence = navigator.explored.evidence
        around = round(SET_ASIDE_M / navigator.cell_m)
        frontier_kernels.set_aside(evidence, self._tried, *self._target, around)
        self.set_aside += 1
        return self._choose(navigator, t_s)

    def _choose(self, navigator: Surveyor, t_s: float) -> Errand | None:
        """Plan the way to the nearest frontier; where none leads to any, wait, give up in the end.

        What stands where it was free before may have gone again, unseen: the robot looks there
        first. Somebody who stands in the only doorway may go soon.
        """
        self._checked_s = t_s
        errand = self._nearest(navigator, t_s)
        if errand is None and self._forgets < FORGETS and navigator.explored.forget_moved():
            self._forgets += 1
            errand = self._nearest(navigator, t_s)
        if errand is not None:
            self._waiting_s = None
        elif self._left:
            if self._waiting_s is None:
                self._waiting_s = t_s
            if t_s - self._waiting_s < PATIENCE_S:
                return Errand()
        return errand

    def _nearest(self, navigator: Surveyor, t_s: float) -> Errand | None:
        """Plan the way to the nearest frontier, those never tried before first.

        What was looked at in vain is looked at from as near as the body gets, then from anywhere.
        """
        grid, cell_m = navigator.explored, navigator.cell_m
        least, peek = round(LEAST_M / cell_m), round(PEEK_M / cell_m)
        costs = grid.costs()
        # At first it looks from where it can turn at ease.
        for tries, near, dearest in ((1, peek, TIGHT), (TRIES, 1, SQUEEZE), (TRIES, peek, SQUEEZE)):
            self._left = bool(
                frontier_kernels.frontier_goals(
                    grid.evidence, self._tried, tries, least, near, self._goals
                )
            )
            if not self._left:
                continue
            goal = way_kernels.spread(
                costs, self._goals, navigator.cell(), dearest, self._distance, self._parent
            )
            if goal < 0:
                continue
            row, column = divmod(int(self._goals.flat[goal]), costs.shape[1])
            self._target = (row, column)
            self._chosen_s = self._checked_s = t_s
            self._looks = 0
            way: NDArray[np.float64] = way_kernels.straightened(
                costs, way_kernels.way_to(self._parent, goal, cell_m), cell_m
            )
            end = divmod(goal, costs.shape[1])
            face_rad = frontier_kernels.facing(grid.evidence, end, (row, column), peek)
            return Errand(way, face_rad)
        self._target = None
        return None

    def _is_frontier(self, navigator: Surveyor, cell: tuple[int, int]) -> bool:
        evidence = navigator.explored.evidence
        return bool(evidence[cell] < 0 and frontier_kernels.borders_unknown(evidence, *cell))
