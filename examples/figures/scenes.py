"""Renders the shots of figures 6.24 to 6.29, each into a file NAME.npz, in a process of its own.

`python -m examples.figures.scenes FOLDER [--scale S] [--samples N] [--stand-in] NAME...`; FOLDER
has the tables. Blender 4.5 hangs in an ordinary exit after a render, so this one is not ordinary.
"""

import argparse
import os
import sys
from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass, replace
from pathlib import Path

import bpy
import numpy as np

import blender_addon
from blender_addon.apply import apply_tan
from examples.demo import __main__ as demo
from examples.demo import render, scene, swimsuit
from examples.demo.body import EYES_CLOSED, BodyUnavailableError, fetch_wheel, read_body
from examples.figures import shots
from examples.figures.shots import LAST_DAY, Schedule, Shot
from hylios.commands.shell import run
from hylios.lab.colour import srgb

FRAMES_PER_DAY = 4
SUNSCREEN_ROUGHNESS, SUNSCREEN_SPECULAR = 0.30, 0.65
SKIN_ROUGHNESS, SKIN_SPECULAR = 0.45, 0.5
CLEAR_OF_EDGE = 0.006
"""Metres from the edge of a patch from which on its colour is read."""

FACING = 0.6
"""Cosine of the angle from the skin's normal to the camera, from which on its colour is read."""

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
    """

    subject: scene.Subject
    lamps: Sequence[scene.Lamp]
    part: Callable[[np.ndarray], np.ndarray]
    parts: int
    centre: tuple[float, float, float]
    reach: float
    capped: bool = False


# ---------------------------------------------------------------- where the sun gets

PATCH_HEIGHTS = (0.072, 0.0, -0.072)
"""Of the three patches' centres over the middle one's, in metres."""
PATCH_HALF, PATCH_CORNER = 0.024, 0.008
SUN_RADIUS, RAY_FROM, RAY_TO, RAY_WIDTH, RAYS = 0.034, 0.048, 0.074, 0.011, 12


def square_patches(across: np.ndarray, up: np.ndarray) -> np.ndarray:
    """Positive (N,) in three patches with rounded corners, one over the other; metres."""
    return np.maximum.reduce([_patch(across, up - height) for height in PATCH_HEIGHTS])


def nearest_patch(up: np.ndarray) -> np.ndarray:
    """Number (N,) of the patch at each height over the middle one's centre."""
    return np.argmin(np.abs(up[:, None] - np.array(PATCH_HEIGHTS)), axis=1)


def _patch(across: np.ndarray, up: np.ndarray) -> np.ndarray:
    beyond = np.abs(np.stack([across, up])) - (PATCH_HALF - PATCH_CORNER)
    outside = np.hypot(*np.maximum(beyond, 0.0))
    return PATCH_CORNER - outside - np.minimum(beyond.max(axis=0), 0.0)


def sun_sign(across: np.ndarray, up: np.ndarray) -> np.ndarray:
    """Negative (N,) on a disk with rays around it, painted with sunscreen; metres."""
    radius, angle = np.hypot(across, up), np.arctan2(up, across)
    step = 2.0 * np.pi / RAYS
    off = (angle + 0.5 * step) % step - 0.5 * step
    along = np.clip(radius * np.cos(off), RAY_FROM, RAY_TO)
    ray = np.hypot(radius * np.cos(off) - along, radius * np.sin(off)) - 0.5 * RAY_WIDTH
    return np.minimum(radius - SUN_RADIUS, ray)


@dataclass(frozen=True)
class Place:
    """Where on a subject a figure is drawn, and how large; `facing` is the sign of y there."""

    origin: tuple[float, float, float]
    scale: float = 1.0
    facing: float = 1.0

    def local(self, points: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
        """Points (N, 3) as metres to the right and up from the place, in the figure's own size."""
        across, _, up = (points - np.array(self.origin)).T / self.scale
        return across, up

    def on_this_side(self, points: np.ndarray) -> np.ndarray:
        """Positive (N,) on the side of the subject that the figure is on."""
        return self.facing * (points[:, 1] - self.origin[1])


def patches_at(place: Place) -> swimsuit.Field:
    """Sun in three patches only."""

    def field(points: np.ndarray) -> np.ndarray:
        return np.minimum(
            place.scale * square_patches(*place.local(points)), place.on_this_side(points)
        )

    return field


def sunscreen_at(place: Place) -> swimsuit.Field:
    """Sun everywhere but on a sun painted with sunscreen."""

    def field(points: np.ndarray) -> np.ndarray:
        return np.maximum(place.scale * sun_sign(*place.local(points)), -place.on_this_side(points))

    return field


def half(points: np.ndarray) -> np.ndarray:
    """Sun on the side of positive x only."""
    return points[:, 0]


def whole(points: np.ndarray) -> np.ndarray:
    """All points belong to one part."""
    return np.zeros(len(points), int)


# ---------------------------------------------------------------- stages


def stages(wheel: Path | None) -> dict[str, Stage]:
    """The stages with the body in a wheel, or with Suzanne where there is none."""
    return _with_body(wheel) if wheel is not None else _with_suzanne()


def _with_body(wheel: Path) -> dict[str, Stage]:
    body = read_body(wheel)
    resting = read_body(wheel, EYES_CLOSED)
    squares, sun = Place((0.055, 0.0, 1.195)), Place((0.0, 0.0, 1.215))

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
    squares, sun = Place((0.042, 0.0, 0.045), 0.55), Place((0.0, 0.0, 0.04), 0.7)
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


def built(stage: Stage) -> bpy.types.Object:
    """Fill an empty scene with a stage; returns what tans."""
    bpy.ops.wm.read_factory_settings(use_empty=True)
    obj = scene.build(stage.subject, stage.lamps)
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


# ---------------------------------------------------------------- tans


def tan(obj: bpy.types.Object, table: Path, schedules: Sequence[Schedule]) -> None:
    """Give each part of an object the tan of its schedule, as the add-on's Apply does.

    Apply gives an object one tan. The further ones are applied to objects that share the mesh,
    whose materials the mesh's further slots take.
    """
    for number, schedule in enumerate(schedules):
        tanned = obj if number == 0 else bpy.data.objects.new(f"{obj.name} {number}", obj.data)
        settings = tanned.skin_tan
        settings.skin, settings.table_path = "FILE", str(table.resolve())
        settings.mask_attribute = scene.MASK
        settings.exposures.clear()
        for day, dose in schedule:
            exposure = settings.exposures.add()
            exposure.day, exposure.dose = day, dose
        settings.first_day, settings.last_day = 0.0, LAST_DAY
        settings.first_frame, settings.last_frame = frame_of(0.0), frame_of(LAST_DAY)
        apply_tan(tanned, bpy.context.scene)
        if number:
            material = tanned.skin_tan.material
            bpy.data.objects.remove(tanned)
            obj.data.materials[number] = material


def frame_of(day: float) -> int:
    """Frame of the timeline that shows a day."""
    return 1 + round(FRAMES_PER_DAY * day)


def set_gloss(material: bpy.types.Material, *, sunscreen: bool) -> None:
    """Have skin that the sun does not reach shine as sunscreen does, or as skin."""
    tree = material.node_tree
    skin = next(node for node in tree.nodes if node.type == "GROUP")
    for node in [node for node in tree.nodes if node.label == "Sunscreen"]:
        tree.nodes.remove(node)
    if not sunscreen:
        return
    share = tree.nodes.new("ShaderNodeAttribute")
    share.attribute_name, share.label = scene.MASK, "Sunscreen"
    for name, covered, bare in (
        ("Roughness", SUNSCREEN_ROUGHNESS, SKIN_ROUGHNESS),
        ("Specular", SUNSCREEN_SPECULAR, SKIN_SPECULAR),
    ):
        mixed = tree.nodes.new("ShaderNodeMapRange")
        mixed.label = "Sunscreen"
        mixed.inputs["To Min"].default_value = covered
        mixed.inputs["To Max"].default_value = bare
        tree.links.new(share.outputs["Fac"], mixed.inputs["Value"])
        tree.links.new(mixed.outputs["Result"], skin.inputs[name])


# ---------------------------------------------------------------- pictures and readings


@dataclass(frozen=True)
class Taken:
    """A rendered shot: linear Rec.709 (rows, columns, 3) and the light in it."""

    picture: np.ndarray
    light: render.Light


def take(shot: Shot, quality: render.Quality, scratch: Path) -> Taken:
    """Render a shot of the stage that is built; `scratch` is a file to use."""
    shown = bpy.context.scene
    render.passes(shown, frame_of(shot.day), quality, scratch, shot.window, denoised=True)
    combined = render.one_pass(render.read_channels(scratch), ("Combined",))
    return Taken(combined[..., :3], render.read_light(scratch))


def sun_distance(white: render.Light, stage: Stage, camera: np.ndarray) -> np.ndarray:
    """Metres (rows, columns) to the edge of what the sun reaches, negative where it does not.

    Not a number beyond the stage's reach and where the skin turns away from a camera at (3,).
    """
    view = camera - white.position
    view /= np.linalg.norm(view, axis=-1, keepdims=True)
    seen = np.sum(view * white.normal, axis=-1) > FACING
    seen &= np.linalg.norm(white.position - np.array(stage.centre), axis=-1) < stage.reach
    points, normals = (each[seen].astype(float) for each in (white.position, white.normal))
    distance = np.full(seen.shape, np.nan)
    distance[seen] = swimsuit.distance_to_edge(stage.subject.cloth, points, normals)
    return distance


def regions(white: render.Light, distance: np.ndarray, stage: Stage) -> list[np.ndarray]:
    """Pixels (parts + 1, rows, columns) of each part in the sun, then of covered skin.

    Well lit, and well away from the edge between them.
    """
    seen = np.isfinite(distance)
    part = np.zeros(seen.shape, int)
    part[seen] = stage.part(white.position[seen].astype(float))
    bright = white.scattered.mean(axis=-1)
    lit = seen & (bright > 0.5 * np.median(bright[seen])) if seen.any() else seen
    sunned = [lit & (part == each) & (distance > CLEAR_OF_EDGE) for each in range(stage.parts)]
    return [*sunned, lit & (distance < -CLEAR_OF_EDGE)]


def readings(light: render.Light, white: render.Light, where: Sequence[np.ndarray]) -> np.ndarray:
    """Mean light out of the skin as a share of a white diffuser's, linear Rec.709 (regions, 3).

    Not a number where nothing of a region is in the picture.
    """
    return np.array(
        [
            light.scattered[each].mean(axis=0) / white.scattered[each].mean(axis=0)
            if each.any()
            else np.full(3, np.nan)
            for each in where
        ]
    )


def shine(taken: Taken, where: Sequence[np.ndarray]) -> np.ndarray:
    """What the surface reflects in the brightest hundredth of each region (regions,)."""
    reflected = (taken.picture - taken.light.scattered).mean(axis=-1)
    return np.array(
        [np.percentile(reflected[each], 99.0) if each.any() else np.nan for each in where]
    )


def shoot(
    wanted: Sequence[Shot], found: Mapping[str, Stage], folder: Path, scale: float, samples: int
) -> Iterator[str]:
    """Render shots into FOLDER/NAME.npz, and give each name once its file is there."""
    scratch = folder / "scratch.exr"
    standing, obj = None, None
    whites: dict[tuple, render.Light] = {}
    for shot in wanted:
        stage = found[shot.stage]
        quality = render.Quality(samples, max(1, round(scale * shot.percent)), "HIGH")
        if standing != (shot.stage, shot.table, shot.schedules):
            # A new scene even for a new tan only: with persistent data Cycles may render a former
            # image in place of the one that has replaced it.
            obj = built(stage)
            tan(obj, folder / f"{shot.table}.exr", shot.schedules)
            standing = (shot.stage, shot.table, shot.schedules)
        for slot in obj.material_slots:
            set_gloss(slot.material, sunscreen=shot.gloss)
        view = (shot.stage, shot.window, shot.percent)
        if view not in whites:
            with render.white(obj):
                frame = frame_of(shot.day)
                whites[view] = render.light(bpy.context.scene, frame, quality, scratch, shot.window)
        taken = take(shot, quality, scratch)
        camera = np.array(bpy.context.scene.camera.location)
        distance = sun_distance(whites[view], stage, camera)
        where = regions(whites[view], distance, stage)
        np.savez(
            folder / f"{shot.name}.npz",
            picture=srgb(taken.picture).astype(np.float32),
            readings=readings(taken.light, whites[view], where),
            shine=shine(taken, where),
            sun_distance=distance,
            subject=stage.subject.name,
        )
        yield shot.name
    scratch.unlink(missing_ok=True)


def main(asked: argparse.Namespace) -> None:
    """Render what is asked for, and print the name of each shot when it is done."""
    found = stages(None if asked.stand_in else body_wheel())
    blender_addon.register()
    wanted = shots.named(asked.names)
    for name in shoot(wanted, found, asked.folder, asked.scale, asked.samples):
        print(f"{shots.DONE}{name}")


def body_wheel() -> Path | None:
    """The wheel with the body, or None where it cannot be had."""
    try:
        return fetch_wheel(demo.OUT / ".cache")
    except BodyUnavailableError as error:
        print(f"{error} Blender's Suzanne stands in for the body.", file=sys.stderr)
        return None


def arguments() -> argparse.ArgumentParser:
    """What the command understands."""
    parser = argparse.ArgumentParser(prog="python -m examples.figures.scenes", description=__doc__)
    parser.add_argument("folder", type=Path)
    parser.add_argument("names", nargs="+")
    parser.add_argument("--scale", type=float, default=1.0)
    parser.add_argument("--samples", type=int, default=20)
    parser.add_argument("--stand-in", action="store_true")
    return parser


if __name__ == "__main__":
    demo.silence_blender()
    os._exit(run(main, arguments().parse_args()))
