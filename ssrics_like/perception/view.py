"""A scan's view: a short descriptor by which a landmark can be recognised."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from ssrics_like.errors import SettingsError
from ssrics_like.perception.checks import require_ranges, scan_kernels

if TYPE_CHECKING:
    from numpy.typing import ArrayLike, NDArray


def describe_view(ranges_m: ArrayLike, view_beams: int) -> NDArray[np.float32]:
    """Return the view of a conditioned scan.

    The field of view is cut into `view_beams` equal parts and each is described
    by the median of its beams, so that one bad beam does not show. A part that
    is narrower than a beam takes the beam that covers it. The result is
    standardised (mean 0, length 1): the dot product of two views is their
    Pearson correlation. A part without a valid beam is put at the mean, and a
    constant view, or one with no valid beam at all, is all zeros.

    Views compare only between lasers with the same field of view.

    Parameters
    ----------
    ranges_m : array_like, shape (beams,)
        Conditioned readings in metres; a reading that is not finite is left out.
    view_beams : int
        Size of the view, 2 or more.

    Returns
    -------
    ndarray, shape (view_beams,), float32
    """
    view = np.empty(require_view_beams(view_beams), np.float32)
    scan_kernels().describe_view(require_ranges(ranges_m).copy(), view)
    return view


def require_view_beams(view_beams: Any) -> int:
    """Return `view_beams`, or raise `SettingsError` when a correlation over it has no meaning."""
    if not isinstance(view_beams, (int, np.integer)) or view_beams < 2:  # noqa: PLR2004
        raise SettingsError(f"view_beams is {view_beams!r}; expected a whole number, 2 or more")
    return int(view_beams)
