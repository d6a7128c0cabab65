"""Every error that a user can cause, under one root.

Each kind is also the builtin that a caller would expect, so that code which
knows nothing of this package can still catch it. The command line prints such
an error as it stands and exits with 1; anything else is a bug and keeps its
traceback.
"""

from __future__ import annotations

import difflib
from collections.abc import Iterable


class SsricsError(Exception):
    """Root of all errors that a user can cause."""


class SourceError(SsricsError, ValueError):
    """A log cannot be read: missing, empty, foreign, or malformed at a line."""


class ScanError(SsricsError, ValueError):
    """A scan has the wrong shape, or another number of beams than the scans before it."""


class SettingsError(SsricsError, ValueError):
    """A YAML file or an override is wrong; one line for each problem."""


class RuleError(SsricsError, ValueError):
    """A rule file is wrong; one line for each problem."""


class LibraryError(SsricsError, LookupError):
    """No library entry or file has the name that was asked for."""


class CueError(SsricsError, ValueError):
    """A file of what was learned is damaged, or of other measures than this version takes."""


class MapError(SsricsError, ValueError):
    """A map, a plan or a table of places is wrong; one line for each problem."""


class ResultsError(SsricsError, OSError):
    """A results folder cannot be written or read."""


class EngineError(SsricsError, RuntimeError):
    """The production engine cannot run, for example on another version of pyactr."""


class MemoryFileError(SsricsError, ValueError):
    """A saved memory is damaged, of another kind, or newer than this version reads."""


class StudyError(SsricsError, ValueError):
    """A study cannot be served, its answers not be stored, read or imported."""


class MissingPackageError(SsricsError, ImportError):
    """A package that only some commands need is not installed."""


def nearest(word: str, known: Iterable[str]) -> str:
    """Return ``; did you mean 'x'?`` for the known name nearest to `word`, else nothing."""
    matches = difflib.get_close_matches(str(word), sorted(known), n=1, cutoff=0.6)
    return f"; did you mean '{matches[0]}'?" if matches else ""


def choices(known: Iterable[str]) -> str:
    """Return the known names as text, sorted, for the end of an error message."""
    return ", ".join(sorted(known))
