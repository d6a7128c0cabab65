"""Writes what happens in one run, as it happens."""

from __future__ import annotations

import math
from collections import Counter
from pathlib import Path
from types import TracebackType
from typing import Any, Self, TextIO

import numpy as np

from ssrics_like.decision import Decision
from ssrics_like.memory import Retrieval, save_memory_file
from ssrics_like.memory.store import save_topology
from ssrics_like.model import CognitiveModel
from ssrics_like.perception.histogram import correlation_histogram
from ssrics_like.perception.observation import Observation
from ssrics_like.perception.reflex import IntervalExample
from ssrics_like.productions.interface import TraceEvent
from ssrics_like.results import tables
from ssrics_like.results.files import csv_line, csv_text, json_text, write_atomically
from ssrics_like.results.thinning import Outline, Series

PATH_STEP_S = 0.1  # path.csv holds at most 10 poses a second
ACTIVATION_POINTS = 300
SETTLING_S = 60.0  # how long after the last scan activation is still drawn
JUMP_M, JUMP_M_S = 5.0, 20.0  # no robot indoors does this between two scans


class Recorder:
    """Streams a run's tables and trace into a folder.

    Parameters
    ----------
    folder : Path
        Folder of this run; it must exist and be empty.
    run : int
        Number of the run.
    start_s : float
        Time of the first observation: zero of the engine's clock.
    range_cap_m : float
        Readings from here on are not drawn.
    outline : dict, optional
        What to draw of the building besides its map, as `Outline.as_data`, where it is known; else
        it is made from where beams end.
    trace : bool
        Whether the modules' events are written.
    """

    def __init__(
        self,
        folder: Path,
        run: int,
        start_s: float,
        range_cap_m: float,
        *,
        outline: dict[str, Any] | None = None,
        trace: bool = True,
    ) -> None:
        self.folder = folder
        self.run = run
        self.scans = 0
        self.length_m = 0.0
        self.jumps = 0
        self.decided: Counter[str] = Counter()
        self.start_s = start_s
        self.end_s = start_s
        self._previous: Observation | None = None
        self._written_s = -math.inf
        self._novelty = Series()
        self._outline = Outline(range_cap_m) if outline is None else outline
        self._names = ["decisions.csv", "path.csv", *(["trace.jsonl"] if trace else [])]
        self._files: dict[str, TextIO] = {}

    def __enter__(self) -> Self:
        for name in self._names:
            self._files[name] = (self.folder / name).open("w", encoding="utf-8", newline="\n")
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        for file in self._files.values():
            file.close()

    def observed(self, observation: Observation, novelty: float | None) -> None:
        """Note an observation and the novelty of the newest interval, if there is one."""
        if self._previous is not None:
            here = observation.true_pose or observation.pose
            before = self._previous.true_pose or self._previous.pose
            step_m = math.hypot(here.x_m - before.x_m, here.y_m - before.y_m)
            self.length_m += step_m
            elapsed_s = observation.t_s - self._previous.t_s
            self.jumps += step_m > JUMP_M and step_m > JUMP_M_S * elapsed_s
        self._previous = observation
        self.end_s = observation.t_s
        self.scans += 1
        if observation.t_s - self._written_s >= PATH_STEP_S - 1e-9:
            self._written_s = observation.t_s
            self._files["path.csv"].write(csv_line(tables.path_row(self.run, observation)))
        if novelty is not None:
            self._novelty.append(observation.t_s, novelty)
        if isinstance(self._outline, Outline):
            self._outline.add(observation)

    def decided_all(self, decisions: list[Decision]) -> None:
        """Note decisions."""
        for decision in decisions:
            self.decided[decision.decision] += 1
            self._files["decisions.csv"].write(csv_line(tables.decision_row(self.run, decision)))

    def traced(self, event: TraceEvent) -> None:
        """Note one event of the engine."""
        if "trace.jsonl" not in self._files:
            return
        self._trace(event.t_s, event.module, event.action, event.name, chunk=event.chunk)

    def retrieved(self, t_s: float, retrieval: Retrieval) -> None:
        """Note every term of every candidate's activation."""
        if "trace.jsonl" not in self._files:
            return
        found = retrieval.candidates
        columns = {
            "names": list(found.names),
            "base_level": found.base_level.tolist(),
            "spreading": found.spreading.tolist(),
            "partial_match": found.partial_match.tolist(),
            "noise": found.noise.tolist(),
            "total": found.total.tolist(),
            "threshold": found.threshold,
        }
        self._trace(t_s, "declarative", "activation", "", candidates=columns)

    def _trace(self, t_s: float, module: str, action: str, name: str, **more: Any) -> None:
        event = {"t_s": self.start_s + t_s, "module": module, "action": action, "name": name}
        event |= {key: value for key, value in more.items() if value is not None}
        self._files["trace.jsonl"].write(json_text(event, indent=None))

    def finish(self, model: CognitiveModel, run_id: str) -> dict[str, Any]:
        """Write what is known only at the end; return the run's entry for the manifest.

        Parameters
        ----------
        model : CognitiveModel
            As the run has left it.
        run_id : str
            Names the run among all runs; see `CognitiveModel.saved_memory`.
        """
        for file in self._files.values():
            file.flush()
        rows = tables.landmark_rows(self.run, model)
        write_atomically(self.folder / "landmarks.csv", csv_text(tables.LANDMARKS, rows))
        for ending in ("json", "graphml"):
            save_topology(model.topological, self.folder / f"topology.{ending}")
        save_memory_file(model.saved_memory(run_id), self.folder / "memory.json")
        write_atomically(
            self.folder / "figures.json", json_text(self._figure_data(model), indent=None)
        )
        seen = model.perception
        return {
            "run": self.run,
            "scans": self.scans,
            "start_s": self.start_s,
            "duration_s": self.end_s - self.start_s,
            "path_length_m": self.length_m,
            "jumps": self.jumps,
            "novelty": {
                "intervals": seen.intervals,
                "novel_intervals": seen.novel_intervals,
                "onsets": seen.onsets,
            },
            "restarts": seen.restarts,
            "decisions": dict(sorted(self.decided.items())),
            "undecided": model.decisions_pending,
            "landmarks": len(model.topological),
            "chunks": len(model.declarative),
            "firings": model.engine.firings,
        }

    def _figure_data(self, model: CognitiveModel) -> dict[str, Any]:
        """Collect what the report draws and no table holds."""
        memory = model.declarative
        gradient = model.perception.profile.gradient
        drawn = self._outline
        last_s = self.end_s - self.start_s
        last_s = min(max(last_s, model.engine.now_s), last_s + SETTLING_S)
        times = np.linspace(0.0, last_s, ACTIVATION_POINTS)
        levels = np.array([memory.activations(float(t)) for t in times])
        levels[~np.isfinite(levels)] = np.nan  # not there yet
        column = {name: i for i, name in enumerate(memory.names)}
        landmarks = [node.id for node in model.topological.nodes if node.id in column]
        return {
            "outline": drawn.as_data() if isinstance(drawn, Outline) else drawn,
            "novelty": self._novelty.as_data(),
            "histograms": {
                "novel": _histogram(model.perception.example_novel, gradient),
                "bored": _histogram(model.perception.example_bored, gradient),
            },
            "activation": {
                "t_s": (times + self.start_s).tolist(),
                "base_level": {name: levels[:, column[name]].tolist() for name in landmarks},
            },
        }


def _histogram(example: IntervalExample | None, gradient: float) -> dict[str, Any] | None:
    if example is None:
        return None
    counts, edges = correlation_histogram(example.correlations, gradient)
    return {
        "scan": example.scan,
        "tau": example.tau,
        "counts": counts.tolist(),
        "edges": edges.tolist(),
    }
