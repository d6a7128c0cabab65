"""A layout: where landmarks lie in one frame, if the arcs are made to agree as well as they can.

For drawing and for other programs only: recognition goes by the links, which need not agree.
"""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, NamedTuple

import numpy as np
from numpy.typing import NDArray
from scipy.sparse import coo_array, diags_array
from scipy.sparse.linalg import spsolve

from ssrics_like.memory.landmark import Arc, Landmark
from ssrics_like.memory.links import Link, Links
from ssrics_like.memory.statistics import wrapped
from ssrics_like.poses import Pose

if TYPE_CHECKING:
    from ssrics_like.memory.saved import SavedMemory

Floats = NDArray[np.float64]
Indices = NDArray[np.int64]

STEPS_MAX = 100
"""Links of drives need 7 to 20; more than this only directions that are hardly known at all."""
STILL = 1e-9
"""Metres and radians: a step so small ends it, far below the 6 decimals of files."""
ROUNDING = 1e-12
"""Share by which the cost may seem to grow because it is rounded."""
DAMPING = 1e-3
"""First damping after a step that made it worse; then ten times as much, or a tenth."""


class Placed(NamedTuple):
    """Where a landmark lies in a layout.

    Attributes
    ----------
    pose : Pose
        Its frame: the middle of a doorway and the direction through, else where the laser was.
    component : int
        Number of the part of the graph that it belongs to; 0 is that of the first landmark.
    """

    pose: Pose
    component: int


def layout_of(memory: SavedMemory) -> dict[str, Placed]:
    """Lay the landmarks of a saved memory, as :func:`relaxed_layout`.

    All positions on a map are in one frame; in any other, each run has a frame of its own.
    """
    runs = {name: origin.rpartition("/")[0] for name, origin in memory.origins.items()}
    return relaxed_layout(memory.landmarks, memory.arcs, {} if memory.frame == "map" else runs)


def relaxed_layout(
    landmarks: Sequence[Landmark], arcs: Iterable[Arc], frames: Mapping[str, str] | None = None
) -> dict[str, Placed]:
    """Lay landmarks where they contradict the arcs least (weighted least squares).

    Of all poses p, theta those are taken that make least, summed over the arcs,

        |R_i^T (p_j - p_i) - z|^2 / position_sd_m^2
        + (theta_j - theta_i - phi)^2 / direction_sd_rad^2

    z and phi being the pose of the landmark j in the frame of i as the arc tells it, R_i the
    rotation by theta_i, and the difference of directions within (-pi, pi]. A link keeps a
    landmark's own direction from whichever side it was met, so that none is half a turn off.

    Parameters
    ----------
    landmarks : sequence of Landmark
        All that the arcs join, in the order in which they were declared.
    arcs : iterable of Arc
        An arc there and the one back tell of one link, seen from either end (see `Links`): of the
        two only the first counts, as where a memory is restored. One without geometry
        (`position_sd_m` is 0, as in files of earlier versions), or from a landmark to itself, tells
        nothing.
    frames : mapping of str to str, optional
        By landmark, the name of the frame in which it was declared, for example its run; those
        that are not in it have one in common.

    Returns
    -------
    dict of str to Placed
        In the order of `landmarks`. A component is what arcs with geometry join, either way; a
        landmark that only others join to the rest is a component of its own.

        The arcs leave open where a component lies as a whole. It is moved and turned, not
        stretched, so that it fits best to where its landmarks were declared: one of a single
        landmark stays where that is. Only those count that were declared in the frame of the
        component's first landmark, so that what later runs add, each with an odometry frame of
        its own, does not turn the picture. Where components lie from one another is as uncertain
        as what odometry says of it, and unknown between frames.

    Raises
    ------
    KeyError
        If an arc begins or ends at no landmark.

    References
    ----------
    Lu & Milios (1997), "Globally consistent range scan alignment for environment mapping",
    Autonomous Robots 4: the sum. Marquardt (1963), "An algorithm for least-squares estimation of
    nonlinear parameters", SIAM J. Appl. Math. 11: the way to its minimum. Kabsch (1976), "A
    solution for the best rotation to relate two sets of vectors", Acta Cryst. A32: the fit.
    """
    order = {landmark.id: index for index, landmark in enumerate(landmarks)}
    links, told = _links(order, arcs)
    frames = {} if frames is None else frames
    poses = np.zeros((len(landmarks), 3))
    components: list[Indices] = []
    component_of = np.full(len(landmarks), -1)
    for index, first in enumerate(landmarks):
        if component_of[index] < 0:
            # Along the most certain ways, so that what follows begins near its end.
            chained = links.seen_from(first.id, most=len(landmarks))
            members = np.array([order[name] for name in chained])
            start = Pose(first.x_m, first.y_m, first.theta_rad)
            poses[members] = [_row(start.onward(link.pose)) for link in chained.values()]
            component_of[members] = len(components)
            components.append(members)
    if told:
        poses = _relaxed(_Ways.of(order, told), poses, [members[0] for members in components])
    for members in components:
        frame = frames.get(landmarks[members[0]].id)
        sure = [k for k in members.tolist() if frames.get(landmarks[k].id) == frame]
        declared = np.array([(landmarks[k].x_m, landmarks[k].y_m) for k in sure])
        poses[members] = _fitted(poses[members], poses[sure, :2], declared)
    return {
        name: Placed(Pose(x_m, y_m, wrapped(theta_rad)), component)
        for (name, (x_m, y_m, theta_rad), component) in zip(
            order, poses.tolist(), component_of.tolist(), strict=True
        )
    }


def _row(pose: Pose) -> tuple[float, float, float]:
    return pose.x_m, pose.y_m, pose.theta_rad


def _links(
    order: Mapping[str, int], arcs: Iterable[Arc]
) -> tuple[Links, list[tuple[str, str, Link]]]:
    """Return the links that arcs tell, to follow and as a list."""
    links = Links()
    told = []
    for arc in arcs:
        one, other = arc.from_id, arc.to_id
        if not {one, other} <= order.keys():
            raise KeyError(f"arc from '{one}' to '{other}' joins no landmarks")
        if one == other or arc.position_sd_m <= 0.0 or links.between(one, other) is not None:
            continue
        variances = arc.position_sd_m**2, arc.direction_sd_rad**2
        link = Link(Pose(arc.x_m, arc.y_m, arc.theta_rad), *variances).bounded
        links.relate(one, other, link)
        told.append((one, other, link))
    return links, told


class _Ways(NamedTuple):
    """What links tell, as arrays of a row each.

    Attributes
    ----------
    i, j : ndarray of int, shape (links,)
        Index of the landmark where it begins, and of the one that is seen from there.
    steps : ndarray, shape (links, 3)
        Pose of the one in the frame of the other: x, y in metres, theta in radians.
    per_sd : ndarray, shape (links, 3)
        One over the standard deviation of each.
    """

    i: Indices
    j: Indices
    steps: Floats
    per_sd: Floats

    @classmethod
    def of(cls, order: Mapping[str, int], told: Sequence[tuple[str, str, Link]]) -> _Ways:
        variances = np.array([[link.variance_m2] * 2 + [link.variance_rad2] for *_, link in told])
        return cls(
            np.array([order[one] for one, _, _ in told]),
            np.array([order[other] for _, other, _ in told]),
            np.array([_row(link.pose) for *_, link in told]),
            1.0 / np.sqrt(variances),
        )

    def seen(self, poses: Floats) -> Floats:
        """Return `steps` as they would be with landmarks at `poses`, shape (landmarks, 3)."""
        dx, dy, turn = (poses[self.j] - poses[self.i]).T
        cos, sin = self._headings(poses)
        return np.column_stack([cos * dx + sin * dy, cos * dy - sin * dx, turn])

    def misfit(self, poses: Floats) -> Floats:
        """Return by how many standard deviations that differs from what was told, flat."""
        off = self.seen(poses) - self.steps
        off[:, 2] -= math.tau * np.round(off[:, 2] / math.tau)
        return (off * self.per_sd).ravel()

    def slopes(self, poses: Floats) -> coo_array:
        """Return the derivatives of that, shape (3 links, 3 landmarks)."""
        x, y, _ = self.seen(poses).T
        cos, sin = self._headings(poses)
        one = np.ones(len(x))
        entries = (  # of what is seen, by which coordinate of which landmark, how much
            (0, 0, self.i, -cos), (0, 1, self.i, -sin), (0, 2, self.i, y),
            (1, 0, self.i, sin), (1, 1, self.i, -cos), (1, 2, self.i, -x),
            (0, 0, self.j, cos), (0, 1, self.j, sin),
            (1, 0, self.j, -sin), (1, 1, self.j, cos),
            (2, 2, self.i, -one), (2, 2, self.j, one),
        )  # fmt: skip
        row = 3 * np.arange(len(x))
        rows = np.concatenate([row + seen for seen, *_ in entries])
        columns = np.concatenate([3 * k + coordinate for _, coordinate, k, _ in entries])
        values = np.concatenate([by for *_, by in entries]) * self.per_sd.ravel()[rows]
        return coo_array((values, (rows, columns)), shape=(3 * len(x), poses.size))

    def _headings(self, poses: Floats) -> tuple[Floats, Floats]:
        return np.cos(poses[self.i, 2]), np.sin(poses[self.i, 2])


def _relaxed(ways: _Ways, poses: Floats, fixed: Sequence[int]) -> Floats:
    """Return the poses of least misfit, the fixed landmarks staying where they are."""
    loose = np.ones(poses.shape, bool)
    loose[fixed] = False
    damping, misfit = 0.0, ways.misfit(poses)
    for _ in range(STEPS_MAX if loose.any() else 0):
        slopes = ways.slopes(poses).tocsr()[:, loose.ravel()]
        normal = slopes.T @ slopes
        damped = normal + damping * diags_array(normal.diagonal())
        # Solved at once and not by conjugate gradients, as scipy's own least squares would: those
        # take longer, and end too early for six decimals that are the same everywhere.
        step = spsolve(damped.tocsc(), -(slopes.T @ misfit), use_umfpack=False)
        tried = poses.copy()
        tried[loose] += step
        misfit_there = ways.misfit(tried)
        if _cost(misfit_there) <= _cost(misfit) * (1.0 + ROUNDING):
            poses, misfit, damping = tried, misfit_there, damping / 10.0
        else:
            damping = max(10.0 * damping, DAMPING)
        if np.abs(step).max() < STILL:
            break
    return poses


def _cost(misfit: Floats) -> float:
    return float(np.sum(misfit**2))


def _fitted(poses: Floats, sure: Floats, declared: Floats) -> Floats:
    """Move and turn poses as one, so that those that are sure come nearest to the declared ones.

    Parameters
    ----------
    poses : ndarray, shape (members, 3)
        All that are moved.
    sure, declared : ndarray, shape (sure, 2)
        Positions of some of them, and where these should be. If they tell no direction, because
        all of either are at one place, nothing is turned.
    """
    centre, goal = sure.mean(axis=0), declared.mean(axis=0)
    a, b = sure - centre, declared - goal
    turn = math.atan2(float(np.sum(a[:, 0] * b[:, 1] - a[:, 1] * b[:, 0])), float(np.sum(a * b)))
    cos, sin = math.cos(turn), math.sin(turn)
    x, y = (poses[:, :2] - centre).T
    moved = np.column_stack([cos * x - sin * y, sin * x + cos * y]) + goal
    return np.column_stack([moved, poses[:, 2] + turn])
