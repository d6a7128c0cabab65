"""From scikit-learn's boosted trees to the project's own, which need no scikit-learn."""

from __future__ import annotations

from typing import Any

import numpy as np

from ssrics_like.perception.trees import BoostedTrees

LEAF = -1


def converted(classifier: Any) -> BoostedTrees:
    """Return the trees of a fitted classifier of two classes.

    Parameters
    ----------
    classifier : sklearn.ensemble.HistGradientBoostingClassifier
        Fitted to measures that are all numbers: what it does with missing ones, and with
        categories, is not carried over.

    Notes
    -----
    scikit-learn has no public way to its trees. What is read here has stood since its version
    1.0: ``_baseline_prediction`` and ``_predictors``, a table of nodes for each tree. A tree's
    first node is its root, and children are counted within the tree.
    """
    tables = [trees[0].nodes for trees in classifier._predictors]  # noqa: SLF001
    sizes = np.array([len(table) for table in tables])
    roots = np.concatenate([[0], sizes.cumsum()[:-1]]).astype(np.int32)
    nodes = np.concatenate(tables)
    first = np.repeat(roots, sizes)
    leaf = nodes["is_leaf"].astype(bool)

    def inner(values: Any, kind: type, otherwise: float) -> Any:
        return np.where(leaf, otherwise, values).astype(kind)

    return BoostedTrees(
        baseline=float(np.ravel(classifier._baseline_prediction)[0]),  # noqa: SLF001
        roots=roots,
        feature=inner(nodes["feature_idx"], np.int32, LEAF),
        threshold=inner(nodes["num_threshold"], np.float64, 0.0),
        left=inner(first + nodes["left"], np.int32, LEAF),
        right=inner(first + nodes["right"], np.int32, LEAF),
        value=np.where(leaf, nodes["value"], 0.0),
    )
