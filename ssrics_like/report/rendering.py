"""Fills the page templates; everything but our own figures, style and script is escaped."""

from __future__ import annotations

from typing import Any


def rendered(template: str, content: dict[str, Any]) -> str:
    """Return a template of the folder ``template/`` filled with content."""
    import jinja2

    environment = jinja2.Environment(
        loader=jinja2.PackageLoader("ssrics_like.report", "template"),
        autoescape=True,
        undefined=jinja2.StrictUndefined,
        trim_blocks=True,
        lstrip_blocks=True,
        keep_trailing_newline=True,
    )
    return environment.get_template(template).render(**content)
