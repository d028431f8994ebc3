"""Where the surface reflects a distant lamp, beside the model's BRDF."""

from collections.abc import Mapping, Sequence

import numpy as np

from examples.truth import model
from examples.truth.outcome import Outcome, Reading, Row
from examples.truth.shots import Shot
from examples.truth.stages import WHITE

ALLOWED = {8.0: 0.05, 45.0: 0.12, 65.0: 0.20}
"""Largest L1 at each angle of incidence where s = .1, as the types have it."""

USUAL, OTHERS = "III", ("S2", "S4")
"""A skin with s = .1, and skins with others."""

BINS = (18, 12)
RAYS = 10_000_000


def shots() -> list[Shot]:
    """Each angle of incidence, on a type and on the thesis's specimens."""
    return [
        Shot(f"gloss {skin} at {angle:g}", "lobe", skin, angle=angle, size=(320, 320), samples=4)
        for skin in (USUAL, *OTHERS)
        for angle in ALLOWED
    ]


def read(taken: Sequence[Shot], lights: Mapping[str, Mapping[str, np.ndarray]]) -> Outcome:
    """Compare renders of shots, by their names, with the model."""
    rows, readings = [], []
    for shot in taken:
        of = model.specimen(shot.skin, shot.tan)
        roughness = of.surface_fold_aspect_ratio
        said = model.gloss(of, shot.angle, RAYS, BINS)
        shown = in_bins(lights[shot.name], shot.angle)
        reading = _reading(shot, shown, said.surface, said.projected_solid_angle)
        allowed = ALLOWED[shot.angle] if shot.skin == USUAL else None
        what = f"gloss lobe at {shot.angle:g}°, s = {roughness:g}"
        rows.append(Row.of([reading], what, (None, allowed), "L1"))
        readings.append(reading)
    return Outcome(rows, readings)


def _reading(shot: Shot, shown: np.ndarray, said: np.ndarray, solid: np.ndarray) -> Reading:
    """Lobes (P, A) in the plane of incidence, and how far they are apart over all directions.

    As a share of all that the model's surface reflects.
    """
    apart = float((np.abs(shown - said) * solid).sum() / (said * solid).sum())
    middles = 90.0 * (np.arange(BINS[0]) + 0.5) / BINS[0]
    places = np.concatenate([-middles[::-1], middles])
    lobes = [np.concatenate([lobe[::-1, -1], lobe[:, 0]]) for lobe in (shown, said)]
    grey = [np.repeat(lobe[:, None], 3, axis=1) for lobe in lobes]
    return Reading("gloss", shot.name, *grey, np.full(places.size, apart), places)


def in_bins(light: Mapping[str, np.ndarray], angle: float) -> np.ndarray:
    """BRDF (P, A) of the gloss in a picture of all directions, in 1/sr, as its mean over bins.

    A bin without a pixel has 0.
    """
    position, gloss = light["position"].astype(float), light["glossy"][..., 1].astype(float)
    seen = np.any(position != 0.0, axis=-1)
    x, y, z = (np.array([0.0, 0.0, 1.0]) - position[seen]).T
    polar, azimuth = np.arctan2(np.hypot(x, y), z), np.arctan2(np.abs(y), x)
    # A pixel's share of the sphere, in a picture where the polar angle grows evenly outwards.
    weight = np.sinc(polar / np.pi) * np.cos(polar)
    brdf = gloss[seen] / (WHITE * np.cos(np.radians(angle)))
    rows = np.minimum((polar / (0.5 * np.pi) * BINS[0]).astype(int), BINS[0] - 1)
    columns = np.minimum((azimuth / np.pi * BINS[1]).astype(int), BINS[1] - 1)
    places, size = rows * BINS[1] + columns, BINS[0] * BINS[1]
    sums = np.bincount(places, weight * brdf, size)
    weights = np.bincount(places, weight, size)
    return np.divide(sums, weights, out=np.zeros(size), where=weights > 0.0).reshape(BINS)
