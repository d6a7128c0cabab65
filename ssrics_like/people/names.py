"""Names of participants and models, shortened to what has room."""

from __future__ import annotations

from collections.abc import Sequence

NAME_MAX, SHOWN_MAX = 30, 6


def short(name: str, most: int = NAME_MAX) -> str:
    """Return a name of at most so many letters; of a longer one both ends.

    Ids often begin alike and end alike, so that either end alone would not tell them apart.
    """
    if len(name) <= most:
        return name
    tail = (most - 1) // 2
    return f"{name[: most - 1 - tail].rstrip()}…{name[len(name) - tail :].lstrip()}"


def in_a_row(names: Sequence[str], what: str = "") -> str:
    """Return names in a row, ``locations 1, 2 and 3``; at most `SHOWN_MAX` of them, shortened."""
    shown = [short(name) for name in names[:SHOWN_MAX]]
    if len(names) > SHOWN_MAX:
        shown.append(f"{len(names) - SHOWN_MAX} others")
    text = shown[0] if len(shown) == 1 else f"{', '.join(shown[:-1])} and {shown[-1]}"
    if not what:
        return text
    return f"{what}{'s' if len(names) > 1 else ''} {text}"
