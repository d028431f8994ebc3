"""One tanned body in Blender, and pictures of its places in some light."""

from collections.abc import Iterator, Mapping
from pathlib import Path

import bpy
import numpy as np
import OpenImageIO as oiio  # noqa: N813
from mathutils import Vector

from examples.demo import render, scene
from examples.gallery import shots

LAMP_DISTANCE = 1.0


def tanned(
    subject: scene.Subject, regions: Mapping[str, np.ndarray], skin: str, sun: tuple[str, float]
) -> bpy.types.Object:
    """The subject in an empty scene, after days in the sun, with a new material's own look.

    `regions` has, by their kinds, how far the subject's vertices (V,) lie in them; `sun` the unit
    and the amount of a day's sun.
    """
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    shown = bpy.context.scene
    obj = bpy.data.objects.new(subject.name, scene.subdivided(subject, regions))
    shown.collection.objects.link(obj)
    bpy.context.view_layer.objects.active = obj
    scene.add_mask(obj.data, subject.cloth)
    settings = obj.skin_tan
    settings.skin, settings.mask_attribute = skin, scene.MASK
    for kind in regions:
        region = settings.regions.add()
        region.kind, region.mask.source = kind, kind
    for day in range(shots.SUNNY_DAYS):
        exposure = settings.exposures.add()
        exposure.day = day
        exposure.unit, amount = sun
        setattr(exposure, "dose" if exposure.unit == "SED" else "multiple", amount)
    settings.first_day, settings.last_day = 0.0, shots.LAST_DAY
    settings.first_frame, settings.last_frame = 0, shots.LAST_DAY
    bpy.ops.skin_tan.apply()
    return obj


def pictures(samples: int, size: int, scratch: Path) -> Iterator[tuple[str, str, str, np.ndarray]]:
    """Place, distance and light of all pictures of the object in the scene, and their pixels."""
    _prepare(size)
    for name, light in shots.LIGHTS.items():
        for place in shots.PLACES:
            for far, metres in shots.DISTANCES.items():
                _set_up(place, metres, light)
                yield place.name, far, name, _picture(shots.SHOWN_DAY, samples, scratch)


def portraits(samples: int, size: int, scratch: Path) -> Iterator[tuple[int, np.ndarray]]:
    """Days, and portraits of the object in the scene on them."""
    _prepare(round(size * shots.PORTRAIT_SIZE))
    _set_up(shots.PORTRAIT, shots.PORTRAIT_DISTANCE, shots.PORTRAIT_LIGHT)
    for day in shots.WEEK_DAYS:
        yield day, _picture(day, samples, scratch)


def _prepare(size: int) -> None:
    shown = bpy.context.scene
    render.prepare(shown)
    shown.cycles.max_bounces = 4  # light between fingers, and between nose and cheek
    shown.render.resolution_x = shown.render.resolution_y = size
    shown.view_settings.view_transform = "Standard"


def _set_up(place: shots.Place, metres: float, light: shots.Light) -> None:
    for obj in [item for item in bpy.data.objects if item.type in ("CAMERA", "LIGHT")]:
        bpy.data.objects.remove(obj)
    _aim(place, metres)
    for lamp in light.lamps:
        _light(place, lamp)
    bpy.context.scene.world = scene.backdrop(light=light.around)


def _picture(day: int, samples: int, scratch: Path) -> np.ndarray:
    """A day's picture (rows, columns, 3), sRGB from 0 to 1."""
    render.picture(bpy.context.scene, day, render.Quality(samples, 100, "HIGH"), scratch)
    return oiio.ImageBuf(str(scratch)).get_pixels(oiio.FLOAT)[..., :3]


def _aim(place: shots.Place, metres: float) -> None:
    camera = bpy.data.cameras.new("Camera")
    camera.lens, camera.clip_start = shots.LENS, 0.01
    camera.sensor_fit, camera.sensor_height = "VERTICAL", shots.SENSOR
    away = Vector(place.away).normalized()
    bpy.context.scene.camera = _placed(camera, place, away, metres)


def _light(place: shots.Place, lamp: shots.Lamp) -> None:
    light = bpy.data.lights.new("Lamp", "AREA")
    light.shape, light.size = "DISK", lamp.size
    light.energy = lamp.power * np.pi**2 * LAMP_DISTANCE**2
    x, y, _ = place.away
    angle, up = np.arctan2(y, x) + np.radians(lamp.turned), np.radians(lamp.up)
    away = Vector((np.cos(angle) * np.cos(up), np.sin(angle) * np.cos(up), np.sin(up)))
    _placed(light, place, away, LAMP_DISTANCE)


def _placed(data, place: shots.Place, away: Vector, metres: float) -> bpy.types.Object:
    obj = bpy.data.objects.new(data.name, data)
    obj.location = Vector(place.target) + metres * away
    obj.rotation_euler = away.to_track_quat("Z", "Y").to_euler()
    bpy.context.scene.collection.objects.link(obj)
    return obj
