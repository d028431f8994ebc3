"""Float images that carry a table of numbers inside the .blend."""

from collections.abc import Mapping
from typing import Any, cast

import bpy
import numpy as np

from hylios.errors import InputError

from .ownership import NewBlocks, Users

# The first name is that of Blender's own configuration, the others those of common studio ones.
COLOUR_SPACES = (
    "Linear Rec.709",
    "Linear Rec.709 (sRGB)",
    "lin_rec709",
    "lin_rec709_srgb",
    "lin_rec709_scene",
    "Utility - Linear - Rec.709",
    "Utility - Linear - sRGB",
    "lin_srgb",
)
DATA_SPACES = ("Non-Color", "Raw", "Utility - Raw", "raw", "data")
MARK = "skin_tan"
"""Custom property of an image that says that this add-on made it."""


def packed_image(
    blocks: NewBlocks, name: str, values: np.ndarray, *, is_colour: bool
) -> bpy.types.Image:
    """Store values (rows, columns, 3) in a new packed float image, the first row at the bottom.

    Parameters
    ----------
    is_colour : bool
        Whether they are linear Rec.709 colours, or else numbers that are no colours.

    Raises
    ------
    InputError
        If Blender's colour management has no space that fits.
    """
    rows, columns, _ = values.shape
    image = blocks.add(bpy.data.images.new(name, columns, rows, alpha=False, float_buffer=True))
    image[MARK] = True
    # Setting it after the pixels would discard them.
    set_colour_space(image, is_colour=is_colour)
    pixels = np.ones((rows, columns, 4), dtype=np.float32)
    pixels[..., :3] = values
    cast(Any, image.pixels).foreach_set(pixels.ravel())
    image.update()
    image.pack()
    # Blender takes pixels that are set for numbers of its working space; those that it reads from
    # the packed file it converts.
    image.buffers_free()
    return image


def set_colour_space(image: bpy.types.Image, *, is_colour: bool) -> None:
    """Declare an image to hold linear Rec.709 colours, or else numbers that are no colours.

    Raises
    ------
    InputError
        If Blender's colour management has no such space.
    """
    names = COLOUR_SPACES if is_colour else DATA_SPACES
    settings: Any = image.colorspace_settings
    for name in names:
        try:
            settings.name = name
        except TypeError:
            continue
        return
    raise InputError(f"Blender's colour management has none of the spaces {', '.join(names)}.")


def replace(
    replaced: Mapping[bpy.types.Image, bpy.types.Image], users: Users, obj: bpy.types.Object
) -> None:
    """Remove an object's former images that no other shows; the new ones get their names."""
    former = {
        image: image.name
        for image in replaced
        if image.get(MARK) and image.library is None and not users.others(image, obj)
    }
    for image in former:
        if image.users > image.use_fake_user:  # nodes of the artist's own show it
            image.user_remap(replaced[image])
    names = {replaced[image]: name for image, name in former.items()}
    bpy.data.batch_remove(list(former))
    for image, name in names.items():
        image.name = name
