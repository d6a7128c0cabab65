"""YAML whose 1e-3 is a number, as in YAML 1.2; YAML 1.1, and so PyYAML, wants 1.0e-3."""

from __future__ import annotations

import re

import yaml

_FLOAT = "tag:yaml.org,2002:float"
_EXPONENT = re.compile(r"[-+]?[0-9][0-9_]*(\.[0-9_]*)?[eE][-+]?[0-9]+")
_FIRST = list("-+0123456789")


class Loader(yaml.SafeLoader):
    """Reads 1e-3 as a number."""


class Dumper(yaml.SafeDumper):
    """Puts text that reads like such a number in quotes."""


for _kind in (Loader, Dumper):
    _kind.add_implicit_resolver(_FLOAT, _EXPONENT, _FIRST)
