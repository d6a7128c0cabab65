"""Values as YAML text that gives the same values back."""

from __future__ import annotations

from typing import Any

import yaml

from ssrics_like.settings import Dumper, Loader


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
        text: str = yaml.dump(
            value, Dumper=Dumper, default_flow_style=flow, sort_keys=False, allow_unicode=unicode,
            width=100_000,
        )  # fmt: skip
        return text

    text = dump(unicode=True)
    # PyYAML writes some line separators as they are, and then reads them as spaces.
    again = yaml.load(text, Loader)  # noqa: S506 - a SafeLoader
    return text if again == value else dump(unicode=False)
