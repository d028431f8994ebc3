"""Small scenes in which tests look at a tan."""

from pathlib import Path

import bpy
import numpy as np
import OpenImageIO

from blender_addon.scene import nodes

OWN_IMAGES, LOOK_IMAGES = 2, 2
"""Images that Apply makes for an object, and for a skin with all planes."""


def apply(obj=None) -> set:
    """Press the button, for an object if one is given."""
    if obj is not None:
        bpy.context.view_layer.objects.active = obj
    return bpy.ops.skin_tan.apply()


def tan_group(obj):
    """The node group of an object's tan."""
    return obj.skin_tan.group


def tan_groups() -> list:
    """The node groups of all tans in the file."""
    return [group for group in bpy.data.node_groups if "skin_tan_layout" in group]


def of_role(obj, role: str):
    """The node of a role in an object's tan."""
    (node,) = nodes.of_role(tan_group(obj), role)
    return node


def pixels(image) -> np.ndarray:
    """Pixels (rows, columns, 4) of an image, the bottom row first."""
    values = np.empty(len(image.pixels), np.float32)
    image.pixels.foreach_get(values)
    return values.reshape(image.size[1], image.size[0], 4)


def look(obj) -> bytes:
    """All pixels that the tan groups in an object's first slot show."""
    return b"".join(pixels(image).tobytes() for image in _images(obj.material_slots[0].material))


def _images(block) -> list:
    shown = []
    for node in block.node_tree.nodes if hasattr(block, "node_tree") else block.nodes:
        if node.bl_idname == "ShaderNodeTexImage" and node.image:
            shown.append(node.image)
        elif getattr(node, "node_tree", None):
            shown.extend(_images(node.node_tree))
    return shown


def tan_object(table_path: Path, shares=None, dose: float = 30.0):
    """A row of unit squares along x, one to a share of the dose, with settings but no tan yet."""
    count = 1 if shares is None else len(shares)
    corners = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], dtype=float)
    vertices = (corners + np.arange(count)[:, None, None] * [1, 0, 0]).reshape(-1, 3)
    mesh = bpy.data.meshes.new("Row")
    mesh.from_pydata(vertices.tolist(), [], np.arange(4 * count).reshape(-1, 4).tolist())
    obj = bpy.data.objects.new("Body", mesh)
    bpy.context.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    settings = obj.skin_tan
    settings.skin, settings.table_path = "FILE", str(table_path)
    # Others have the redness of a new tan, and the kinetics fitted to people.
    settings.kinetics, settings.redness = "THESIS", False
    exposure = settings.exposures.add()
    exposure.day, exposure.dose = 0.0, dose
    if shares is not None:
        add_mask(obj, np.repeat(shares, 4))
    return obj


def add_mask(obj, values, name: str = "sun") -> None:
    attribute = obj.data.attributes.new(name, "FLOAT", "POINT")
    attribute.data.foreach_set("value", np.asarray(values, dtype=np.float32))
    obj.skin_tan.mask_attribute = name


def add_camera(location, scale: float) -> None:
    """An orthographic camera that looks down; `scale` is the width of its picture."""
    data = bpy.data.cameras.new("Camera")
    data.type, data.ortho_scale = "ORTHO", scale
    camera = bpy.data.objects.new("Camera", data)
    camera.location = location
    bpy.context.collection.objects.link(camera)
    bpy.context.scene.camera = camera


def white_world() -> None:
    world = bpy.data.worlds.new("World")
    if world.node_tree is None:
        world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    bpy.context.scene.world = world


def render(
    path: Path, *, width: int, height: int, samples: int = 1, kind: str = "OPEN_EXR"
) -> np.ndarray:
    """Render the current frame with Cycles; linear pixels (height, width, 3), top row first."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples = samples
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.cycles.seed = 1
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = kind
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    return read_pixels(path)


def read_pixels(path: Path) -> np.ndarray:
    return np.asarray(OpenImageIO.ImageBuf(str(path)).get_pixels(OpenImageIO.FLOAT))[..., :3]


def set_modifier_input(modifier, identifier: str, value):
    """Set an input of a geometry-nodes modifier, which is a property of its own from 5.2 on."""
    if bpy.app.version >= (5, 2, 0):
        getattr(modifier.properties.inputs, identifier).value = value
    else:
        modifier[identifier] = value


def modifier_input(modifier, identifier: str):
    """What an input of a geometry-nodes modifier holds."""
    if bpy.app.version >= (5, 2, 0):
        return getattr(modifier.properties.inputs, identifier).value
    return modifier[identifier]
