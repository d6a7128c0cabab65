"""What a results folder shows: figures and one page that opens offline."""

from ssrics_like.report.comparison_figure import comparison_svg
from ssrics_like.report.page import write_report
from ssrics_like.report.variants_page import write_variants_report
from ssrics_like.results.listing import has_variants

__all__ = ["comparison_svg", "has_variants", "write_report", "write_variants_report"]
