"""Options that several commands share."""

from __future__ import annotations

from pathlib import Path
from typing import Annotated

from cyclopts import Parameter

Out = Annotated[Path | None, Parameter(name=["--out", "-o"])]
Overrides = Annotated[tuple[str, ...], Parameter(name="--set", negative="", consume_multiple=False)]
Quiet = Annotated[bool, Parameter(name=["--quiet", "-q"], negative="")]
Flag = Annotated[bool, Parameter(negative="")]
