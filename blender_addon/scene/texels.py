"""Shares of several masks at the texels of the largest image among them."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any, cast

import bpy
import numpy as np
from numpy.typing import NDArray

from .mask_images import at_places, at_texels
from .mask_values import at_corners, mask_values, shares_of, uv_places
from .masks import Mask
from .unwrapped import Covered, covered

LARGEST = 4096
"""Texels along a side, at most."""

LEVELS = 255
"""Even steps of a share that texels tell apart; those of images of 8 bits are exact."""


@dataclass(frozen=True, eq=False)
class TexelShares:
    """Shares that differ, and which of them each texel has.

    Attributes
    ----------
    shares : (K, M) float array
    counts : (K,) int array
        Texels that have them.
    number : (rows, columns) int array
        Of the shares; the first row is at the bottom.
    uv_map : str
        Where the texels lie; empty for the map that renders.
    said : tuple of str
        Sentences on the masks.
    """

    shares: NDArray[np.float64]
    counts: NDArray[np.int_]
    number: NDArray[np.int_]
    uv_map: str
    said: tuple[str, ...]


def has_images(masks: Sequence[Mask]) -> bool:
    """Whether texels can tell the shares of masks: one is an image, and none has tiles."""
    images = [mask.image for mask in masks if mask.image is not None]
    return bool(images) and not any(image.source == "TILED" for image in images)


def texel_shares(obj: bpy.types.Object, masks: Sequence[Mask], largest: int) -> TexelShares:
    """Shares of masks, of which one is an image, at the texels of the largest image.

    Parameters
    ----------
    largest : int
        Texels along a side, at most.

    Raises
    ------
    InputError
        If a mask cannot be read.
    """
    lead = max((mask for mask in masks if mask.image), key=lambda mask: _texels(mask.image))
    size = np.array(cast(bpy.types.Image, lead.image).size)
    scale = min(1.0, largest / size.max())
    columns, rows = (max(int(side), 1) for side in np.ceil(size * scale))
    where: Covered | None = None
    key = np.zeros((rows * columns, 8), np.uint8)
    for number, mask in enumerate(masks):
        if mask.image is not None and mask.uv_map == lead.uv_map:
            shares = _of_image(mask, rows, columns)
        else:
            if where is None:
                mesh = cast(bpy.types.Mesh, obj.data)
                where = covered(mesh, uv_places(obj, lead.uv_map), rows, columns)
            shares = np.ones(rows * columns, np.float32)
            shares[where.texels] = _on_mesh(obj, mask, where)
        key[:, number] = shares * LEVELS + 0.5
    tuples, number = _differing(key.view(np.uint64).ravel())
    given = tuples.view(np.uint8).reshape(-1, 8)[:, : len(masks)] / LEVELS
    counts = np.bincount(number)
    said = () if where is None or where.is_clear else (_on_map(obj, lead.uv_map),)
    return TexelShares(given, counts, number.reshape(rows, columns), lead.uv_map, said)


def _on_map(obj: bpy.types.Object, uv_map: str) -> str:
    called = f"the UV map {uv_map!r}" if uv_map else "the UV map"
    return (
        f"Faces of {obj.name!r} lie over each other or outside the image in {called}; with more "
        "than three masks those that are no images are wrong there."
    )


def _texels(image: Any) -> int:
    return image.size[0] * image.size[1]


def _of_image(mask: Mask, rows: int, columns: int) -> NDArray[np.float32]:
    """Shares at all texels of an image, or between them for another size."""
    image = cast(Any, mask.image)
    if tuple(image.size) == (columns, rows):
        return shares_of(mask, at_texels(image, mask.channel))
    y, x = np.mgrid[:rows, :columns].reshape(2, -1)
    places = np.stack([(x + 0.5) / columns, (y + 0.5) / rows], axis=1)
    return shares_of(mask, at_places(image, places, mask.channel))


def _on_mesh(obj: bpy.types.Object, mask: Mask, where: Covered) -> NDArray[np.float32]:
    """Shares of a mask at points of the mesh."""
    if mask.image is not None:
        places = where.values(uv_places(obj, mask.uv_map))
        return shares_of(mask, at_places(mask.image, places, mask.channel))
    mesh = cast(bpy.types.Mesh, obj.data)
    return np.clip(where.values(at_corners(mesh, mask_values(obj, mask))), 0.0, 1.0)


def _differing(key: NDArray[np.uint64]) -> tuple[NDArray[np.uint64], NDArray[np.int64]]:
    """Keys that differ, and which of them each is; quick where neighbours are alike."""
    starts = np.flatnonzero(np.append(True, key[1:] != key[:-1]))
    differing, number = np.unique(key[starts], return_inverse=True)
    lengths = np.diff(np.append(starts, key.size))
    return differing, np.repeat(number.ravel(), lengths)
