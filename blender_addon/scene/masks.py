"""Masks: what says how much of the sun reaches each point, and what can say it.

A mask reads one number m, 0 under cloth and 1 on bare skin, from a vertex group, an attribute or an
image. The share of the dose is 1 - strength (1 - m), with 1 - m for m where it is inverted.
"""

import json
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, fields
from typing import Any, cast

import bpy

from hylios.errors import InputError

from . import first_version
from .images import MARK
from .ownership import names
from .trees import all_nested

RESERVED = frozenset(
    """
    N uv generated generated_transform tangent tangent_sign undisplaced_tangent
    undisplaced_tangent_sign vertex_color undeformed undisplaced undisplaced_N particle
    curve_intercept curve_length curve_random point_random ptex_face_id ptex_uv density color flame
    heat temperature velocity velocity_x velocity_y velocity_z pointiness random_per_island
    shadow_transparency motion_P motion_N
    """.split()
)
"""Names under which Cycles shows something of its own and not the mesh's attribute.

From `Attribute::standard_name` in Cycles' sources, less P and radius, which a mesh may use.
"""

TYPES = {
    "FLOAT": "Number",
    "FLOAT_COLOR": "Colour",
    "BYTE_COLOR": "Colour",
    "BOOLEAN": "Yes or no",
    "INT": "Whole number",
    "INT8": "Whole number",
}
DOMAINS = {"POINT": "points", "CORNER": "corners", "FACE": "faces"}
COLOURS = ("FLOAT_COLOR", "BYTE_COLOR")

BUILT_IN = frozenset(("material_index", "sharp_face"))
"""Attributes of Blender's own; nobody looks for a mask among them."""

MOST_TOLD = 12
"""Names of masks in one sentence."""

LONGEST_NAME = 63
"""Bytes of the name of a new mask. Blender 4.5 has room for 67, of which a number takes four."""

COPIES_KEY = "skin_tan_copies"
"""Custom property of a mesh: by the names of attributes that this add-on made, the vertex groups
of which they are copies, as JSON."""


@dataclass(frozen=True)
class Mask:
    """What an artist has set of one mask, as `SkinTanMask` holds it.

    Attributes
    ----------
    source : str
        Name of an attribute or a vertex group; empty, without an image, for no mask.
    image : Image or None
        The source, where it is an image.
    uv_map : str
        Where the image lies; empty for the map that renders.
    channel : str
        Of a colour: MEAN, RED, GREEN, BLUE or ALPHA.
    invert : bool
    strength : float
        0 leaves all bare.
    """

    source: str = ""
    image: bpy.types.Image | None = None
    uv_map: str = ""
    channel: str = "MEAN"
    invert: bool = False
    strength: float = 1.0

    @classmethod
    def of(cls, source: Any) -> "Mask":
        """The values of anything with attributes of these names."""
        return cls(**{field.name: getattr(source, field.name) for field in fields(cls)})

    def __bool__(self) -> bool:
        return bool(self.source or self.image)


@dataclass(frozen=True)
class Source:
    """What a mask can read.

    Attributes
    ----------
    kind : str
        ATTRIBUTE, EVALUATED (an attribute that modifiers make), GROUP or IMAGE.
    name : str
    data_type, domain : str
        Of an attribute.
    """

    kind: str
    name: str
    data_type: str = ""
    domain: str = ""

    @property
    def label(self) -> str:
        """What it is, in a few words for a list."""
        if self.kind == "GROUP":
            return "Vertex group"
        if self.kind == "IMAGE":
            return "Image"
        made = ", by a modifier" if self.kind == "EVALUATED" else ""
        return f"{TYPES[self.data_type]}, {DOMAINS[self.domain]}{made}"

    @property
    def has_channels(self) -> bool:
        return self.kind == "IMAGE" or self.data_type in COLOURS


def usable_sources(obj: bpy.types.Object, depsgraph: bpy.types.Depsgraph | None) -> list[Source]:
    """All that can be a mask of a mesh object, attributes that modifiers make among them."""
    mesh = _mesh(obj)
    listed = [
        Source("ATTRIBUTE", item.name, item.data_type, item.domain)
        for item in mesh.attributes
        if _is_offered(item) and not _is_own(mesh, item.name)
    ]
    taken = {source.name for source in listed}
    listed += [
        Source("GROUP", group.name) for group in obj.vertex_groups if group.name not in taken
    ]
    evaluated = evaluated_mesh(obj, depsgraph)
    if evaluated is not None:
        present = {item.name for item in mesh.attributes} | {group.name for group in listed}
        listed += [
            Source("EVALUATED", item.name, item.data_type, item.domain)
            for item in evaluated.attributes
            if _is_offered(item) and item.name not in present
        ]
    if mesh.uv_layers:
        taken = {source.name for source in listed}
        skin = textures(obj)
        images = sorted(
            (image for image in _images() if image.name not in taken),
            key=lambda image: (image in skin, cast(Any, image.colorspace_settings).is_data),
        )
        listed += [Source("IMAGE", image.name) for image in images]
    return listed


def textures(obj: bpy.types.Object) -> set[bpy.types.Image]:
    """Images in an object's materials, which are skin and clothes rather than masks."""
    trees = [slot.material.node_tree for slot in obj.material_slots if slot.material]
    own = {
        inner
        for tree in trees
        if tree
        for inner in (tree, *all_nested(tree))
        if not first_version.is_tan_group(inner)
    }
    shown = (getattr(node, "image", None) for tree in own for node in tree.nodes)
    return {image for image in shown if image is not None}


def require_name(name: str) -> None:
    """Raise InputError unless a new mask can have a name."""
    if name in RESERVED | BUILT_IN or name.startswith("."):
        raise InputError(
            f"The name of the mask is {name!r}, which Blender keeps for itself; give it another."
        )
    length = len(name.encode())
    if length > LONGEST_NAME:
        raise InputError(
            f"The name of the mask, {name[:20]!r}…, has {length} bytes; allowed are at most "
            f"{LONGEST_NAME}."
        )


def source_of(
    obj: bpy.types.Object, mask: Mask, depsgraph: bpy.types.Depsgraph | None
) -> Source | None:
    """What a mask reads, or None where that is not there or nothing is set."""
    if mask.image is not None:
        return Source("IMAGE", mask.image.name)
    mesh = _mesh(obj)
    attribute = mesh.attributes.get(mask.source) if mask.source else None
    if attribute is not None:
        return Source("ATTRIBUTE", attribute.name, attribute.data_type, attribute.domain)
    if mask.source in obj.vertex_groups:
        return Source("GROUP", mask.source)
    evaluated = evaluated_mesh(obj, depsgraph)
    attribute = evaluated.attributes.get(mask.source) if evaluated and mask.source else None
    if attribute is not None:
        return Source("EVALUATED", attribute.name, attribute.data_type, attribute.domain)
    return None


def require_usable(obj: bpy.types.Object, mask: Mask) -> Source | None:
    """What a mask reads; None where none is set.

    Raises
    ------
    InputError
        If it is not there, or cannot be a mask.
    """
    if not mask:
        return None
    source = source_of(obj, mask, None) or source_of(obj, mask, current_depsgraph())
    if source is None:
        skin = {image.name for image in textures(obj)}
        usable = [
            item.name
            for item in usable_sources(obj, current_depsgraph())
            if item.kind != "IMAGE" or item.name not in skin
        ]
        raise InputError(
            f"The mesh has no {mask.source!r}, which is set as a mask; allowed are: "
            f"{_told(usable)}."
        )
    if source.kind == "IMAGE":
        _require_image(obj, mask)
    elif source.kind != "GROUP":
        _require_attribute(source)
    return source


def _told(usable: list[str]) -> str:
    """Names of masks for a sentence, which does not grow with their number."""
    told = ", ".join(usable[:MOST_TOLD]) or "vertex groups and attributes, which it has none of"
    more = len(usable) - MOST_TOLD
    return f"{told} and {more} more" if more > 0 else told


def image_named(obj: bpy.types.Object, name: str) -> bpy.types.Image | None:
    """The image that a name stands for where no attribute or vertex group has it."""
    mesh = _mesh(obj)
    if not name or name in mesh.attributes or name in obj.vertex_groups:
        return None
    return next((image for image in _images() if image.name == name), None)


def evaluated_mesh(
    obj: bpy.types.Object, depsgraph: bpy.types.Depsgraph | None
) -> bpy.types.Mesh | None:
    """The mesh that modifiers lead to, if there is one."""
    data = obj.evaluated_get(depsgraph).data if depsgraph and obj.modifiers else None
    return data if isinstance(data, bpy.types.Mesh) else None


def current_depsgraph() -> bpy.types.Depsgraph:
    return bpy.context.evaluated_depsgraph_get()


def uv_map_names(obj: bpy.types.Object, depsgraph: bpy.types.Depsgraph | None) -> list[str]:
    """UV maps of a mesh object, those that modifiers make among them."""
    meshes = (_mesh(obj), evaluated_mesh(obj, depsgraph))
    return list(dict.fromkeys(layer.name for mesh in meshes if mesh for layer in mesh.uv_layers))


def _require_image(obj: bpy.types.Object, mask: Mask) -> None:
    image = cast(bpy.types.Image, mask.image)
    maps = uv_map_names(obj, None) or uv_map_names(obj, current_depsgraph())
    if not maps:
        raise InputError(
            f"The mask is the image {image.name!r}, and {names([obj])} has no UV map to lay it on; "
            "unwrap the mesh first (UV > Unwrap in Edit Mode)."
        )
    if mask.uv_map and mask.uv_map not in {*maps, *uv_map_names(obj, current_depsgraph())}:
        raise InputError(f"The mesh has no UV map {mask.uv_map!r}; allowed are: {', '.join(maps)}.")
    if not image.size[0]:
        raise InputError(
            f"The image {image.name!r}, which is the mask, has no pixels; its file is missing "
            f"({image.filepath or 'no path'})."
        )


def _require_attribute(source: Source) -> None:
    if source.name in RESERVED:
        raise InputError(
            f"The attribute {source.name!r} cannot be a mask: Cycles keeps that name for itself; "
            "rename the attribute."
        )
    if source.data_type not in TYPES or source.domain not in DOMAINS:
        kind, domain = (_words(name, getattr(source, name)) for name in ("data_type", "domain"))
        raise InputError(
            f"The attribute {source.name!r} cannot be a mask: it is of type {kind} on {domain}; "
            "allowed are numbers, whole numbers, yes or no, and colours, of points, corners or "
            "faces."
        )


def _words(name: str, value: str) -> str:
    """What a property of an attribute is called in Blender's menus."""
    items: Any = bpy.types.Attribute.bl_rna.properties[name]
    return items.enum_items[value].name


def _is_offered(attribute: bpy.types.Attribute) -> bool:
    return (
        attribute.data_type in TYPES
        and attribute.domain in DOMAINS
        and not attribute.is_internal
        and attribute.name not in RESERVED | BUILT_IN
    )


def _is_own(mesh: bpy.types.Mesh, name: str) -> bool:
    """Whether this add-on made an attribute for its shader."""
    quoted = json.dumps(name)
    return f"{quoted}:" in mesh.get(COPIES_KEY, "") or quoted in mesh.get("skin_tan_basis", "")


def _images() -> Iterator[bpy.types.Image]:
    """Images that are neither a render nor a table of this add-on."""
    images: Iterable[Any] = bpy.data.images
    return (image for image in images if image.type in ("IMAGE", "UV_TEST") and MARK not in image)


def _mesh(obj: bpy.types.Object) -> bpy.types.Mesh:
    return cast(bpy.types.Mesh, obj.data)
