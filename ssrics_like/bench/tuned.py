"""What was tuned, as a file: a run that reads it need not tune again."""

from __future__ import annotations

import json
from collections.abc import Sequence
from pathlib import Path
from typing import Annotated, Any, Literal

from pydantic import BaseModel, ConfigDict, Field, ValidationError

from ssrics_like.bench.candidates import JOINT, TRAINED
from ssrics_like.designators import designator_kind
from ssrics_like.errors import ResultsError, SsricsError, nearest
from ssrics_like.settings import explain

FORMAT = "ssrics-tuned"


class _Strict(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)


class TunedDesignator(_Strict):
    """What tuning chose for one designator.

    Attributes
    ----------
    settings : dict
        The best of its grid; the model of one that is trained is not among them.
    f : float or None
        Pooled F that they reach on the drives of the tuning; None without a meaning.
    tried : int
        How many choices there were.
    edges : list of str
        Numbers among the settings that lie at an edge of the grid: a wider one might do better.
    """

    settings: dict[str, Any]
    f: float | None
    tried: int
    edges: list[str] = Field(default_factory=list)


class Tuned(_Strict):
    """What was tuned, and on which drives.

    Attributes
    ----------
    tuning, training : int
        How many drives served each; their seeds count from 0, their conditions take turns.
    radius_m : float
        Of the score.
    designators : dict
        By name.
    """

    format: Literal["ssrics-tuned"] = "ssrics-tuned"
    version: Literal[1] = 1
    tuning: Annotated[int, Field(ge=1, le=10_000)]
    training: Annotated[int, Field(ge=1, le=10_000)]
    radius_m: Annotated[float, Field(gt=0.0, le=100.0)]
    designators: dict[str, TunedDesignator]


def tuned_data(tuned: Tuned) -> dict[str, Any]:
    """Return what was tuned as plain values, as they stand in a file."""
    return tuned.model_dump()


def read_tuned(path: Path, names: Sequence[str]) -> Tuned:
    """Read what an earlier run tuned.

    Parameters
    ----------
    path : Path
        ``tuned.json`` of an earlier run.
    names : sequence of str
        Candidates that are wanted.

    Raises
    ------
    ResultsError
        The file cannot be read, is another, or lacks a designator that is wanted.
    """
    tuned = _read(path)
    for name, chosen in tuned.designators.items():
        try:
            kind = designator_kind(name)
        except SsricsError as e:
            raise ResultsError(f"{path}: designators: {e}") from None
        unknown = [key for key in chosen.settings if key not in kind.Settings.model_fields]
        if unknown:
            hint = nearest(unknown[0], kind.Settings.model_fields)
            raise ResultsError(
                f"{path}: designators.{name}.settings: unknown setting '{unknown[0]}'{hint}"
            )
        if name != TRAINED:
            _check_values(path, name, kind.Settings, chosen.settings)
    missing = [name for name in names if JOINT not in name and name not in tuned.designators]
    if missing:
        raise ResultsError(
            f"{path}: designators: lacks {', '.join(missing)}; leave --tuned out to tune anew"
        )
    return tuned


def _check_values(path: Path, name: str, model: type[BaseModel], settings: dict[str, Any]) -> None:
    try:
        model.model_validate(settings)
    except ValidationError as e:
        lines = [f"{path}: {name}: {text}" for _, text in explain(model, e, settings)]
        raise ResultsError("\n".join(lines)) from None


def _read(path: Path) -> Tuned:
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as e:
        raise ResultsError(f"{path}: cannot be read ({e.strerror})") from None
    except UnicodeDecodeError:
        raise ResultsError(f"{path}: is not UTF-8, expected {FORMAT} in JSON") from None
    try:
        data = json.loads(text)
        found = data.get("format") if isinstance(data, dict) else None
        if found != FORMAT:
            raise ResultsError(f"{path}: format: {found!r}, expected '{FORMAT}'")
        return Tuned.model_validate(data)
    except json.JSONDecodeError as e:
        raise ResultsError(f"{path}:{e.lineno}:{e.colno}: not valid JSON: {e.msg}") from None
    except ValidationError as e:
        key = ".".join(str(part) for part in e.errors()[0]["loc"])
        raise ResultsError(f"{path}: {key}: {e.errors()[0]['msg'].lower()}") from None
