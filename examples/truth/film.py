"""Colour and gloss of wet, oiled and sunscreened skin under even white light."""

from collections.abc import Mapping, Sequence

import numpy as np

from examples.truth import model
from examples.truth.albedo import reading
from examples.truth.outcome import Outcome, Reading, Row
from examples.truth.shots import Shot
from hylios.tissue.liquids import LIQUIDS

SKINS, SKIN_TANS = ("I", "III", "VI"), ("untanned", "dark")
ANGLES = (0.0, 45.0)
WHOLE = {0.0: (0.3, 0.6), 45.0: (0.4, 0.8)}
INSIDE = {0.0: (0.2, 0.4), 45.0: (0.25, 0.5)}
"""What is allowed at each angle: mean and largest CIEDE2000."""

SURFACE = {0.0: 0.002, 45.0: 0.004}
"""Largest error of the share of light that film and surface reflect."""

SAMPLES = 448


def shots() -> list[Shot]:
    """Three types, untanned and dark, under the liquids, at each angle."""
    return [
        Shot(
            f"{skin} {tan} {liquid} at {angle:g}",
            "white",
            skin,
            tan,
            angle=angle,
            samples=SAMPLES,
            film=liquid.upper(),
        )
        for skin in SKINS
        for tan in SKIN_TANS
        for liquid in LIQUIDS
        for angle in ANGLES
    ]


def read(taken: Sequence[Shot], lights: Mapping[str, Mapping[str, np.ndarray]]) -> Outcome:
    """Compare renders of shots, by their names, with the model."""
    said = {
        shot.name: model.albedo(
            model.specimen(shot.skin, shot.tan),
            [shot.angle],
            film=LIQUIDS[shot.film.lower()].index,
        )
        for shot in taken
    }
    rows, readings = [], []
    for angle in ANGLES:
        some = [shot for shot in taken if shot.angle == angle]
        for what, shown, part, allowed in (
            ("whole", "combined", "total", WHOLE),
            ("subsurface part", "diffuse", "subsurface", INSIDE),
        ):
            compared = [
                reading("film", shot, lights[shot.name][shown], getattr(said[shot.name], part)[0])
                for shot in some
            ]
            if compared:
                rows.append(Row.of(compared, f"film, {what}, at {angle:g}°", allowed[angle]))
                readings += compared
        shares = [_surface(shot, lights[shot.name], said[shot.name]) for shot in some]
        if shares:
            limit = (None, SURFACE[angle])
            rows.append(Row.of(shares, f"film, reflected by it, at {angle:g}°", limit, "share"))
            readings += shares
    return Outcome(rows, readings)


def _surface(shot: Shot, light: Mapping[str, np.ndarray], said: model.Albedo) -> Reading:
    """What film and surface reflect."""
    shown = light["glossy"].mean(axis=(0, 1))[None]
    reflected = said.total - said.subsurface
    return Reading("film", shot.name, shown, reflected, np.abs(shown - reflected).max(axis=1))
