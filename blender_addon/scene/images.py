"""Float images that carry a table of numbers inside the .blend."""

import hashlib
import re
from collections.abc import Collection, Iterable, Mapping
from functools import partial
from typing import Any, cast

import bpy
import numpy as np

from hylios.errors import InputError

from . import exr
from .changes import Changes
from .ownership import Users

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
"""Custom property of an image that this add-on made: the name that it gave it."""


CONTENT, PACKED = "skin_tan_content", "skin_tan_packed"
"""Custom properties of an image that objects share: digests of its numbers and of its file."""


SHOWN, LASTING = "skin_tan_shown", "skin_tan_lasting"
"""Custom properties of an image of one object: what its pixels and its packed file come from."""


def stem(name: str) -> str:
    """A name without the number that Blender puts behind one that is taken."""
    return re.sub(r"\.\d{3,}$", "", name)


def packed_image(name: str, values: np.ndarray, *, is_colour: bool) -> bpy.types.Image:
    """Store values (rows, columns, 3) in a new packed float image, the first row at the bottom.

    Parameters
    ----------
    values : array
        With a fourth number to a place, that is the image's alpha, and the others stay as they are.
    is_colour : bool
        Whether they are linear Rec.709 colours, or else numbers that are no colours.

    Raises
    ------
    InputError
        If Blender's colour management has no space that fits.
    """
    rows, columns, channels = values.shape
    has_alpha = channels > 3
    image = bpy.data.images.new(name, columns, rows, alpha=has_alpha, float_buffer=True)
    if has_alpha:
        image.alpha_mode = "CHANNEL_PACKED"
    set_colour_space(image, is_colour=is_colour)
    if not is_colour:
        # EEVEE would keep 11 bits, too few for a place between two texels.
        cast(Any, image).use_half_precision = False
    image[MARK] = image.name
    _pack(image, exr.encoded(values))
    return image


def _pack(image: bpy.types.Image, data: bytes) -> None:
    """Pack a file into a float image, which shows what is packed from now on.

    Blender takes pixels that are set for numbers of its working space; those that it reads from
    the packed file it converts.
    """
    cast(Any, image).pack(data=data, data_len=len(data))
    if image.source != "FILE":
        image.source = "FILE"
    image.buffers_free()


def linear(values: np.ndarray) -> np.ndarray:
    """Linear light of sRGB's coded values (IEC 61966-2-1)."""
    curved = ((np.maximum(values, 0.0) + 0.055) / 1.055) ** 2.4
    return np.where(values <= 0.04045, values / 12.92, curved)


def _set_pixels(image: bpy.types.Image, values: np.ndarray) -> None:
    pixels = np.ones((*values.shape[:2], 4), dtype=np.float32)
    pixels[..., : values.shape[-1]] = values
    cast(Any, image.pixels).foreach_set(pixels.ravel())
    image.update()


def swap_pixels(
    image: bpy.types.Image,
    values: np.ndarray,
    content: str,
    *,
    pack: bool,
    data: bytes | None = None,
) -> None:
    """Put other numbers (rows, columns, 3) into an image that a file keeps.

    A new image in place of it would be no more than a pointer into nothing after an undo, unless a
    step of the undo history comes between: Blender keeps what it takes for unchanged.

    Parameters
    ----------
    content : str
        What the numbers come from, for `restore`.
    pack : bool
        Whether they last beyond the closing of the file; that takes longer.
    data : bytes, optional
        Their file (`exr.encoded`), where it has been made before.
    """
    rows, columns, _ = values.shape
    if tuple(image.size) != (columns, rows):
        image.scale(columns, rows)
    _set_pixels(image, values)
    image[SHOWN] = content
    if pack:
        _pack(image, data or exr.encoded(values))
        image[LASTING] = content


def note_content(fresh: Iterable[bpy.types.Image], content: str) -> None:
    """Note in new packed images what they come from."""
    for image in fresh:
        image[SHOWN] = image[LASTING] = content


def note_shown(shown: Iterable[bpy.types.Image], content: str) -> None:
    """Note in images what their pixels come from, which are for a moment only."""
    for image in shown:
        image[SHOWN] = content


def restore(image: bpy.types.Image, content: str) -> bool:
    """Have an image show what it holds after an undo, if that comes from `content`."""
    if image.get(LASTING) != content:
        return False
    show_packed(image)
    return True


def show_packed(image: bpy.types.Image) -> None:
    """Have an image show what its packed file holds."""
    reread(image)
    if LASTING in image:
        image[SHOWN] = image[LASTING]


def reread(image: bpy.types.Image) -> None:
    """Have an image's pixels be those of its packed file.

    Blender's own reload looks for a file on disk first, and prints an error where there is none.
    """
    image.buffers_free()
    image.update_tag()


def shared_image(name: str, values: np.ndarray, *, is_colour: bool) -> bpy.types.Image:
    """The image of these values (rows, columns, 3) that is in the file, or else a new one.

    It is known by its numbers, not by its name, as long as nobody has renamed or changed it.
    Parameters and errors as in `packed_image`.
    """
    numbers = np.ascontiguousarray(values, dtype="<f4")
    digest = hashlib.sha256(f"{is_colour} {numbers.shape} ".encode() + numbers.tobytes())
    content = digest.hexdigest()
    for image in bpy.data.images:
        if image.get(CONTENT) == content and image.library is None and _is_unchanged(image):
            return image
    image = packed_image(name, values, is_colour=is_colour)
    image[CONTENT], image[PACKED] = content, _packed_digest(image)
    return image


def _is_unchanged(image: bpy.types.Image) -> bool:
    return (
        not image.is_dirty
        and image.packed_file is not None
        and _has_its_name(image)
        and image.get(PACKED) == _packed_digest(image)
    )


def _packed_digest(image: Any) -> str:
    return hashlib.sha256(image.packed_file.data).hexdigest()


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
    replaced: Mapping[bpy.types.Image, bpy.types.Image],
    made: Collection[bpy.types.Image],
    users: Users,
    obj: bpy.types.Object,
    changes: Changes,
) -> list[bpy.types.Image]:
    """Remove an object's former images that none else shows; new ones of its own get their names.

    Parameters
    ----------
    replaced : mapping
        From former images to new ones.
    made : collection of Image
        Those that this add-on made for the object.

    Returns
    -------
    list of Image
        Images of the artist's own, which are kept.
    """
    kept = []
    for image, new in replaced.items():
        if image.library is not None:
            continue
        if image not in made or image.use_fake_user or not _has_its_name(image):
            # An artist's image must not be lost on saving for want of a user.
            changes.set(image, "use_fake_user", True)
            kept.append(image)
        elif users.others(image, obj):
            continue
        elif CONTENT in new and (CONTENT not in image or not _is_called_alike(image, new)):
            # Of an earlier plan: the new one shows more, or the same over other coordinates.
            changes.at_the_end(partial(remove_if_unused, image))
        elif CONTENT in new:
            changes.at_the_end(partial(image.user_remap, new))
            changes.at_the_end(partial(bpy.data.images.remove, image))
        else:
            name = image.name
            # Nodes of the artist's own show the new image too.
            changes.at_the_end(partial(image.user_remap, new))
            changes.at_the_end(partial(bpy.data.images.remove, image))
            changes.at_the_end(partial(setattr, new, "name", name))
            changes.at_the_end(partial(new.__setitem__, MARK, name))
    return kept


def remove_unused() -> None:
    """Remove images of this add-on that nothing shows any more, and that nobody has renamed."""
    for image in list(bpy.data.images):
        if MARK in image and image.users == 0 and image.library is None and _has_its_name(image):
            bpy.data.images.remove(image)


def remove_if_unused(image: bpy.types.Image) -> None:
    """Remove an image if nothing shows it."""
    if image.users == 0:
        bpy.data.images.remove(image)


def _is_called_alike(image: bpy.types.Image, other: bpy.types.Image) -> bool:
    return stem(str(image.get(MARK))) == stem(str(other.get(MARK)))


def _has_its_name(image: bpy.types.Image) -> bool:
    """Whether an image has the name still that it was made with."""
    return stem(image.name) == stem(str(image.get(MARK)))
