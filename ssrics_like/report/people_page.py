"""People and models on one page that opens offline, with every picture as SVG and PDF."""

from __future__ import annotations

import hashlib
import io
from pathlib import Path
from typing import TYPE_CHECKING, Any

from ssrics_like.people.beside import Beside
from ssrics_like.people.definitions import TERMS, WORDS
from ssrics_like.people.folders import Folders
from ssrics_like.people.markers import PEOPLE
from ssrics_like.people.names import short
from ssrics_like.people.resampling import LEAST
from ssrics_like.report import style
from ssrics_like.report.drawing import HALO, as_svg
from ssrics_like.report.people_agreement_figure import draw_people_agreement
from ssrics_like.report.people_ceiling_figure import draw_people_ceiling
from ssrics_like.report.people_locations_figure import draw_people_locations
from ssrics_like.report.people_map_figure import draw_people_map
from ssrics_like.report.people_novelty_figure import draw_people_novelty
from ssrics_like.report.people_tables import (
    figure_table,
    figure_with_interval,
    location_table,
    pair_table,
    people_table,
    people_text,
    sortable,
)
from ssrics_like.report.rendering import rendered
from ssrics_like.report.words import figure_text
from ssrics_like.results.counts import counted

if TYPE_CHECKING:
    from ssrics_like.people.figures import Figure
    from ssrics_like.report.drawing import Drawing

PAGE = "comparison.html"
PDF_METADATA = {"CreationDate": None, "Creator": None, "Producer": None}
PAGE_PX, LEAST_PX, PHONE_PX = 1040.0, 640.0, 330.0
"""Width of a figure on the page, the least to which it is shrunk (page.css), and of a phone's."""
NOTHING = {
    "map": "",
    "locations": "There is no location, neither labelled nor found.",
    "ceiling": "Of a single person there are no others to hold anybody against.",
    "agreement": "There is a single marker, and so no pair.",
    "novelty": "No results folder holds the novelty of its runs.",
}
HEADINGS = {
    "map": "Where people and robots marked landmarks",
    "locations": "Location by location",
    "ceiling": "Where robots stand among people",
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
            "ceiling": draw_people_ceiling(made),
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
                "wide": drawing is not None and _width_px(drawing) > PHONE_PX,
                "caption": drawing.caption if drawing else "",
                "otherwise": NOTHING[name],
            }
    content = {**_content(read, made), "sections": sections}
    return {PAGE: rendered("people.html", content), **files}


def sources_of(read: Folders) -> dict[str, Any]:
    """Return what was read, with the digest of the choices, as it stands in comparison.json."""
    return {
        "choices": _named(read.choices),
        "participants": _listed(read),
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


def _named(file: Path) -> dict[str, Any]:
    return {"file": file.name, "sha256": hashlib.sha256(file.read_bytes()).hexdigest()}


def _listed(read: Folders) -> dict[str, Any] | None:
    if read.listed is None:
        return None
    return {
        **_named(read.listed.file),
        "marked_nothing": list(read.listed.silent),
        "unfinished": read.listed.unfinished,
    }


def _at_scale(svg: str, drawing: Drawing) -> str:
    """Keep a figure that is narrower than the page from being blown up to its width."""
    width_px = _width_px(drawing)
    if width_px >= PAGE_PX:
        return svg
    limits = f"max-width: {width_px:.0f}px; min-width: {min(LEAST_PX, width_px):.0f}px; "
    return svg.replace('style="', f'style="{limits}', 1)


def _width_px(drawing: Drawing) -> float:
    return PAGE_PX * float(drawing.figure.get_size_inches()[0]) / style.WIDTH_IN


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
        ("list of participants", _list_of(read)),
        ("radius", f"{settings.radius_m:g} m"),
        ("bin of the route", f"{settings.bin_m:g} m"),
        ("units", f"{len(made.units)}: {locations} locations and {bins} bins of the route"),
        ("locations", "found from people's marks" if made.clustered else "labelled"),
        ("draws for each interval", str(settings.resamples)),
        ("seed", str(settings.seed)),
    ]
    return {
        "title": f"People and robots on {where}",
        "people": people_text(made),
        "models": [
            (short(model.name), model.name, counted(len(model.runs), "run"))
            for model in made.models
        ],
        "notes": made.notes,
        "cards": _cards(made),
        "locations": sortable(location_table(made)),
        "figures": sortable(figure_table(made)),
        "pairs": sortable(pair_table(made)),
        "participants": sortable(people_table(made)),
        "words": [(term, text) for term, text in TERMS.items() if term in WORDS],
        "definitions": [(term, text) for term, text in TERMS.items() if term not in WORDS],
        "facts": facts,
        "has_intervals": len(made.people) >= LEAST,
    }


def _list_of(read: Folders) -> str:
    if read.listed is None:
        return "none; whoever marked nothing is not counted"
    silent, unfinished = len(read.listed.silent), read.listed.unfinished
    return (
        f"{read.listed.file.name}; {silent} finished and marked nothing, {unfinished} neither "
        "finished nor marked anything and are not counted"
    )


def _cards(made: Beside) -> list[tuple[str, str, str, bool]]:
    """Return the figures at the top: what, how much, its interval, and whether it stands out."""
    people = made.figures[PEOPLE]
    cards = [
        ("Krippendorff's α of people", *_split(people["alpha"]), False),
        ("F of people: the ceiling", *_split(people["f_others"]), False),
    ]
    cards += [
        (f"F of {short(model.name)}", *_split(made.figures[model.name]["f_others"]), True)
        for model in made.models
    ]
    return cards


def _split(figure: Figure) -> tuple[str, str]:
    """Return a figure, and its interval."""
    value = figure_text(figure.value)
    return value, figure_with_interval(figure).removeprefix(value).strip().strip("[]")
