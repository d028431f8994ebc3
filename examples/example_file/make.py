"""The example's scene: a body that was on a beach for days, then in a garden in other clothes."""

import os
from dataclasses import dataclass, replace
from pathlib import Path

import bmesh
import bpy
import numpy as np

from examples.demo import scene, swimsuit

CLOTH_METRES = 0.003
"""How far clothes lie over the skin."""

LAST_FRAME, LAST_DAY = 120, 40.0

README = """The tan in this file plays without the add-on: press Space.

With it, look at the tab Tan of the sidebar (N). The body was on a beach for twelve days in a
swimsuit, then a day in the garden in a shirt (Gardening, which has a mask of its own): so arms and
neck are a little darker than the back. Both masks come from the clothes in the collection Clothes
by the button From Clothes: show them with their eyes in the outliner. Paint Mask takes up a brush
on a mask; other doses and days show at once. Skin tans as measured in people: lines this plain take
days in the sun, of which none blisters. The thesis' tans are deeper: Skin > Tan.
"""


@dataclass(frozen=True)
class Time:
    """A time in the sun, in tanning doses."""

    name: str
    day: float
    multiple: float


SKIN = "III"
BEACH_DAYS = 12
TIMES = (
    *(Time(f"Beach {day + 1}", float(day), 1.2) for day in range(BEACH_DAYS)),
    Time("Gardening", float(BEACH_DAYS), 2.0),
)
"""All below 4 burn doses, so that nobody blisters; the lines are 10 CIEDE2000, seen from afar."""

LAMPS = (
    scene.Lamp("Key", 55.0, 0.35, 2.2, 1.4),
    scene.Lamp("Rim", -125.0, 0.3, 1.2, 0.3),
)
"""Larger than the demo's, whose gloss would hide lines on the shoulders."""


@dataclass(frozen=True)
class Garment:
    """Clothes that were worn in the sun.

    Attributes
    ----------
    field : swimsuit.Field
        Negative under the cloth.
    colour : tuple of 3 float
        Linear.
    """

    name: str
    field: swimsuit.Field
    colour: tuple[float, float, float]


def shirt(points: np.ndarray) -> np.ndarray:
    """A shirt with short sleeves for the body of `read_body`."""
    x, _, z = points.T
    aside = np.abs(x)
    is_arm = aside > 0.143 + 0.3 * (1.15 - z)
    neck = np.hypot(aside, 2.0 * (z - 1.39)) - 0.085
    return np.maximum(swimsuit.band(points, 0.85, 1.40), np.where(is_arm, 1.16 - z, -neck))


def garments_of(name: str) -> tuple[Garment, Garment]:
    """What a subject of the demo wears, by its name."""
    colours = (0.02, 0.06, 0.25), (0.55, 0.5, 0.42)
    if name == "Body":
        return (
            Garment("Swimsuit", swimsuit.one_piece, colours[0]),
            Garment("Shirt", shirt, colours[1]),
        )
    return (
        Garment("Band", lambda points: swimsuit.band(points, 0.012, 0.052), colours[0]),
        Garment("Scarf", lambda points: swimsuit.band(points, -0.13, -0.05), colours[1]),
    )


def make(subject: scene.Subject, out: Path) -> None:
    """Write a file with a tanned subject of the demo, which the add-on's own buttons have made."""
    shot = bpy.context.scene
    body = scene.stage(framed(subject), LAMPS)
    clothes = bpy.data.collections.new("Clothes")
    shot.collection.children.link(clothes)
    worn = garments_of(subject.name)
    for garment in worn:
        clothes.objects.link(sewn(body, garment))
    settings = body.skin_tan
    shot.frame_end, settings.last_day = LAST_FRAME, LAST_DAY
    settings.skin = SKIN
    for time in TIMES:
        bpy.ops.skin_tan.add_exposure(name=time.name, day=time.day)
        exposure = settings.exposures[-1]
        exposure.unit, exposure.multiple = "MMD", time.multiple
    for garment, target in zip(worn, ("OBJECT", "EXPOSURE"), strict=True):
        bpy.ops.skin_tan.mask_from_clothes(
            garments=[{"name": garment.name}], target=target, name=f"{garment.name} Mask"
        )
    for cloth in clothes.objects:
        cloth.hide_render = True
        cloth.hide_set(True)
    bpy.ops.skin_tan.apply()
    bpy.ops.skin_tan.go_to_darkest_day()
    shot.cycles.samples, shot.cycles.use_denoising = 128, True
    bpy.data.texts.new("Read Me").write(README)
    look_through_camera()
    out.parent.mkdir(parents=True, exist_ok=True)
    unfinished = out.with_suffix(".unfinished.blend")
    bpy.ops.wm.save_as_mainfile(filepath=str(unfinished.resolve()), compress=True, copy=True)
    os.replace(unfinished, out)


def framed(subject: scene.Subject) -> scene.Subject:
    """A body's picture from the neck to the waist, where its lines are; others as they are."""
    if subject.name != "Body":
        return subject
    return replace(subject, target=(0.0, 0.0, 1.17), height=0.6)


def sewn(body: bpy.types.Object, garment: Garment) -> bpy.types.Object:
    """A garment as an object: the body's faces under the cloth, up to its edge and off the skin."""
    points, normals = scene.positions_and_normals(body.data)
    inside = garment.field(points) < 0.0
    mesh = body.data.copy()
    mesh.name = garment.name
    points = np.where(inside[:, None], points, to_edge(garment.field, points))
    mesh.vertices.foreach_set("co", (points + CLOTH_METRES * normals).astype(np.float32).ravel())
    cut = bmesh.new()
    cut.from_mesh(mesh)
    bare = [face for face in cut.faces if not any(inside[v.index] for v in face.verts)]
    bmesh.ops.delete(cut, geom=bare, context="FACES")
    cut.to_mesh(mesh)
    cut.free()
    material = bpy.data.materials.new(garment.name)
    if material.node_tree is None:
        material.use_nodes = True
    shader = material.node_tree.nodes["Principled BSDF"]
    shader.inputs["Base Color"].default_value = (*garment.colour, 1.0)
    shader.inputs["Roughness"].default_value = 0.8
    mesh.materials.append(material)
    return bpy.data.objects.new(garment.name, mesh)


def to_edge(field: swimsuit.Field, points: np.ndarray) -> np.ndarray:
    """Points (N, 3) moved to where a field is 0, by two of Newton's steps."""
    step = 1e-4
    for _ in range(2):
        slope = np.stack(
            [(field(points + step * a) - field(points - step * a)) / (2 * step) for a in np.eye(3)],
            axis=1,
        )
        steepness = np.maximum((slope**2).sum(axis=1), 0.1)
        points = points - (field(points) / steepness)[:, None] * slope
    return points


def look_through_camera() -> None:
    """Have viewports show the picture with its materials."""
    for screen in bpy.data.screens:
        for area in screen.areas:
            if area.type == "VIEW_3D":
                area.spaces.active.shading.type = "MATERIAL"
                area.spaces.active.region_3d.view_perspective = "CAMERA"
