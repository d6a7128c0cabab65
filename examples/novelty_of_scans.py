"""The report's novelty algorithm on scans of your own.

Makes scans of a robot that stands still, then walks, then stands still, and prints the
boredom quotient of each interval, in batch and scan by scan.
"""

from __future__ import annotations

import numpy as np

from ssrics_like import NoveltyDetector, novelty_profile
from ssrics_like.perception import correlation_histogram, is_novel

INTERVAL = 50


def scans() -> np.ndarray:
    """Return 300 scans of 180 beams in a corridor that bends while the robot walks."""
    rng = np.random.default_rng(0)
    bearings = np.radians(np.arange(-90, 90))
    bend = np.concatenate([np.zeros(100), np.linspace(0, 1, 100), np.ones(100)])
    ranges = 1.2 / np.maximum(np.abs(np.sin(bearings[None, :] - bend[:, None])), 0.15)
    return ranges + rng.normal(0, 0.01, ranges.shape)


def main() -> None:
    """Print tau and what it means for each interval."""
    walk = scans()
    for i, tau in enumerate(novelty_profile(walk, INTERVAL, advance="tumbling")):
        status = "NOVEL" if is_novel(tau, 0.75) else "not NOVEL"
        print(f"scans {i * INTERVAL:3d}-{(i + 1) * INTERVAL - 1:3d}: tau = {tau:.2f}, {status}")

    detector = NoveltyDetector(INTERVAL)
    taus = [tau for scan in walk if (tau := detector.update(scan)) is not None]
    print(f"streaming equals batch: {taus == novelty_profile(walk, INTERVAL).tolist()}")
    counts, _ = correlation_histogram(detector.correlations())
    print(f"histogram of the last interval: {counts.tolist()}")


if __name__ == "__main__":
    main()
