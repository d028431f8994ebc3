"""Float images that carry a table of numbers inside the .blend."""

import bpy
import numpy as np

from hylios.errors import InputError

# The first name is that of Blender's own configuration, the others those of common studio ones.
COLOUR_SPACES = ("Linear Rec.709", "Linear Rec.709 (sRGB)", "lin_rec709")
DATA_SPACES = ("Non-Color", "Raw", "Utility - Raw")


def packed_image(name: str, values: np.ndarray, *, is_colour: bool) -> bpy.types.Image:
    """Store values (rows, columns, 3) in a packed float image, the first row at the bottom.

    A local image of that name is replaced wherever it is used.

    Raises
    ------
    InputError
        If Blender's colour management has no space that fits.
    """
    rows, columns, _ = values.shape
    image = bpy.data.images.new(name, columns, rows, alpha=False, float_buffer=True)
    try:
        # Setting it after the pixels would discard them.
        set_colour_space(image, is_colour=is_colour)
    except InputError:
        bpy.data.images.remove(image)
        raise
    pixels = np.ones((rows, columns, 4), dtype=np.float32)
    pixels[..., :3] = values
    image.pixels.foreach_set(pixels.ravel())
    image.update()
    image.pack()
    former = bpy.data.images.get((name, None))
    if former is not None and former != image:
        former.user_remap(image)
        bpy.data.images.remove(former)
        image.name = name
    return image


def set_colour_space(image: bpy.types.Image, *, is_colour: bool) -> None:
    """Declare an image to hold linear Rec.709 colours, or else numbers that are no colours.

    Raises
    ------
    InputError
        If Blender's colour management has no such space.
    """
    names = COLOUR_SPACES if is_colour else DATA_SPACES
    for name in names:
        try:
            image.colorspace_settings.name = name
        except TypeError:
            continue
        return
    raise InputError(f"Blender's colour management has none of the spaces {', '.join(names)}.")
