"""Telling a slip of the pen from a word of somebody else's."""

from __future__ import annotations

import difflib
from collections.abc import Iterable

CUTOFF = 0.75
"""Similarity from which a word is a slip of another: 'resoluton' is one, 'map_type' is not."""


def misspelt(word: str, known: Iterable[str]) -> bool:
    """Tell whether a word that is not known is probably meant to be one that is.

    Maps and tables come from many tools, which add keys and columns of their own; those are
    passed over. What nearly is a known word was meant to be it.
    """
    return bool(difflib.get_close_matches(word.strip().lower(), sorted(known), 1, CUTOFF))
