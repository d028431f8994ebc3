"""Apply: from an object's settings to images, node group, material and keys."""

import bpy

from hylios.errors import InputError

from . import applied, own_colour, peeling, remarks, several, timing
from .model import doses
from .model.film import film_of
from .model.look import untanned_colour
from .model.regions import shown as shown_region
from .model.regions import spots
from .model.settings import TanSettings
from .model.tan import Tan, tan_of
from .props import SkinTanSettings, settings_of
from .scene import (
    detail,
    film,
    first_version,
    images,
    layout_1,
    mask_nodes,
    masks,
    nodes,
    regions,
    size,
    slots,
    timeline,
)
from .scene import skin as skins
from .scene.changes import Changes
from .scene.ownership import names
from .scene.plan import LOOK
from .scene.region_nodes import Region, Spots
from .scene.sampled import Sampled
from .scene.several import made_images as made_of_masks
from .tannable import tannable
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
    tan = tan_of(values, rough=rough and not applied.has_look(obj, scene))
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
        told += own_colour.tell(obj, skin.group, changes, is_on=sampled.own_image is not None)
        in_view = keep_view(skin.group, skin.trees(), changes)
        skin.set_viewport_colour(untanned_colour(tan.look), changes)
        detail.set_size(skin.trees(), obj, unit, changes)
        nodes.set_roughness(skin.trees(), skin.group, sampled.roughness, changes)
        _note(obj, skin, sampled, applied.text_of(obj, scene, seen), changes, rough=rough)
        kept = images.replace(replaced, made, skin.users, obj, changes)
        said = [*attached, *told, *timed, *remarks.on_tan(obj, skin, values, tan)]
        said += remarks.on_size(obj, scene)
        said += [] if rough else remarks.on_dose(obj, values)
        said += several.remarks(obj, of_masks, shown, rough=rough)
        return " ".join([*said, *in_view, *remarks.on_kept(kept)])


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
    obj: bpy.types.Object,
    skin: skins.Skin,
    sampled: Sampled,
    text: str,
    changes: Changes,
    *,
    rough: bool,
) -> None:
    """Note in images and on the object of which settings they are, and whether exactly."""
    of_masks, is_biology_own = made_of_masks(skin.group), settings_of(obj).biology.is_changed()
    images.note_content(of_masks, applied.content(text, rough=rough))
    images.note_content(sampled.of_history(), applied.digest(text))
    if rough and is_biology_own:
        images.note_shown(sampled.of_look(), applied.look_digest(text, rough=True))
    applied.note(
        obj,
        applied.roughly(text, look=is_biology_own, history=bool(of_masks)) if rough else text,
        changes,
    )


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
                label = exposure.label(number)
                raise InputError(f"A time in the sun cannot be used, {label}: {error}") from error


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
