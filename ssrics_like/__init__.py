"""A cognitive architecture module that lets a robot mark landmarks the way people do.

The public names are loaded when they are first used, so that importing the
package, and asking the command line for help, costs next to nothing.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from ssrics_like.decision import Decision
    from ssrics_like.model import CognitiveModel
    from ssrics_like.perception.novelty import NoveltyDetector, novelty_profile
    from ssrics_like.perception.observation import LaserScan, Observation, Pose
    from ssrics_like.scenarios.modules import load_memory, load_perception, load_productions
    from ssrics_like.sources import open_log

__version__ = "0.1.0"

_HOMES = {
    "CognitiveModel": "ssrics_like.model",
    "Decision": "ssrics_like.decision",
    "LaserScan": "ssrics_like.perception.observation",
    "NoveltyDetector": "ssrics_like.perception.novelty",
    "Observation": "ssrics_like.perception.observation",
    "Pose": "ssrics_like.perception.observation",
    "load_memory": "ssrics_like.scenarios.modules",
    "load_perception": "ssrics_like.scenarios.modules",
    "load_productions": "ssrics_like.scenarios.modules",
    "novelty_profile": "ssrics_like.perception.novelty",
    "open_log": "ssrics_like.sources",
}

__all__ = [
    "CognitiveModel",
    "Decision",
    "LaserScan",
    "NoveltyDetector",
    "Observation",
    "Pose",
    "load_memory",
    "load_perception",
    "load_productions",
    "novelty_profile",
    "open_log",
]


def __getattr__(name: str) -> Any:
    """Load a public name from its home."""
    home = _HOMES.get(name)
    if home is None:
        raise AttributeError(f"module 'ssrics_like' has no attribute '{name}'")
    return getattr(importlib.import_module(home), name)


def __dir__() -> list[str]:
    return sorted([*globals(), *__all__])
