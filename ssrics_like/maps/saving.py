"""From a building to a map on disk, the same bytes each time."""

from __future__ import annotations

import io
from pathlib import Path

import numpy as np
from PIL import Image

from ssrics_like.atomic import write_atomically
from ssrics_like.errors import MapError
from ssrics_like.maps.map_file import ROS_FREE, ROS_OCCUPIED
from ssrics_like.maps.yaml_text import yaml_text
from ssrics_like.world.building import Building
from ssrics_like.world.grid import FREE, OCCUPIED, UNKNOWN, GridMap

GREYS = {FREE: 254, OCCUPIED: 0, UNKNOWN: 205}
"""As the map_saver of ROS writes them."""


def save_building(building: Building, folder: Path, name: str = "map") -> Path:
    """Write a building as ``name.yaml`` and ``name.png``, as ROS map_server reads them.

    `ssrics_like.maps.load_building` gives the same building back, to the last bit.

    Parameters
    ----------
    building : Building
        What to write.
    folder : Path
        Where to; made if it is not there.
    name : str
        Name of the files without ending.

    Returns
    -------
    Path
        The YAML file.

    Raises
    ------
    MapError
        The files cannot be written.
    """
    path = folder / f"{name}.yaml"
    try:
        folder.mkdir(parents=True, exist_ok=True)
        write_atomically(folder / f"{name}.png", png_of(building.grid))
        write_atomically(path, yaml_of(building, f"{name}.png"))
    except OSError as e:
        raise MapError(f"{path}: cannot be written ({e.strerror})") from None
    return path


def png_of(grid: GridMap) -> bytes:
    """Return a grid as a PNG picture with 8 bits of grey, its highest row on top."""
    greys = np.zeros(max(GREYS) + 1, np.uint8)
    greys[list(GREYS)] = list(GREYS.values())
    stream = io.BytesIO()
    Image.fromarray(greys[grid.cells[::-1]]).save(stream, "PNG", optimize=True)
    return stream.getvalue()


def yaml_of(building: Building, image: str) -> str:
    """Return what the YAML file says of a building whose picture is `image`."""
    origin = building.grid.origin
    data = {
        "title": building.title,
        "image": image,
        "resolution": building.grid.cell_m,
        "origin": [origin.x_m, origin.y_m, origin.theta_rad],
        "occupied_thresh": ROS_OCCUPIED,
        "free_thresh": ROS_FREE,
        "negate": 0,
    }
    if building.locations:
        data["locations"] = [
            {"id": p.id, "x_m": p.x_m, "y_m": p.y_m, "label": p.label, "kind": p.kind}
            for p in building.locations
        ]
    return yaml_text(data, flow=None)
