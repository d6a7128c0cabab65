"""What surrounds a place in a room, as a robot that looks round sees it."""

import math

import numpy as np

LEFT, RIGHT, BELOW, ABOVE = -2.0, 5.0, -1.5, 3.0  # walls of a room


def seen_in_room(place, *, known=36):
    """Return how far the walls of the room are in 36 directions, of which the last are unknown."""
    angles = place.theta_rad + np.arange(36) * math.tau / 36
    cos, sin = np.cos(angles) + 1e-9, np.sin(angles) + 1e-9  # no wall is met exactly along another
    x_m = np.where(cos > 0, max(RIGHT - place.x_m, 0.0), min(LEFT - place.x_m, 0.0))
    y_m = np.where(sin > 0, max(ABOVE - place.y_m, 0.0), min(BELOW - place.y_m, 0.0))
    lengths = np.minimum(np.abs(x_m / cos), np.abs(y_m / sin)).clip(0.0, 6.0)
    unknown = np.where(np.arange(36) < known, 0.0, 6.0)
    return np.concatenate([lengths, unknown, np.zeros(36)]).astype(np.float32)
