"""A table made for daylight under coloured lamps, beside the spectra under those lamps."""

from collections.abc import Mapping, Sequence

import numpy as np

from examples.truth import model
from examples.truth.outcome import Outcome, Reading, Row
from examples.truth.shots import Shot
from hylios.adding import spectrum
from hylios.lab.colour import colour, difference
from hylios.lab.illuminants import rec709_weights_under

LAMPS = ("A", "D50", "FL2", "FL11", "LED-B3")
SKINS, SEEN = ("II", "IV", "VI"), ("untanned", "dark")
WAVELENGTHS = np.arange(400.0, 701.0, 5.0)


def shots() -> list[Shot]:
    """Skin under white light; what it shows under a lamp is that times the lamp's colour."""
    return [Shot(f"{skin} {tan}", "white", skin, tan) for skin in SKINS for tan in SEEN]


def read(taken: Sequence[Shot], lights: Mapping[str, Mapping[str, np.ndarray]]) -> Outcome:
    """Compare the product of albedo and lamp with the reflected spectrum, both adapted to white."""
    rows, readings = [], []
    spectra = {
        shot.name: spectrum(model.specimen(shot.skin, shot.tan), WAVELENGTHS, angle=0.0).total
        for shot in taken
    }
    for lamp in LAMPS:
        weights = rec709_weights_under(WAVELENGTHS, lamp)
        some = []
        for shot in taken:
            said = (weights @ spectra[shot.name])[None]
            albedo = lights[shot.name]["combined"].mean(axis=(0, 1))
            shown = under(albedo, lamp)[None]
            case = f"{lamp}, {shot.name}"
            some.append(Reading("illuminants", case, shown, said, difference(shown, said)))
        rows.append(Row.of(some, f"table for D65 under a lamp of the colour of {lamp}"))
        readings += some
    return Outcome(rows, readings)


def under(albedo: np.ndarray, lamp: str) -> np.ndarray:
    """Linear Rec.709 (3,) of an albedo times a lamp's colour, adapted to the lamp's white."""
    space = colour.RGB_COLOURSPACES["ITU-R BT.709"]
    to_xyz, to_rgb = np.asarray(space.matrix_RGB_to_XYZ), np.asarray(space.matrix_XYZ_to_RGB)
    place = colour.CCS_ILLUMINANTS["CIE 1931 2 Degree Standard Observer"][lamp]
    white = np.asarray(colour.xy_to_XYZ(place))
    shown = to_xyz @ (albedo * (to_rgb @ white))
    cones = np.asarray(colour.adaptation.CHROMATIC_ADAPTATION_TRANSFORMS["Bradford"])
    ratio = (cones @ to_xyz @ np.ones(3)) / (cones @ white)
    return to_rgb @ np.linalg.inv(cones) @ (ratio * (cones @ shown))
