"""How the model senses: laser scans in, novelty and orienting reflexes out.

Everything here is pure: arrays and values in, values out. numba is imported
only when the first kernel runs.
"""

from ssrics_like.errors import ScanError
from ssrics_like.perception.conditioning import ConditionedScan, condition
from ssrics_like.perception.histogram import correlation_histogram
from ssrics_like.perception.marking import (
    EveryMarker,
    Marker,
    OnsetMarker,
    PeakMarker,
    make_marker,
)
from ssrics_like.perception.novelty import (
    NoveltyDetector,
    boredom_quotient,
    is_novel,
    novelty_profile,
    scan_correlations,
)
from ssrics_like.perception.novelty_watch import IntervalExample
from ssrics_like.perception.observation import LaserScan, Observation, Pose
from ssrics_like.perception.profile import PerceptionProfile
from ssrics_like.perception.reflex import PerceptionBuffer, Reflex
from ssrics_like.perception.sectors import Sector, SectorClassifier, classify
from ssrics_like.perception.view import describe_view

__all__ = [
    "ConditionedScan",
    "EveryMarker",
    "IntervalExample",
    "LaserScan",
    "Marker",
    "NoveltyDetector",
    "Observation",
    "OnsetMarker",
    "PeakMarker",
    "PerceptionBuffer",
    "PerceptionProfile",
    "Pose",
    "Reflex",
    "ScanError",
    "Sector",
    "SectorClassifier",
    "boredom_quotient",
    "classify",
    "condition",
    "correlation_histogram",
    "describe_view",
    "is_novel",
    "make_marker",
    "novelty_profile",
    "scan_correlations",
]
