"""A run of a results folder to look at moment by moment: one page that opens offline."""

from ssrics_like.viewer.page import write_view

__all__ = ["write_view"]
