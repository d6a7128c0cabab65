"""What a results folder shows: figures and one page that opens offline."""

from ssrics_like.report.page import write_report

__all__ = ["write_report"]
