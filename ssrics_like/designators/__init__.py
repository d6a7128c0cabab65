"""Baselines that mark places on a drive, behind one small protocol.

Each is found by a name and made for one drive; what marks are worth is said elsewhere
(`ssrics_like.comparison`).
"""

from ssrics_like.designators.boosted_scan import ScanModel, train
from ssrics_like.designators.peaks import Peaks, ScoredDesignator
from ssrics_like.designators.protocol import (
    Designator,
    DesignatorKind,
    DesignatorSettings,
    Mark,
    designate,
)
from ssrics_like.designators.registry import (
    add_designator,
    designator_kind,
    designator_names,
    make_designator,
)
from ssrics_like.designators.scan_features import scan_features
from ssrics_like.designators.tuning import Trial, trials, tune

__all__ = [
    "Designator",
    "DesignatorKind",
    "DesignatorSettings",
    "Mark",
    "Peaks",
    "ScanModel",
    "ScoredDesignator",
    "Trial",
    "add_designator",
    "designate",
    "designator_kind",
    "designator_names",
    "make_designator",
    "scan_features",
    "train",
    "trials",
    "tune",
]
