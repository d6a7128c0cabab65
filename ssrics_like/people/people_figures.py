"""How people agree with one another: what no model need surpass."""

from __future__ import annotations

import numpy as np
from numpy.typing import NDArray

from ssrics_like.people.ceiling import people_against_others
from ssrics_like.people.figures import Crowd, Figure
from ssrics_like.people.raters import alpha, fleiss, mean_kappa, weighted_fleiss
from ssrics_like.people.resampling import interval, known_median, mean


def people_figures(crowd: Crowd, kappa: NDArray[np.float64]) -> dict[str, Figure]:
    """Return the figures of the people among themselves.

    Parameters
    ----------
    crowd : Crowd
        The people.
    kappa : ndarray, shape (people, people)
        Cohen's kappa of every pair of them.

    Returns
    -------
    dict of str to Figure
        Agreement of all of them, and the human ceiling: the mean over people of how each meets
        the consensus of the others. The keys are explained in `definitions`.
    """
    count = len(crowd)
    drawn_fleiss, drawn_alpha = weighted_fleiss(crowd.marked, crowd.weights)
    pairs = kappa[np.triu_indices(count, 1)]
    found = {
        "kappa_people": Figure(mean(pairs), interval(mean_kappa(kappa, crowd.weights), count)),
        "kappa_people_median": Figure(known_median(pairs)),
        "fleiss": Figure(fleiss(crowd.marked), interval(drawn_fleiss, count)),
        "alpha": Figure(alpha(crowd.marked), interval(drawn_alpha, count)),
    }
    return found | people_against_others(crowd)
