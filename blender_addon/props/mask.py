"""What an artist sets of one mask: what says how much of the sun reaches each point."""

from typing import Any

import bpy
from bpy.props import BoolProperty, EnumProperty, FloatProperty, PointerProperty, StringProperty

from ..scene import mask_nodes, masks

CHANNELS = (
    ("MEAN", "Brightness", "Mean of red, green and blue"),
    ("RED", "Red", "Red alone"),
    ("GREEN", "Green", "Green alone"),
    ("BLUE", "Blue", "Blue alone"),
    ("ALPHA", "Alpha", "Opacity alone"),
)


def usable_names(owner: Any, context: bpy.types.Context, text: str) -> list[tuple[str, str]]:
    """Names of what can be a mask, with what it is; for the search of a text field."""
    del text  # Blender filters
    return [
        (source.name, source.label)
        for source in masks.usable_sources(owner.id_data, masks.current_depsgraph())
    ]


def uv_map_names(owner: Any, context: bpy.types.Context, text: str) -> list[str]:
    """Names of UV maps, for the search of a text field."""
    del text
    return masks.uv_map_names(owner.id_data, masks.current_depsgraph())


def show_mask(owner: Any, context: bpy.types.Context | None) -> None:
    """Have a tan that is there show what the settings of its object's masks are now."""
    obj = owner.id_data
    if obj.type != "MESH":  # a script may set what it likes
        return
    mask_nodes.show_at_once(obj, obj.skin_tan.shown_mask())


def take_source(owner: Any, context: bpy.types.Context) -> None:
    """Of a name that was chosen, take the image if it stands for one."""
    obj, name = owner.id_data, owner.source
    if obj.type == "MESH" and (owner.image is None or owner.image.name != name):
        image = masks.image_named(obj, name)
        if owner.image != image:
            owner.image = image
    settings = obj.skin_tan
    if owner == settings.mask and settings.mask_attribute != name:
        settings.mask_attribute = name
    show_mask(owner, context)


def take_image(owner: Any, context: bpy.types.Context) -> None:
    """Name the image that was chosen as the source; without one, the source is none either."""
    obj, image = owner.id_data, owner.image
    name = image.name if image else owner.source
    is_mesh = obj.type == "MESH"
    if is_mesh and image is None and masks.source_of(obj, masks.Mask(name), None) is None:
        name = ""
    if owner.source != name:
        owner.source = name
    else:
        show_mask(owner, context)


def follow_image(owner: Any) -> None:
    """Call a mask by its image's name where the image was renamed."""
    if owner.image is not None and owner.image.name != owner.source:
        owner.source = owner.image.name


def take_attribute(settings: Any, context: bpy.types.Context) -> None:
    """Take the source by its former name."""
    if settings.mask.source != settings.mask_attribute:
        settings.mask.source = settings.mask_attribute


UV_MAP = StringProperty(
    name="UV Map",
    description="How the image lies on the mesh. Empty for the map that renders use",
    search=uv_map_names,
    update=show_mask,
)
CHANNEL = EnumProperty(
    name="Channel",
    description="Which part of the colour counts",
    items=CHANNELS,
    update=show_mask,
)


def source_field(name: str, says: str) -> Any:
    """The name of what a mask reads; `says` what it tells, and what 0 and 1 mean."""
    return StringProperty(
        name=name,
        description=f"{says}. A vertex group, an attribute of points, corners or faces, or an "
        "image",
        search=usable_names,
        update=take_source,
    )


def image_field(says: str) -> Any:
    """The image itself, where a mask reads one; `says` what black and white mean."""
    return PointerProperty(
        name="Image",
        description=f"The image that is the mask: {says}",
        type=bpy.types.Image,
        update=take_image,
    )


def invert_field(says: str) -> Any:
    return BoolProperty(name="Invert", description=says, update=show_mask)


def strength_field(name: str, says: str, update: Any = show_mask) -> Any:
    return FloatProperty(
        name=name,
        description=says,
        default=1.0,
        min=0.0,
        max=1.0,
        subtype="FACTOR",
        update=update,
    )


class SkinTanMask(bpy.types.PropertyGroup):
    source: source_field(
        "Mask", "What says how much of the sun reaches each point: 0 is covered, 1 is bare"
    )
    image: image_field("black is covered, white is bare")
    uv_map: UV_MAP
    channel: CHANNEL
    invert: invert_field(
        "The sun reaches where the mask is black (0), as with a vertex group that holds what "
        "clothes cover"
    )
    strength: strength_field(
        "Strength", "How much sun the cloth holds back: 1 is all of it, 0.5 lets half through"
    )


class SkinTanFilmMask(bpy.types.PropertyGroup):
    """Like `SkinTanMask`, of where a film lies."""

    source: source_field("Film Mask", "What says where the film lies: 0 is dry, 1 is covered")
    image: image_field("black is dry, white is covered")
    uv_map: UV_MAP
    channel: CHANNEL
    invert: invert_field("The film lies where the mask is black (0)")
    strength: strength_field("Strength", "How much of the skin the film covers where the mask is 1")
