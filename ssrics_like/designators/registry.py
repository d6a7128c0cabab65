"""Designators by name, so that anyone can add one."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any, cast

from pydantic import ValidationError

from ssrics_like.designators.bocpd import Bocpd
from ssrics_like.designators.boosted_scan import BoostedScan
from ssrics_like.designators.change_points import ChangePoints
from ssrics_like.designators.doorway_gap import DoorwayGap
from ssrics_like.designators.every_metres import EveryMetres
from ssrics_like.designators.gwr import Gwr
from ssrics_like.designators.random_marks import RandomMarks
from ssrics_like.designators.report_rule import ReportRule
from ssrics_like.designators.surprise_gaussian import SurpriseGaussian
from ssrics_like.designators.surprise_histogram import SurpriseHistogram
from ssrics_like.designators.turning import Turning
from ssrics_like.errors import LibraryError, SettingsError, choices, nearest
from ssrics_like.settings import explain

if TYPE_CHECKING:
    from ssrics_like.designators.protocol import Designator, DesignatorKind

_KINDS: dict[str, Any] = {
    "every-metres": EveryMetres,
    "random": RandomMarks,
    "turning": Turning,
    "report": ReportRule,
    "surprise-histogram": SurpriseHistogram,
    "surprise-gaussian": SurpriseGaussian,
    "bocpd": Bocpd,
    "change-points": ChangePoints,
    "doorway-gap": DoorwayGap,
    "gwr": Gwr,
    "boosted-scan": BoostedScan,
}


def designator_names() -> tuple[str, ...]:
    """Return the names of all designators, in the order in which they were added."""
    return tuple(_KINDS)


def designator_kind(name: str) -> DesignatorKind:
    """Return the class of a designator: its settings, grid, source, and whether in hindsight.

    Raises
    ------
    LibraryError
        No designator has this name.
    """
    if name not in _KINDS:
        raise LibraryError(
            f"no designator '{name}'{nearest(name, _KINDS)}; known are {choices(_KINDS)}"
        )
    return cast("DesignatorKind", _KINDS[name])


def make_designator(name: str, **settings: object) -> Designator:
    """Return a new designator, for one drive.

    Parameters
    ----------
    name : str
        As in `designator_names`.
    **settings
        Of that designator; what is not given keeps its default.

    Raises
    ------
    LibraryError
        No designator has this name.
    SettingsError
        With one line for each setting that is unknown, missing or out of range.
    MissingPackageError
        It needs a library that is not installed.

    Examples
    --------
    >>> designator = make_designator("every-metres", every_m=2.0)
    """
    kind = designator_kind(name)
    try:
        checked = kind.Settings.model_validate(settings)
    except ValidationError as e:
        lines = [f"{name}: {text}" for _, text in explain(kind.Settings, e, settings)]
        raise SettingsError("\n".join(lines)) from None
    return kind(checked)


def add_designator(name: str, kind: Any) -> None:
    """Let a designator of one's own be found by name.

    Parameters
    ----------
    name : str
        A new name.
    kind : DesignatorKind
        A class with `Settings`, `GRID`, `hindsight` and `source` whose instances are made
        from the settings and have `update` and `flush`.

    Raises
    ------
    LibraryError
        The name is taken.
    SettingsError
        The class lacks something.
    """
    if name in _KINDS:
        raise LibraryError(f"there is a designator '{name}' already")
    needed = ("Settings", "GRID", "hindsight", "source", "update", "flush")
    missing = [attribute for attribute in needed if not hasattr(kind, attribute)]
    if missing:
        raise SettingsError(f"designator '{name}' lacks {', '.join(missing)}")
    unknown = [key for key in kind.GRID if key not in kind.Settings.model_fields]
    if unknown:
        raise SettingsError(f"designator '{name}': GRID names no setting: {', '.join(unknown)}")
    _KINDS[name] = kind
