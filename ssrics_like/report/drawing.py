"""From a matplotlib figure to SVG text that can stand in a page with others."""

from __future__ import annotations

import io
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from html import escape
from typing import TYPE_CHECKING

from ssrics_like.report.style import MEASURED_FONT, SHOWN_FONTS

if TYPE_CHECKING:
    from matplotlib.figure import Figure

HALO = "halo"
"""Prefix of the gid of text that gets a white rim, to be read on lines and walls."""

_HALO_STYLE = "paint-order: stroke; stroke: #fff; stroke-width: 2.6px; stroke-linejoin: round"
_ROOT_STYLE = "stroke-linejoin: round; stroke-linecap: butt"
_NUMBERS = re.compile(r'( (?:d|x|y)=")([^"]*)"')
_METADATA = {"Date": None, "Creator": None, "Format": None, "Type": None}


@dataclass(frozen=True, eq=False)
class Drawing:
    """A figure with what is said of it.

    Attributes
    ----------
    name : str
        Name of its file without ending, and prefix of the ids in it.
    figure : Figure
        As matplotlib drew it.
    label : str
        What a screen reader says in its place.
    caption : str
        One or two sentences: what is seen and how to read it.
    tips : mapping of str to str
        gid of an artist -> text shown when the pointer rests on it.
    """

    name: str
    figure: Figure
    label: str
    caption: str
    tips: Mapping[str, str] = field(default_factory=dict)


def as_svg(drawing: Drawing) -> str:
    """Return a drawing as SVG text; equal drawings give equal text.

    The text is made fit for a page: ids carry the drawing's name, no style rule reaches beyond
    it, nothing refers to the net, coordinates have two decimals (1/7200 inch).
    """
    stream = io.StringIO()
    drawing.figure.savefig(stream, format="svg", metadata=_METADATA)
    svg = stream.getvalue()
    svg = re.sub(r"<\?xml.*?\?>|<!DOCTYPE.*?>|<!--.*?-->", "", svg, flags=re.DOTALL)
    svg = re.sub(r"<metadata>.*?</metadata>", "", svg, flags=re.DOTALL)
    svg = re.sub(r'<defs>\s*<style type="text/css">[^<]*</style>\s*</defs>', "", svg)
    svg = svg.replace(f"'{MEASURED_FONT}'", SHOWN_FONTS)
    svg = re.sub(r' transform="rotate\(-0 [^"]*\)"', "", svg)
    # Enlarged images are smoothed; these are drawn large enough to be reduced instead.
    svg = re.sub(r' style="image-rendering:[^"]*"', "", svg)
    svg = _NUMBERS.sub(_shortened, svg)
    svg = re.sub(r"\s*\n\s*", "\n", svg)
    prefix = drawing.name
    svg = re.sub(r' id="([^"]*)"', rf' id="{prefix}-\1"', svg)
    svg = re.sub(r'(xlink:href="#|url\(#)', rf"\1{prefix}-", svg)
    svg = re.sub(rf'(<g id="{prefix}-{HALO}[^"]*")>', rf'\1 style="{_HALO_STYLE}">', svg)
    for gid, text in drawing.tips.items():
        mark = f'<g id="{prefix}-{gid}"'
        svg = re.sub(
            rf"{re.escape(mark)}([^>]*)>",
            lambda found, mark=mark, text=text: (  # type: ignore[misc]
                f"{mark}{found[1]}><title>{escape(text, quote=False)}</title>"
            ),
            svg,
            count=1,
        )
    root = f'<svg role="img" aria-label="{escape(drawing.label)}" style="{_ROOT_STYLE}" '
    return svg.replace("<svg ", root, 1).strip() + "\n"


def _shortened(found: re.Match[str]) -> str:
    numbers = re.sub(r"(\.\d\d)\d+", r"\1", found[2])
    joined = re.sub(r" ?\n(?=[A-Za-z])|\n$", "", numbers)
    return f'{found[1]}{joined}"'
