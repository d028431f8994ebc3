"""Colours of tanned and untanned skin, read back from the renders and predicted by the model."""

import csv
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from examples.demo import swimsuit
from examples.demo.render import Light, Window
from hylios.history import history_of_shares
from hylios.lab import colour
from hylios.table import SkinTable, melanin_dynamics
from hylios.tanning import Exposures

SKINS = ("untanned", "tanned")
PATCH_RADIUS = 0.012  # metres
CLEAR_OF_EDGE = 0.022


@dataclass(frozen=True)
class Patch:
    """A round patch of skin: `skin` is one of `SKINS`, `centre` (3,) in metres.

    `window` is the part of the picture that holds it.
    """

    skin: str
    centre: np.ndarray
    window: Window

    def mean(self, light: Light, values: np.ndarray) -> np.ndarray:
        """Mean (3,) of a render's values over the patch."""
        return values[_near(light.position, self.centre)].mean(axis=0)


@dataclass(frozen=True)
class Reading:
    """Colour of a patch on a day, linear Rec.709 (3,).

    Attributes
    ----------
    rendered : light scattered in the skin, as a share of what a white diffuser gives there
    predicted : the table's subsurface colour at the tanning state of that day
    entering : share of the light that the shader lets into the skin; its surface reflects the rest
    """

    day: float
    skin: str
    rendered: np.ndarray
    predicted: np.ndarray
    entering: float

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
    view = camera - position
    facing = np.sum(view * normal, axis=-1) / np.linalg.norm(view, axis=-1)
    good = (brightness >= np.median(brightness)) & (facing > 0.8)
    patches = []
    for skin, side in zip(SKINS, (-1.0, 1.0), strict=True):
        candidates = position[good & (side * distance > CLEAR_OF_EDGE)]
        candidates = candidates[:: max(1, len(candidates) // 300)]
        centre = _most_even(candidates, position, brightness)
        patches.append(Patch(skin, centre, _window(_near(white.position, centre))))
    return patches


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
        entering=float(np.mean(patch.mean(light, light.albedo) / predicted)),
    )


def predictions(table: SkinTable, dose: float, days: Sequence[float]) -> np.ndarray:
    """Subsurface colours (days, 2, 3), linear Rec.709, without and with a dose in SED on day 0."""
    described = table.provenance
    history = history_of_shares(
        Exposures(hours=np.array([0]), doses=np.array([dose])),
        melanin_dynamics(described),
        hours=[round(24 * day) for day in days],
        mmd=described["mmd_sed"],
        med=described["med_sed"],
        shares=[0.0, 1.0],
    )
    return table.plane("subsurface_colour", history.image)


def report(readings: Sequence[Reading]) -> str:
    """A table to print, and how much the shader's surface keeps out of the skin."""
    lines = [
        f"{'':15}{'read back from the render':^40}{'predicted by the model':^40}",
        f"{'day':>4} {'skin':9} {_heading()} {_heading()}  CIEDE2000",
    ]
    for reading in readings:
        pair = f"{_described(reading.rendered)} {_described(reading.predicted)}"
        lines.append(f"{reading.day:4g} {reading.skin:9} {pair}  {reading.difference:9.2f}")
    entering = np.mean([reading.entering for reading in readings])
    inside = [
        colour.difference(reading.rendered / reading.entering, reading.predicted)
        for reading in readings
    ]
    lines.append(
        f"The shader's surface lets {entering:.1%} of the light into the skin. Counting only what "
        f"went in, the mean CIEDE2000 is {np.mean(inside):.2f} in place of "
        f"{np.mean([reading.difference for reading in readings]):.2f}."
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
        writer.writerow(["day", "skin", *sources, "ciede2000", "entering"])
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
                    f"{reading.entering:.4f}",
                ]
            )
