"""People and models on one page that opens offline, with every picture as SVG and PDF."""

from __future__ import annotations

import hashlib
import io
from typing import TYPE_CHECKING, Any

from ssrics_like.people.beside import Beside
from ssrics_like.people.definitions import DEFINITIONS
from ssrics_like.people.folders import Folders
from ssrics_like.people.markers import PEOPLE
from ssrics_like.report import style
from ssrics_like.report.drawing import HALO, as_svg
from ssrics_like.report.people_agreement_figure import draw_people_agreement
from ssrics_like.report.people_locations_figure import draw_people_locations
from ssrics_like.report.people_map_figure import draw_people_map
from ssrics_like.report.people_novelty_figure import draw_people_novelty
from ssrics_like.report.people_tables import (
    figure_table,
    figure_with_interval,
    location_table,
    pair_table,
    people_table,
    sortable,
)
from ssrics_like.report.rendering import rendered
from ssrics_like.report.words import figure_text

if TYPE_CHECKING:
    from ssrics_like.people.figures import Figure
    from ssrics_like.report.drawing import Drawing

PAGE = "comparison.html"
PDF_METADATA = {"CreationDate": None, "Creator": None, "Producer": None}
PAGE_PX, LEAST_PX = 1040.0, 640.0
"""Width of a figure on the page, and the least to which it is shrunk (page.css)."""
NOTHING = {
    "map": "",
    "locations": "There is no location, neither labelled nor found.",
    "agreement": "There is a single marker, and so no pair.",
    "novelty": "No results folder holds the novelty of its runs.",
}
HEADINGS = {
    "map": "Where people and robots marked landmarks",
    "locations": "Location by location",
    "agreement": "Who agrees with whom",
    "novelty": "Novelty along the route",
}


def page_and_figures(read: Folders, made: Beside) -> dict[str, str | bytes]:
    """Return the page and the pictures of a comparison, by the names of their files.

    What they hold depends on nothing but the comparison: the same one gives the same bytes.

    Raises
    ------
    ResultsError
        A file that only the pictures need is damaged.
    """
    files: dict[str, str | bytes] = {}
    sections = {}
    with style.context():
        drawings: dict[str, Drawing | None] = {
            "map": draw_people_map(read, made),
            "locations": draw_people_locations(made),
            "agreement": draw_people_agreement(made),
            "novelty": draw_people_novelty(read, made),
        }
        for name, drawing in drawings.items():
            svg = as_svg(drawing) if drawing else ""
            if drawing:
                files[f"figures/{name}.svg"] = svg
                files[f"figures/{name}.pdf"] = _pdf(drawing)
            sections[name] = {
                "heading": HEADINGS[name],
                "svg": _at_scale(svg, drawing) if drawing else "",
                "caption": drawing.caption if drawing else "",
                "otherwise": NOTHING[name],
            }
    content = {**_content(read, made), "sections": sections}
    return {PAGE: rendered("people.html", content), **files}


def sources_of(read: Folders) -> dict[str, Any]:
    """Return what was read, with the digest of the choices, as it stands in comparison.json."""
    return {
        "choices": {
            "file": read.choices.name,
            "sha256": hashlib.sha256(read.choices.read_bytes()).hexdigest(),
        },
        "models": [
            {
                "model": model.name,
                "title": str(records.scenario.get("title") or ""),
                "runs": len(model.runs),
                "seed": records.manifest.get("seed"),
            }
            for model, records in zip(read.models, read.records, strict=True)
        ],
        "map": read.building.title if read.building else None,
    }


def _at_scale(svg: str, drawing: Drawing) -> str:
    """Keep a figure that is narrower than the page from being blown up to its width."""
    width_px = PAGE_PX * drawing.figure.get_size_inches()[0] / style.WIDTH_IN
    if width_px >= PAGE_PX:
        return svg
    limits = f"max-width: {width_px:.0f}px; min-width: {min(LEAST_PX, width_px):.0f}px; "
    return svg.replace('style="', f'style="{limits}', 1)


def _pdf(drawing: Drawing) -> bytes:
    """Return a drawing as PDF; the white rim of text, a style in SVG, is drawn here."""
    import matplotlib as mpl
    from matplotlib.patheffects import withStroke
    from matplotlib.text import Text

    for text in drawing.figure.findobj(Text):
        if str(text.get_gid()).startswith(HALO):
            text.set_path_effects([withStroke(linewidth=2.4, foreground="white")])
    stream = io.BytesIO()
    with mpl.rc_context({"pdf.fonttype": 42}):
        drawing.figure.savefig(stream, format="pdf", metadata=PDF_METADATA)
    return stream.getvalue()


def _content(read: Folders, made: Beside) -> dict[str, Any]:
    settings = made.settings
    where = read.building.title if read.building else read.records[0].folder.name
    locations, bins = len(made.units.location_of), len(made.units.bins_m)
    facts = [
        ("people's choices", read.choices.name),
        ("radius", f"{settings.radius_m:g} m"),
        ("bin of the route", f"{settings.bin_m:g} m"),
        ("units", f"{len(made.units)}: {locations} locations and {bins} bins of the route"),
        ("locations", "found from people's marks" if made.clustered else "labelled"),
        ("draws for each interval", str(settings.resamples)),
        ("seed", str(settings.seed)),
    ]
    return {
        "title": f"People and robots on {where}",
        "people": len(made.people),
        "models": [(model.name, len(model.runs)) for model in made.models],
        "notes": made.notes,
        "cards": _cards(made),
        "locations": sortable(location_table(made)),
        "figures": sortable(figure_table(made)),
        "pairs": sortable(pair_table(made)),
        "participants": sortable(people_table(made)),
        "definitions": DEFINITIONS,
        "facts": facts,
    }


def _cards(made: Beside) -> list[tuple[str, str, str, bool]]:
    """Return the figures at the top: what, how much, a note, and whether it stands out."""
    people = made.figures[PEOPLE]
    cards = [
        ("Krippendorff's α of people", *_split(people["alpha"]), False),
        ("F of people, the ceiling", *_split(people["f_others"]), False),
    ]
    cards += [
        (f"F of {model.name}", *_split(made.figures[model.name]["f_others"]), True)
        for model in made.models
    ]
    return cards


def _split(figure: Figure) -> tuple[str, str]:
    """Return a figure, and its interval."""
    value = figure_text(figure.value)
    return value, figure_with_interval(figure).removeprefix(value).strip().strip("[]")
