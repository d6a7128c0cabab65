"""Writes the page: data, style and script in one file that needs no other."""

from __future__ import annotations

from pathlib import Path
from typing import Any

import jinja2

from ssrics_like.errors import ResultsError
from ssrics_like.results.files import json_text, write_atomically
from ssrics_like.viewer.content import content_of
from ssrics_like.viewer.reading import read_watched

ENDINGS = (".html", ".htm")
SCRIPTS = (
    "decoding.js", "time.js", "colours.js", "camera.js", "labels.js", "map.js", "gestures.js",
    "plot.js", "novelty.js", "activation.js", "buffers.js", "productions.js", "decisions.js",
    "view.js",
)  # fmt: skip
"""In the order in which they build on one another."""


def write_view(
    folder: Path, number: int | None = None, *, log: Path | None = None, out: Path | None = None
) -> Path:
    """Write the page on which a run is played.

    Parameters
    ----------
    folder : Path
        A folder that ``ssrics run`` or ``ssrics replay`` wrote.
    number : int, optional
        Number of the run; the first one if left out.
    log : Path, optional
        The log that the folder was made from, for its scans.
    out : Path, optional
        The page; ``view-run-NNN.html`` in the folder if left out. The same input gives the same
        bytes.

    Returns
    -------
    Path
        Where it is.

    Raises
    ------
    ResultsError
        See `ssrics_like.viewer.reading.read_watched`; or the page cannot be written.
    MapError, MemoryFileError, SourceError
        The map, the saved topological memory or the log is damaged or missing.
    """
    folder = Path(folder)
    if out is not None:
        _check(out)
    watched = read_watched(folder, number, log)
    page = out or folder / f"view-{watched.run.name}.html"
    try:
        write_atomically(page, page_text(content_of(watched, folder)))
    except OSError as e:
        raise ResultsError(f"{page}: cannot be written ({e.strerror})") from None
    return page


def page_text(content: dict[str, Any]) -> str:
    """Return the page that shows some content."""
    loader = jinja2.ChoiceLoader(
        [
            jinja2.PackageLoader("ssrics_like.viewer", "template"),
            jinja2.PackageLoader("ssrics_like.report", "template"),  # the look that pages share
        ]
    )
    environment = jinja2.Environment(
        loader=loader,
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    # In a script element only "<" could end the element, or begin a comment.
    data = json_text(content, indent=None).replace("<", "\\u003c")
    template = environment.get_template("view.html")
    return template.render(content=content, data=data, scripts=SCRIPTS)


def _check(out: Path) -> None:
    """Complain of a name that no page can have, before anything is read."""
    if out.is_dir() or out.suffix.lower() not in ENDINGS:
        raise ResultsError(f"--out: {out}: expected the name of a page, ending in .html")
    if not out.parent.is_dir():
        raise ResultsError(f"--out: {out}: there is no folder {out.parent}")
