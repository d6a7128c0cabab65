"""Markdown as HTML; raw HTML in it is shown as it is written, and pictures are left out."""

from __future__ import annotations

from functools import cache
from typing import TYPE_CHECKING

from ssrics_like.study.packages import needed

if TYPE_CHECKING:
    from markdown_it import MarkdownIt


@cache
def _parser() -> MarkdownIt:
    found: MarkdownIt = needed("markdown_it").MarkdownIt("commonmark", {"html": False})
    # A picture would be a request to somebody else's server.
    return found.disable("image")


def html_of(markdown: str) -> str:
    """Return Markdown as HTML that holds no markup but its own.

    Raises
    ------
    MissingPackageError
        markdown-it-py is not installed.
    """
    return str(_parser().render(markdown))
