"""A skin table of smooth analytic values, and the small scenes in which tests look at it."""

from pathlib import Path

import bpy
import numpy as np
import OpenImageIO

from hylios.table import SkinTable, StateAxes
from hylios.tanning import PIGMENTATIONS

UNTANNED_COLOUR = np.array([0.62, 0.41, 0.31])
UNTANNED_WIDTH = np.array([1.6, 0.7, 0.45])


def smooth_table(pigmentation: str = "intermediate") -> SkinTable:
    """Colour falls exponentially with the melanin, profile width grows with the thickness."""
    steady = PIGMENTATIONS[pigmentation].steady_state()
    directions = np.array([[1.0, 1.0, 1.0, 0.1], [1.0, -1.0, 0.0, 0.0]]).T
    axes = StateAxes(
        untanned=np.append(steady / steady.sum(), 1.0),
        basis=np.linalg.qr(directions)[0] * [-1.0, 1.0],
        knots=(np.linspace(-0.5, 3.0, 15), np.linspace(-2.0, 2.0, 9)),
    )
    states = axes.knot_states()
    melanin, thickness = states[..., :3].sum(-1, keepdims=True), states[..., 3:]
    colour = UNTANNED_COLOUR * np.exp(np.array([-0.5, -0.8, -1.0]) * (melanin - 1.0))
    planes = {
        "subsurface_colour": colour,
        "total_colour": colour + 0.03,
        "band_reflectance": np.broadcast_to(0.5, colour.shape),
        "profile_width": UNTANNED_WIDTH * thickness,
    }
    provenance = {
        "specimen": "S3",
        "pigmentation": pigmentation,
        "mmd_sed": 4.9,
        "med_sed": 2.9,
        "bands_nm": [365, 1100, 1650],
        "software": "test",
    }
    return SkinTable(axes, planes, provenance)


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


def render(path: Path, *, width: int, height: int, samples: int = 1) -> np.ndarray:
    """Render the current frame with Cycles; linear pixels (height, width, 3), top row first."""
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples = samples
    scene.cycles.use_adaptive_sampling = False
    scene.cycles.use_denoising = False
    scene.cycles.seed = 1
    scene.render.resolution_x, scene.render.resolution_y = width, height
    scene.render.resolution_percentage = 100
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    return read_pixels(path)


def read_pixels(path: Path) -> np.ndarray:
    return np.asarray(OpenImageIO.ImageBuf(str(path)).get_pixels(OpenImageIO.FLOAT))[..., :3]
