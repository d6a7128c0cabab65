"""Growing the trees: gradient boosting by scikit-learn.

References
----------
Friedman (2001), "Greedy function approximation: a gradient boosting machine", Annals of
Statistics 29. Ke et al. (2017), "LightGBM", for the histograms that make it fast.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any

from ssrics_like.errors import MissingPackageError, SettingsError
from ssrics_like.training.conversion import converted
from ssrics_like.training.labels import DOORWAY, NOT

if TYPE_CHECKING:
    import numpy as np
    from numpy.typing import ArrayLike, NDArray

    from ssrics_like.perception.trees import BoostedTrees

TREES, RATE, LEAVES, LEAST_IN_LEAF, L2, MEASURES = 200, 0.08, 24, 60, 1.0, 0.3
"""Ours."""


def learner() -> Any:
    """Return ``sklearn.ensemble``.

    Raises
    ------
    MissingPackageError
        scikit-learn is not installed.
    """
    try:
        return importlib.import_module("sklearn.ensemble")
    except ImportError:
        raise MissingPackageError(
            "training needs the package scikit-learn; pip install 'ssrics-like[learn]'"
        ) from None


def learner_version() -> str:
    """Return the version of scikit-learn; raises as `learner`."""
    learner()
    return str(importlib.import_module("sklearn").__version__)


def grown(measures: NDArray[np.float32], told: ArrayLike, seed: int, jobs: int) -> BoostedTrees:
    """Grow trees that tell doorways.

    Parameters
    ----------
    measures : ndarray, shape (places, features)
        What the places look like.
    told : array_like, shape (places,)
        DOORWAY or NOT for each.
    seed : int
        Of the measures that each split may ask for, and of the places that histograms are made of.
    jobs : int
        Threads that work at the same time; it makes no difference to the result.

    Raises
    ------
    SettingsError
        All places are alike.
    MissingPackageError
        scikit-learn is not installed.
    """
    kinds = set(map(int, told))  # type: ignore[arg-type]
    if kinds != {DOORWAY, NOT}:
        raise SettingsError(
            "nothing to learn: of the places on the drives all or none lie in doorways; "
            "expected more buildings"
        )
    classifier = learner().HistGradientBoostingClassifier(
        max_iter=TREES, learning_rate=RATE, max_leaf_nodes=LEAVES, min_samples_leaf=LEAST_IN_LEAF,
        l2_regularization=L2, max_features=MEASURES, early_stopping=False, random_state=seed,
    )  # fmt: skip
    # scikit-learn itself depends on threadpoolctl.
    threads = importlib.import_module("threadpoolctl")
    with threads.threadpool_limits(limits=jobs, user_api="openmp"):
        classifier.fit(measures, told)
    return converted(classifier)
