"""The columns of the results folder's tables, and how a run's things fill them."""

from __future__ import annotations

from collections.abc import Iterator
from typing import Any

from ssrics_like.decision import Decision
from ssrics_like.model import CognitiveModel
from ssrics_like.perception.observation import Observation, Pose

DECISIONS = [
    "run",
    "event",
    "scan",
    "t_s",
    "decided_s",
    "x_m",
    "y_m",
    "theta_rad",
    "true_x_m",
    "true_y_m",
    "modality",
    "novelty",
    "sector",
    "structure",
    "decision",
    "landmark",
    "rule",
    "activation",
    "confidence",
]
LANDMARKS = [
    "run",
    "landmark",
    "t_s",
    "x_m",
    "y_m",
    "theta_rad",
    "sector",
    "structure",
    "salience",
    "relevance",
    "permanence",
    "visits",
]
PATH = [
    "run",
    "t_s",
    "x_m",
    "y_m",
    "theta_rad",
    "true_x_m",
    "true_y_m",
    "true_theta_rad",
]


def decision_row(run: int, d: Decision) -> list[Any]:
    """Return a row of decisions.csv."""
    true = _xy(d.true_pose)
    return [
        run, d.event, d.scan, d.t_s, d.decided_s, d.pose.x_m, d.pose.y_m, d.pose.theta_rad, *true,
        d.modality, d.novelty, d.sector, d.structure, d.decision, d.landmark, d.rule,
        d.activation, d.confidence,
    ]  # fmt: skip


def path_row(run: int, o: Observation) -> list[Any]:
    """Return a row of path.csv."""
    theta = o.true_pose.theta_rad if o.true_pose else None
    return [
        run, o.t_s, o.pose.x_m, o.pose.y_m, o.pose.theta_rad, *_xy(o.true_pose), theta,
    ]  # fmt: skip


def landmark_rows(run: int, model: CognitiveModel) -> Iterator[list[Any]]:
    """Return the rows of landmarks.csv.

    Salience, relevance and permanence are those at the end of the run; salience is empty where the
    rule set keeps no memory.
    """
    worths = model.worths()
    for node in model.topological.nodes:
        yield [
            run, node.id, node.t_s, node.x_m, node.y_m, node.theta_rad, node.labels["sector"],
            node.labels["structure"], *worths[node.id], node.visits,
        ]  # fmt: skip


def _xy(pose: Pose | None) -> tuple[float | None, float | None]:
    return (pose.x_m, pose.y_m) if pose else (None, None)
