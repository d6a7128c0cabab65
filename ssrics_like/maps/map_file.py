"""What a map's YAML file may say, as ROS map_server defines it and with keys of our own."""

from __future__ import annotations

from dataclasses import replace
from typing import Annotated, Any, Literal

import numpy as np
from numpy.typing import NDArray
from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    ValidationInfo,
    field_validator,
)

from ssrics_like.maps.image import GreyImage
from ssrics_like.world.grid import AT_ORIGIN, FREE, OCCUPIED, UNKNOWN, GridMap
from ssrics_like.world.locations import Kind, Location

ROS_OCCUPIED, ROS_FREE = 0.65, 0.196  # what the map_saver of ROS writes
RAW_OCCUPIED = 100  # nav_msgs/OccupancyGrid: 0 to 100, anything else is unknown

Share = Annotated[float, Field(ge=0.0, le=1.0)]


def _three(value: Any) -> Any:
    """Say plainly what an origin looks like."""
    if isinstance(value, list | tuple) and len(value) != 3:  # noqa: PLR2004 - x, y, yaw
        raise ValueError(f"{list(value)}: expected three numbers, [x, y, yaw]")
    return value


Triple = Annotated[
    tuple[float, float, float],
    Field(strict=False),  # YAML has lists, not tuples
    BeforeValidator(_three),
]


def _name(value: Any) -> Any:
    """Let a name be written as a number: ``id: 1``."""
    return str(value) if isinstance(value, int) and not isinstance(value, bool) else value


def _lower(value: Any) -> Any:
    return value.lower() if isinstance(value, str) else value


Name = Annotated[str, Field(min_length=1), BeforeValidator(_name)]


class _Strict(BaseModel):
    model_config = ConfigDict(frozen=True, extra="forbid", strict=True, allow_inf_nan=False)


class LocationEntry(_Strict):
    """A labelled place; attributes as `ssrics_like.world.locations.Location`."""

    id: Name
    x_m: float
    y_m: float
    label: str = ""
    kind: Kind = "doorway"

    def location(self) -> Location:
        """Return it as the world's own kind of value."""
        return Location(self.id, self.x_m, self.y_m, self.label, self.kind)


class MapFile(_Strict):
    """A map_server file.

    Attributes
    ----------
    image : str
        The picture, relative to the file.
    resolution : float
        Metres a pixel.
    origin : tuple of float
        x, y and yaw of the picture's lower left corner in the frame of the map.
    mode : {"trinary", "scale", "raw"}
        How a pixel becomes an occupancy.
    negate : bool or int
        Whether white is occupied.
    occupied_thresh, free_thresh : float
        Occupancy above which a cell is occupied, below which it is free.
    title : str
        What it is the map of.
    locations : tuple of LocationEntry
        Labelled places.
    humans : str or None
        CSV file of people's landmarks, relative to the file.
    """

    image: Annotated[str, Field(min_length=1)]
    resolution: Annotated[float, Field(gt=0.0)]
    origin: Triple = (0.0, 0.0, 0.0)
    mode: Annotated[Literal["trinary", "scale", "raw"], BeforeValidator(_lower)] = "trinary"
    negate: bool | Literal[0, 1] = False
    occupied_thresh: Share = ROS_OCCUPIED
    free_thresh: Annotated[Share, Field(validate_default=True)] = ROS_FREE
    title: str = ""
    locations: Annotated[tuple[LocationEntry, ...], Field(strict=False)] = ()
    humans: Annotated[str, Field(min_length=1)] | None = None

    @field_validator("free_thresh")
    @classmethod
    def _thresholds_are_in_order(cls, free: float, info: ValidationInfo) -> float:
        occupied = info.data.get("occupied_thresh", 1.0)
        if free > occupied:
            raise ValueError(f"the free threshold {free} is above the occupied one, {occupied}")
        return free

    def grid(self, image: GreyImage) -> GridMap:
        """Apply mode, negate and thresholds to the picture."""
        x_m, y_m, yaw_rad = self.origin
        origin = replace(AT_ORIGIN, x_m=x_m, y_m=y_m, theta_rad=yaw_rad)
        cells = self._meaning(image.top)[image.levels]
        if image.opaque is not None and self.mode != "raw":
            cells[~image.opaque] = UNKNOWN
        return GridMap(np.ascontiguousarray(cells[::-1]), self.resolution, origin)

    def _meaning(self, top: int) -> NDArray[np.uint8]:
        """Return what a cell of each grey level from 0 to `top` is."""
        levels = np.arange(top + 1)
        if self.mode == "raw":
            value = np.round(levels * 255 / top)
            occupancy = np.where(value <= RAW_OCCUPIED, value / RAW_OCCUPIED, np.nan)
        else:
            occupancy = (levels if self.negate else top - levels) / top
        meaning = np.full(top + 1, UNKNOWN, np.uint8)
        meaning[occupancy > self.occupied_thresh] = OCCUPIED
        meaning[occupancy < self.free_thresh] = FREE
        return meaning
