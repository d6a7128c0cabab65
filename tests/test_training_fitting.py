"""Trees grown by scikit-learn say the same as plain arrays."""

import sys

import numpy as np
import pytest

from ssrics_like.designators.optional import one_thread
from ssrics_like.errors import MissingPackageError, SettingsError
from ssrics_like.training import TrainingSettings, train_doorways
from ssrics_like.training.conversion import converted
from ssrics_like.training.fitting import grown

RNG = np.random.default_rng(8)
MEASURES = np.round(RNG.normal(size=(3000, 12)), 2).astype(np.float32)  # with ties, as cells make
TOLD = (MEASURES[:, 0] * MEASURES[:, 1] + 0.3 * RNG.normal(size=3000) > 0.4).astype(int)


def test_converted_trees_give_equal_probabilities():
    ensemble = pytest.importorskip("sklearn.ensemble")
    classifier = ensemble.HistGradientBoostingClassifier(
        max_iter=40, max_leaf_nodes=24, random_state=0
    )
    with one_thread():
        classifier.fit(MEASURES, TOLD)
    trees = converted(classifier)
    expected = classifier.predict_proba(MEASURES)[:, 1]
    found = [trees.probability(row) for row in MEASURES]
    assert np.abs(found - expected).max() < 1e-12
    assert np.ptp(expected) > 0.8
    assert len(trees.roots) == 40


def test_a_single_leaf_is_a_tree_too():
    ensemble = pytest.importorskip("sklearn.ensemble")
    classifier = ensemble.HistGradientBoostingClassifier(max_iter=3, min_samples_leaf=20)
    classifier.fit(MEASURES[:30], TOLD[:30])
    trees = converted(classifier)
    assert (trees.feature == -1).all()
    expected = classifier.predict_proba(MEASURES[:1])[0, 1]
    assert trees.probability(MEASURES[0]) == pytest.approx(expected, abs=1e-12)


def test_what_is_grown_tells_the_classes_and_a_seed_decides():
    pytest.importorskip("sklearn.ensemble")
    one, again, other = (grown(MEASURES, TOLD, seed, 1) for seed in (1, 1, 2))
    p = np.array([one.probability(row) for row in MEASURES])
    assert np.mean((p > 0.5) == TOLD) > 0.9
    assert np.array_equal(one.threshold, again.threshold)
    assert np.array_equal(one.value, again.value)
    assert len(one.value) != len(other.value) or not np.array_equal(one.value, other.value)


@pytest.mark.parametrize("told", [np.zeros(3000, int), np.ones(3000, int)])
def test_places_that_are_all_alike_teach_nothing(told):
    with pytest.raises(SettingsError, match="or none, lies in a doorway; expected more buildings"):
        grown(MEASURES, told, 0, 1)


def test_a_missing_scikit_learn_is_said_before_anything_is_driven(monkeypatch):
    monkeypatch.setitem(sys.modules, "sklearn.ensemble", None)
    said = []
    with pytest.raises(MissingPackageError, match=r"scikit-learn; pip install 'ssrics-like\[learn"):
        next(train_doorways(TrainingSettings(), 1, said.append))
    assert said == []
