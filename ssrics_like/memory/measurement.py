"""What perceiving a landmark tells of where its frame lies: a Kalman update that knows outliers.

Where a landmark lies is uncertain by how far path integration and the links are off, and across the
way to it by how uncertainly the frame is turned in which that way is known. So a landmark that is
perceived aside of where it was expected, or turned, turns that frame as well.

Now and then one is perceived astray, or askew, or both, as a doorway is that is entered at a slant.
What is perceived then is not spread about at random: it is what else there is, and may well look
like a copy of where the robot is not. So it counts as a hit of a lesser kind, and is not made less
probable by how much room there is to err in.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from ssrics_like.memory.links import Link
from ssrics_like.poses import Pose

ASTRAY_M, ASKEW_RAD = 0.33, 0.9
"""How far astray a landmark is perceived now and then, and how far askew (standard deviations)."""
HIT, ASTRAY, ASKEW, BOTH = 0.7, 0.1, 0.1, 0.1
"""How often neither is so, the place only, the direction only, both."""


class Measured(NamedTuple):
    """A landmark's frame, now that it was perceived.

    Attributes
    ----------
    nats : float
        Minus the logarithm of how probable it was to perceive it so: 0 for one that was known for
        certain and hit.
    fix : Link
        The frame, in that of path integration. Its variances are the greatest along any line, and
        hold how far apart it lies by what may have happened, a hit or an outlier.
    turned_rad : float
        By how much the frame of the landmark before is turned against what was believed.
    """

    nats: float
    fix: Link
    turned_rad: float


def measured(
    before: Link,
    onward: Link,
    drift: Link,
    place: Pose,
    place_sd_m: float,
    direction_sd_rad: float = math.inf,
) -> Measured:
    """Perceive a landmark.

    Parameters
    ----------
    before : Link
        The frame of the landmark before, in that of path integration.
    onward : Link
        Where the landmark is expected, seen from there.
    drift : Link
        How far path integration has gone astray since then; its pose is of no account.
    place : Pose
        Where it was perceived, in the frame of path integration.
    place_sd_m, direction_sd_rad : float
        How exactly landmarks are perceived (standard deviations); infinite where no direction was.
    """
    way = _way(before, onward, drift, place)
    ways, hit_m2, astray_m2 = [way], place_sd_m**2, max(ASTRAY_M, place_sd_m) ** 2
    if math.isinf(direction_sd_rad):
        often = [(HIT + ASKEW, hit_m2, math.inf), (ASTRAY + BOTH, astray_m2, math.inf)]
    else:
        hit_rad2, askew_rad2 = direction_sd_rad**2, max(ASKEW_RAD, direction_sd_rad) ** 2
        often = [
            (HIT, hit_m2, hit_rad2), (ASTRAY, astray_m2, hit_rad2),
            (ASKEW, hit_m2, askew_rad2), (BOTH, astray_m2, askew_rad2),
        ]  # fmt: skip
        if abs(way.askew_rad) > 0.5 * math.pi:  # it may as well be turned the other way round
            other_rad = way.askew_rad - math.copysign(math.tau, way.askew_rad)
            ways.append(way._replace(askew_rad=other_rad))
    return _mixed([(n, each.ended(m2, rad2)) for each in ways for n, m2, rad2 in often])


class _Way(NamedTuple):
    """The way to a landmark, as it was believed and as it was perceived.

    Attributes
    ----------
    start, onward, place : Pose
        The frame before; the landmark's, seen from there; where it was perceived.
    frame_rad2 : float
        How uncertainly the frame before is turned (variance).
    off_m2, off_rad2 : float
        How far off the landmark may lie, and be turned, seen from a frame of which that is known.
    too_far_m, lever_m2 : float
        How much further it was perceived; the square of the lever with which it may be aside.
    aside_rad, askew_rad : float
        By how much the frame before seems to be turned, by place and by direction.
    """

    start: Pose
    onward: Pose
    place: Pose
    frame_rad2: float
    off_m2: float
    off_rad2: float
    too_far_m: float
    lever_m2: float
    aside_rad: float
    askew_rad: float

    def ended(self, place_m2: float, direction_rad2: float) -> Measured:
        """Return what is believed, if the landmark was perceived so exactly (variances).

        All hangs on how the frame before is turned: what is left then to explain is due to the
        landmark alone, and is shared out between what is believed of it and what was perceived.
        """
        off_m2, off_rad2 = self.off_m2 + place_m2, self.off_rad2 + direction_rad2
        by_place, by_direction = self.lever_m2 / off_m2, 1.0 / off_rad2
        told = 1.0 + self.frame_rad2 * (by_place + by_direction)
        seems_rad = by_place * self.aside_rad + by_direction * self.askew_rad
        turned_rad, left_rad2 = self.frame_rad2 / told * seems_rad, self.frame_rad2 / told
        # By the law of cosines the squares of both add up to that of how far it is off, whatever
        # the angle.
        aside_m2 = 4.0 * self.lever_m2 * math.sin(0.5 * (self.aside_rad - turned_rad)) ** 2
        square = (self.too_far_m**2 + aside_m2) / off_m2
        square += by_direction * (self.askew_rad - turned_rad) ** 2
        if turned_rad:
            square += turned_rad**2 / self.frame_rad2
        area = (off_m2 / place_m2) ** 2 * told * (1.0 + self.off_rad2 / direction_rad2)

        gain, turn_gain = self.off_m2 / off_m2, self.off_rad2 / off_rad2
        turned = Pose(self.start.x_m, self.start.y_m, self.start.theta_rad + turned_rad)
        at, place = turned.onward(self.onward), self.place
        fix = Link(
            Pose(
                at.x_m + gain * (place.x_m - at.x_m),
                at.y_m + gain * (place.y_m - at.y_m),
                at.theta_rad + turn_gain * (self.askew_rad - turned_rad),
            ),
            # Across the way, where it is greater.
            (1.0 - gain) * self.off_m2 + (1.0 - gain) ** 2 * self.lever_m2 * left_rad2,
            (1.0 - turn_gain) * self.off_rad2 + (1.0 - turn_gain) ** 2 * left_rad2,
        )
        return Measured(0.5 * (square + math.log(area)), fix, turned_rad)


def _way(before: Link, onward: Link, drift: Link, place: Pose) -> _Way:
    seen, expected = place.seen_from(before.pose), onward.pose
    seen_m, expected_m = math.hypot(seen.x_m, seen.y_m), math.hypot(expected.x_m, expected.y_m)
    aside_rad = math.atan2(seen.y_m, seen.x_m) - math.atan2(expected.y_m, expected.x_m)
    return _Way(
        before.pose, expected, place, before.variance_rad2,
        before.variance_m2 + onward.variance_m2 + drift.variance_m2,
        onward.variance_rad2 + drift.variance_rad2,
        seen_m - expected_m, seen_m * expected_m,
        math.remainder(aside_rad, math.tau),
        math.remainder(seen.theta_rad - expected.theta_rad, math.tau),
    )  # fmt: skip


def _mixed(kinds: list[tuple[float, Measured]]) -> Measured:
    """Return mean and variances of what may have been measured, each so often."""
    least = min(kind.nats for _, kind in kinds)
    odds = [often * math.exp(least - kind.nats) for often, kind in kinds]
    total = sum(odds)
    one = kinds[0][1].fix.pose
    x_m = y_m = turn_rad = turned_rad = square_m2 = square_rad2 = 0.0
    for odd, (_, kind) in zip(odds, kinds, strict=True):
        share, (pose, variance_m2, variance_rad2) = odd / total, kind.fix
        dx_m, dy_m = pose.x_m - one.x_m, pose.y_m - one.y_m
        turn = math.remainder(pose.theta_rad - one.theta_rad, math.tau)
        x_m, y_m, turn_rad = x_m + share * dx_m, y_m + share * dy_m, turn_rad + share * turn
        turned_rad += share * kind.turned_rad
        # Along the line on which they lie apart, where it is greatest.
        square_m2 += share * (variance_m2 + dx_m**2 + dy_m**2)
        square_rad2 += share * (variance_rad2 + turn**2)
    fix = Link(
        Pose(one.x_m + x_m, one.y_m + y_m, math.remainder(one.theta_rad + turn_rad, math.tau)),
        max(square_m2 - x_m**2 - y_m**2, 0.0),
        max(square_rad2 - turn_rad**2, 0.0),
    )
    return Measured(least - math.log(total), fix, turned_rad)
