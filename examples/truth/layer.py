"""Measures how much of a Principled BSDF's base shows through its gloss in Cycles.

Under white light a Principled BSDF of IOR 1.5526, level .5 and Multiscatter GGX renders
E(angle) + L(angle) base: E is what the gloss reflects, L what it lets through to the base and out
again. L depends on the roughness and on the angle of view. Two renders of squares of base 0 and .5
give L. The add-on divides colours by it.

    python -m examples.truth.layer blender_addon/model/layer.csv

takes a minute and needs Blender's module.
"""

import argparse
import tempfile
from pathlib import Path

import bpy
import numpy as np
import OpenImageIO

from hylios.files import written_beside

IOR = 1.5526
ANGLES = (0.0, 8.0, 30.0, 45.0, 60.0, 70.0)
ROUGHNESSES = np.round(np.arange(0.05, 1.001, 0.05), 2)
BASES = (0.0, 0.5)
SAMPLES, PIXELS = 1024, 8

HEAD = """\
# Share of light that a Principled BSDF's gloss lets through to its base and out again, in Cycles.
# IOR {ior}, specular level .5, Multiscatter GGX, Blender {version}; by roughness and angle of view
# in degrees. Measured by examples/truth/layer.py: {samples} samples of {pixels} pixels; twice the
# standard error is {error:.1g} at most.
roughness,{angles}
"""


def squares() -> bpy.types.Object:
    """A row of squares for every base, one for every roughness; and its material."""
    corners = np.array([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], dtype=float)
    places = [(x, y, 0) for y in range(len(BASES)) for x in range(len(ROUGHNESSES))]
    vertices = (corners + np.array(places)[:, None]).reshape(-1, 3)
    mesh = bpy.data.meshes.new("Squares")
    mesh.from_pydata(vertices.tolist(), [], np.arange(len(vertices)).reshape(-1, 4).tolist())
    obj = bpy.data.objects.new("Squares", mesh)
    bpy.context.collection.objects.link(obj)
    for name, values in (
        ("rough", np.tile(ROUGHNESSES, len(BASES))),
        ("base", np.repeat(BASES, len(ROUGHNESSES))),
    ):
        attribute = mesh.attributes.new(name, "FLOAT", "POINT")
        attribute.data.foreach_set("value", np.repeat(values, 4).astype(np.float32))
    mesh.materials.append(gloss())
    return obj


def gloss() -> bpy.types.Material:
    material = bpy.data.materials.new("Gloss")
    if material.node_tree is None:
        material.use_nodes = True
    tree = material.node_tree
    skin = tree.nodes["Principled BSDF"]
    skin.distribution = "MULTI_GGX"
    skin.inputs["IOR"].default_value = IOR
    for name, socket in (("rough", "Roughness"), ("base", "Base Color")):
        attribute = tree.nodes.new("ShaderNodeAttribute")
        attribute.attribute_name = name
        tree.links.new(attribute.outputs["Fac"], skin.inputs[socket])
    return material


def white_world() -> None:
    world = bpy.data.worlds.new("White")
    if world.node_tree is None:
        world.use_nodes = True
    world.node_tree.nodes["Background"].inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    bpy.context.scene.world = world


def render(angle: float, path: Path) -> np.ndarray:
    """Means (bases, roughnesses) and their standard errors, seen at an angle; light is 1."""
    scene = bpy.context.scene
    data = bpy.data.cameras.new("Camera")
    data.type, data.ortho_scale = "ORTHO", len(ROUGHNESSES)
    camera = bpy.data.objects.new("Camera", data)
    turn = np.radians(angle)
    centre = np.array([len(ROUGHNESSES) / 2, len(BASES) / 2, 0.0])
    camera.location = centre + 50.0 * np.array([0.0, -np.sin(turn), np.cos(turn)])
    camera.rotation_euler = (turn, 0.0, 0.0)
    bpy.context.collection.objects.link(camera)
    scene.camera = camera
    # Squares look lower by the angle's cosine; pixels are made lower by the same.
    scene.render.pixel_aspect_x, scene.render.pixel_aspect_y = 1.0, 1.0
    scene.render.resolution_x = len(ROUGHNESSES) * PIXELS
    height = max(round(len(BASES) * np.cos(turn) * PIXELS), 4 * len(BASES))
    scene.render.resolution_y = height
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
    pixels = np.asarray(OpenImageIO.ImageBuf(str(path)).get_pixels(OpenImageIO.FLOAT))[::-1, :, 0]
    rows = (np.arange(height) - 0.5 * (height - 1)) / (np.cos(turn) * PIXELS) + len(BASES) / 2
    means = []
    for base in range(len(BASES)):
        inside = pixels[np.abs(rows - base - 0.5) < 0.3].reshape(-1, len(ROUGHNESSES), PIXELS)
        inside = np.swapaxes(inside[..., 1:-1], 0, 1).reshape(len(ROUGHNESSES), -1)
        means.append((inside.mean(axis=1), inside.std(axis=1) / np.sqrt(inside.shape[1])))
    return np.array(means)


def main(target: Path) -> None:
    """Write the CSV."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.seed = SAMPLES, 1
    scene.cycles.use_adaptive_sampling = scene.cycles.use_denoising = False
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    squares()
    white_world()
    with tempfile.TemporaryDirectory() as folder:
        seen = np.array([render(angle, Path(folder) / "seen.exr") for angle in ANGLES])
    through = (seen[:, 1, 0] - seen[:, 0, 0]) / (BASES[1] - BASES[0])
    error = 2.0 * np.hypot(seen[:, 1, 1], seen[:, 0, 1]).max() / (BASES[1] - BASES[0])
    text = HEAD.format(
        ior=IOR,
        version=bpy.app.version_string,
        samples=SAMPLES,
        pixels=PIXELS**2,
        error=error,
        angles=",".join(f"{angle:g}" for angle in ANGLES),
    )
    for roughness, values in zip(ROUGHNESSES, through.T, strict=True):
        text += ",".join([f"{roughness:g}", *(f"{value:.4f}" for value in values)]) + "\n"
    with written_beside(target) as unfinished:
        unfinished.write_text(text)


if __name__ == "__main__":
    parser = argparse.ArgumentParser("python -m examples.truth.layer", description=__doc__)
    parser.add_argument("target", type=Path, help="the CSV to write")
    main(parser.parse_args().target)
