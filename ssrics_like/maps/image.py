"""Pictures as grey levels: what a map's picture says before thresholds are applied."""

from __future__ import annotations

import warnings
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import NDArray
from PIL import Image, UnidentifiedImageError

from ssrics_like.errors import MapError
from ssrics_like.world.buildings.plan import CELLS_MAX

FORMATS = ("PNG", "PPM", "BMP")
"""As Pillow calls them; PPM stands for PGM and PBM too."""

_TOP = 255
_TOP_16 = 65_535


@dataclass(frozen=True, eq=False)
class GreyImage:
    """A picture's grey levels.

    Attributes
    ----------
    levels : ndarray, shape (rows, columns), unsigned integer
        Sum of a pixel's colour channels. Row 0 is the top.
    top : int
        The level of white.
    opaque : ndarray, shape (rows, columns), bool, or None
        Which pixels are not in the least transparent; None means all of them.
    """

    levels: NDArray[Any]
    top: int
    opaque: NDArray[np.bool_] | None = None


def read_image(path: Path) -> GreyImage:
    """Read a picture in PNG, PGM (plain or binary), PBM, PPM or BMP format, of any mode.

    Raises
    ------
    MapError
        The file is missing, is no picture, is cut off, or has too many pixels.
    """
    try:
        with warnings.catch_warnings():
            # Pillow warns of large pictures, which are counted here, and of odd chunks.
            warnings.simplefilter("ignore")
            return _read(path)
    except MapError:
        raise
    except Image.DecompressionBombError:
        raise _too_large(path) from None
    except Exception as e:  # noqa: BLE001 - a decoder fed garbage raises whatever it meets
        if isinstance(e, OSError) and e.strerror:
            said = {FileNotFoundError: "no such file", IsADirectoryError: "is a folder"}
            why = said.get(type(e), f"cannot be read ({e.strerror})")
            raise MapError(f"{path}: {why}") from None
        if isinstance(e, UnidentifiedImageError):
            raise MapError(f"{path}: is no picture in PNG, PGM, PPM or BMP format") from None
        raise MapError(f"{path}: the picture is cut off or damaged ({_first_line(e)})") from None


def _read(path: Path) -> GreyImage:
    with Image.open(path, formats=FORMATS) as image:
        columns, rows = image.size
        if columns * rows > CELLS_MAX:
            raise _too_large(path)
        if columns * rows == 0:
            raise MapError(f"{path}: the picture has no pixels")
        image.load()
        return _grey(image, path)


def _grey(image: Image.Image, path: Path) -> GreyImage:
    see_through = image.info.get("transparency")
    if image.mode.startswith("I"):  # 16 bits a pixel, also where Pillow keeps them in 32
        levels = np.asarray(image).astype(np.int64)
        if levels.min() < 0 or levels.max() > _TOP_16:
            raise MapError(f"{path}: has grey levels beyond 16 bits")
        opaque = levels != see_through if isinstance(see_through, int) else None
        return GreyImage(levels.astype(np.uint16), _TOP_16, opaque)
    if image.mode in ("1", "L"):
        image = image.convert("L" if see_through is None else "LA")
    elif image.mode in ("P", "RGB"):
        image = image.convert("RGB" if see_through is None else "RGBA")
    elif image.mode == "PA":
        image = image.convert("RGBA")
    if image.mode not in ("L", "LA", "RGB", "RGBA"):
        raise MapError(f"{path}: is a picture of mode {image.mode}, expected grey or colour")
    channels = np.atleast_3d(np.asarray(image))
    alpha = channels[..., -1] if image.mode.endswith("A") else None
    colours = channels if alpha is None else channels[..., :-1]
    depth = colours.shape[2]
    return GreyImage(
        colours.sum(axis=2, dtype=np.uint16), _TOP * depth, None if alpha is None else alpha == _TOP
    )


def _too_large(path: Path) -> MapError:
    return MapError(
        f"{path}: has more than {CELLS_MAX // 1_000_000} million pixels, more than a map may have"
    )


def _first_line(error: Exception) -> str:
    lines = str(error).splitlines()
    return lines[0] if lines else type(error).__name__
