"""The timeline: buffers and productions while the first reflexes are decided."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

from ssrics_like.report import style
from ssrics_like.report.drawing import Drawing
from ssrics_like.report.episodes import BEFORE_S, Episode, read_episodes
from ssrics_like.report.labels import text_half_size
from ssrics_like.report.records import Results
from ssrics_like.report.spans import BUSY, FAILED, FIRED, FULL, GOAL, PRODUCTIONS, STOPPED, Span
from ssrics_like.report.words import seen_text, time_text

if TYPE_CHECKING:
    from matplotlib.axes import Axes

LANES = (GOAL, "orienting", "retrieval", "imaginal", "landmark", PRODUCTIONS)
NAMES = {GOAL: "goal"}
LEFT_PT, RIGHT_PT, TOP_PT, BOTTOM_PT = 66.0, 10.0, 26.0, 30.0
LANE_PT, TITLE_PT = 17.0, 24.0
MS = 1000.0
SLACK_PT = 6.0
"""A label may be estimated this much wider than its bar: estimates are on the wide side."""

_LOOKS: dict[str, dict[str, Any]] = {
    FULL: {"facecolor": "#cfdeec", "edgecolor": "#8fb0cd"},
    BUSY: {"facecolor": "white", "edgecolor": style.BLUE, "hatch": "/////"},
    FAILED: {"facecolor": "white", "edgecolor": style.ACCENT, "hatch": "/////"},
    FIRED: {"facecolor": "#33475b", "edgecolor": "#33475b"},
    STOPPED: {"facecolor": "white", "edgecolor": "#33475b"},
}


def draw_timeline(results: Results) -> Drawing | None:
    """Draw the first interesting reflexes below each other; None where none was decided."""
    run = results.shown
    traced = results.scenario.get("trace", True)
    episodes = read_episodes(results.folder, run) if traced else []
    if not episodes:
        return None
    lanes = [lane for lane in LANES if any(s.lane == lane for e in episodes for s in e.spans)]
    strip_pt = LANE_PT * len(lanes)
    height_pt = TOP_PT + BOTTOM_PT + len(episodes) * (strip_pt + TITLE_PT)
    figure = style.new_figure(height_pt / style.POINTS)
    longest_ms = max(e.end_s - e.arrival_s for e in episodes) * MS
    for i, episode in enumerate(episodes):
        top = TOP_PT + (i + 1) * TITLE_PT + i * strip_pt
        axes = style.place_axes(figure, LEFT_PT, RIGHT_PT, height_pt - top - strip_pt, top)
        axes.set_xlim(-BEFORE_S * MS, longest_ms)
        axes.set_ylim(len(lanes) - 0.5, -0.5)
        _strip(axes, episode, lanes)
        if i == len(episodes) - 1:
            axes.set_xlabel("time since the reflex entered the orienting buffer, ms")
        else:
            axes.tick_params(labelbottom=False)
    _legend(figure, {s.kind for e in episodes for s in e.spans}, height_pt)
    listed = ", ".join(time_text(e.reflex.t_s) for e in episodes)
    return Drawing(
        "timeline",
        figure,
        "Timeline of buffers and productions for the first reflexes",
        "What the buffers held and which productions were at work while reflexes were decided: the "
        "first of each decision, then the first of the run. Each strip is one reflex, perceived at "
        f"{listed}; zero is when its chunk entered the orienting buffer, and a strip ends shortly "
        "after the decision.",
    )


def _strip(axes: Axes, episode: Episode, lanes: list[str]) -> None:
    low, high = axes.get_xlim()
    for lane in range(len(lanes)):
        axes.axhline(lane + 0.5, color=style.RULE, linewidth=0.6, zorder=0)
    end_ms = min((episode.end_s - episode.arrival_s) * MS, high)
    for lane, name in enumerate(lanes):
        spans = sorted((s for s in episode.spans if s.lane == name), key=lambda s: s.start_s)
        starts = [max((s.start_s - episode.arrival_s) * MS, low) for s in spans]
        for span, start, free in zip(spans, starts, [*starts[1:], high], strict=False):
            end = min((span.end_s - episode.arrival_s) * MS, end_ms)
            if end > start:
                _bar(axes, span, (start, end, free), lane)
    axes.axvline(0.0, color=style.MUTED, linewidth=0.7, dashes=(2, 2), zorder=1)
    axes.set_yticks(range(len(lanes)), [NAMES.get(lane, lane) for lane in lanes])
    axes.tick_params(axis="y", length=0)
    axes.spines["left"].set_visible(False)
    reflex = episode.reflex
    seen = seen_text(reflex.sector, reflex.structure)
    outcome = f"{reflex.decision} {reflex.landmark}".strip()
    axes.annotate(
        f"Reflex {reflex.event}: {outcome}", (0, 1), (-LEFT_PT + 2, 6), xycoords="axes fraction",
        textcoords="offset points", fontsize=style.FONT_PT, fontweight="bold",
    )  # fmt: skip
    axes.annotate(
        f"perceived at {time_text(reflex.t_s)} ({seen}; novelty {reflex.novelty:.2f}), "
        f"decided {reflex.decided_s - reflex.t_s:.2f} s later",
        (1, 1), (0, 6), xycoords="axes fraction", textcoords="offset points", ha="right",
        fontsize=style.SMALL_PT, color=style.MUTED,
    )  # fmt: skip


def _bar(axes: Axes, span: Span, times_ms: tuple[float, float, float], lane: int) -> None:
    """Draw a span from its start to its end; its label goes inside, or beside if that is free."""
    from matplotlib.patches import Rectangle

    start, end, free = times_ms
    look = _LOOKS[span.kind]
    axes.add_patch(Rectangle((start, lane - 0.36), end - start, 0.72, linewidth=0.8, **look))
    text = f"{span.label}: none" if span.kind == FAILED else span.label
    low, high = axes.get_xlim()
    points_per_ms = (style.WIDTH_IN * style.POINTS - LEFT_PT - RIGHT_PT) / (high - low)
    inside_pt, beside_pt = (end - start) * points_per_ms, (free - end) * points_per_ms
    place: dict[str, Any] = {"va": "center_baseline", "zorder": 5}
    if span.kind in (BUSY, FAILED):
        place["bbox"] = {"facecolor": "white", "edgecolor": "none", "pad": 1.0}
    for size in (style.SMALL_PT, style.TINY_PT):
        needed_pt = 2 * text_half_size(text, size)[0]
        if needed_pt <= inside_pt + SLACK_PT:
            colour = "white" if span.kind == FIRED else style.INK
            axes.text(
                (start + end) / 2, lane, text, ha="center", fontsize=size, color=colour, **place
            )
            return
    if needed_pt <= beside_pt:
        axes.text(end + 3 / points_per_ms, lane, text, fontsize=style.SMALL_PT,
                  color=style.INK, **place)  # fmt: skip


def _legend(figure: Any, kinds: set[str], height_pt: float) -> None:
    from matplotlib.patches import Patch

    names = {
        FULL: "buffer holds a chunk", BUSY: "retrieval under way", FAILED: "retrieval that fails",
        FIRED: "production, from selection to firing", STOPPED: "production stopped",
    }  # fmt: skip
    handles = [
        Patch(label=text, linewidth=0.8, **_LOOKS[kind])
        for kind, text in names.items()
        if kind in kinds
    ]
    figure.legend(
        handles=handles, loc="upper left", ncols=len(handles), columnspacing=1.6,
        bbox_to_anchor=(2 / (style.WIDTH_IN * style.POINTS), 1 - 4 / height_pt),
    )  # fmt: skip
