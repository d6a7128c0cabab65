"""What a landmark is worth: salience, relevance, permanence, as numbers of their own.

They are named after Gillner et al. (2008): how much it stands out, how much the way has to be
chosen there, how probably it is there still. The formulas are this project's.
"""

from __future__ import annotations

import math
from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import NDArray


class Worth(NamedTuple):
    """Three numbers of one landmark.

    Attributes
    ----------
    salience : float or None
        How surprising its view is among those in memory, bits; None without a view.
    relevance : float
        How much it is a place to choose the way at, bits times use.
    permanence : float
        How probable it is that it is still there, 0 to 1.
    """

    salience: float | None
    relevance: float
    permanence: float


def surprise(likeness: NDArray[np.float64]) -> float:
    """Return how surprising a view is: ``-log2((1 + sum_j exp(s_j)) / (n + 1))``.

    Surprise is the negative logarithm of a probability (Shannon 1948), here of meeting a view like
    this one: the mean, over the others and itself, of how well each would do for it.

    Parameters
    ----------
    likeness : ndarray, shape (n,)
        Logarithm s_j of how well each of the other views would do for this one; 0 for the same.

    Returns
    -------
    float
        Bits: 0 where all look alike, or there is no other; log2(n + 1) for one like no other.
    """
    alike = 1.0 + float(np.exp(likeness).sum())
    return max(0.0, math.log2((len(likeness) + 1) / alike))


def choice(traversals: Sequence[int]) -> float:
    """Return the entropy of the ways at a landmark: ``-sum p log2 p``, by their use.

    Parameters
    ----------
    traversals : sequence of int
        How often each way was gone, there and back together.

    Returns
    -------
    float
        Bits: 0 at a dead end, 1 with two ways used alike, 2 with four.
    """
    total = sum(traversals)
    return sum(n / total * math.log2(total / n) for n in traversals if n > 0)


def relevance(traversals: Sequence[int], mean: float) -> float:
    """Return how much a landmark matters for finding ways: choice times use.

    Parameters
    ----------
    traversals : sequence of int
        How often each way at it was gone, there and back together.
    mean : float
        Sum of these, on the average of all landmarks.

    Returns
    -------
    float
        0 or more; 0 where nothing was gone.
    """
    return choice(traversals) * sum(traversals) / mean if mean > 0 else 0.0


def permanence(
    *,
    lasted_s: float,
    unseen_s: float,
    confirmed: int,
    missed: int,
    missed_since: int,
    lasting_s: float,
) -> float:
    """Return how probable it is that something is still there.

    ``(S + s0) q^k / ((S + s0) q^k + a)``: it has lasted S and was not confirmed for a time a, in
    which k opportunities to see it were missed. What has lasted S lasts another a with probability
    (S + s0) / (S + s0 + a), if all that is known of how long such things last is S, and that one
    seen once lasts s0 or longer half of the time. q is the chance of missing what is there, by
    Laplace's rule of succession: ``1 - (c + 1) / (c + m + 2)``.

    Parameters
    ----------
    lasted_s : float
        S, from the first to the last confirmation, seconds.
    unseen_s : float
        a, since the last confirmation, seconds.
    confirmed, missed : int
        c and m, confirmations after the first, and opportunities missed before the last.
    missed_since : int
        k, opportunities missed since.
    lasting_s : float
        s0, seconds, above 0.

    Returns
    -------
    float
        0 to 1; 1 for what is being seen.

    References
    ----------
    Rosen, D. M., Mason, J. & Leonard, J. J. (2016). Towards lifelong feature-based mapping in
    semi-static environments. ICRA. Their persistence filter, with two simplifications: nothing is
    seen where it is not, and what is gone was gone before the first opportunity missed.
    """
    if unseen_s <= 0.0:
        return 1.0
    miss = (missed + 1) / (confirmed + missed + 2)
    # Logarithm of the odds that it is gone: q^k may be too small for a number.
    gone = math.log(unseen_s) - math.log(max(0.0, lasted_s) + lasting_s)
    gone -= missed_since * math.log(miss)
    return 1.0 / (1.0 + math.exp(gone)) if gone < 0.0 else math.exp(-gone) / (1.0 + math.exp(-gone))
