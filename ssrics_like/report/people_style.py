"""How people and models look in every picture of a comparison."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING, Any

from ssrics_like.people.beside import Beside
from ssrics_like.people.markers import PEOPLE
from ssrics_like.people.names import NAME_MAX, short
from ssrics_like.report import style
from ssrics_like.results.counts import counted

if TYPE_CHECKING:
    from matplotlib.axes import Axes

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


def said(group: str, count: int, most: int = NAME_MAX) -> str:
    """Return a group with its size: ``people (12)``, ``human-like (6 runs)``."""
    if group == PEOPLE:
        return f"{PEOPLE} ({count})"
    return f"{short(group, most)} ({counted(count, 'run')})"


def mark_look(made: Beside, group: str, size: float = 5.0) -> dict[str, Any]:
    """Return how a mark or share is drawn, to be told apart in black and white print, too.

    People's are filled and round with a pale edge; those of models are hollow, of other shapes.
    """
    colour = colours_of(made)[group]
    look = {"marker": shapes_of(made)[group], "linestyle": "none", "markersize": size}
    if group == PEOPLE:
        return {**look, "markerfacecolor": colour, "markeredgecolor": "white",
                "markeredgewidth": 0.7}  # fmt: skip
    return {**look, "markerfacecolor": "white", "markeredgecolor": colour,
            "markeredgewidth": 0.2 * size}  # fmt: skip


def name_tips(axes: Axes, shown: Sequence[str], whole: Sequence[str]) -> dict[str, str]:
    """Return tips that tell all of the names of rows that were shortened: gid -> name."""
    tips = {}
    for i, label in enumerate(axes.get_yticklabels()):
        if shown[i] != whole[i]:
            label.set_gid(f"name-{i}")
            tips[f"name-{i}"] = whole[i]
    return tips
