"""How every figure looks: colours, sizes, fonts. The page's own colours stand in page.css."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from typing import TYPE_CHECKING, Any

from ssrics_like.results.records import DECISIONS

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

# Colours that colour-blind readers can tell apart: Okabe & Ito (2008), "Color universal design".
BLUE, ORANGE, GREEN, VERMILION = "#0072B2", "#E69F00", "#009E73", "#D55E00"

SECTORS = {"left": BLUE, "front": ORANGE, "right": GREEN}
HIGHLIGHTS = (
    "#332288", "#CC6677", "#44AA99", "#882255", "#999933",
    "#AA4499", "#117733", "#4A9CC4", "#5B6470", "#8C6D1F",
)  # fmt: skip
"""Colours of lines, none of which is a sector's; after Tol (2021), "Colour schemes", muted."""

INK = "#1f2933"
MUTED = "#66727f"
RULE = "#d8dee4"
PALE = "#c3ccd5"
WALL = "#aab4bf"
PLAN_WALL = "#56616b"
UNKNOWN = "#eceff2"
PATH_FROM, PATH_TO = "#b9cbe0", "#33527a"
ACCENT = VERMILION

WIDTH_IN = 10.0
POINTS = 72.0
FONT_PT = 8.5
SMALL_PT = 7.0
TINY_PT = 6.2

MEASURED_FONT = "DejaVu Sans"
"""Comes with matplotlib, so that layout and bytes are the same on every machine."""

SHOWN_FONTS = "system-ui, 'Segoe UI', Roboto, Helvetica, Arial, sans-serif"
"""What a browser shows instead; all are narrower, so that nothing runs over."""

_PARAMETERS: dict[Any, Any] = {
    "axes.axisbelow": True,
    "axes.edgecolor": PALE,
    "axes.labelcolor": MUTED,
    "axes.labelsize": FONT_PT,
    "axes.linewidth": 0.8,
    "axes.spines.right": False,
    "axes.spines.top": False,
    "axes.titlecolor": INK,
    "axes.titlelocation": "left",
    "axes.titlesize": FONT_PT + 1,
    "axes.titleweight": "bold",
    "axes.unicode_minus": True,
    "figure.facecolor": "white",
    "font.family": [MEASURED_FONT],
    "font.size": FONT_PT,
    "grid.color": "#edf0f3",
    "grid.linewidth": 0.8,
    "legend.borderaxespad": 0.0,
    "legend.borderpad": 0.0,
    "legend.fontsize": FONT_PT - 0.5,
    "legend.frameon": False,
    "legend.handletextpad": 0.35,
    "legend.labelcolor": INK,
    "path.simplify": True,
    "svg.fonttype": "none",
    "svg.hashsalt": "ssrics-like",
    "text.color": INK,
    "text.parse_math": False,
    "xtick.color": PALE,
    "xtick.labelcolor": MUTED,
    "xtick.labelsize": FONT_PT - 0.5,
    "xtick.major.size": 3.0,
    "ytick.color": PALE,
    "ytick.labelcolor": MUTED,
    "ytick.labelsize": FONT_PT - 0.5,
    "ytick.major.size": 3.0,
}


@contextmanager
def context() -> Iterator[None]:
    """Draw and save figures in this style, whatever the user's own matplotlibrc says."""
    import matplotlib as mpl

    with mpl.rc_context():
        mpl.rcdefaults()
        mpl.rcParams.update(_PARAMETERS)
        yield


def new_figure(height_in: float, width_in: float = WIDTH_IN) -> Figure:
    """Return an empty figure, of the page's width if none is given."""
    from matplotlib.figure import Figure

    return Figure(figsize=(width_in, height_in))


def place_axes(figure: Figure, left: float, right: float, bottom: float, top: float) -> Axes:
    """Add axes inside margins given in points."""
    width, height = figure.get_size_inches() * POINTS
    return figure.add_axes(
        (left / width, bottom / height, (width - left - right) / width,
         (height - bottom - top) / height)
    )  # fmt: skip


def mixed(colour: str, share: float) -> str:
    """Return a colour thinned with white."""
    from matplotlib.colors import to_hex, to_rgb

    red, green, blue = (1.0 - share * (1.0 - part) for part in to_rgb(colour))
    return to_hex((red, green, blue))


def sector_colour(sector: str) -> str:
    """Return the colour of a sector; grey for one that the report does not know."""
    return SECTORS.get(sector, MUTED)


def decision_order(decision: str) -> int:
    """Return the place of a decision among all of them."""
    return DECISIONS.index(decision) if decision in DECISIONS else len(DECISIONS)
