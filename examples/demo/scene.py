"""The scene: a subject with its mask as a mesh object, camera, lights and backdrop."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from types import MappingProxyType

import bmesh
import bpy
import numpy as np
from mathutils import Vector

from examples.demo import swimsuit
from examples.demo.body import Mesh, read_body

MASK = "sun_mask"
LENS_MILLIMETRES = 120.0
SENSOR_MILLIMETRES = 36.0
SIZE = (540, 720)
# Faces this near to the cloth's edge are cut finely enough to hold it.
FINE_WITHIN = 0.008
FINE_CUTS = 5


@dataclass(frozen=True)
class Lamp:
    """A soft lamp of the same effect on a subject of any size.

    Attributes
    ----------
    turned : float
        Angle in degrees about the vertical from the camera on.
    up : float
        Height as a share of the distance.
    size : float
        Diameter as a share of the picture's height.
    power : float
        What a white surface that faces it would reflect.
    """

    name: str
    turned: float
    up: float
    size: float
    power: float


LAMPS = (Lamp("Key", 45.0, 0.45, 1.3, 1.5), Lamp("Rim", -115.0, 0.35, 0.8, 0.45))


@dataclass(frozen=True)
class Subject:
    """What is in the picture, all in metres.

    Attributes
    ----------
    mesh : Mesh
        Coarse, to be subdivided `levels` times.
    cloth : swimsuit.Field
        What was worn in the sun.
    target : (3,) tuple
        Centre of the picture.
    height : float
        What the picture shows from top to bottom.
    turned : float
        Angle in degrees about the vertical at which the camera stands; 0 is straight behind.
    """

    name: str
    mesh: Mesh
    levels: int
    cloth: swimsuit.Field
    target: tuple[float, float, float]
    height: float
    turned: float


def swimmer(wheel: Path) -> Subject:
    """A body that wore a one-piece swimsuit, from behind."""
    return Subject("Body", read_body(wheel), 2, swimsuit.one_piece, (0.0, 0.0, 1.27), 0.76, 25.0)


def suzanne() -> Subject:
    """Blender's own monkey with a band across her face, a head of 25 cm."""
    bpy.ops.mesh.primitive_monkey_add()
    obj = bpy.context.object
    vertices = 0.125 * np.array([vertex.co[:] for vertex in obj.data.vertices])
    faces = [tuple(face.vertices) for face in obj.data.polygons]
    bpy.data.objects.remove(obj)

    def cloth(points):
        return swimsuit.band(points, 0.012, 0.052)

    return Subject("Suzanne", Mesh(vertices, faces), 3, cloth, (-0.018, 0.0, 0.0), 0.44, 200.0)


def build(subject: Subject, lamps: Sequence[Lamp] = LAMPS) -> bpy.types.Object:
    """As `stage`, with the subject's mask."""
    obj = stage(subject, lamps)
    add_mask(obj.data, subject.cloth)
    return obj


def stage(subject: Subject, lamps: Sequence[Lamp] = LAMPS) -> bpy.types.Object:
    """Fill an empty scene with the subject, camera and light; returns the subject's object."""
    scene = bpy.context.scene
    obj = bpy.data.objects.new(subject.name, subdivided(subject))
    scene.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj

    distance = subject.height * LENS_MILLIMETRES / SENSOR_MILLIMETRES
    camera = bpy.data.cameras.new("Camera")
    camera.lens = LENS_MILLIMETRES
    camera.sensor_fit = "VERTICAL"
    camera.sensor_height = SENSOR_MILLIMETRES
    scene.camera = _placed("Camera", camera, subject, subject.turned, 0.04, distance)
    scene.render.resolution_x, scene.render.resolution_y = SIZE
    for lamp in lamps:
        _light(lamp, subject)
    scene.world = backdrop(light=0.22)
    scene.view_settings.view_transform = "Standard"
    return obj


def subdivided(
    subject: Subject, shares: Mapping[str, np.ndarray] = MappingProxyType({})
) -> bpy.types.Mesh:
    """The subject's mesh by Catmull and Clark, with finer faces where the cloth's edge was.

    `shares` has attributes (V,) of the subject's vertices that the mesh keeps.
    """
    mesh = bpy.data.meshes.new(subject.name)
    mesh.from_pydata(subject.mesh.vertices, [], subject.mesh.faces)
    for name, share in shares.items():
        add_attribute(mesh, name, share)
    obj = bpy.data.objects.new(subject.name, mesh)
    bpy.context.scene.collection.objects.link(obj)
    modifier = obj.modifiers.new("Subdivision", "SUBSURF")
    modifier.levels = subject.levels
    evaluated = obj.evaluated_get(bpy.context.evaluated_depsgraph_get())
    smooth = bpy.data.meshes.new_from_object(evaluated)
    bpy.data.objects.remove(obj)
    bpy.data.meshes.remove(mesh)
    near = np.abs(_edge_distance(smooth, subject.cloth)) < FINE_WITHIN
    fine = bmesh.new()
    fine.from_mesh(smooth)
    edges = [edge for edge in fine.edges if any(near[vertex.index] for vertex in edge.verts)]
    bmesh.ops.subdivide_edges(
        fine, edges=edges, cuts=FINE_CUTS, use_grid_fill=True, smooth=1.0, use_smooth_even=True
    )
    fine.to_mesh(smooth)
    fine.free()
    smooth.shade_smooth()
    return smooth


def add_mask(mesh: bpy.types.Mesh, cloth: swimsuit.Field) -> None:
    """Store the share of the dose that reached each vertex."""
    add_attribute(mesh, MASK, swimsuit.share_of_dose(_edge_distance(mesh, cloth)))


def add_attribute(mesh: bpy.types.Mesh, name: str, values: np.ndarray) -> None:
    """Store numbers (V,) of a mesh's vertices."""
    mesh.attributes.new(name, "FLOAT", "POINT")
    mesh.attributes[name].data.foreach_set("value", values.astype(np.float32))


def make_even(obj: bpy.types.Object) -> None:
    """Take relief and blotches from a tanned object's skin, as the light model has it."""
    for material in filter(None, (slot.material for slot in obj.material_slots)):
        tree = material.node_tree
        for node in list(tree.nodes):
            if "Relief" in node.inputs:
                tree.nodes.remove(node)


def positions_and_normals(mesh: bpy.types.Mesh) -> tuple[np.ndarray, np.ndarray]:
    """Both (V, 3), of a mesh's vertices."""
    arrays = []
    for elements, name in ((mesh.vertices, "co"), (mesh.vertex_normals, "vector")):
        values = np.empty(3 * len(mesh.vertices), np.float32)
        elements.foreach_get(name, values)
        arrays.append(values.reshape(-1, 3).astype(float))
    return arrays[0], arrays[1]


def _edge_distance(mesh: bpy.types.Mesh, cloth: swimsuit.Field) -> np.ndarray:
    return swimsuit.distance_to_edge(cloth, *positions_and_normals(mesh))


def _light(lamp: Lamp, subject: Subject) -> None:
    light = bpy.data.lights.new(lamp.name, "AREA")
    light.shape = "DISK"
    light.size = lamp.size * subject.height
    distance = 2.5 * subject.height
    light.energy = lamp.power * np.pi**2 * distance**2
    _placed(lamp.name, light, subject, subject.turned + lamp.turned, lamp.up, distance)


def _placed(name: str, data, subject: Subject, turned: float, up: float, distance: float):
    """New object that looks at the subject's centre; `up` is its height as a share of distance."""
    obj = bpy.data.objects.new(name, data)
    angle = np.radians(turned)
    away = Vector((np.sin(angle), np.cos(angle), up)).normalized()
    obj.location = Vector(subject.target) + distance * away
    obj.rotation_euler = away.to_track_quat("Z", "Y").to_euler()
    bpy.context.scene.collection.objects.link(obj)
    return obj


def backdrop(light: float) -> bpy.types.World:
    """Even grey light from all around; the camera sees a grey that darkens to the corners."""
    world = bpy.data.worlds.new("Backdrop")
    if world.node_tree is None:
        world.use_nodes = True  # Blender 4.5
    tree = world.node_tree
    tree.nodes.clear()
    node, link = tree.nodes.new, tree.links.new
    place = node("ShaderNodeTexCoord")
    off_centre = node("ShaderNodeVectorMath")
    off_centre.operation = "DISTANCE"
    off_centre.inputs[1].default_value = (0.5, 0.55, 0.0)
    shade = node("ShaderNodeMapRange")
    for name, value in (("From Max", 0.75), ("To Min", 0.32), ("To Max", 0.10)):
        shade.inputs[name].default_value = value
    seen = node("ShaderNodeLightPath")
    strength = node("ShaderNodeMix")
    strength.inputs["A"].default_value = light
    background, output = node("ShaderNodeBackground"), node("ShaderNodeOutputWorld")
    background.inputs["Color"].default_value = (1.0, 1.0, 1.0, 1.0)
    link(place.outputs["Window"], off_centre.inputs[0])
    link(off_centre.outputs["Value"], shade.inputs["Value"])
    link(shade.outputs["Result"], strength.inputs["B"])
    link(seen.outputs["Is Camera Ray"], strength.inputs["Factor"])
    link(strength.outputs["Result"], background.inputs["Strength"])
    link(background.outputs["Background"], output.inputs["Surface"])
    return world
