"""Places labels so that none covers another."""

from __future__ import annotations

import itertools
import math
from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

GLYPH_WIDTH = 0.65
"""Width of a digit or letter over the size of its font, a little on the wide side."""
LINE_STEP_PT = 1.5
LEGEND_GLYPH = 0.88
"""Words in a legend are longer than names, so that wide and narrow letters even out."""


class Room:
    """Keeps account of which boxes of a figure are taken, to place labels without overlap.

    Parameters
    ----------
    width_pt, height_pt : float
        Size of the axes; labels stay inside.
    """

    def __init__(self, width_pt: float, height_pt: float) -> None:
        self._size = width_pt, height_pt
        self._boxes: list[tuple[float, float, float, float]] = []
        self._lines = np.empty((0, 2))

    def take(self, x: float, y: float, half_width: float, half_height: float) -> None:
        """Note that a box around a point is taken."""
        self._boxes.append((x - half_width, y - half_height, x + half_width, y + half_height))

    def cross(self, points: NDArray[np.float64]) -> None:
        """Note a line, shape (n, 2): labels may lie on it, but rather not."""
        if len(points) < 2:  # noqa: PLR2004 - a point is no line
            return
        along = np.concatenate([[0.0], np.hypot(*np.diff(points, axis=0).T).cumsum()])
        steps = np.arange(0.0, along[-1], LINE_STEP_PT)
        dense = np.column_stack([np.interp(steps, along, points[:, axis]) for axis in (0, 1)])
        # A way gone a hundred times is still one line to a label.
        cells = np.unique(np.round(dense / LINE_STEP_PT), axis=0) * LINE_STEP_PT
        self._lines = np.unique(np.vstack([self._lines, cells]), axis=0)

    def find(
        self, candidates: Iterable[tuple[float, float]], half_width: float, half_height: float
    ) -> tuple[float, float] | None:
        """Return, and take, the candidate whose box is free and lies least on lines.

        Of equal ones the first; None if none is free.
        """
        boxes = np.array(self._boxes, np.float64).reshape(-1, 4)
        width, height = self._size
        best, fewest = None, math.inf
        for x, y in candidates:
            left, right = x - half_width, x + half_width
            low, high = y - half_height, y + half_height
            if left < 0 or low < 0 or right > width or high > height:
                continue
            clear = (
                (boxes[:, 0] >= right) | (boxes[:, 2] <= left)
                | (boxes[:, 1] >= high) | (boxes[:, 3] <= low)
            )  # fmt: skip
            if not clear.all():
                continue
            off = np.abs(self._lines - (x, y))
            crossed = int(((off[:, 0] < half_width) & (off[:, 1] < half_height)).sum())
            if crossed < fewest:
                best, fewest = (x, y), crossed
            if fewest == 0:
                break
        if best is not None:
            self.take(*best, half_width, half_height)
        return best


def around(
    x: float, y: float, gap: float, half_width: float, half_height: float
) -> list[tuple[float, float]]:
    """Return centres of eight boxes beside a point, the right one first."""
    dx, dy = gap + half_width, gap + half_height
    near = 0.75 * gap + half_width
    return [
        (x + dx, y), (x, y + dy), (x - dx, y), (x, y - dy),
        (x + near, y + dy), (x - near, y + dy), (x + near, y - dy), (x - near, y - dy),
    ]  # fmt: skip


def text_half_size(text: str, size_pt: float) -> tuple[float, float]:
    """Estimate half the width and height of a line of text, points."""
    return len(text) * GLYPH_WIDTH * size_pt / 2, size_pt * 0.55


def legend_grid(
    texts: Sequence[str], width_pt: float, size_pt: float = 8.0, around_pt: float = 24.0
) -> tuple[int, int]:
    """Return in how many columns and rows the entries of a legend fit into a width.

    Parameters
    ----------
    texts : sequence of str
        The entries' labels; a legend is filled column by column.
    width_pt : float
        What there is.
    size_pt : float
        Size of the font.
    around_pt : float
        Width of an entry's sign, and of what lies between two entries.
    """
    widths = [2 * text_half_size(text, size_pt)[0] * LEGEND_GLYPH + around_pt for text in texts]
    for rows in range(1, len(texts) + 1):
        columns = math.ceil(len(texts) / rows)
        # As matplotlib fills them: the first columns have one entry more than the last.
        fuller = len(texts) - columns * (rows - 1)
        ends = np.cumsum([rows if i < fuller else rows - 1 for i in range(columns)]).tolist()
        parts = itertools.pairwise([0, *ends])
        if sum(max(widths[a:b], default=0.0) for a, b in parts) <= width_pt:
            return columns, rows
    return 1, max(len(texts), 1)


def spread(wanted: Sequence[float], gap: float, low: float, high: float) -> list[float]:
    """Move values apart to at least `gap`, as little as need be, within limits, keeping order.

    Where they cannot all fit the gap shrinks.
    """
    count = len(wanted)
    if count == 0:
        return []
    gap = min(gap, (high - low) / max(count - 1, 1))
    order = np.argsort(np.asarray(wanted), kind="stable")
    # With the gaps taken out, the nearest rising sequence is an isotonic regression.
    shifted = [min(max(wanted[i], low), high) - k * gap for k, i in enumerate(order)]
    blocks: list[tuple[float, int]] = []
    for value in shifted:
        mean, size = value, 1
        while blocks and blocks[-1][0] > mean:
            before, n = blocks.pop()
            mean, size = (before * n + mean * size) / (n + size), n + size
        blocks.append((mean, size))
    level = [mean for mean, size in blocks for _ in range(size)]
    placed = [0.0] * count
    for k, i in enumerate(order):
        placed[i] = min(max(level[k], low), high - (count - 1) * gap) + k * gap
    return placed
