"""Measures the gloss of a Principled BSDF in Cycles, and what of its base shows through it.

Under white light a Principled BSDF of IOR 1.5526, level .5 and Multiscatter GGX renders
E(angle) + L(angle) base: E is what the gloss reflects, L what it lets through to the base and out
again. Both depend on the roughness and on the angle of view.

The light model's surface reflects more than E at an angle: none of its facets shadows another, as
Smith's shadowing has it in GGX (Walter et al., Microfacet Models for Refraction, EGSR 2007). By
reciprocity what a camera sees under even light is the directional albedo. E grows straight with
the shader's Specular Tint, so that two renders of a black base say at which tint it is the model's
(`hylios.adding`). L is measured at that tint, with bases of 0 and 1.

    python -m examples.truth.layer blender_addon/model

writes gloss.csv, the tint, and layer.csv, L, by which the add-on divides colours. It takes two
minutes and needs Blender's module.
"""

import argparse
import tempfile
from dataclasses import replace
from pathlib import Path

import bpy
import numpy as np
import OpenImageIO

from hylios.adding import spectrum
from hylios.files import written_beside
from hylios.quadrature import MOST, skin_quadrature
from hylios.skin.phototypes import skin_type

IOR = 1.5526
ANGLES = (0.0, 8.0, 30.0, 45.0, 55.0, 60.0, 65.0, 70.0, 75.0, 80.0, 85.0)
ROUGHNESSES = np.round(np.arange(0.05, 1.001, 0.05), 2)
BASE = 1.0
"""Of the shader: with white, gloss and base hold nearly all light together, so without noise."""

SAMPLES, PIXELS = 1024, 8

LUMINANCE = np.array([0.2126, 0.7152, 0.0722])
"""Of linear Rec.709 (ITU-R BT.709): the surface is nearly grey."""

HEAD = """\
# {what}
# IOR {ior}, specular level .5, Multiscatter GGX, Blender {version}; by roughness and angle of view
# in degrees. Measured by examples/truth/layer.py: {samples} samples of {pixels} pixels; twice the
# standard error is {error:.1g} at most.
roughness,{angles}
"""
TINT = "Specular Tint at which a Principled BSDF reflects as much as the light model's surface."
THROUGH = (
    "Share of light that this gloss lets through to the shader's base and out again, in Cycles."
)


def model_albedo(roughness: float) -> np.ndarray:
    """What the model's surface reflects at `ANGLES`, (A,), as luminance.

    Its slopes are as steep as those of a shader of a roughness: the square of that.
    """
    skin = skin_type("III")
    of = replace(skin.at(skin.untanned_state), surface_fold_aspect_ratio=roughness**2)
    visible = skin_quadrature(MOST)
    light = spectrum(of, visible.wavelengths, angle=list(ANGLES))
    return light.surface @ visible.weights.T @ LUMINANCE


def strips() -> bpy.types.Object:
    """Long strips side by side, one for every roughness; and their material."""
    corners = np.array([(0, -500, 0), (1, -500, 0), (1, 500, 0), (0, 500, 0)], dtype=float)
    places = [(x, 0, 0) for x in range(len(ROUGHNESSES))]
    vertices = (corners + np.array(places)[:, None]).reshape(-1, 3)
    mesh = bpy.data.meshes.new("Strips")
    mesh.from_pydata(vertices.tolist(), [], np.arange(len(vertices)).reshape(-1, 4).tolist())
    obj = bpy.data.objects.new("Strips", mesh)
    bpy.context.collection.objects.link(obj)
    for name in ("rough", "tint"):
        mesh.attributes.new(name, "FLOAT", "POINT")
    give(obj, "rough", ROUGHNESSES)
    mesh.materials.append(gloss())
    return obj


def give(obj: bpy.types.Object, name: str, values: np.ndarray) -> None:
    """Give a number to each strip."""
    data = obj.data.attributes[name].data
    data.foreach_set("value", np.repeat(values, 4).astype(np.float32))


def gloss() -> bpy.types.Material:
    material = bpy.data.materials.new("Gloss")
    if material.node_tree is None:
        material.use_nodes = True
    tree = material.node_tree
    skin = tree.nodes["Principled BSDF"]
    skin.distribution = "MULTI_GGX"
    skin.inputs["IOR"].default_value = IOR
    for name, socket in (("rough", "Roughness"), ("tint", "Specular Tint")):
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


def camera(angle: float) -> None:
    """See all strips side by side, at an angle, with pixels lower than they are wide."""
    scene = bpy.context.scene
    data = bpy.data.cameras.new("Camera")
    data.type, data.ortho_scale = "ORTHO", len(ROUGHNESSES)
    obj = bpy.data.objects.new("Camera", data)
    turn = np.radians(angle)
    obj.location = (len(ROUGHNESSES) / 2, -50.0 * np.sin(turn), 50.0 * np.cos(turn))
    obj.rotation_euler = (turn, 0.0, 0.0)
    bpy.context.collection.objects.link(obj)
    scene.camera = obj
    scene.render.resolution_x, scene.render.resolution_y = len(ROUGHNESSES) * PIXELS, PIXELS


def render(obj: bpy.types.Object, base: float, tint: np.ndarray) -> np.ndarray:
    """Means of strips of a base and their standard errors, (2, R); light is 1."""
    give(obj, "tint", tint)
    skin = obj.data.materials[0].node_tree.nodes["Principled BSDF"]
    skin.inputs["Base Color"].default_value = (base, base, base, 1.0)
    with tempfile.TemporaryDirectory() as folder:
        path = str(Path(folder) / "seen.exr")
        bpy.context.scene.render.filepath = path
        bpy.ops.render.render(write_still=True)
        pixels = np.asarray(OpenImageIO.ImageBuf(path).get_pixels(OpenImageIO.FLOAT))[..., 0]
    inside = pixels.reshape(PIXELS, len(ROUGHNESSES), PIXELS)[..., 1:-1]
    return np.array(
        [inside.mean(axis=(0, 2)), inside.std(axis=(0, 2)) / np.sqrt(inside[:, 0].size)]
    )


def measured() -> tuple[np.ndarray, np.ndarray]:
    """Tint and L, each with two of its standard errors, (2, R, A)."""
    obj = strips()
    wanted = np.array([model_albedo(roughness) for roughness in ROUGHNESSES]).T
    tints, through = [], []
    for angle, reflected in zip(ANGLES, wanted, strict=True):
        camera(angle)
        (usual, error), (twice, _) = (
            render(obj, 0.0, np.full(len(ROUGHNESSES), t)) for t in (1, 2)
        )
        slope = twice - usual
        tint = 1.0 + (reflected - usual) / slope
        tints.append((tint, 2.0 * error / slope))
        (black, own), (grey, other) = (render(obj, base, tint) for base in (0.0, BASE))
        through.append(((grey - black) / BASE, 2.0 * np.hypot(own, other) / BASE))
    return np.array(tints).transpose(1, 2, 0), np.array(through).transpose(1, 2, 0)


def write(path: Path, what: str, factors: np.ndarray) -> None:
    """Write numbers and errors (2, R, A)."""
    text = HEAD.format(
        what=what,
        ior=IOR,
        version=bpy.app.version_string,
        samples=SAMPLES,
        pixels=PIXELS * (PIXELS - 2),
        error=factors[1].max(),
        angles=",".join(f"{angle:g}" for angle in ANGLES),
    )
    for roughness, values in zip(ROUGHNESSES, factors[0], strict=True):
        text += ",".join([f"{roughness:g}", *(f"{value:.4f}" for value in values)]) + "\n"
    with written_beside(path) as unfinished:
        unfinished.write_text(text)


def main(folder: Path) -> None:
    """Measure, and write both files."""
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    scene = bpy.context.scene
    scene.render.engine = "CYCLES"
    scene.cycles.samples, scene.cycles.seed = SAMPLES, 1
    scene.cycles.use_adaptive_sampling = scene.cycles.use_denoising = False
    scene.cycles.pixel_filter_type = "BOX"
    scene.render.image_settings.file_format = "OPEN_EXR"
    scene.render.image_settings.color_depth = "32"
    white_world()
    tint, through = measured()
    write(folder / "gloss.csv", TINT, tint)
    write(folder / "layer.csv", THROUGH, through)


if __name__ == "__main__":
    parser = argparse.ArgumentParser("python -m examples.truth.layer", description=__doc__)
    parser.add_argument("folder", type=Path, help="for gloss.csv and layer.csv")
    main(parser.parse_args().folder)
