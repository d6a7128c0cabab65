"""Gathers what is wrong in several places, so that all of it is said at once."""

from __future__ import annotations

from collections.abc import Collection, Iterator
from contextlib import contextmanager

from ssrics_like.errors import SettingsError, SsricsError, nearest


class Problems:
    """What is wrong so far.

    Attributes
    ----------
    lines : list of str
        One for each problem.
    """

    def __init__(self) -> None:
        self.lines: list[str] = []
        self._errors: list[SsricsError] = []

    @contextmanager
    def gathered(self, before: str = "") -> Iterator[None]:
        """Note an error of the user in the block, with `before` it, instead of raising it."""
        try:
            yield
        except SsricsError as e:
            self._errors.append(e)
            self.lines += [f"{before}{line}" for line in str(e).splitlines()]

    def complain(self) -> None:
        """Raise what was noted, if anything: a lone error as it was.

        Raises
        ------
        SettingsError
            With all lines, each once.
        """
        lines = list(dict.fromkeys(self.lines))
        if self._errors and lines == str(self._errors[0]).splitlines():
            raise self._errors[0]
        if lines:
            raise SettingsError("\n".join(lines))


def unknown_location(name: str, known: Collection[str]) -> str:
    """Say that a map has no location of a name, and which it has."""
    hint = nearest(name, known) or f"; it has {', '.join(known) or 'none'}"
    return f"the map has no location '{name}'{hint}"
