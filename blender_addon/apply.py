"""Apply: from an object's settings to images, node group, material and keys."""

from typing import Any, cast

import bpy

from hylios.errors import InputError

from . import applied, own_colour, peeling, several, timing
from .model import catalogue, doses
from .model.curve import curve_of, is_seen
from .model.film import film_of
from .model.look import untanned_colour
from .model.regions import shown as shown_region
from .model.regions import spots
from .model.response import holds_redness, tells_skin
from .model.settings import TanSettings
from .model.size import lines_on
from .model.summary import of_blisters
from .model.tan import Tan, tan_of
from .props import SkinTanExposure, SkinTanSettings, settings_of
from .props.region import is_on, is_shown
from .scene import (
    detail,
    film,
    first_version,
    images,
    layout_1,
    mask_nodes,
    masks,
    nodes,
    recolour,
    regions,
    size,
    slots,
    timeline,
)
from .scene import skin as skins
from .scene.changes import Changes
from .scene.ownership import is_local, names
from .scene.plan import LOOK
from .scene.region_nodes import Region, Spots
from .scene.sampled import Sampled
from .scene.several import made_images as made_of_masks
from .scene.trees import tan_groups, tree_of
from .views import keep_view, remember_source


def apply_tan(
    obj: bpy.types.Object | None, scene: bpy.types.Scene, *, rough: bool = False, live: bool = False
) -> str:
    """Give an object the tan that its settings describe, and return a sentence on what was done.

    No other object changes its look. Nothing in the file is changed where an error is raised.

    Parameters
    ----------
    rough : bool
        Whether the look is for a moment only; the object still counts as changed then.
    live : bool
        Whether the scene's frames count as the last Apply has met them, not as they are.

    Raises
    ------
    InputError
        If the object cannot carry a tan, or a setting or the table cannot be used.
    """
    obj = tannable(obj)
    settings = settings_of(obj)
    _require_masks(obj)
    _require_sun(settings)
    timeline.check_day_property(obj)
    unit = size.body_unit(obj, scene)
    values = settings.values()
    days = values.first_day, values.last_day
    seen = applied.applied_frames(obj, scene) if live else applied.scene_frames(scene)
    frames = timing.frames(settings, days, seen)
    tan = tan_of(values, rough=rough)
    of_masks = several.computed(obj, rough=rough)
    with Changes() as changes:
        keep_response(settings, changes)
        skin = skins.prepare(obj, replacing=settings.new_material)
        first_version.take_over(skin.group, changes)
        layout_1.take_over(skin.group, skin.trees(), changes)
        made = [*nodes.made_images(skin.group), *made_of_masks(skin.group)]
        timed = timing.key(obj, scene, days, frames, changes)
        regions.show(obj, skin.group, _regions(settings, values), unit, changes)
        sampled = _sampled(tan, obj, unit, peeling.show(obj, skin.group, values, unit, changes))
        sampled, told = own_colour.prepare(obj, skin, tan.look, sampled, changes)
        replaced = nodes.update(skin.group, sampled, changes)
        shown = mask_nodes.shown_mask(obj, settings.shown_mask(), changes)
        mask_nodes.show(skin.group, shown, changes)
        replaced |= several.show(obj, skin.group, of_masks, changes)
        _show_film(obj, skin, sampled, changes)
        remember_source(skin.group, settings, values, tan, changes)
        attached = skin.attach(changes)
        own_colour.tell(obj, skin.group, changes, is_on=sampled.own_image is not None)
        in_view = keep_view(skin.group, skin.trees(), changes)
        skin.set_viewport_colour(untanned_colour(tan.look), changes)
        detail.set_size(skin.trees(), obj, unit, changes)
        nodes.set_roughness(skin.trees(), skin.group, sampled.roughness, changes)
        _note(obj, sampled, applied.text_of(obj, scene, seen), changes, rough=rough)
        kept = images.replace(replaced, made, skin.users, obj, changes)
        said = [*attached, *told, *timed, *_remarks(obj, skin, values, tan), *_on_size(obj, scene)]
        said += [] if rough else _on_dose(obj, values)
        said += several.remarks(obj, of_masks, shown, rough=rough)
        said += [*in_view, *_on_kept(kept)]
        return " ".join(said)


def list_materials(obj: bpy.types.Object | None) -> str:
    """Write into an object's settings which of its materials tan: as ticked, or else a guess.

    Returns a sentence on it.

    Raises
    ------
    InputError
        If the object cannot carry a tan.
    """
    obj = tannable(obj)
    ticked = slots.ticks(obj, skins.group_of(obj))
    with Changes() as changes:
        slots.remember(obj, ticked, changes)
    skin = [material for material, tans in ticked.items() if tans]
    return f"Ticked as skin: {names(skin)}." if skin else "No material is ticked as skin."


def keep_response(settings: SkinTanSettings, changes: Changes) -> None:
    """Remember kinetics and redness of a tan, so that they are no longer those of a new one."""
    for name, number in settings.response_numbers().items():
        changes.set(settings, name, number)


def mesh_object(obj: bpy.types.Object | None) -> bpy.types.Object:
    """The object, if it is a mesh.

    Raises
    ------
    InputError
        If it is not.
    """
    if obj is None:
        raise InputError("No object is active; select a mesh object.")
    if obj.type != "MESH":
        raise InputError(f"{obj.name!r} is of type {kind_of(obj)}; select a mesh object.")
    return obj


def kind_of(obj: bpy.types.Object) -> str:
    """What an object is, as Blender's menus call it."""
    kinds: Any = obj.bl_rna.properties["type"]
    return kinds.enum_items[obj.type].name


def timeable(obj: bpy.types.Object | None) -> bpy.types.Object:
    """The object, if the day of its tan can be keyed: a local mesh object or a library override.

    Raises
    ------
    InputError
        If it cannot.
    """
    obj = mesh_object(obj)
    if obj.library is not None:
        raise InputError(
            f"The object {obj.name!r} is linked from another file; allowed is a local one or a "
            "library override (Object > Library Override > Make)."
        )
    return obj


def tannable(obj: bpy.types.Object | None) -> bpy.types.Object:
    """The object, if it can carry a tan.

    Raises
    ------
    InputError
        If it cannot.
    """
    obj = mesh_object(obj)
    action = obj.animation_data.action if obj.animation_data else None
    for block, what in ((obj, "object"), (obj.data, "mesh of"), (action, "animation of")):
        if block is not None and block.override_library is not None:
            raise InputError(
                f"The {what} {obj.name!r} is a library override; allowed is a local one "
                "(Object > Library Override > Clear)."
            )
        if block is not None and not is_local(block):
            raise InputError(
                f"The {what} {obj.name!r} is linked from another file; allowed is a local one "
                "(Object > Relations > Make Local)."
            )
    return obj


def _sampled(
    tan: Tan, obj: bpy.types.Object, unit: float, peel_image: bpy.types.Image | None
) -> Sampled:
    history, look = tan.history, tan.look
    return Sampled(
        states=images.packed_image(
            f"Skin Tan States {obj.name}", history.coordinates, is_colour=False
        ),
        places=images.packed_image(f"Skin Tan Places {obj.name}", history.lines, is_colour=False),
        look={
            role: images.shared_image(
                f"Skin Tan Look {name}", getattr(look, role), is_colour=name == "Colours"
            )
            for role, name in LOOK.items()
        },
        melanin=look.melanin,
        blood=look.blood,
        thickness=look.thickness,
        bulge=look.bulge,
        level=look.level,
        near_weight=look.near_weight,
        roughness=look.roughness,
        has_profile=look.has_profile,
        first_day=history.first_day,
        last_day=history.last_day,
        scene_unit=unit,
        peel_image=peel_image,
    )


def _note(
    obj: bpy.types.Object, sampled: Sampled, text: str, changes: Changes, *, rough: bool
) -> None:
    """Note in images, and where they are exact on the object, of which settings they are."""
    images.note_content(sampled.of_history(), applied.digest(text))
    if rough and settings_of(obj).biology.is_changed():
        images.note_shown(sampled.of_look(), applied.look_digest(text))
    if not rough:
        applied.note(obj, text, changes)


def _show_film(obj: bpy.types.Object, skin: skins.Skin, sampled: Sampled, changes: Changes) -> None:
    """Have an object's tan show what lies on its skin."""
    settings = settings_of(obj)
    worn = None
    if settings.film != "NONE":
        worn = film.Film(**vars(film_of(settings.film.lower(), sampled.roughness)))
    where = film.where(obj, settings.worn_film_mask(), changes)
    film.show(skin.group, skin.trees(), worn, where, sampled.level, changes)


def _require_masks(obj: bpy.types.Object) -> None:
    """Raise InputError unless all masks of an object can be used."""
    settings = settings_of(obj)
    settings.name_masks()
    for mask in settings.all_masks():
        masks.require_usable(obj, mask)


def _require_sun(settings: SkinTanSettings) -> None:
    """Raise InputError, with its name, where a time in the sun has no such date or hours."""
    for number, exposure in enumerate(settings.exposures, 1):
        if exposure.enabled and exposure.unit == "SUN":
            try:
                doses.require_date(exposure.month, exposure.day_of_month)
                doses.require_hours(exposure.from_hour, exposure.to_hour)
            except InputError as error:
                called = _called(exposure, number)
                raise InputError(f"A time in the sun cannot be used, {called}: {error}") from error


def _called(exposure: SkinTanExposure, number: int) -> str:
    return repr(exposure.name) if exposure.name else f"time in the sun {number}"


def _regions(settings: SkinTanSettings, values: TanSettings) -> list[regions.Placed]:
    """The regions of settings, as nodes show them."""
    placed = []
    for item in settings.shown_regions():
        kind = item.kind.lower()
        shown = shown_region(values, kind, item.strength)
        own = shown.region
        told = Region(
            label=item.label(),
            melanin=round(own.melanin, 4),
            blood=round(own.blood, 4),
            tan=own.tan,
            strength=item.strength,
            spots=Spots(**vars(spots()[kind])) if item.has_spots() else None,
            colour=shown.colour,
        )
        placed.append(regions.Placed(told, masks.Mask.of(item.mask)))
    return placed


def _remarks(obj: bpy.types.Object, skin: skins.Skin, values: TanSettings, tan: Tan) -> list[str]:
    remarks = []
    if skin.others:
        remarks.append(f"The skin on {names(skin.others)} stays as it was.")
    removed = nodes.missing_roles(skin.group)
    if removed:
        remarks.append(
            f"The tan does not show: nodes were removed from {skin.group.name!r}: "
            f"{', '.join(removed)}."
        )
    if tan.look.has_profile and nodes.has_own_shader(skin.group):
        remarks.append(
            f"The Principled BSDF was removed from {skin.group.name!r}: subsurface scattering is "
            "left to the shader in its place."
        )
    if settings_of(obj).film != "NONE":
        remarks += _on_film(obj, skin)
    remarks += _on_regions(settings_of(obj))
    if timeline.is_driven(obj):
        remarks.append(timeline.DRIVEN)
    late = sum(doses.begin(exposure) > 24.0 * values.last_day for exposure in values.exposures)
    if late:
        remarks.append(f"Times in the sun after day {values.last_day:g} have no effect: {late}.")
    table = catalogue.table(values.table)
    if values.redness and not holds_redness(table):
        remarks.append("The table holds no blood, so no sunburn shows.")
    if values.peeling and not tells_skin(table):
        remarks.append("The table does not say how its skin burns, so nothing peels.")
    if values.kinetics not in table.kinetics:
        remarks.append(
            "The table holds tans as in the thesis only, so one as measured in people is rough; "
            "build it with the standard preset, or set Tan to As in the Thesis."
        )
    if not tan.look.has_profile:
        remarks.append("The table has no diffusion profile, so there is no subsurface scattering.")
    return remarks


def _on_dose(obj: bpy.types.Object, values: TanSettings) -> list[str]:
    """Why no tan can be seen on an object, or it can be where it should not."""
    if not obj.modifiers and obj.mode != "EDIT" and not cast(bpy.types.Mesh, obj.data).polygons:
        return [f"{obj.name!r} has no faces, so no skin can be seen."]
    if slots.is_set_elsewhere(obj):
        tanned = [block for block in slots.materials_of(obj) if any(tan_groups(tree_of(block)))]
        return [
            f"No tan can be seen: geometry nodes set other materials on {obj.name!r}; set "
            f"{names(tanned)} there."
        ]
    if not settings_of(obj).exposures:
        return [f"{obj.name!r} has no time in the sun, so nothing tans; add one with +."]
    if not values.exposures:
        return [f"All times in the sun of {obj.name!r} are switched off, so nothing tans."]
    seen = [] if is_seen(curve_of(values)) else [timing.NOT_SEEN]
    blisters = [" ".join(lines) + "." for lines in [of_blisters(values)] if lines]
    return [*seen, *blisters, *_on_own_masks(settings_of(obj))]


def _on_regions(settings: SkinTanSettings) -> list[str]:
    """Which regions are on and lie nowhere."""
    without = [
        region.label() for region in settings.regions if is_on(region) and not is_shown(region)
    ]
    if not without:
        return []
    return [f"No mask says where these regions lie, so they do not show: {', '.join(without)}."]


def _on_own_masks(settings: SkinTanSettings) -> list[str]:
    """Which times in the sun are to have a mask of their own and have none."""
    without = [
        _called(exposure, number)
        for number, exposure in enumerate(settings.exposures, 1)
        if exposure.enabled and exposure.own_mask and not masks.Mask.of(exposure.mask)
    ]
    if not without:
        return []
    return [f"Own Mask is empty in {', '.join(without)}, so the whole body is bare then."]


def _on_film(obj: bpy.types.Object, skin: skins.Skin) -> list[str]:
    """Why an object's film does not show, or not everywhere."""
    shown = dict.fromkeys(slot.material for slot in obj.material_slots if slot.material)
    recoloured = [material for material in shown if recolour.is_in(material)]
    if recoloured:
        return [f"No film shows on {names(recoloured)}: a recoloured material keeps its own gloss."]
    if not film.is_shown(skin.group):
        return [
            f"The film does not show: the Principled BSDF in {skin.group.name!r} was removed or "
            "has a coat of its own."
        ]
    return []


def _on_size(obj: bpy.types.Object, scene: bpy.types.Scene) -> list[str]:
    lines = lines_on(size.length(obj, scene)) if size.shows_our_light(obj) else ()
    return [f"{' '.join(lines)}; press Fit Skin to Size."] if lines else []


def _on_kept(kept: list[bpy.types.Image]) -> list[str]:
    if not kept:
        return []
    return [f"No longer shown but kept in the file: {names(kept)}."]
