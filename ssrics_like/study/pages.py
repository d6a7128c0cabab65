"""The pages of a study: templates filled, everything but our own markup escaped."""

from __future__ import annotations

from functools import cache
from typing import Any

import jinja2

from ssrics_like.study.study import Study, Trial
from ssrics_like.study.texts import html_of


@cache
def _environment() -> jinja2.Environment:
    return jinja2.Environment(
        loader=jinja2.PackageLoader("ssrics_like.study", "template"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )


def page(name: str, study: Study, **content: Any) -> str:
    """Return a page; Markdown texts of the study are given as ``consent`` and so on."""
    said = study.settings
    shown = {
        "title": said.title,
        "said": said,
        "html": html_of,
        "progress": None,
        **content,
    }
    return _environment().get_template(f"{name}.html").render(**shown)


def step_page(study: Study, trial: Trial | None, position: int, steps: int, name: str) -> str:
    """Return the page of a participant's step."""
    if position > steps:
        return page("thanks", study, participant=name)
    progress = {"at": position, "of": steps}
    if trial is None:
        return page("instructions", study, progress=progress)
    return page(trial.kind, study, trial=trial, progress=progress)
