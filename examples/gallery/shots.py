"""What the gallery shows: places, distances, lights and skins. Needs no Blender."""

from dataclasses import dataclass

SKINS = ("I", "III", "VI")

SUNNY_DAYS = 7

ALIKE, SAME_SUN = ("MMD", 1.0), ("SED", 6.0)
"""Unit and amount of sun of a day: minimal tanning doses, so that all skins tan alike, or the sun
of an hour or two at noon."""

SHOWN_DAY, LAST_DAY = 8, 30

WEEK_SKINS, WEEK_DAYS = ("II", "IV", "VI"), (0, 1, 3, 8, 14, 30)
"""Skins and days of the sheet on which skin burns, tans and fades."""

Vector = tuple[float, float, float]


@dataclass(frozen=True)
class Place:
    """A part of the body of `examples.demo.body`, in metres.

    Attributes
    ----------
    target : Vector
        Centre of the picture.
    away : Vector
        Direction from there to the camera.
    """

    name: str
    target: Vector
    away: Vector


PLACES = (
    Place("face", (0.012, -0.125, 1.487), (0.42, -1.0, 0.06)),
    Place("shoulder", (0.115, -0.02, 1.335), (0.9, -0.85, 0.55)),
    Place("hand", (0.292, -0.225, 0.835), (1.0, -0.5, 0.25)),
)

PORTRAIT = Place("portrait", (0.045, -0.07, 1.44), (0.5, -1.0, 0.06))
PORTRAIT_DISTANCE, PORTRAIT_SIZE = 0.72, 0.75
"""Metres to the camera, and the picture's height over that of the others."""

DISTANCES = {"arm's length": 0.65, "20 cm": 0.20}
"""Metres from the skin to the camera."""

LENS, SENSOR = 50.0, 24.0
"""In mm; the sensor's height is that of the square picture."""


@dataclass(frozen=True)
class Lamp:
    """A round lamp.

    Attributes
    ----------
    turned, up : float
        Degrees from the camera's direction to the right, and above the horizon.
    size : float
        Diameter in metres, at a distance of 1 m.
    power : float
        What a white surface that faces it would reflect.
    """

    turned: float
    up: float
    size: float
    power: float


@dataclass(frozen=True)
class Light:
    """Lamps, and even light from all around."""

    lamps: tuple[Lamp, ...]
    around: float


LIGHTS = {
    "window": Light((Lamp(-50.0, 30.0, 0.7, 1.2), Lamp(125.0, 20.0, 0.5, 0.35)), 0.18),
    "sun": Light((Lamp(50.0, 45.0, 0.06, 1.5), Lamp(-140.0, 30.0, 0.5, 0.25)), 0.20),
}

PORTRAIT_LIGHT = Light((Lamp(35.0, 60.0, 0.9, 1.4), Lamp(-120.0, 25.0, 0.5, 0.3)), 0.22)
"""Large and high, so that little of the skin shines."""
