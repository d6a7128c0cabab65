"""What the page needs to know of a manifest, checked."""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from pydantic import ValidationError

from ssrics_like.errors import ResultsError
from ssrics_like.productions.rules import Rule
from ssrics_like.productions.syntax import RuleSyntaxError, parse_rule
from ssrics_like.productions.vocabulary import BUFFERS
from ssrics_like.world.robot import RobotProfile


@dataclass(frozen=True, eq=False)
class Said:
    """What a manifest says.

    Attributes
    ----------
    title : str
        Of the scenario; may be empty.
    frame : str
        Frame of the positions that the model saw.
    file, format, sha256 : str
        The map or log that the results were made from.
    reading : mapping
        How a log was read: ``strict``, ``fallback_rate_hz``, ``frame``; empty in simulation.
    world : mapping
        The simulated world; empty for a log.
    robot : RobotProfile or None
        The simulated robot.
    novelty_threshold : float
        From here on an interval is novel.
    retrieval_threshold : float
        Of declarative memory.
    rules : tuple of Rule
        The rule set, in its order.
    has_trace : bool
        Whether the scenario has the modules' events written.
    """

    title: str
    frame: str
    file: str
    format: str
    sha256: str
    reading: Mapping[str, Any]
    world: Mapping[str, Any]
    robot: RobotProfile | None
    novelty_threshold: float
    retrieval_threshold: float
    rules: tuple[Rule, ...]
    has_trace: bool


def said_in(folder: Path, manifest: Mapping[str, Any]) -> Said:
    """Read a manifest.

    Raises
    ------
    ResultsError
        Something is missing, of the wrong kind, or of a version that knows other rules.
    """
    file = folder / "manifest.json"
    try:
        scenario, made_from = manifest["scenario"], manifest["input"]
        world = dict(scenario.get("world") or {})
        return Said(
            title=str(scenario.get("title") or ""),
            frame=str(manifest["frame"]),
            file=str(made_from["file"]),
            format=str(made_from["format"]),
            sha256=str(made_from["sha256"]),
            reading=dict(scenario.get("source") or {}),
            world=world,
            robot=_robot(file, dict(world["robot"])) if world else None,
            novelty_threshold=1.0 - float(scenario["perception"]["threshold"]),
            retrieval_threshold=float(scenario["memory"]["retrieval_threshold"]),
            rules=tuple(
                _rule(file, str(name), entry)
                for name, entry in scenario["productions"]["rules"].items()
            ),
            has_trace=bool(scenario.get("trace", True)),
        )
    except KeyError as e:
        raise ResultsError(f"{file}: is damaged, or of another version: {e} is missing") from None
    except (TypeError, ValueError, AttributeError) as e:
        raise ResultsError(f"{file}: is damaged: {e}") from None


def _robot(file: Path, said: dict[str, Any]) -> RobotProfile:
    said.pop("name", None)
    try:
        return RobotProfile.model_validate(said)
    except ValidationError as e:
        first = e.errors()[0]
        key = ".".join(map(str, first["loc"]))
        raise ResultsError(f"{file}: is damaged: robot.{key}: {first['msg']}") from None


def _rule(file: Path, name: str, entry: Mapping[str, Any]) -> Rule:
    """Take a rule apart."""
    source = str(entry["rule"])
    try:
        text = parse_rule(source)
    except RuleSyntaxError as e:
        raise ResultsError(f"{file}: is damaged: rule '{name}': {e}") from None
    for clause in text.tests:
        if clause.buffer not in BUFFERS:
            raise ResultsError(f"{file}: rule '{name}': unknown buffer '{clause.buffer}'")
    return Rule(name, str(entry["why"]), text, source, float(entry["utility"]), 1)
