"""Growing the trees: gradient boosting by scikit-learn.

References
----------
Friedman (2001), "Greedy function approximation: a gradient boosting machine", Annals of
Statistics 29. Ke et al. (2017), "LightGBM", for the histograms that make it fast.
"""

from __future__ import annotations

import importlib
from typing import TYPE_CHECKING, Any, NamedTuple

from ssrics_like.errors import MissingPackageError, SettingsError
from ssrics_like.training.conversion import converted

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


class Size(NamedTuple):
    """How large the trees are to be.

    Attributes
    ----------
    trees : int
        How many.
    leaves : int
        At most so many in each.
    rate : float
        What part of what is still wrong the next tree puts right.
    """

    trees: int = TREES
    leaves: int = LEAVES
    rate: float = RATE


def grown(
    measures: NDArray[np.float32],
    told: ArrayLike,
    seed: int,
    jobs: int,
    size: Size = Size(),  # noqa: B008 - it cannot be changed
    what: str = "lies in a doorway",
) -> BoostedTrees:
    """Grow trees that tell places of one kind from all others.

    Parameters
    ----------
    measures : ndarray, shape (places, features)
        What the places look like.
    told : array_like, shape (places,)
        1 for each of the kind, 0 for each other.
    seed : int
        Of the measures that each split may ask for, and of the places that histograms are made of.
    jobs : int
        Threads that work at the same time; it makes no difference to the result.
    size : Size
        How large the trees are to be.
    what : str
        What a place of the kind does, to say so if there is none.

    Raises
    ------
    SettingsError
        All places are alike.
    MissingPackageError
        scikit-learn is not installed.
    """
    kinds = set(map(int, told))  # type: ignore[arg-type]
    if kinds != {0, 1}:
        raise SettingsError(
            f"nothing to learn: every place on the drives, or none, {what}; expected more buildings"
        )
    classifier = learner().HistGradientBoostingClassifier(
        max_iter=size.trees, learning_rate=size.rate, max_leaf_nodes=size.leaves,
        min_samples_leaf=LEAST_IN_LEAF, l2_regularization=L2, max_features=MEASURES,
        early_stopping=False, random_state=seed,
    )  # fmt: skip
    # scikit-learn itself depends on threadpoolctl.
    threads = importlib.import_module("threadpoolctl")
    with threads.threadpool_limits(limits=jobs, user_api="openmp"):
        classifier.fit(measures, told)
    return converted(classifier)
