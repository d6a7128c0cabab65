"""Observations from logs: CARMEN, CMU, pose graphs, DP-SLAM and URG rows, plain or gzipped."""

from ssrics_like.sources.log import LogSource, open_log
from ssrics_like.sources.recognise import FORMATS
from ssrics_like.sources.report import ReadReport
from ssrics_like.sources.timing import TimingSummary

__all__ = ["FORMATS", "LogSource", "ReadReport", "TimingSummary", "open_log"]
