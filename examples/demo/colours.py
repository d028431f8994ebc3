"""Colours of tanned and untanned skin, read back from the renders and predicted by the model.

What is compared is light that has been inside the skin: in the render, as a share of what a white
diffuser gives in the same place; in the light model, solved for the state of that day and seen at
the angle at which the camera sees the place. Table, look and shader lie between the two.
"""

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from examples.demo import swimsuit
from examples.demo.render import Light, Window
from hylios.adding import colours
from hylios.lab import colour
from hylios.quadrature import MOST
from hylios.skin import Skin
from hylios.tanning import Exposures

SKINS = ("untanned", "tanned")
PATCH_RADIUS = 0.012  # metres
CLEAR_OF_EDGE = 0.022

ALLOWED = 0.3
"""Mean CIEDE2000 between what is read back and what is predicted."""


@dataclass(frozen=True)
class Patch:
    """A round patch of skin: `skin` is one of `SKINS`, `centre` (3,) in metres.

    `window` is the part of the picture that holds it, `angle` that at which the camera sees it, in
    degrees from the normal.
    """

    skin: str
    centre: np.ndarray
    window: Window
    angle: float

    def mean(self, light: Light, values: np.ndarray) -> np.ndarray:
        """Mean (3,) of a render's values over the patch."""
        return values[_near(light.position, self.centre)].mean(axis=0)


@dataclass(frozen=True)
class Reading:
    """Colour of a patch on a day, linear Rec.709 (3,).

    Attributes
    ----------
    rendered : light scattered in the skin, as a share of what a white diffuser gives there
    predicted : the model's subsurface colour at the tanning state of that day
    """

    day: float
    skin: str
    rendered: np.ndarray
    predicted: np.ndarray

    @property
    def difference(self) -> float:
        """CIEDE2000 between rendered and predicted colour."""
        return float(colour.difference(self.rendered, self.predicted))


def patches(white: Light, cloth: swimsuit.Field, camera: np.ndarray) -> list[Patch]:
    """A patch of covered and one of bare skin, for a camera at (3,) and a white subject's light.

    The most evenly lit of all places that face the camera, are well lit and well away from the
    cloth's edge: where light is uneven, what scatters over from beside a patch changes its colour.
    """
    seen = np.linalg.norm(white.normal, axis=-1) > 0.9
    position, normal = white.position[seen].astype(float), white.normal[seen].astype(float)
    brightness = white.scattered[seen].mean(axis=-1)
    distance = swimsuit.distance_to_edge(cloth, position, normal)
    facing = _cosine(camera - position, normal)
    good = (brightness >= np.median(brightness)) & (facing > 0.8)
    patches = []
    for skin, side in zip(SKINS, (-1.0, 1.0), strict=True):
        candidates = position[good & (side * distance > CLEAR_OF_EDGE)]
        candidates = candidates[:: max(1, len(candidates) // 300)]
        centre = _most_even(candidates, position, brightness)
        inside = _near(white.position, centre)
        normals = white.normal[inside].astype(float)
        seen_at = _cosine(camera - white.position[inside].astype(float), normals).mean()
        angle = float(np.degrees(np.arccos(seen_at)))
        patches.append(Patch(skin, centre, _window(inside), angle))
    return patches


def _cosine(view: np.ndarray, normal: np.ndarray) -> np.ndarray:
    """Of the angle between ways to the camera (N, 3) and normals of length 1 (N, 3)."""
    return np.sum(view * normal, axis=-1) / np.linalg.norm(view, axis=-1)


def _most_even(candidates: np.ndarray, position: np.ndarray, brightness: np.ndarray) -> np.ndarray:
    """The candidate (3,) whose patch is seen whole and has the most even light."""
    lights = [brightness[_near(position, place)] for place in candidates]
    whole = 0.8 * max(light.size for light in lights)
    unevenness = [light.std() / light.mean() if light.size >= whole else np.inf for light in lights]
    return candidates[int(np.argmin(unevenness))]


def _near(position: np.ndarray, centre: np.ndarray) -> np.ndarray:
    return np.linalg.norm(position - centre, axis=-1) < PATCH_RADIUS


def _window(inside: np.ndarray) -> Window:
    """The part of the picture that a mask of its pixels (rows from the top, columns) covers."""
    (rows, columns), (y, x) = inside.shape, np.nonzero(inside)
    return (
        x.min() / columns,
        (x.max() + 1) / columns,
        1.0 - (y.max() + 1) / rows,
        1.0 - y.min() / rows,
    )


def reading(day: float, patch: Patch, light: Light, white: Light, predicted: np.ndarray) -> Reading:
    """What a render shows at a patch, beside what is predicted there (3,)."""
    return Reading(
        day=day,
        skin=patch.skin,
        rendered=patch.mean(light, light.scattered) / patch.mean(white, white.scattered),
        predicted=predicted,
    )


def predictions(
    skin: Skin, dose: float, days: Sequence[float], angles: Sequence[float]
) -> np.ndarray:
    """Subsurface colours (days, 2, 3), linear Rec.709, without and with a dose in SED on day 0.

    Each of the two is seen at an angle in degrees.
    """
    hours = [24.0 * day for day in days]
    columns = [
        colours(skin, skin.states(Exposures([0], [sun]), hours), count=MOST, angle=angle).subsurface
        for sun, angle in zip((0.0, dose), angles, strict=True)
    ]
    return np.stack(columns, axis=1)


def report(readings: Sequence[Reading]) -> str:
    """A table to print, and how far the two are apart."""
    lines = [
        f"{'':15}{'read back from the render':^40}{'predicted by the model':^40}",
        f"{'day':>4} {'skin':9} {_heading()} {_heading()}  CIEDE2000",
    ]
    for reading in readings:
        pair = f"{_described(reading.rendered)} {_described(reading.predicted)}"
        lines.append(f"{reading.day:4g} {reading.skin:9} {pair}  {reading.difference:9.2f}")
    apart = np.array([reading.difference for reading in readings])
    lines.append(
        f"CIEDE2000 between the two: mean {apart.mean():.2f} (allowed {ALLOWED:g}), largest "
        f"{apart.max():.2f}. Both are light that has been inside the skin, seen at the same angle."
    )
    return "\n".join(lines)


def _heading() -> str:
    return f"{'sRGB':>15}  {'L*':>6} {'a*':>6} {'b*':>6}  "


def _described(linear: np.ndarray) -> str:
    srgb = " ".join(f"{value:3d}" for value in srgb_bytes(linear))
    return f"{srgb:>15}  " + " ".join(f"{value:6.2f}" for value in colour.lab(linear)) + "  "


def srgb_bytes(linear: np.ndarray) -> list[int]:
    """sRGB, 0 to 255, of linear Rec.709 (3,)."""
    return [round(255 * float(value)) for value in colour.srgb(linear)]


def write_csv(readings: Sequence[Reading], path: Path) -> None:
    """Write all readings: sRGB as 0 to 255, L*a*b* under D65, and the CIEDE2000 between the two."""
    names = ("red", "green", "blue", "L", "a", "b")
    with path.open("w", newline="") as file:
        writer = csv.writer(file)
        sources = [f"{source}_{name}" for source in ("rendered", "predicted") for name in names]
        writer.writerow(["day", "skin", *sources, "ciede2000"])
        for reading in readings:
            numbers = []
            for linear in (reading.rendered, reading.predicted):
                numbers += [*srgb_bytes(linear), *(f"{value:.3f}" for value in colour.lab(linear))]
            writer.writerow(
                [
                    f"{reading.day:g}",
                    reading.skin,
                    *numbers,
                    f"{reading.difference:.3f}",
                ]
            )
