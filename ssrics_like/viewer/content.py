"""All that the page holds of a run, as plain data."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import numpy as np

from ssrics_like.report import style
from ssrics_like.report.novelty_figure import coarser
from ssrics_like.viewer.pictures import map_picture, walls_picture
from ssrics_like.viewer.quantising import in_steps, milliseconds, packed, turns
from ssrics_like.viewer.reading import Watched
from ssrics_like.viewer.telling import story_data

PLACE_STEP_M = 0.01
LEVEL_STEP = 0.001
NOVELTY_BINS_MAX = 2000
LINES_MAX = 300
"""Landmarks whose activation is drawn; the most visited ones, where there are more."""
LAYOUT = 1
"""Layout of the data, for whoever reads it from a page."""


def content_of(watched: Watched, folder: Path) -> dict[str, Any]:
    """Return the data of the page: numbers in SI units, times from the start of the run."""
    run, said = watched.run, watched.said
    return {
        "layout": LAYOUT,
        "title": said.title or folder.resolve().name,
        "run": run.number,
        "runs": watched.runs,
        "start_s": run.start_s,
        "end_s": _end_s(watched),
        "positions": "the simulator's true ones" if run.is_true
        else f"those of the log, frame {said.frame}",
        "notes": list(watched.notes),
        "path": {
            "t": milliseconds(watched.poses[:, 0]),
            "x": in_steps(watched.poses[:, 1], PLACE_STEP_M),
            "y": in_steps(watched.poses[:, 2], PLACE_STEP_M),
            "theta": turns(watched.poses[:, 3]),
            "landings": run.landings.tolist(),
        },
        "scans": _scans(watched),
        "robot": {
            "radius_m": said.robot.radius_m if said.robot else None,
            "laser_m": said.robot.laser.x_m if said.robot else 0.0,
        },
        "map": map_picture(watched.building.grid) if watched.building else None,
        "walls": walls_picture(watched.pictures.outline),
        "landmarks": _landmarks(watched),
        "arcs": [[a.from_id, a.to_id, a.t_s, a.is_known] for a in watched.arcs],
        "novelty": _novelty(watched),
        "decisions": [
            [r.event, r.t_s, r.decided_s, r.x_m, r.y_m, r.novelty, r.sector, r.structure,
             r.decision, r.landmark, r.rule]
            for r in sorted(run.reflexes, key=lambda r: r.decided_s)
        ],
        "activation": _activation(watched),
        "rules": [[rule.name, rule.why, rule.source] for rule in said.rules],
        "story": story_data(watched.story, said.rules) if watched.story else None,
    }  # fmt: skip


def _end_s(watched: Watched) -> float:
    """Return when the last thing happens: a retrieval may end after the last scan."""
    times = [watched.run.duration_s, float(watched.poses[-1, 0])]
    times += [reflex.decided_s for reflex in watched.run.reflexes]
    if watched.story is not None:
        times += [firing.t_s for firing in watched.story.firings]
    return max(times)


def _scans(watched: Watched) -> dict[str, Any] | None:
    scans = watched.scans
    if scans is None or not scans.ranges.size:
        return None
    return {
        "poses": packed(scans.poses.astype(np.uint32)),
        "beams": scans.ranges.shape[1],
        "first_rad": scans.first_rad,
        "step_rad": scans.step_rad,
        "ranges": packed(scans.ranges),
    }


def _landmarks(watched: Watched) -> list[list[Any]]:
    """Return name, since when it is known, where it is drawn, sector and visits."""
    known = {
        reflex.landmark: reflex.decided_s
        for reflex in watched.run.reflexes
        if reflex.decision == "declared"
    }
    return [
        [mark.name, known.get(mark.name, mark.t_s), mark.drawn_x_m, mark.drawn_y_m,
         mark.sector, mark.visits]
        for mark in watched.run.landmarks
    ]  # fmt: skip


def _novelty(watched: Watched) -> dict[str, Any]:
    novelty = coarser(watched.pictures.novelty, NOVELTY_BINS_MAX)
    return {
        "threshold": watched.said.novelty_threshold,
        "t": in_steps(novelty.t_s, LEVEL_STEP),
        "mean": in_steps(novelty.mean, LEVEL_STEP),
        "least": in_steps(novelty.least, LEVEL_STEP),
        "largest": in_steps(novelty.largest, LEVEL_STEP),
    }


def _activation(watched: Watched) -> dict[str, Any]:
    """Return base levels over time; the colours are those of the report's figure."""
    data = watched.pictures.activation
    visits = {mark.name: mark.visits for mark in watched.run.landmarks}
    there = [name for name, levels in data.base_level.items() if np.isfinite(levels).any()]
    ranked = sorted(there, key=lambda name: -visits.get(name, 0))[:LINES_MAX]
    colours = dict(zip(ranked, style.HIGHLIGHTS, strict=False))
    return {
        "threshold": watched.said.retrieval_threshold,
        "t": in_steps(data.t_s, LEVEL_STEP),
        "levels": [
            [name, colours.get(name), in_steps(data.base_level[name], LEVEL_STEP)]
            for name in ranked
        ],
    }
