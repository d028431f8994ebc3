"""The numbers of a mask that is an image."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from hylios.errors import InputError

from .images import linear
from .mask_nodes import NUMBER, WEIGHTS


def at_places(image: Any, places: NDArray, channel: str) -> NDArray[np.float32]:
    """An image at UV coordinates (N, 2), as an Image Texture node that extends the edges.

    Raises
    ------
    InputError
        If it has tiles.
    """
    pixels = _pixels(image)
    rows, columns, _ = pixels.shape
    at = np.clip(np.nan_to_num(places) * (columns, rows) - 0.5, 0.0, (columns - 1, rows - 1))
    low = np.minimum(at.astype(np.int64), (max(columns - 2, 0), max(rows - 2, 0)))
    high = np.minimum(low + 1, (columns - 1, rows - 1))
    part = (at - low).astype(np.float32)
    right, up = part[:, :1], part[:, 1:]
    lower = pixels[low[:, 1], low[:, 0]] * (1 - right) + pixels[low[:, 1], high[:, 0]] * right
    upper = pixels[high[:, 1], low[:, 0]] * (1 - right) + pixels[high[:, 1], high[:, 0]] * right
    return _numbers(image, np.asarray(lower * (1 - up) + upper * up, np.float32), channel)


def of_channel(colours: NDArray[np.float32], channel: str) -> NDArray[np.float32]:
    """What counts of colours (N, 4)."""
    if channel == "ALPHA":
        return colours[:, 3].copy()
    return colours[:, :3] @ np.array(WEIGHTS.get(channel, NUMBER), np.float32)


def _pixels(image: Any) -> NDArray[np.float32]:
    """Pixels (rows, columns, channels)."""
    if image.source == "TILED":
        raise InputError(
            f"The image {image.name!r} has tiles (UDIM), which cannot be copied; allowed is one "
            "without."
        )
    columns, rows = image.size
    pixels = np.empty(rows * columns * image.channels, np.float32)
    image.pixels.foreach_get(pixels)
    return pixels.reshape(rows, columns, image.channels)


def _numbers(image: Any, sampled: NDArray[np.float32], channel: str) -> NDArray[np.float32]:
    """Of pixels (N, channels)."""
    if image.channels < 4:
        opaque = np.ones((len(sampled), 1), np.float32)
        colours = sampled[:, :3] if image.channels == 3 else np.repeat(sampled[:, :1], 3, axis=1)
        sampled = np.concatenate([colours, opaque], axis=1)
    if not image.is_float and "sRGB" in image.colorspace_settings.name:
        sampled[:, :3] = linear(sampled[:, :3])
    return of_channel(sampled, channel)
