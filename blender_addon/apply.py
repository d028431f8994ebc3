"""Apply: from an object's settings to images, node group, material and keys."""

import bpy

from hylios.errors import InputError
from hylios.table import read_table

from . import doses, images, nodes, tables, timeline
from .tan import check_days, tan

# Names longer than this are cut in Blender 4.5; cutting them here lets them be found again.
NAME_BYTES = 63


def apply_tan(obj: bpy.types.Object | None, scene: bpy.types.Scene) -> str:
    """Give an object the tan that its settings describe, and return a sentence on what was done.

    Nothing in the scene is changed where an error is raised.

    Raises
    ------
    InputError
        If the object cannot carry a tan, or a setting or the table cannot be used.
    """
    check_object(obj)
    settings = obj.skin_tan
    _check_mask(obj, settings.mask_attribute)
    check_days(settings.first_day, settings.last_day)
    timeline.check_frames(settings.first_frame, settings.last_frame)
    table = read_table(tables.table_path(settings.skin, settings.table_path))
    minimal = minimal_doses(settings, table.provenance)
    result = tan(
        table,
        doses.received(settings.exposures, minimal.mmd, table.provenance),
        mmd=minimal.mmd,
        med=minimal.med,
        first_day=settings.first_day,
        last_day=settings.last_day,
    )

    colour = images.packed_image(_name("Skin Tan Colour", obj), result.colour, is_colour=True)
    width = None
    if result.profile_width is not None:
        width = images.packed_image(
            _name("Skin Tan Width", obj), result.profile_width, is_colour=False
        )
    sampled = nodes.Sampled(
        colour=colour,
        profile_width=width,
        tan=result,
        mask_attribute=settings.mask_attribute,
        scene_unit=_scene_unit(scene),
    )
    name = _name("Skin Tan", obj)
    material = nodes.tan_material(name, nodes.tan_group(name, sampled))
    timeline.key_days(
        obj,
        scene,
        (settings.first_day, settings.last_day),
        (settings.first_frame, settings.last_frame),
    )
    said = _assign(obj, material) + _late_exposures(settings)
    return said if width is not None else f"{said} Its table has no profile: no subsurface."


def minimal_doses(settings, provenance: dict) -> tables.MinimalDoses:
    """The minimal doses to use: the artist's own where that is set, else the table's.

    Raises
    ------
    InputError
        If the table's are to be used and it has none.
    """
    if settings.own_minimal_doses:
        return tables.MinimalDoses(mmd=settings.mmd, med=settings.med)
    return tables.minimal_doses(provenance)


def check_object(obj) -> None:
    """Raise InputError unless an object can carry a tan."""
    if obj is None:
        raise InputError("No object is active; select a mesh object.")
    if obj.type != "MESH":
        raise InputError(f"{obj.name!r} is a {obj.type.lower()} object; allowed is a mesh.")
    action = obj.animation_data.action if obj.animation_data else None
    for datablock, what in ((obj, "object"), (obj.data, "mesh of"), (action, "animation of")):
        if datablock is not None and (datablock.library or datablock.override_library):
            raise InputError(
                f"The {what} {obj.name!r} is linked from another file; allowed is a local one "
                "(Object > Relations > Make Local)."
            )


def _check_mask(obj, name: str) -> None:
    if not name:
        return
    attribute = obj.data.attributes.get(name)
    if attribute is None:
        floats = [a.name for a in obj.data.attributes if _is_mask(a) and not a.is_internal]
        allowed = ", ".join(floats) or "none yet"
        raise InputError(
            f"The mesh has no attribute {name!r}; float attributes of its points: {allowed}."
        )
    if not _is_mask(attribute):
        raise InputError(
            f"Attribute {name!r} is of type {attribute.data_type} on domain {attribute.domain}; "
            "allowed is FLOAT on POINT."
        )


def _is_mask(attribute: bpy.types.Attribute) -> bool:
    """Whether an attribute can hold the share of the dose at each point."""
    return attribute.domain == "POINT" and attribute.data_type == "FLOAT"


def _scene_unit(scene) -> float:
    """Length of a scene unit in metres; Blender ignores the scale where units are off."""
    units = scene.unit_settings
    return 1.0 if units.system == "NONE" else units.scale_length


def _name(prefix: str, obj) -> str:
    return f"{prefix} {obj.name}".encode()[:NAME_BYTES].decode(errors="ignore")


def _assign(obj, material) -> str:
    """Put the material into the slot that has it, or the active one, or a new one."""
    for slot in obj.material_slots:
        if slot.material == material:
            return f"Updated {material.name!r}."
    if not obj.material_slots:
        obj.data.materials.append(None)
    slot = obj.material_slots[obj.active_material_index]
    former = slot.material
    if obj.data.users > 1:
        # Other objects have this mesh too: they keep their own skin.
        slot.link = "OBJECT"
    slot.material = material
    if former is None:
        return f"Applied {material.name!r}."
    # An artist's material must not be lost on saving for want of a user.
    former.use_fake_user = True
    return (
        f"Applied {material.name!r} to slot {slot.slot_index + 1} in place of {former.name!r}; "
        "other slots are unchanged."
    )


def _late_exposures(settings) -> str:
    late = sum(doses.begin(each) > 24.0 * settings.last_day for each in settings.exposures)
    if not late:
        return ""
    return f" Exposures after day {settings.last_day:g} have no effect: {late}."
