"""Spreading activation: what is in the buffers brings related chunks to mind."""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence

import numpy as np
from numpy.typing import NDArray

from ssrics_like.memory.parameters import MemoryParameters


def association_strengths(
    occurrences: NDArray[np.float64], fan: int, strength: float, floor: float | None
) -> NDArray[np.float64]:
    """Strength S_ji from one source j to each chunk i.

    ``S_ji = S - ln(fan_j / n_ji)``, and 0 where the chunk has nothing to do with j.

    Parameters
    ----------
    occurrences : ndarray, shape (n,)
        n_ji: how often j stands in the slots of chunk i, and once more if i is j.
    fan : int
        fan_j: how often j stands in slots of all memory, plus one for j itself.
    strength : float
        S.
    floor : float or None
        Least strength of an association; None for no limit.

    Returns
    -------
    ndarray, shape (n,)

    References
    ----------
    Bothell, ACT-R 7.27+ Reference Manual, "Spreading activation"; Anderson (2007), ch. 3.
    """
    result = np.zeros(len(occurrences))
    linked = occurrences > 0
    strengths = strength - np.log(fan / occurrences[linked])
    result[linked] = strengths if floor is None else np.maximum(strengths, floor)
    return result


def spreading_activation(
    sources: Mapping[str, Sequence[str]],
    parameters: MemoryParameters,
    occurrences: Callable[[str], NDArray[np.float64]],
    fan: Callable[[str], int],
    count: int,
) -> NDArray[np.float64]:
    """Activation that each of `count` chunks receives from the buffers.

    ``sum over buffers k, sources j of (W_k / n_k) S_ji``, n_k being the number of
    sources in the buffer, with repetitions.

    Parameters
    ----------
    sources : mapping of str to sequence of str
        The symbols in the slots of the chunk in each buffer.
    parameters : MemoryParameters
        Gives S, its floor and W of each buffer.
    occurrences, fan : callable
        n_ji, shape (count,), and fan_j of a source.
    count : int
        Number of chunks.

    Returns
    -------
    ndarray, shape (count,)
    """
    total = np.zeros(count)
    if parameters.strength_of_association is None:
        return total
    for buffer, symbols in sources.items():
        weight = parameters.source_activation.get(buffer, 0.0)
        if weight == 0:
            continue
        for symbol in symbols:
            total += (weight / len(symbols)) * association_strengths(
                occurrences(symbol),
                fan(symbol),
                parameters.strength_of_association,
                parameters.association_floor,
            )
    return total
