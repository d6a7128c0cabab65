"""What perceiving a landmark tells of where its frame lies: a Kalman update that knows outliers.

Where a landmark lies is uncertain along the way to it, by how far path integration and the links
are off, and more so across it, by how uncertainly the frame is turned in which that way is known.
So a landmark that is perceived aside of where it was expected turns the frame as well.

Now and then one is perceived astray. What is perceived then is not spread about at random: it is
what else there is, and may well look like a copy of where the robot is not. So it counts as a hit
of a lesser kind, and is not made less probable by how much room there is to err in.
"""

from __future__ import annotations

import math
from typing import NamedTuple

from ssrics_like.memory.links import Link
from ssrics_like.poses import Pose

ASTRAY, ASTRAY_M = 0.2, 0.33
"""So often a landmark is perceived astray, and how far then (standard deviation)."""
ASKEW, ASKEW_RAD = 0.2, 0.9
"""So often its direction is mismeasured, and by how much then (standard deviation)."""


class Measured(NamedTuple):
    """A landmark's frame, now that it was perceived.

    Attributes
    ----------
    nats : float
        Minus the logarithm of how probable it was to perceive it so: 0 for one that was known for
        certain and hit.
    fix : Link
        The frame, in that of path integration; its variances are those that are left, of a hit and
        of an outlier on average.
    turned_rad : float
        By how much it is turned against what was expected.
    """

    nats: float
    fix: Link
    turned_rad: float


def measured_place(
    before: Link, onward: Link, drift: Link, place: Pose, place_sd_m: float
) -> Measured:
    """Perceive a landmark in a place.

    Parameters
    ----------
    before : Link
        The frame of the landmark before, in that of path integration.
    onward : Link
        Where the landmark is expected, seen from there.
    drift : Link
        How far path integration has gone astray since then; its pose is of no account.
    place : Pose
        Where it was perceived; its direction does not count here.
    place_sd_m : float
        How exactly landmarks are perceived (standard deviation).
    """
    start, seen = before.pose, place.seen_from(before.pose)
    expected_m = math.hypot(onward.pose.x_m, onward.pose.y_m)
    seen_m = math.hypot(seen.x_m, seen.y_m)
    bearing_rad = math.atan2(onward.pose.y_m, onward.pose.x_m)
    aside_rad = math.remainder(math.atan2(seen.y_m, seen.x_m) - bearing_rad, math.tau)
    # How much too far it is, and the chord by which it is aside: by the law of cosines their
    # squares add up to that of how far it is off, whatever the angle.
    far_m, lever_m2 = seen_m - expected_m, seen_m * expected_m
    aside_m2 = 4.0 * lever_m2 * math.sin(0.5 * aside_rad) ** 2
    along_m2 = before.variance_m2 + onward.variance_m2 + drift.variance_m2
    turning_m2 = before.variance_rad2 * lever_m2
    across_m2 = along_m2 + turning_m2

    def nats(variance_m2: float) -> float:
        along, across = along_m2 + variance_m2, across_m2 + variance_m2
        log_area = math.log(along * across / variance_m2**2)
        return 0.5 * (far_m**2 / along + aside_m2 / across + log_area)

    hit_m2, astray_m2 = place_sd_m**2, max(ASTRAY_M, place_sd_m) ** 2
    improbable, astray = _mixed(nats(hit_m2), nats(astray_m2), ASTRAY)
    along = along_m2 * _mean(1.0 / (along_m2 + hit_m2), 1.0 / (along_m2 + astray_m2), astray)
    weight = _mean(1.0 / (across_m2 + hit_m2), 1.0 / (across_m2 + astray_m2), astray)
    across, turning = weight * across_m2, weight * turning_m2
    turned_rad = turning * aside_rad
    length_m = expected_m + along * far_m
    direction_rad = start.theta_rad + bearing_rad + across * aside_rad
    fix = Link(
        Pose(
            start.x_m + length_m * math.cos(direction_rad),
            start.y_m + length_m * math.sin(direction_rad),
            math.remainder(start.theta_rad + onward.pose.theta_rad + turned_rad, math.tau),
        ),
        (1.0 - across) * across_m2,  # the greater of both
        (1.0 - turning) * before.variance_rad2 + onward.variance_rad2 + drift.variance_rad2,
    )
    return Measured(improbable, fix, turned_rad)


def measured_direction(fix: Link, turn_rad: float, direction_sd_rad: float) -> Measured:
    """Perceive a landmark's direction.

    Parameters
    ----------
    fix : Link
        The frame, as expected, in that of path integration.
    turn_rad : float
        By how much the direction differs from that of the frame, half a turn being no difference.
    direction_sd_rad : float
        How exactly it is perceived (standard deviation).
    """
    known_rad2 = fix.variance_rad2

    def nats(variance_rad2: float) -> float:
        both_rad2 = known_rad2 + variance_rad2
        return 0.5 * (turn_rad**2 / both_rad2 + math.log(both_rad2 / variance_rad2))

    hit_rad2, askew_rad2 = direction_sd_rad**2, max(ASKEW_RAD, direction_sd_rad) ** 2
    improbable, askew = _mixed(nats(hit_rad2), nats(askew_rad2), ASKEW)
    gain = known_rad2 * _mean(1.0 / (known_rad2 + hit_rad2), 1.0 / (known_rad2 + askew_rad2), askew)
    pose, turned_rad = fix.pose, gain * turn_rad
    turned = Pose(pose.x_m, pose.y_m, math.remainder(pose.theta_rad + turned_rad, math.tau))
    found = Link(turned, fix.variance_m2, (1.0 - gain) * known_rad2)
    return Measured(improbable, found, turned_rad)


def _mixed(hit: float, outlier: float, outliers: float) -> tuple[float, float]:
    """Return minus the logarithm of a mixture of two densities, and the outlier's share of it.

    Of both minus the logarithm is given, and how frequent outliers are.
    """
    least = min(hit, outlier)
    a, b = (1.0 - outliers) * math.exp(least - hit), outliers * math.exp(least - outlier)
    return least - math.log(a + b), b / (a + b)


def _mean(of_hit: float, of_outlier: float, outlier: float) -> float:
    return (1.0 - outlier) * of_hit + outlier * of_outlier
