"""YAML files as checked settings: every error with its place, all of them at once.

PyYAML keeps a line mark on each node but drops it on loading, and lets a key
stand twice. Here the node tree is walked once, so that both are known when
pydantic has said what is wrong.
"""

from ssrics_like.settings.checking import explain, fields_at, in_order, validated
from ssrics_like.settings.document import Document, Key, Mark, read_document
from ssrics_like.settings.overriding import override, parse_override
from ssrics_like.settings.yaml_numbers import Dumper, Loader

__all__ = [
    "Document",
    "Dumper",
    "Key",
    "Loader",
    "Mark",
    "explain",
    "fields_at",
    "in_order",
    "override",
    "parse_override",
    "read_document",
    "validated",
]
