"""How people and models look in every picture of a comparison."""

from __future__ import annotations

from typing import Any

from ssrics_like.people.beside import Beside
from ssrics_like.people.markers import PEOPLE
from ssrics_like.report import style

MODEL_COLOURS = (style.VERMILION, style.GREEN, "#882255", "#8C6D1F", "#332288", "#44AA99")
SHAPES = ("D", "s", "^", "v", "P", "X")


def colours_of(made: Beside) -> dict[str, str]:
    """Return the colour of each group: people blue, models in turn."""
    found = {PEOPLE: style.BLUE}
    for number, model in enumerate(made.models):
        found[model.name] = MODEL_COLOURS[number % len(MODEL_COLOURS)]
    return found


def shapes_of(made: Beside) -> dict[str, str]:
    """Return the shape of each group's marks, so that colour alone need not tell them apart."""
    found = {PEOPLE: "o"}
    for number, model in enumerate(made.models):
        found[model.name] = SHAPES[number % len(SHAPES)]
    return found


def said(group: str, count: int) -> str:
    """Return a group with its size: ``people (12)``, ``human-like (6 runs)``."""
    if group == PEOPLE:
        return f"{PEOPLE} ({count})"
    return f"{group} ({count} {'run' if count == 1 else 'runs'})"


def dot(colour: str, shape: str, size: float = 5.0) -> dict[str, Any]:
    """Return how a mark or share is drawn."""
    return {"marker": shape, "linestyle": "none", "markersize": size, "markerfacecolor": colour,
            "markeredgecolor": "white", "markeredgewidth": 0.6}  # fmt: skip


def short(name: str, most: int = 30) -> str:
    """Return a name, shortened to what has room."""
    return name if len(name) <= most else name[: most - 1].rstrip() + "…"
