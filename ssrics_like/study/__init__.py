"""Collecting people's choices of landmarks: studies as YAML, a web page, a store, tables."""

from ssrics_like.study.order import order_of
from ssrics_like.study.reading import read_study
from ssrics_like.study.study import Study, Trial

__all__ = ["Study", "Trial", "order_of", "read_study"]
