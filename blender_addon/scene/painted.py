"""The colour that an artist gave to a material, estimated without rendering."""

from collections.abc import Iterator
from typing import Any, NamedTuple, cast

import bpy
import numpy as np
from numpy.typing import NDArray

from .images import linear
from .recolour import FACTOR, INSERTED
from .trees import shaders

SIDE = 256
"""Pixels along a side of the smaller copy of an image that is looked at."""

MOST_CORNERS = 20000
"""Corners of faces at which an image is looked up."""

MOST_MAPPINGS = 8
"""Nodes between a UV map and a texture that are looked through; links may run in a circle."""

RED_OVER_GREEN, GREEN_OVER_BLUE, RED = (1.1, 5.0), (0.95, 6.0), (0.015, 0.98)
"""Ranges of linear colours of human skin: of the types I to VI, pale to tanned, with a margin."""


class Texture(NamedTuple):
    """An image, and the name of the UV map by which it lies on a mesh; empty for the usual one."""

    image: bpy.types.Image
    uv_map: str


def is_like_skin(colour: NDArray[np.float64] | None) -> bool:
    """Whether a linear colour (3,) is near that of human skin."""
    if colour is None or not np.isfinite(colour).all() or colour.min() <= 0.0:
        return False
    red, green, blue = colour
    return (
        RED[0] <= red <= RED[1]
        and RED_OVER_GREEN[0] <= red / green <= RED_OVER_GREEN[1]
        and GREEN_OVER_BLUE[0] <= green / blue <= GREEN_OVER_BLUE[1]
    )


def painted_colour(
    obj: bpy.types.Object, material: bpy.types.Material
) -> NDArray[np.float64] | None:
    """Median linear colour (3,) of a material over the area of an object's faces that show it.

    None where neither an image nor a plain colour nor a colour attribute leads to its shaders, or
    no file is there.
    """
    attributes: list[str] = []
    for path, _, end in shaders(material):
        sources = list(_sources(material, path, end))
        attributes += [source for source in sources if isinstance(source, str)]
        source = next((source for source in sources if not isinstance(source, str)), None)
        if isinstance(source, Texture):
            source = _median(source.image, *_places(obj, material, source.uv_map))
        if source is not None:
            return source
    colours = (_of_attribute(obj, material, name) for name in attributes)
    return next((colour for colour in colours if is_like_skin(colour)), None)  # else a mask


def painted_images(obj: bpy.types.Object) -> set[bpy.types.Image]:
    """Images that are the colour of an object's materials."""
    materials = [slot.material for slot in obj.material_slots if slot.material]
    sources = [
        next((source for source in _sources(material, path, end) if not isinstance(source, str)), 0)
        for material in materials
        for path, _, end in shaders(material)
    ]
    return {source.image for source in sources if isinstance(source, Texture)}


def painted_attributes(obj: bpy.types.Object) -> set[str]:
    """Names of attributes that the colour of an object's materials follows."""
    shown = [slot.material for slot in obj.material_slots if slot.material]
    sources = [
        source
        for material in shown
        for path, _, end in shaders(material)
        for source in _sources(material, path, end)
    ]
    usual = cast(Any, obj.data).attributes.default_color_name
    return {source or usual for source in sources if isinstance(source, str)}


def _sources(
    material: bpy.types.Material, path: tuple[Any, ...], end: Any
) -> Iterator[Texture | NDArray[np.float64] | str]:
    """What leads to an input, the nearest first: textures, colours (3,), names of attributes.

    The name of the attribute that the mesh shows by default is empty.
    """
    waiting: list[tuple[Any, tuple[Any, ...]]] = [(end, path)]
    seen: set[tuple[Any, str]] = set()
    while waiting:
        socket, around = waiting.pop(0)
        if not socket.is_linked:
            # A plain colour counts only where it is the shader's, maybe through groups' inputs.
            if socket == end or getattr(socket.node, "node_tree", None) is not None:
                if socket.type == "RGBA":
                    yield np.array(socket.default_value[:3], dtype=float)
            continue
        node, output = socket.links[0].from_node, socket.links[0].from_socket.identifier
        if (node, output) in seen:
            continue
        seen.add((node, output))
        if node.get(INSERTED) == FACTOR:
            # What the tan multiplies is the painted colour, not what it multiplies it by.
            if not node.inputs[0].is_linked:
                yield np.array(node.inputs[0].default_value[:3], dtype=float)
            waiting.insert(0, (node.inputs[0], around))
            continue
        image, inner = (getattr(node, name, None) for name in ("image", "node_tree"))
        if node.bl_idname == "ShaderNodeTexImage" and image and _is_colour(image):
            yield Texture(image, _uv_map(node))
        if node.bl_idname == "ShaderNodeRGB":
            yield np.array(node.outputs[0].default_value[:3], dtype=float)
        if node.bl_idname == "ShaderNodeVertexColor":
            yield node.layer_name
        if node.bl_idname == "ShaderNodeAttribute" and node.attribute_type == "GEOMETRY":
            yield node.attribute_name
        if inner is not None:
            waiting += [(exit_, (*around, inner)) for exit_ in _exits(inner, output)]
        elif node.bl_idname == "NodeGroupInput" and around:
            outer, group = (material.node_tree, *around)[-2:]
            waiting += [(entry, around[:-1]) for entry in _entries(outer, group, output)]
        else:
            waiting += [(entry, around) for entry in node.inputs if entry.is_linked]


def _exits(group: Any, identifier: str) -> list[Any]:
    """What leads to an output of a node group, inside."""
    nodes = [node for node in group.nodes if node.bl_idname == "NodeGroupOutput"]
    return [end for node in nodes for end in node.inputs if end.identifier == identifier]


def _entries(outer: Any, group: Any, identifier: str) -> list[Any]:
    """Inputs of the nodes that show a group in a tree."""
    nodes = [node for node in outer.nodes if getattr(node, "node_tree", None) == group]
    return [end for node in nodes for end in node.inputs if end.identifier == identifier]


def _is_colour(image: bpy.types.Image) -> bool:
    return not cast(Any, image.colorspace_settings).is_data


def _uv_map(node: Any) -> str:
    """Name of the UV map that a texture's node is given, maybe through a mapping."""
    for _ in range(MOST_MAPPINGS):
        end = node.inputs.get("Vector")
        if end is None or not end.is_linked:
            break
        node = end.links[0].from_node
        if node.bl_idname in ("ShaderNodeUVMap", "ShaderNodeAttribute"):
            return getattr(node, "uv_map", None) or getattr(node, "attribute_name", "")
    return ""


Places = tuple[NDArray[np.float32] | None, NDArray[np.floating] | None]
"""Texture coordinates (N, 2), and the area of the mesh that each stands for (N,)."""


def _places(obj: bpy.types.Object, material: bpy.types.Material, uv_map: str) -> Places:
    """Corners of the faces that show a material, in a UV map or the one that renders."""
    layers: Any = cast(Any, obj.data).uv_layers
    layer = layers.get(uv_map) or next((layer for layer in layers if layer.active_render), None)
    corners, shares = _corners(obj, material)
    if layer is None or not len(corners):
        return None, None
    places = np.zeros(2 * len(layer.uv), np.float32)
    layer.uv.foreach_get("vector", places)
    return places.reshape(-1, 2)[corners], shares


def _of_attribute(
    obj: bpy.types.Object, material: bpy.types.Material, name: str
) -> NDArray[np.float64] | None:
    """Median linear colour (3,) of a mesh's colours where it shows a material; "" is the usual."""
    mesh: Any = obj.data
    attribute = mesh.attributes.get(name or mesh.attributes.default_color_name)
    corners, shares = _corners(obj, material)
    if attribute is None or "COLOR" not in attribute.data_type or not len(corners):
        return None
    if attribute.domain == "POINT":
        points = np.zeros(len(mesh.loops), np.int32)
        mesh.loops.foreach_get("vertex_index", points)
        corners = points[corners]
    elif attribute.domain != "CORNER":
        return None
    colours = np.zeros(4 * len(attribute.data), np.float32)
    attribute.data.foreach_get("color", colours)
    return weighted_median(colours.reshape(-1, 4)[corners, :3].astype(float), shares)


def _corners(
    obj: bpy.types.Object, material: bpy.types.Material
) -> tuple[NDArray[np.intp], NDArray[np.floating]]:
    """Corners of the faces that show a material, of many a part, and their areas."""
    mesh: Any = obj.data
    count = len(mesh.polygons) if obj.mode != "EDIT" else 0  # there a mesh tells nothing of them
    index, counts = np.zeros(count, np.int32), np.zeros(count, np.int32)
    if count:
        mesh.polygons.foreach_get("material_index", index)
        mesh.polygons.foreach_get("loop_total", counts)
    slots = [slot.slot_index for slot in obj.material_slots if slot.material == material]
    index = index.clip(0, len(obj.material_slots) - 1)
    shown = np.flatnonzero(np.repeat(np.isin(index, slots), counts))
    shown = shown[:: max(len(shown) // MOST_CORNERS, 1)]
    areas = areas_of_faces(mesh)[:count] / counts
    return shown, np.repeat(areas, counts)[shown]


def areas_of_faces(mesh: Any) -> NDArray[np.float32]:
    """Area of every face of a mesh; 0 where it is no number."""
    areas = np.zeros(len(mesh.polygons), np.float32)
    mesh.polygons.foreach_get("area", areas)
    return np.where(np.isfinite(areas), areas, np.float32(0.0))


def weighted_median(values: NDArray, weights: NDArray) -> NDArray[np.float64]:
    """Median (K,) of values (N, K) with weights (N,), by columns; all count alike if all are 0."""
    weights = weights.astype(float) if weights.any() else np.ones(len(values))
    order = np.argsort(values, axis=0)
    part = np.cumsum(weights[order], axis=0) / weights.sum()
    # Where one half ends exactly between two values the median lies between them.
    middle = [np.argmax(part > 0.5 + shift, axis=0) for shift in (-1e-9, 1e-9)]
    picked = [np.take_along_axis(order, row[None], axis=0) for row in middle]
    return np.mean([np.take_along_axis(values, rows, axis=0)[0] for rows in picked], axis=0)


def _median(
    image: Any, places: NDArray | None, shares: NDArray | None
) -> NDArray[np.float64] | None:
    """Median linear colour (3,) of an image at places with shares of an area, or of all of it."""
    pixels = _pixels(image)
    if pixels is None:
        return None
    rows, columns, _ = pixels.shape
    if places is None or shares is None or not np.isfinite(places).all():
        pixels, shares = pixels.reshape(-1, 4), np.ones(rows * columns, np.float32)
    else:
        inside = ((places >= 0.0) & (places < 1.0)).all(axis=1)
        if inside.any():
            places, shares = places[inside], shares[inside]
        x, y = (places % 1.0 * (columns, rows)).astype(int).T
        pixels = pixels[y.clip(0, rows - 1), x.clip(0, columns - 1)]
    opaque = pixels[:, 3] > 0.5
    if opaque.any():
        pixels, shares = pixels[opaque], shares[opaque]
    colour = weighted_median(pixels[:, :3].astype(float), shares)
    return colour if image.is_float else linear(colour)


def _pixels(image: Any) -> NDArray[np.float32] | None:
    """Pixels (rows, columns, 4) of an image, of a small copy where it is large."""
    if min(image.size) == 0:
        return None
    is_copy = image.source == "FILE" and not image.is_dirty and max(image.size) > SIDE
    if is_copy:
        image = image.copy()
    try:
        if is_copy:
            image.scale(min(image.size[0], SIDE), min(image.size[1], SIDE))
        values = np.zeros(len(image.pixels), np.float32)
        image.pixels.foreach_get(values)
        width, height, channels = *image.size, image.channels
    finally:
        if is_copy:
            bpy.data.images.remove(image)
    if len(values) != width * height * channels:
        return None
    values = values.reshape(height, width, channels)
    if channels == 4:
        return values
    colour = values[..., :3] if channels == 3 else values[..., :1].repeat(3, axis=2)
    return np.concatenate([colour, np.ones((height, width, 1), np.float32)], axis=2)
