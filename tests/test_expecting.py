"""How sure the model is of what memory answers, above all where it is in doubt."""

import math
from types import SimpleNamespace

import numpy as np
import pytest

from ssrics_like.expecting import UNSETTLED, Expecting
from ssrics_like.memory import Candidates, Chunk, Retrieval

NAMES = np.array(["L1", "L2", "L3"], np.object_)
FAMILIAR = np.array([0.0, -3.0, -1.0])
THRESHOLD = -13.0


def recalled(*matches, winner=0):
    """Return what memory answers, that being the sum of what speaks for each landmark."""
    none = np.zeros(len(NAMES))
    match = np.array(matches, float)
    found = Candidates(
        NAMES, FAMILIAR, none, match, none, FAMILIAR + match, THRESHOLD, winner=winner
    )
    return Retrieval(Chunk(NAMES[winner], "landmark", {}), 0.05, 0.0, found)


def odds(*matches):
    mean = np.logaddexp.reduce(FAMILIAR) - math.log(len(NAMES))
    return np.exp([*matches, THRESHOLD - mean])


def expecting(*, again=False, in_doubt=True, settled=True):
    whereabouts = SimpleNamespace(
        again=again, in_doubt=in_doubt, settled=lambda _name, _share: settled
    )
    return Expecting(whereabouts, None, lambda _reflex, _names: {}), whereabouts


def test_familiarity_does_not_count_for_a_robot_in_doubt():
    share = odds(-4.0, -2.0, -6.0)
    known, _ = expecting(in_doubt=False)
    assert known.confidence(recalled(-4.0, -2.0, -6.0)) == pytest.approx(
        math.exp(-4.0)
        / (np.exp(FAMILIAR + np.array([-4.0, -2.0, -6.0])).sum() + math.exp(THRESHOLD))
    )
    lost, _ = expecting()
    for winner in range(3):
        confidence = lost.confidence(recalled(-4.0, -2.0, -6.0, winner=winner))
        assert confidence == pytest.approx(share[winner] / share.sum())


def test_a_robot_that_is_lost_is_no_more_than_unsettled():
    lost, _ = expecting(settled=False)
    assert lost.confidence(recalled(-1.0, -20.0, -20.0)) == UNSETTLED


def test_several_looks_at_one_place_count_as_their_mean():
    lost, here = expecting()
    first, second = (-1.0, -3.0, -9.0), (-5.0, -1.0, -9.0)
    evidence, new = lost.noted(recalled(*first))
    elsewhere = lost._expected.elsewhere
    assert evidence == pytest.approx({n: m + elsewhere for n, m in zip(NAMES, first, strict=True)})
    assert new == recalled(*first).candidates.threshold_by_context
    here.again = True
    mean = np.mean([first, second], axis=0)
    share = odds(*mean)
    for _ in range(2):  # asking does not change what was seen
        confidence = lost.confidence(recalled(*second, winner=1))
        assert confidence == pytest.approx(share[1] / share.sum())
    evidence, _ = lost.noted(recalled(*second))
    assert [evidence[name] - elsewhere for name in NAMES] == pytest.approx(mean)
    here.again = False  # another place begins anew
    share = odds(*second)
    assert lost.confidence(recalled(*second)) == pytest.approx(share[0] / share.sum())


def test_looks_of_a_robot_that_knows_where_it_is_are_not_averaged():
    known, here = expecting(in_doubt=False)
    known.noted(recalled(-1.0, -3.0, -9.0))
    here.again = True
    evidence, _ = known.noted(recalled(-5.0, -1.0, -9.0))
    assert evidence["L1"] - known._expected.elsewhere == pytest.approx(-5.0)


def test_a_landmark_that_was_none_at_the_first_look_counts_as_seen_now():
    lost, here = expecting()
    lost.noted(recalled(-1.0, -3.0, -9.0))
    lost._looks[0].pop("L3")
    here.again = True
    evidence, _ = lost.noted(recalled(-1.0, -3.0, -5.0))
    assert evidence["L3"] - lost._expected.elsewhere == pytest.approx(-5.0)


def test_nothing_recalled_says_nothing():
    assert expecting()[0].noted(None) == ({}, 0.0)
