"""Subjects, lamps and cameras of figures 6.24 to 6.29, built in Blender."""

from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import bpy
import numpy as np

from examples.demo import render, scene, swimsuit
from examples.demo.body import EYES_CLOSED, read_body
from examples.figures.sun_fields import (
    Placement,
    half,
    nearest_patch,
    patches_at,
    sunscreen_at,
    whole,
)

CAP_COLOUR = (0.010, 0.022, 0.050, 1.0)
CAP_THICKNESS = 0.0022
CAP_EDGE = ((0.0, -0.11, 1.562), (0.0, 0.09, 1.478))
"""Two points of the plane that the cap of the body ends at."""

EVEN = (
    scene.Lamp("Left", 38.0, 0.40, 1.1, 0.95),
    scene.Lamp("Right", -38.0, 0.40, 1.1, 0.95),
)
RAKING = (scene.Lamp("Key", 40.0, 0.45, 1.3, 1.35), scene.Lamp("Rim", -80.0, 0.35, 1.0, 0.55))


@dataclass(frozen=True)
class Stage:
    """A subject in its light.

    Attributes
    ----------
    subject : scene.Subject
        Its cloth is where the sun does not get: the field is positive in the sun.
    lamps : sequence of Lamp
    part : callable
        Number (N,) of the part of the subject that each point (N, 3) belongs to.
    parts : int
    centre, reach
        Colours are read within `reach` of `centre`, in metres.
    capped : bool
        Whether she wears a swim cap.
    dim : float, optional
        Even light from all around, where it is not the usual.
    """

    subject: scene.Subject
    lamps: Sequence[scene.Lamp]
    part: Callable[[np.ndarray], np.ndarray]
    parts: int
    centre: tuple[float, float, float]
    reach: float
    capped: bool = False
    dim: float | None = None


def stages(wheel: Path | None) -> dict[str, Stage]:
    """The stages with the body in a wheel, or with Suzanne where there is none."""
    return _with_body(wheel) if wheel is not None else _with_suzanne()


def _with_body(wheel: Path) -> dict[str, Stage]:
    body = read_body(wheel)
    resting = read_body(wheel, EYES_CLOSED)
    squares, sun = Placement((0.055, 0.0, 1.195)), Placement((0.0, 0.0, 1.215))

    def part(points: np.ndarray) -> np.ndarray:
        return nearest_patch(squares.local(points)[1])

    def subject(name, mesh, field, target, height, turned):
        return scene.Subject(name, mesh, 2, field, target, height, turned)

    return {
        "patches": Stage(
            subject("Back", body, patches_at(squares), (0.0, 0.0, 1.19), 0.46, 8.0),
            RAKING,
            part,
            3,
            (0.055, 0.1, 1.195),
            0.13,
        ),
        "sunscreen": Stage(
            subject("Back", body, sunscreen_at(sun), (0.0, 0.0, 1.19), 0.46, 8.0),
            RAKING,
            whole,
            1,
            (0.0, 0.1, 1.215),
            0.12,
        ),
        "face": Stage(
            subject("Face", resting, half, (0.0, -0.02, 1.505), 0.30, 180.0),
            EVEN,
            whole,
            1,
            (0.0, -0.1, 1.48),
            0.075,
            capped=True,
        ),
        "swimmer": Stage(
            replace(scene.swimmer(wheel), target=(0.0, 0.0, 1.21), height=0.60),
            scene.LAMPS,
            whole,
            1,
            (0.0, 0.1, 1.03),
            0.15,
        ),
    }


def _with_suzanne() -> dict[str, Stage]:
    squares, sun = Placement((0.042, 0.0, 0.045), 0.55), Placement((0.0, 0.0, 0.04), 0.7)
    monkey = scene.suzanne()

    def part(points: np.ndarray) -> np.ndarray:
        return nearest_patch(squares.local(points)[1])

    def seen(field: swimsuit.Field, turned: float) -> scene.Subject:
        return scene.Subject("Suzanne", monkey.mesh, 3, field, (0.0, 0.0, 0.0), 0.36, turned)

    centre, face = (0.02, 0.08, 0.03), (0.0, -0.1, 0.0)
    return {
        "patches": Stage(seen(patches_at(squares), 8.0), RAKING, part, 3, centre, 0.12),
        "sunscreen": Stage(seen(sunscreen_at(sun), 8.0), RAKING, whole, 1, centre, 0.12),
        "face": Stage(seen(half, 180.0), EVEN, whole, 1, face, 0.1),
        "swimmer": Stage(monkey, scene.LAMPS, whole, 1, face, 0.1),
    }


BEHIND = (
    scene.Lamp("Behind", 142.0, 0.25, 0.35, 5.0),
    scene.Lamp("Side", -105.0, 0.30, 0.5, 0.9),
)
HIGH = (scene.Lamp("Sun", 25.0, 1.6, 0.25, 2.0), scene.Lamp("Sky", -30.0, 0.8, 2.5, 0.35))


def spectral_stages(wheel: Path | None) -> dict[str, Stage]:
    """Stages of figures 6.9 to 6.12, 6.19 and 6.20: the face in two lights, and a back outdoors."""
    usual = stages(wheel)
    face, back = usual["face"], usual["sunscreen"]
    on_shoulder = Placement((0.085, 0.0, 1.29), 0.62)
    if wheel is None:
        on_shoulder = Placement((0.04, 0.0, 0.04), 0.4)
    outdoors = replace(back.subject, cloth=sunscreen_at(on_shoulder))
    if wheel is not None:
        outdoors = replace(outdoors, target=(0.02, 0.0, 1.27), height=0.36)
    return {
        "face": replace(face, lamps=RAKING),
        "lit from behind": replace(face, lamps=BEHIND, dim=0.03),
        "beach": replace(back, subject=outdoors, lamps=HIGH, reach=0.2),
    }


def built(stage: Stage) -> bpy.types.Object:
    """Fill an empty scene with a stage; returns what tans."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    obj = scene.build(stage.subject, stage.lamps)
    if stage.dim is not None:
        bpy.context.scene.world = scene.backdrop(light=stage.dim)
    for _ in range(stage.parts):
        obj.data.materials.append(None)
    obj.data.polygons.foreach_set("material_index", _parts_of_faces(obj.data, stage))
    if stage.capped:
        swim_cap(obj.data)
    render.prepare(bpy.context.scene)
    return obj


def _parts_of_faces(mesh: bpy.types.Mesh, stage: Stage) -> np.ndarray:
    centres = np.empty(3 * len(mesh.polygons), np.float32)
    mesh.polygons.foreach_get("center", centres)
    return stage.part(centres.reshape(-1, 3).astype(float)).astype(np.int32)


def swim_cap(body: bpy.types.Mesh) -> None:
    """Put a cap over the body's head: its skin above `CAP_EDGE`, a little further out."""
    import bmesh  # a part of bpy, there once bpy is

    front, back = np.array(CAP_EDGE)
    normal = np.cross((1.0, 0.0, 0.0), back - front)
    cap = bmesh.new()
    cap.from_mesh(body)
    geometry = [*cap.verts, *cap.edges, *cap.faces]
    bmesh.ops.bisect_plane(
        cap, geom=geometry, plane_co=front, plane_no=normal * np.sign(normal[2]), clear_inner=True
    )
    cap.normal_update()
    for vertex in cap.verts:
        vertex.co += CAP_THICKNESS * vertex.normal
    mesh = bpy.data.meshes.new("Cap")
    cap.to_mesh(mesh)
    cap.free()
    mesh.materials.clear()
    mesh.materials.append(_cap_material())
    mesh.polygons.foreach_set("material_index", np.zeros(len(mesh.polygons), np.int32))
    obj = bpy.data.objects.new("Cap", mesh)
    bpy.context.scene.collection.objects.link(obj)
    rim = obj.modifiers.new("Rim", "SOLIDIFY")
    rim.thickness, rim.offset = CAP_THICKNESS, -1.0


def _cap_material() -> bpy.types.Material:
    material = bpy.data.materials.new("Cap")
    if material.node_tree is None:
        material.use_nodes = True  # Blender 4.5
    shader = material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = CAP_COLOUR
    shader.inputs["Roughness"].default_value = 0.35
    return material
