"""Rendering with Cycles: pictures, and the light in them that comes out of the skin."""

from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import bpy
import numpy as np
import OpenImageIO as oiio  # noqa: N813

# Passes by their property, and by their name in a file of Blender 5 and of Blender 4.5.
PASSES = {
    "diffuse_direct": ("Diffuse Direct", "DiffDir"),
    "diffuse_color": ("Diffuse Color", "DiffCol"),
    "position": ("Position", "Position"),
    "normal": ("Normal", "Normal"),
}


@dataclass(frozen=True)
class Quality:
    """Samples to a pixel, size in percent of the scene's, and how hard to denoise."""

    samples: int
    percent: int
    denoiser: str = "BALANCED"


STILL = Quality(samples=20, percent=100, denoiser="HIGH")
VIDEO = Quality(samples=6, percent=50)
OVERVIEW = Quality(samples=32, percent=50)
READING = Quality(samples=256, percent=100)

Window = tuple[float, float, float, float]  # left, right, bottom, top, as shares of the picture
WHOLE = (0.0, 1.0, 0.0, 1.0)


@dataclass(frozen=True)
class Light:
    """Light, position and normal of a render's pixels, arrays (rows, columns, 3).

    Attributes
    ----------
    scattered
        Light of the lamps and the surroundings that has been in the skin, without what the
        surface reflects and without light from other skin.
    albedo
        The part of the light that the shader scatters in the skin.
    position, normal
        Of the surface, in metres; both 0 where there is none.
    """

    scattered: np.ndarray
    albedo: np.ndarray
    position: np.ndarray
    normal: np.ndarray


def prepare(scene: bpy.types.Scene) -> None:
    """Set up Cycles for many pictures of a scene in which only the skin's colour changes."""
    scene.render.engine = "CYCLES"
    scene.render.use_persistent_data = True
    scene.cycles.use_light_tree = False  # two lamps need none
    scene.cycles.max_bounces = 2
    for name in PASSES:
        setattr(scene.view_layers[0], f"use_pass_{name}", True)


def picture(scene: bpy.types.Scene, frame: int, quality: Quality, path: Path) -> None:
    """Render a frame into a PNG file."""
    set_file_format(scene, "IMAGE", "PNG")
    scene.cycles.use_denoising = True
    scene.cycles.denoising_quality = quality.denoiser
    _render(scene, frame, quality, path)


def light(
    scene: bpy.types.Scene, frame: int, quality: Quality, scratch: Path, window: Window = WHOLE
) -> Light:
    """Render a window of a frame and return the light in it; `scratch` is a file to use."""
    passes(scene, frame, quality, scratch, window, denoised=False)
    return read_light(scratch)


def passes(
    scene: bpy.types.Scene,
    frame: int,
    quality: Quality,
    path: Path,
    window: Window,
    *,
    denoised: bool,
) -> None:
    """Render a window of a frame into a multilayer EXR file; only the picture is denoised."""
    set_file_format(scene, "MULTI_LAYER_IMAGE", "OPEN_EXR_MULTILAYER")
    scene.cycles.use_denoising = denoised
    scene.cycles.denoising_quality = quality.denoiser
    settings = scene.render
    settings.use_border = settings.use_crop_to_border = True
    settings.border_min_x, settings.border_max_x = window[:2]
    settings.border_min_y, settings.border_max_y = window[2:]
    _render(scene, frame, quality, path)
    settings.use_border = settings.use_crop_to_border = False


@contextmanager
def white(obj: bpy.types.Object) -> Iterator[None]:
    """Make an object a perfect white diffuser for a while."""
    material = bpy.data.materials.new("White")
    if material.node_tree is None:
        material.use_nodes = True  # Blender 4.5
    tree = material.node_tree
    tree.nodes.clear()
    diffuser = tree.nodes.new("ShaderNodeBsdfDiffuse")
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    diffuser.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    tree.links.new(diffuser.outputs["BSDF"], output.inputs["Surface"])
    skins = [slot.material for slot in obj.material_slots]
    for slot in obj.material_slots:
        slot.material = material
    yield
    for slot, skin in zip(obj.material_slots, skins, strict=True):
        slot.material = skin
    bpy.data.materials.remove(material)


def read_light(path: Path) -> Light:
    """The light in a file with the passes of a render."""
    channels = read_channels(path)
    passes = {key: one_pass(channels, names) for key, names in PASSES.items()}
    albedo = passes["diffuse_color"]
    return Light(
        scattered=passes["diffuse_direct"] * albedo,
        albedo=albedo,
        position=passes["position"],
        normal=passes["normal"],
    )


def read_channels(path: Path) -> dict[str, np.ndarray]:
    """All channels (rows, columns) in a file with the passes of a render, by their names."""
    channels = {}
    for part in range(oiio.ImageBuf(str(path)).nsubimages):
        image = oiio.ImageBuf(str(path), part, 0)
        planes = np.moveaxis(image.get_pixels(oiio.FLOAT), -1, 0)
        channels.update(zip(image.spec().channelnames, planes, strict=True))
    return channels


def one_pass(channels: dict[str, np.ndarray], names: tuple[str, ...]) -> np.ndarray:
    """The pass (rows, columns, 3 or 4) that has one of the names in `read_channels`."""
    components = [planes for name, planes in channels.items() if name.split(".")[1] in names]
    return np.stack(components, axis=-1)


def set_file_format(scene: bpy.types.Scene, kind: str, file_format: str) -> None:
    """Set the file format of a scene's renders; Blender 4.5 has no kinds of media."""
    settings = scene.render.image_settings
    if hasattr(settings, "media_type"):
        settings.media_type = kind
    settings.file_format = file_format
    settings.color_depth = "32" if file_format == "OPEN_EXR_MULTILAYER" else "8"


def _render(scene: bpy.types.Scene, frame: int, quality: Quality, path: Path) -> None:
    scene.frame_set(frame)
    scene.cycles.samples = quality.samples
    scene.render.resolution_percentage = quality.percent
    scene.render.filepath = str(path)
    bpy.ops.render.render(write_still=True)
