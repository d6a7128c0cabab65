"""Puts figures, tables and the manifest together into one page that opens offline."""

from __future__ import annotations

from pathlib import Path
from typing import TYPE_CHECKING

from ssrics_like.errors import ResultsError
from ssrics_like.report import style
from ssrics_like.report.activation_figure import draw_activation
from ssrics_like.report.column_figure import draw_column_map
from ssrics_like.report.content import content_of
from ssrics_like.report.drawing import as_svg
from ssrics_like.report.graph_figure import draw_graph
from ssrics_like.report.histogram_figure import draw_histograms
from ssrics_like.report.locations_figure import draw_locations
from ssrics_like.report.map_figure import draw_map
from ssrics_like.report.novelty_figure import draw_novelty
from ssrics_like.report.reading import read_results
from ssrics_like.report.records import Results
from ssrics_like.report.rendering import rendered
from ssrics_like.report.runs_figure import draw_runs
from ssrics_like.report.timeline_figure import draw_timeline
from ssrics_like.results.files import write_atomically

if TYPE_CHECKING:
    from collections.abc import Callable

    from ssrics_like.report.drawing import Drawing

PAGE = "report.html"

FIGURES: tuple[tuple[str, str, str, Callable[[Results], Drawing | None], str], ...] = (
    ("map", "Map", "Map", draw_map, ""),
    ("locations", "Locations", "Locations found", draw_locations,
     "No doorway is labelled on this map, so that no location is designated."),
    ("runs", "Runs", "All runs", draw_runs, ""),
    ("novelty", "Novelty", "Novelty over time", draw_novelty,
     "The run ended before the first interval was complete, so there is no novelty to show."),
    ("histograms", "Histograms", "A novel and a bored interval", draw_histograms,
     "The run ended before the first interval was complete, so there are no correlations to show."),
    ("timeline", "Timeline", "Buffers and productions", draw_timeline,
     "No reflex was decided in this run, so no buffer was used; or the scenario keeps no trace."),
    ("activation", "Activation", "Activation of landmarks", draw_activation,
     "No landmark was declared in this run, so that declarative memory held none."),
    ("graph", "Graph", "Topological memory", draw_graph, "No landmark was declared in this run."),
)  # fmt: skip
"""Name, short and full heading, how to draw it, and what to say where there is nothing to draw."""


def write_report(folder: Path) -> Path:
    """Draw the figures of a results folder and write its report.

    What is written depends on nothing but the results: the same ones give the same bytes.

    Parameters
    ----------
    folder : Path
        A folder that ``ssrics run`` or ``ssrics replay`` wrote.

    Returns
    -------
    Path
        ``report.html``, which needs no other file; ``figures/*.svg`` stand beside it.

    Raises
    ------
    ResultsError
        The folder holds no results, a file is missing or damaged, or the report cannot be written.
    MemoryFileError
        The saved topological memory is missing or damaged.
    """
    folder = Path(folder)
    results = read_results(folder)
    with style.context():
        sections = [_section(results, *figure) for figure in FIGURES]
        column = draw_column_map(results)
        figures = {section["name"]: section["svg"] for section in sections}
        figures["map-column"] = as_svg(column) if column else ""
    if results.scores is None:
        sections = [section for section in sections if section["name"] != "locations"]
    page = folder / PAGE
    shown = [section for section in sections if section["svg"] or section["otherwise"]]
    html = rendered("page.html", {**content_of(results), "sections": shown})
    try:
        (folder / "figures").mkdir(exist_ok=True)
        for name, svg in figures.items():
            file = folder / "figures" / f"{name}.svg"
            if svg:
                write_atomically(file, svg)
            else:
                file.unlink(missing_ok=True)  # of an earlier report
        write_atomically(page, html)
    except OSError as e:
        raise ResultsError(f"{e.filename or folder}: cannot be written ({e.strerror})") from None
    return page


def _section(
    results: Results,
    name: str,
    short: str,
    heading: str,
    draw: Callable[[Results], Drawing | None],
    otherwise: str,
) -> dict[str, str]:
    """Draw a figure; return it with what stands around it."""
    drawing = draw(results)
    if name == "activation" and results.shown.landmarks:
        otherwise = (
            "The rule set keeps no landmark in declarative memory, so that none has an activation."
        )
    return {
        "name": name,
        "short": short,
        "heading": heading,
        "svg": as_svg(drawing) if drawing else "",
        "caption": drawing.caption if drawing else "",
        "otherwise": otherwise,
    }
