"""The tan of an object whose exposures have several masks, from its settings to its nodes."""

import functools
from collections.abc import Mapping, Sequence

import bpy
import numpy as np
from numpy.typing import NDArray

from .model import basis
from .model.ahead import Ahead
from .model.basis import Basis
from .model.room import GRID, Room, blocks_of, images_in, room_for, room_in
from .model.settings import TanSettings
from .model.tan import basis_of, day_basis_of, peeling_of
from .props import settings_of
from .scene import exr, images, mask_values, nodes, several, several_nodes, timeline
from .scene.changes import Changes
from .scene.mask_nodes import ShownMask, shown_mask
from .scene.masks import Mask

Packed = dict[str, tuple[NDArray[np.float32], bytes]]


@functools.lru_cache(maxsize=2)
def _packed(values: TanSettings, which: tuple[int, ...], room: Room | None) -> Packed:
    """The images of an exact basis, and their files; none where images of that room cannot hold it.

    One takes some 20 MB at most, so few are kept.
    """
    made = basis_of(values, which)
    if room is None or not room.holds(made):
        return {}
    return {role: (own, exr.encoded(own)) for role, own in images_in(made, room).items()}


AHEAD = Ahead(_packed)


def _of_a_day(
    owner: int, content: str, values: TanSettings, which: Sequence[int], day: float, room: Room
) -> Basis:
    """As `day_basis_of`, for an object (its session_uid); its images will be noted to come from
    `content`."""
    del owner, content
    return day_basis_of(values, which, day, room)


DAYS = Ahead(_of_a_day)

NAMES = {"rows": "s", "days": " Days", "places": " Places"} | dict.fromkeys(
    map(GRID.format, range(5)), " Shares"
)
"""What images are called, by role."""


def has_several(obj: bpy.types.Object) -> bool:
    """Whether an object's exposures have several masks."""
    return len(set(settings_of(obj).masks())) > 1


def computed(obj: bpy.types.Object, *, rough: bool = False) -> Basis | None:
    """The basis of an object's masks; None where there is one mask at most.

    Parameters
    ----------
    rough : bool
        Whether it is for a picture while somebody changes a setting.

    Raises
    ------
    InputError
        If there are too many masks, or a setting cannot be used.
    """
    if not has_several(obj):
        return None
    return basis_of(settings_of(obj).values(), which_masks(obj), rough=rough)


def is_at_hand(obj: bpy.types.Object) -> bool:
    """Whether `computed` takes no time; else a thread begins with it."""
    if not has_several(obj):
        return True
    return AHEAD.is_at_hand(*_exact(obj))


def _exact(obj: bpy.types.Object) -> tuple[TanSettings, tuple[int, ...], Room | None]:
    """What `_packed` takes for an object: settings, the mask of every exposure, and the room in the
    images that show it now."""
    shown = shown_images(obj)
    return settings_of(obj).values(), tuple(which_masks(obj)), room_of(shown) if shown else None


def show(
    obj: bpy.types.Object,
    group: bpy.types.NodeTree,
    made: Basis | None,
    changes: Changes,
) -> dict[bpy.types.Image, bpy.types.Image]:
    """Have a tan's group show several masks, or one again; new images by former ones."""
    if made is None:
        several.take_out(obj, group, changes)
        return {}
    room = room_for(made)
    told = {
        role: images.packed_image(f"Skin Tan Mask{NAMES[role]} {obj.name}", own, is_colour=False)
        for role, own in images_in(made, room).items()
    }
    shapes = several_nodes.Basis(
        room.rank, parts=room.parts, step=basis.ROWS, rows=told["rows"], days=told["days"]
    )
    over_shares = several_nodes.Grid(
        [told[GRID.format(block)] for block in range(blocks_of(room.rank))], told["places"]
    )
    masks = distinct_masks(obj)
    shown = [shown_mask(obj, mask, changes) for mask in masks]
    return several.show(obj, group, shapes, over_shares, shown, called(masks), changes)


def shown_images(obj: bpy.types.Object) -> dict[str, bpy.types.Image]:
    """The images by which an object shows the masks of its settings; none if it does not."""
    return several.own_images(settings_of(obj).group, called(distinct_masks(obj)))


def room_of(shown: Mapping[str, bpy.types.Image]) -> Room:
    """How much images hold."""
    return room_in(tuple(shown["rows"].size), tuple(shown[GRID.format(0)].size))


def is_in_place(obj: bpy.types.Object) -> bool:
    """Whether an object shows the masks of its settings, so that other doses are other pixels."""
    group = settings_of(obj).group
    if nodes.own_history(group) is None or has_several(obj) != several.is_shown(group):
        return False
    return not has_several(obj) or bool(shown_images(obj))


def fits(obj: bpy.types.Object) -> bool:
    """Whether the images of several masks, which are in place, hold what settings lead to."""
    return _holds_peeling(obj) and bool(_packed(*_exact(obj)))


def _holds_peeling(obj: bpy.types.Object) -> bool:
    """Whether the image of what peels, if there is one, has the size of what peels now."""
    sizes = [(own.shape[1], own.shape[0]) for own in _peeled(obj)]
    return sizes == [tuple(image.size) for image in _peeling_images(obj)]


def _show_peeling(obj: bpy.types.Object, content: str, *, pack: bool) -> None:
    """Put what peels into the image of it, which has its size."""
    for image, own in zip(_peeling_images(obj), _peeled(obj), strict=True):
        images.swap_pixels(image, own, content, pack=pack)


def show_exact(obj: bpy.types.Object, content: str) -> None:
    """Put what an object's settings lead to into its images, which hold it; lasting.

    Parameters
    ----------
    content : str
        What it comes from: the settings.
    """
    told = _packed(*_exact(obj))
    for role, image in shown_images(obj).items():
        values, data = told[role]
        images.swap_pixels(image, values, content, pack=True, data=data)
    _show_peeling(obj, content, pack=True)


def _peeled(obj: bpy.types.Object) -> list[NDArray[np.float32]]:
    """What peels, for one image or none."""
    told = peeling_of(settings_of(obj).values(), which_masks(obj))
    return [] if told is None else [told]


def _peeling_images(obj: bpy.types.Object) -> tuple[bpy.types.Image, ...]:
    return (nodes.own_history(settings_of(obj).group) or ())[2:]


def show_day(obj: bpy.types.Object, content: str, *, any_day: bool = False) -> bool:
    """Have an object that is in place show this frame's day exactly, and all others roughly.

    A thread computes it, so this must be called again until it shows.

    Parameters
    ----------
    content : str
        What it comes from: the settings.
    any_day : bool
        Whether another day will do that is shown exactly already.

    Returns
    -------
    bool
        Whether it shows, or is refused.
    """
    settings, shown = settings_of(obj), shown_images(obj)
    day = timeline.shown_day(obj) or 0.0
    owner, wanted, which = obj.session_uid, f"{content} on day {day}", which_masks(obj)
    done = DAYS.taken(owner)
    if done is not None:
        (_, told, _, of_masks, *_), made = done
        if made is not None and of_masks == which and room_of(shown).holds(made):
            _show_roughly(obj, shown, made, told)
        elif told == wanted:
            return True
    call = owner, wanted, settings.values(), which, day, room_of(shown)
    now = shown["rows"].get(images.SHOWN, "")
    is_enough = now == wanted or (any_day and now.startswith(content))
    if is_enough or DAYS.is_refused(*call):
        return True
    DAYS.is_at_hand(*call)
    return False


def _show_roughly(
    obj: bpy.types.Object, shown: Mapping[str, bpy.types.Image], made: Basis, content: str
) -> None:
    """Put a basis into images that hold it, and what peels, until the file is closed."""
    told = images_in(made, room_of(shown))
    # What shapes that are 0 are multiplied by does not matter.
    spare = {GRID.format(block) for block in range(blocks_of(made.rank), len(told))}
    for role, image in shown.items():
        if role not in spare:
            images.swap_pixels(image, told[role], content, pack=False)
    if _holds_peeling(obj):
        _show_peeling(obj, content, pack=False)


def called(masks: Sequence[Mask]) -> str:
    """Says which masks these are."""
    told = [
        (own.source, own.image and own.image.name_full, own.uv_map, own.channel, own.invert)
        for own in masks
    ]
    return repr([(*own, mask.strength) for own, mask in zip(told, masks, strict=True)])


def remarks(
    obj: bpy.types.Object, made: Basis | None, shown: ShownMask, *, rough: bool
) -> list[str]:
    """Sentences on an object's masks, and on whether they are too many to show exactly.

    Parameters
    ----------
    shown : ShownMask
        What the nodes read where there is one mask.
    rough : bool
        Whether it is for a picture while somebody changes a setting.
    """
    if made is None:
        return mask_values.remarks(obj, settings_of(obj).shown_mask(), shown)
    if rough:
        return []
    said = mask_values.remarks_on_several(obj, distinct_masks(obj))
    if made.error > basis.SAID:
        said.append(
            f"The masks lead to so many different tans that some points are off by up to "
            f"{made.error:.0%} of their melanin."
        )
    return said


def distinct_masks(obj: bpy.types.Object) -> Sequence[Mask]:
    """The masks that differ, in the order of the exposures."""
    return list(dict.fromkeys(settings_of(obj).masks()))


def which_masks(obj: bpy.types.Object) -> list[int]:
    """Which of these every exposure that counts has."""
    distinct = distinct_masks(obj)
    return [distinct.index(mask) for mask in settings_of(obj).masks()]
