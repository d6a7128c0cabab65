"""What the page says in words and numbers: cards, tables, settings."""

from __future__ import annotations

import json
import math
from collections import Counter
from collections.abc import Mapping
from datetime import UTC, datetime
from typing import Any

from ssrics_like.memory.home import HOME
from ssrics_like.report.location_tables import locations_of
from ssrics_like.report.markers import TIPPED_MAX
from ssrics_like.report.records import Results
from ssrics_like.report.style import decision_order
from ssrics_like.report.words import figure_text, number_text, percent_text, time_text
from ssrics_like.results.errands import outcome_text
from ssrics_like.results.records import DECISIONS, Landmark, Run

CLOCK_STEP_S = 1e-6  # the last decimal of the tables
EARLIEST_DATE_S, LATEST_DATE_S = 631152000.0, 4102444800.0
"""Clocks between 1990 and 2100 are taken for seconds since 1970."""


def content_of(results: Results) -> dict[str, Any]:
    """Return all that the template shows besides figures, as plain values."""
    run, scenario, manifest = results.shown, results.scenario, results.manifest
    source = str(manifest["input"]["file"])
    return {
        "title": str(scenario["title"]) or source,
        "source": f"The simulated building {source}" if scenario.get("world") else source,
        "modules": {
            kind: str(scenario[kind]["name"]) for kind in ("perception", "productions", "memory")
        },
        "shown": run.number,
        "start": _start(run),
        "cards": cards(run),
        "locations": locations_of(results.scores),
        "has_coverage": any(each.coverage is not None for each in results.runs),
        "warnings": [str(text) for text in manifest["warnings"]],
        "runs": [_run_row(each) for each in results.runs],
        "decisions": _decisions_shown(results.runs),
        "errands": [row for each in results.runs for row in _errand_rows(each)],
        "landmarks": [_landmark_row(i, mark) for i, mark in enumerate(run.landmarks)],
        "positions": _positions(results),
        "linked": len(run.landmarks) <= TIPPED_MAX,
        "rules_title": str(scenario["productions"].get("title", "")),
        "rules": _rules(run, scenario["productions"]["rules"]),
        "settings": [
            *_world_settings(results),
            *(_settings(kind, scenario[kind]) for kind in ("perception", "memory")),
        ],
        "facts": _facts(results),
        # Equal results make equal pages, so the page leaves out when they were made.
        "manifest": json.dumps(
            {key: value for key, value in manifest.items() if key != "wall_clock"},
            indent=2,
            ensure_ascii=False,
        ),
    }


def cards(run: Run) -> list[dict[str, str]]:
    """Return the figures at the top of the page: what, how much, and a word of explanation."""
    decided = run.decided
    undecided = int(run.entry.get("undecided", 0))
    reflexes = decided.total() + undecided
    novelty = run.entry["novelty"]
    novel, intervals = int(novelty["novel_intervals"]), int(novelty["intervals"])
    share = f"{100 * novel / intervals:.0f} %" if intervals else "–"
    found = [
        ("scans", _grouped(int(run.entry["scans"])), ""),
        ("duration", time_text(run.duration_s), ""),
        ("path", f"{run.length_m:.1f} m", ""),
        *_coverage_card(run),
        ("novel intervals", share, f"{_grouped(novel)} of {_grouped(intervals)}"),
        ("reflexes", _grouped(reflexes), f"{undecided} undecided" if undecided else ""),
    ]
    found.append(("productions fired", _grouped(int(run.entry["firings"])), ""))
    kinds = [k for k in DECISIONS if k != "unsure" or decided[k]]
    kinds += sorted(set(decided) - set(DECISIONS))
    found += [(kind, _grouped(decided[kind]), "") for kind in kinds]
    found.append(("landmarks", _grouped(len(run.landmarks)), "in the graph"))
    rate = run.marks_per_100_m
    found.append(
        (
            "marks per 100 m",
            "–" if math.isnan(rate) else f"{rate:.1f}",
            "declared, recognised or unsure",
        )
    )
    return [{"name": name, "value": value, "note": note} for name, value, note in found]


def _coverage_card(run: Run) -> list[tuple[str, str, str]]:
    """Return how much of the building was seen; nothing for a log."""
    if run.coverage is None:
        return []
    return [("coverage", percent_text(run.coverage, 1), "of what was reachable at the start")]


def _grouped(count: int) -> str:
    return f"{count:,}".replace(",", "\u202f")


def _start(run: Run) -> str:
    """Say what the source's clock showed at zero, where that was not zero too."""
    if abs(run.start_s) < CLOCK_STEP_S:
        return ""
    text = f"Times count from the start of the run, at {run.start_s:.6f} s on the log's own clock"
    if EARLIEST_DATE_S <= run.start_s < LATEST_DATE_S:
        date = datetime.fromtimestamp(run.start_s, tz=UTC)
        text += f" ({date:%Y-%m-%d %H:%M} UTC, if that counts from 1970)"
    return f"{text}."


def _decisions_shown(runs: tuple[Run, ...]) -> list[str]:
    """Return every decision that some run took, in the usual order."""
    return sorted({kind for run in runs for kind in run.decided}, key=decision_order)


def _run_row(run: Run) -> dict[str, Any]:
    rate = run.marks_per_100_m
    return {
        "number": run.number,
        "seed": run.entry.get("seed", ""),
        "scans": run.entry["scans"],
        "duration": time_text(run.duration_s),
        "length": f"{run.length_m:.1f}",
        "coverage": "–" if run.coverage is None else percent_text(run.coverage, 1),
        "decided": dict(run.decided),
        "landmarks": len(run.landmarks),
        "rate": "–" if math.isnan(rate) else f"{rate:.1f}",
        "ended": str(run.entry.get("ended", "")),
    }


def _positions(results: Results) -> str:
    """Say which positions the table of landmarks has, where the map has others."""
    if not results.shown.is_true:
        return ""
    frame = results.manifest["frame"]
    return (
        f"Positions and headings are those that the robot believed in ({frame} frame); the map "
        "shows the true ones."
    )


def _landmark_row(index: int, mark: Landmark) -> dict[str, Any]:
    """Return a landmark's cells: what is shown, and what it is sorted by."""
    return {
        "index": index,
        "sector": mark.sector,
        "cells": [
            (mark.name, index, "name"),
            (time_text(mark.t_s), mark.t_s, "number"),
            (number_text(mark.x_m, 2), mark.x_m, "number"),
            (number_text(mark.y_m, 2), mark.y_m, "number"),
            (number_text(math.degrees(mark.theta_rad), 0) + "°", mark.theta_rad, "number"),
            (mark.sector, mark.sector, "sector"),
            (mark.structure, mark.structure, "word"),
            *(
                (figure_text(math.nan if value is None else value),
                 -math.inf if value is None else value, "number")
                for value in (mark.salience, mark.relevance, mark.permanence)
            ),
            (str(mark.visits), mark.visits, "number"),
        ],
    }  # fmt: skip


def _rules(run: Run, rules: Mapping[str, Any]) -> list[dict[str, Any]]:
    """Return each production: why it is there, its text, how much it decided."""
    by_rule = Counter(reflex.rule for reflex in run.reflexes)
    return [
        {"name": name, "why": rule["why"], "text": rule["rule"], "decided": by_rule[name]}
        for name, rule in rules.items()
    ]


def _world_settings(results: Results) -> list[dict[str, Any]]:
    """Return what the world was set to, without what was left out; nothing for a log."""
    world = results.scenario.get("world")
    if not world:
        return []
    given = {key: value for key, value in world.items() if value not in (None, [], {})}
    title = results.building.title if results.building else ""
    robot = given.pop("robot", None)
    parts = [
        _settings("world", {"name": results.manifest["input"]["file"], "title": title} | given)
    ]
    return [*parts, _settings("robot", _flat(robot))] if robot else parts


def _flat(values: Mapping[str, Any], above: str = "") -> dict[str, Any]:
    """Return nested values under dotted keys."""
    found: dict[str, Any] = {}
    for key, value in values.items():
        found |= _flat(value, f"{above}{key}.") if isinstance(value, dict) else {above + key: value}
    return found


def _settings(kind: str, profile: Mapping[str, Any]) -> dict[str, Any]:
    """Return a profile's settings, its title and source apart."""
    values = {
        str(key): _value(value)
        for key, value in profile.items()
        if key not in ("name", "title", "source")
    }
    return {
        "kind": kind,
        "name": str(profile["name"]),
        "title": str(profile.get("title", "")),
        "source": str(profile.get("source", "")),
        "values": values,
    }


def _value(value: Any) -> str:
    if value is None:
        return "none"
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, float):
        return f"{value:g}".replace("-", "−")
    if isinstance(value, dict):
        return ", ".join(f"{k} {_value(v)}" for k, v in value.items()) or "none"
    if isinstance(value, list):
        return "; ".join(_value(item) for item in value) or "none"
    return str(value)


def _errand_rows(run: Run) -> list[dict[str, str]]:
    """Return what is said of each errand of a run."""
    return [
        {
            "run": str(run.number),
            "order": str(errand["order"]),
            "began": time_text(float(errand["started_s"]) - run.start_s),
            "outcome": outcome_text(errand),
        }
        for errand in run.entry.get("errands", ())
    ]


def _began(scenario: Mapping[str, Any]) -> str:
    """Say when and where, as seen from its memory, a run began."""
    memory = scenario.get("memory_from") or {}
    before = f"{time_text(float(memory.get('pause_s') or 0.0))} before"
    return f"{before}; the robot begins at home" if memory.get("start") == HOME else before


def _facts(results: Results) -> list[tuple[str, str]]:
    """Return where the results come from."""
    manifest = results.manifest
    source, versions = manifest["input"], manifest["versions"]
    memory = results.shown.entry.get("memory_from")
    return [
        ("input", f"{source['file']} ({source['format']})"),
        ("sha256", str(source["sha256"])),
        ("frame of positions", str(manifest["frame"])),
        ("seed", str(manifest["seed"])),
        *([("memory from", f"{memory['file']}, {_began(results.scenario)}")] if memory else []),
        ("versions", ", ".join(f"{name} {version}" for name, version in versions.items())),
    ]
