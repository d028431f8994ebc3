"""Pieces of skin with their lights and cameras, built in Blender; lengths in metres."""

from collections.abc import Callable

import bpy
import numpy as np
from mathutils import Vector

from examples.truth.shots import Shot

SIDE = 1.0
"""Of the skin on most stages: far more than light travels in it."""

WIDTH, EDGE_WIDTH = 0.01, 0.02
"""Of the picture, and of that of a lit edge."""

WIDE = 200.0
"""Side of the skin under a camera that sees all directions, a metre above it."""

WHITE = np.pi
"""Irradiance under which a white diffuser has radiance 1."""


def white(shot: Shot) -> bpy.types.Object:
    """Skin under even white light from everywhere, seen at an angle."""
    skin = _box(shot, SIDE, SIDE)
    _camera(shot, WIDTH, shot.angle)
    _world(1.0)
    return skin


def lobe(shot: Shot) -> bpy.types.Object:
    """Skin under a distant lamp at an angle, seen by a camera that sees every direction."""
    skin = _box(shot, WIDE, WIDE)
    camera = _camera(shot, WIDTH, 0.0)
    camera.location = (0.0, 0.0, 1.0)
    camera.data.type = "PANO"
    owner = camera.data if hasattr(camera.data, "panorama_type") else camera.data.cycles
    owner.panorama_type, owner.fisheye_fov = "FISHEYE_EQUIDISTANT", np.pi
    camera.data.clip_end = 1e5
    _lamp(shot.angle)
    return skin


def edge(shot: Shot) -> bpy.types.Object:
    """Skin under a lamp straight above, of which a sharp screen covers x < 0."""
    skin = _box(shot, SIDE, SIDE)
    _camera(shot, EDGE_WIDTH, 0.0)
    _lamp(0.0)
    screen = _screen(shot.unit)
    for ray in ("camera", "diffuse", "glossy", "transmission"):
        setattr(screen, f"visible_{ray}", False)
    return skin


def slab(shot: Shot) -> bpy.types.Object:
    """A slab of skin, lit from behind by a distant lamp."""
    skin = _box(shot, 0.2, 0.001 * shot.thickness)
    _camera(shot, WIDTH, 0.0)
    _lamp(180.0)
    return skin


def ball(shot: Shot) -> bpy.types.Object:
    """A ball of skin of 10 cm that fills the picture, under a lamp and weak light from around."""
    bpy.ops.mesh.primitive_uv_sphere_add(segments=64, ring_count=32, radius=0.05)
    skin = bpy.context.object
    bpy.ops.object.shade_smooth()
    _camera(shot, 0.08, 30.0)
    _lamp(60.0)
    _world(0.2)
    return skin


def plain_material() -> bpy.types.Material:
    """A single Principled BSDF with subsurface like a light skin's."""
    material = bpy.data.materials.new("Plain")
    if material.node_tree is None:
        material.use_nodes = True  # Blender 4.5
    shader = material.node_tree.nodes["Principled BSDF"]
    shader.subsurface_method = "BURLEY"
    values = {
        "Base Color": (0.4, 0.26, 0.18, 1.0),
        "Roughness": 0.316,
        "IOR": 1.5526,
        "Subsurface Weight": 1.0,
        "Subsurface Radius": (24.0, 16.0, 13.0),
        "Subsurface Scale": 0.001,
    }
    for name, value in values.items():
        shader.inputs[name].default_value = value
    return material


STAGES: dict[str, Callable[[Shot], bpy.types.Object]] = {
    "white": white,
    "lobe": lobe,
    "edge": edge,
    "slab": slab,
    "ball": ball,
}


def _box(shot: Shot, side: float, depth: float) -> bpy.types.Object:
    """A box whose upper face, at z = 0, is in the middle of the stage."""
    half = 0.5 * side
    corners = [(x, y, z) for z in (-depth, 0.0) for y in (-half, half) for x in (-half, half)]
    faces = [(0, 2, 3, 1), (4, 5, 7, 6), (0, 1, 5, 4), (2, 6, 7, 3), (0, 4, 6, 2), (1, 3, 7, 5)]
    mesh = bpy.data.meshes.new("Skin")
    mesh.from_pydata((np.array(corners) / (shot.unit * shot.scale)).tolist(), [], faces)
    return _linked("Skin", mesh, scale=shot.scale)


def _screen(unit: float) -> bpy.types.Object:
    """A plane over the half of the stage where x is negative."""
    corners = [(x, y, 0.3) for x, y in ((-SIDE, -SIDE), (0.0, -SIDE), (0.0, SIDE), (-SIDE, SIDE))]
    mesh = bpy.data.meshes.new("Screen")
    mesh.from_pydata((np.array(corners) / unit).tolist(), [], [(0, 1, 2, 3)])
    return _linked("Screen", mesh)


def _camera(shot: Shot, width: float, angle: float) -> bpy.types.Object:
    """A camera without perspective that looks at the stage's middle."""
    data = bpy.data.cameras.new("Camera")
    data.type, data.ortho_scale = "ORTHO", width / shot.unit
    data.clip_start, data.clip_end = 0.001 / shot.unit, 1000.0 / shot.unit
    camera = _looking_down("Camera", data, angle, 0.2 / shot.unit)
    bpy.context.scene.camera = camera
    return camera


def _lamp(angle: float) -> None:
    data = bpy.data.lights.new("Lamp", "SUN")
    data.angle, data.energy = 0.0, WHITE
    _looking_down("Lamp", data, angle, 1.0)


def _looking_down(name: str, data, angle: float, distance: float) -> bpy.types.Object:
    """An object so far from the origin, which it looks at from the side of negative x."""
    radians = np.radians(angle)
    away = Vector((-np.sin(radians), 0.0, np.cos(radians)))
    obj = _linked(name, data)
    obj.location = distance * away
    obj.rotation_euler = away.to_track_quat("Z", "Y").to_euler()
    return obj


def _world(strength: float) -> None:
    """Even light; only rays that happen to leave see it, so that it brings no noise."""
    world = bpy.data.worlds.new("World")
    if world.node_tree is None:
        world.use_nodes = True  # Blender 4.5
    inputs = world.node_tree.nodes["Background"].inputs
    inputs["Color"].default_value, inputs["Strength"].default_value = (1.0,) * 4, strength
    world.cycles.sampling_method = "NONE"
    bpy.context.scene.world = world


def _linked(name: str, data, scale: float = 1.0) -> bpy.types.Object:
    obj = bpy.data.objects.new(name, data)
    obj.scale = (scale,) * 3
    bpy.context.scene.collection.objects.link(obj)
    return obj
