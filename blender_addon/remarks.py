"""What Apply says of a tan besides that it is done: what does not show, and why."""

from typing import cast

import bpy

from . import timing
from .model import catalogue, doses
from .model.curve import curve_of, is_seen
from .model.response import holds_redness, tells_skin
from .model.settings import TanSettings
from .model.size import lines_on
from .model.summary import of_blisters
from .model.tan import Tan
from .props import SkinTanSettings, settings_of
from .props.region import is_on, is_shown
from .scene import film, masks, nodes, recolour, size, slots, timeline
from .scene.ownership import names
from .scene.skin import Skin
from .scene.trees import tan_groups, tree_of


def on_tan(obj: bpy.types.Object, skin: Skin, values: TanSettings, tan: Tan) -> list[str]:
    """What of an object's settings its materials, timeline or table cannot show."""
    return [
        *_on_nodes(skin, tan),
        *_on_film(obj, skin),
        *_on_regions(settings_of(obj)),
        *_on_days(obj, values),
        *_on_table(values, tan),
    ]


def on_size(obj: bpy.types.Object, scene: bpy.types.Scene) -> list[str]:
    """That a body is no person's size."""
    lines = lines_on(size.length(obj, scene)) if size.shows_our_light(obj) else ()
    return [f"{' '.join(lines)}; press Fit Skin to Size."] if lines else []


def on_dose(obj: bpy.types.Object, values: TanSettings) -> list[str]:
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


def on_kept(kept: list[bpy.types.Image]) -> list[str]:
    """Which images of a former tan somebody else keeps."""
    return [f"No longer shown but kept in the file: {names(kept)}."] if kept else []


def _on_nodes(skin: Skin, tan: Tan) -> list[str]:
    said = []
    if skin.others:
        said.append(f"The skin on {names(skin.others)} stays as it was.")
    removed = nodes.missing_roles(skin.group)
    if removed:
        said.append(
            f"The tan does not show: nodes were removed from {skin.group.name!r}: "
            f"{', '.join(removed)}."
        )
    if tan.look.has_profile and nodes.has_own_shader(skin.group):
        said.append(
            f"The Principled BSDF was removed from {skin.group.name!r}: subsurface scattering is "
            "left to the shader in its place."
        )
    return said


def _on_film(obj: bpy.types.Object, skin: Skin) -> list[str]:
    """Why an object's film does not show, or not everywhere."""
    if settings_of(obj).film == "NONE":
        return []
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


def _on_regions(settings: SkinTanSettings) -> list[str]:
    """Which regions are on and lie nowhere."""
    without = [
        region.label() for region in settings.regions if is_on(region) and not is_shown(region)
    ]
    if not without:
        return []
    return [f"No mask says where these regions lie, so they do not show: {', '.join(without)}."]


def _on_days(obj: bpy.types.Object, values: TanSettings) -> list[str]:
    said = [timeline.DRIVEN] if timeline.is_driven(obj) else []
    late = sum(doses.begin(exposure) > 24.0 * values.last_day for exposure in values.exposures)
    if late:
        said.append(f"Times in the sun after day {values.last_day:g} have no effect: {late}.")
    return said


def _on_table(values: TanSettings, tan: Tan) -> list[str]:
    """What of the settings the skin's table does not hold."""
    table, said = catalogue.table(values.table), []
    if values.redness and not holds_redness(table):
        said.append("The table holds no blood, so no sunburn shows.")
    if values.peeling and not tells_skin(table):
        said.append("The table does not say how its skin burns, so nothing peels.")
    if values.kinetics not in table.kinetics:
        said.append(
            "The table holds tans as in the thesis only, so one as measured in people is rough; "
            "build it with the standard preset, or set Tan to As in the Thesis."
        )
    if not tan.look.has_profile:
        said.append("The table has no diffusion profile, so there is no subsurface scattering.")
    return said


def _on_own_masks(settings: SkinTanSettings) -> list[str]:
    """Which times in the sun are to have a mask of their own and have none."""
    without = [
        exposure.label(number)
        for number, exposure in enumerate(settings.exposures, 1)
        if exposure.enabled and exposure.own_mask and not masks.Mask.of(exposure.mask)
    ]
    if not without:
        return []
    return [f"Own Mask is empty in {', '.join(without)}, so the whole body is bare then."]
