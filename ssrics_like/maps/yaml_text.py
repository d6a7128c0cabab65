"""Values as YAML text that gives the same values back."""

from __future__ import annotations

from typing import Any

import yaml


def yaml_text(value: Any, *, flow: bool | None) -> str:
    """Return a value as YAML.

    Parameters
    ----------
    value : dict or list
        Plain values.
    flow : bool or None
        Whether to write it in one line. None writes so only what holds no further lists or keys.
    """

    def dump(*, unicode: bool) -> str:
        text: str = yaml.safe_dump(
            value, default_flow_style=flow, sort_keys=False, allow_unicode=unicode, width=100_000
        )
        return text

    text = dump(unicode=True)
    # PyYAML writes some line separators as they are, and then reads them as spaces.
    return text if yaml.safe_load(text) == value else dump(unicode=False)
