"""Making masks for an object, for a brush or from clothes, and setting them."""

from collections.abc import Generator
from dataclasses import dataclass
from typing import Any, cast

import bpy
import numpy as np

from hylios.errors import InputError

from .props import SkinTanMask, SkinTanRegionMask, settings_of
from .scene import clothes, mask_colours, mask_values, masks, painted, posed, vertex_groups
from .scene.changes import Changes
from .scene.ownership import names
from .scene.size import body_unit


@dataclass(frozen=True)
class ClothesRequest:
    """What From Clothes is to do.

    Attributes
    ----------
    garments : tuple of Object
    name : str
        Of a new mask.
    reach, inside, softness : float
        In millimetres: as in `scene.clothes.Reach`.
    left_out : tuple of Object
        What an artist may have selected as clothes, and is no mesh.
    """

    garments: tuple[bpy.types.Object, ...]
    name: str = "Clothes Mask"
    reach: float = 30.0
    inside: float = 5.0
    softness: float = 4.0
    left_out: tuple[bpy.types.Object, ...] = ()


def mask_for_brush(
    obj: bpy.types.Object, settings: SkinTanMask | SkinTanRegionMask, name: str, domain: str
) -> tuple[str, str]:
    """Have a brush paint on a mask: on the one there is, or on a new one.

    A new one is all bare, or of a region all black: it is nowhere yet.

    Numbers for which Blender has no brush are copied into a new mask.

    Returns
    -------
    tuple of str
        COLOUR, GROUP or IMAGE, which says with what brush, and a sentence.

    Raises
    ------
    InputError
        If the mesh cannot be painted on.
    """
    mesh = cast(bpy.types.Mesh, obj.data)
    if obj.mode == "EDIT":
        raise InputError(f"{obj.name!r} is in Edit Mode; leave Edit Mode (Tab).")
    if not mesh.polygons:
        raise InputError(f"{obj.name!r} has no faces, so there is nothing to paint on.")
    mask, words = _mask(obj, settings), _words(settings)
    source = masks.source_of(obj, mask, masks.current_depsgraph())
    if source is None or not mask_colours.is_paintable(source):
        kind = source.kind if source else ""
        if source is not None and kind == "GROUP":
            obj.vertex_groups.active_index = obj.vertex_groups[source.name].index
            return kind, f"{_legend(mask, words, 'Weight 0', '1')}: painting {source.name!r}."
        if source is not None and kind == "IMAGE":
            _require_no_skin(mask.image.name, mask.image in painted.painted_images(obj))
            _activate_image(mesh, mask)
            return kind, f"{_legend(mask, words)}: painting {source.name!r}."
        return "COLOUR", _new_for_brush(obj, settings, mask, source, (name, domain))
    _require_no_skin(source.name, source.name in painted.painted_attributes(obj))
    mask_colours.activate(mesh, source.name)
    also = _also_read(obj, source.name)
    return "COLOUR", f"{_legend(mask, words)}: painting {source.name!r}.{also}"


def from_clothes(
    obj: bpy.types.Object,
    settings: SkinTanMask,
    request: ClothesRequest,
    context: bpy.types.Context,
    scene: bpy.types.Scene,
) -> Generator[float, None, str]:
    """Cover what lies under garments; yields how much is done, and returns a sentence.

    Until the end, nothing is changed.

    Raises
    ------
    InputError
        If there is no garment, or an object cannot be used.
    """
    if not request.garments:
        raise InputError(
            _on_left_out(request) or "No clothes are selected; select garments, and last the body."
        )
    masks.require_name(request.name)
    mesh = cast(bpy.types.Mesh, obj.data)
    if not mesh.polygons:
        raise InputError(f"{obj.name!r} has no faces, so nothing on it can be covered.")
    skin = posed.posed_skin(obj, context)
    surface = posed.posed_clothes(list(request.garments), context)
    if not len(surface.triangles):
        are_several = len(request.garments) > 1
        cover = "have no faces, so they cover" if are_several else "has no faces, so it covers"
        raise InputError(f"{names(request.garments)} {cover} nothing.")
    unit = 0.001 / body_unit(obj, scene)
    reach = clothes.Reach(request.reach * unit, request.inside * unit, request.softness * unit)
    yield 0.0
    groups = {name for item in request.garments for name in clothes.delete_groups(obj, item)}
    also = np.zeros(len(mesh.vertices), bool)
    for name in groups:
        also |= vertex_groups.weights(obj, name) > 0.5
    shares = yield from clothes.covered_shares(skin, surface, reach, also)
    if len(shares) != len(mesh.vertices):
        raise InputError(f"{obj.name!r} was edited meanwhile; press From Clothes again.")
    with Changes() as changes:
        name = mask_colours.written(obj, settings.source, request.name, shares, changes)
    mask_colours.activate(mesh, name)
    _set(settings, name)
    covered = 1.0 - float(shares.mean())
    said = f"The mask {name!r} covers {100 * covered:.0f} % of the points."
    if covered == 0.0:
        said = (
            f"No skin lies within {request.reach:g} mm under {names(request.garments)}: the mask "
            f"{name!r} is all bare."
        )
    return f"{said} {_on_left_out(request)}".rstrip()


def _on_left_out(request: ClothesRequest) -> str:
    if not request.left_out:
        return ""
    return (
        f"Only meshes count as clothes, so {names(request.left_out)} did not: convert curves "
        "(Object > Convert), make instances real (Object > Apply)."
    )


def _require_no_skin(name: str, is_skin: bool) -> None:
    """Raise InputError where a brush on a mask would paint the skin itself."""
    if is_skin:
        raise InputError(
            f"The mask {name!r} is the colour of the skin, which Paint Mask would paint over; "
            "choose another mask, or empty the field for a new one."
        )


def _words(settings: SkinTanMask | SkinTanRegionMask) -> tuple[str, str]:
    """What 0 and 1 mean in a mask."""
    if isinstance(settings, SkinTanRegionMask):
        return "outside the region", "in it"
    return "covered", "bare"


def _mask(obj: bpy.types.Object, settings: SkinTanMask | SkinTanRegionMask) -> masks.Mask:
    owner = settings_of(obj)
    return owner.object_mask() if settings == owner.mask else masks.Mask.of(settings)


def _new_for_brush(
    obj: bpy.types.Object,
    settings: SkinTanMask | SkinTanRegionMask,
    mask: masks.Mask,
    source: masks.Source | None,
    form: tuple[str, str],
) -> str:
    """A new mask of a name and domain, maybe with the numbers of a mask without a brush."""
    name, domain = form
    mesh = cast(bpy.types.Mesh, obj.data)
    said = _legend(mask if source else masks.Mask(), _words(settings))
    count = len(mesh.vertices) if domain == "POINT" else len(mesh.loops)
    shares = np.full(count, not isinstance(settings, SkinTanRegionMask), np.float32)
    if source is not None:
        plain = masks.Mask(mask.source, channel=mask.channel)
        values = mask_values.mask_values(obj, plain)
        shares, domain = values.shares, values.domain
        said = f"{source.name!r} was copied, for Blender has no brush for it. {said}"
    with Changes() as changes:
        made = mask_colours.new_colours(mesh, name, shares, domain, changes)
    mask_colours.activate(mesh, made)
    if source is None:
        _set(settings, made)
    else:
        settings.channel, settings.source = "MEAN", made
    return f"{said}: painting {made!r}."


def _legend(
    mask: masks.Mask, words: tuple[str, str], low: str = "Black", high: str = "white"
) -> str:
    """What to paint with."""
    nothing, all_of_it = reversed(words) if mask.invert else words
    return f"{low} is {nothing}, {high} is {all_of_it}"


def _set(settings: Any, name: str) -> None:
    """Have a mask read a colour attribute that holds shares."""
    settings.invert, settings.strength, settings.channel = False, 1.0, "MEAN"
    settings.source = name


def _also_read(obj: bpy.types.Object, name: str) -> str:
    """A sentence where several times in the sun have one mask of their own."""
    exposures = settings_of(obj).exposures
    readers = [item for item in exposures if item.own_mask and item.mask.source == name]
    return f" {len(readers)} times in the sun read it." if len(readers) > 1 else ""


def _activate_image(mesh: bpy.types.Mesh, mask: masks.Mask) -> None:
    paint: Any = cast(Any, bpy.context).tool_settings.image_paint
    paint.mode, paint.canvas = "IMAGE", mask.image
    layers: Any = mesh.uv_layers
    if mask.uv_map in layers:
        layers.active = layers[mask.uv_map]
