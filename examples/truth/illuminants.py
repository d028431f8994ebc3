"""Tables made for other lamps under white light, and one for daylight under coloured lamps.

Both beside the reflected spectra under those lamps.
"""

import subprocess
import sys
from collections.abc import Mapping, Sequence
from itertools import product
from pathlib import Path

import numpy as np

from examples.truth import model
from examples.truth.outcome import Outcome, Reading, Row
from examples.truth.shots import Shot
from hylios.adding import spectrum
from hylios.errors import InputError
from hylios.lab.colour import colour, difference
from hylios.lab.illuminants import rec709_weights_under

LAMPS = ("A", "D50", "FL2", "FL11", "LED-B3")
SKINS, SEEN = ("II", "VI"), ("untanned", "dark")
MADE_FOR = (0.3, 0.6)

TABLES = Path("out/truth/tables")
"""Folder of the tables that are made for lamps, with the preset preview."""

WAVELENGTHS = np.arange(400.0, 701.0, 5.0)


def shots() -> list[Shot]:
    """Skin under white light, with the add-on's table and with a table for each lamp.

    What the first shows under a lamp is that times the lamp's colour.
    """
    usual = [Shot(_name("", *case), "white", *case) for case in product(SKINS, SEEN)]
    made = [
        Shot(_name(lamp, skin, tan), "white", skin, tan, table=str(table))
        for lamp, skin in product(LAMPS, SKINS)
        for table in [built(skin, lamp)]
        for tan in SEEN
    ]
    return [*usual, *made]


def built(skin: str, lamp: str) -> Path:
    """The table of a skin for a lamp, built by the shell command.

    Raises
    ------
    InputError
        If that fails, with what the command says.
    """
    TABLES.mkdir(parents=True, exist_ok=True)
    path = (TABLES / f"{skin} {lamp}.exr").resolve()
    options = ["--specimen", skin, "--illuminant", lamp, "--preset", "preview", "--force"]
    command = [sys.executable, "-m", "lut_builder.cli", "build", *options, "-o", str(path)]
    ended = subprocess.run(command, capture_output=True, text=True)
    if ended.returncode:
        why = ended.stderr.strip().rpartition("\n")[2]
        raise InputError(f"the table of {skin} for the illuminant {lamp} cannot be built: {why}")
    return path


def _name(lamp: str, skin: str, tan: str) -> str:
    return f"{lamp or 'D65'}, {skin} {tan}"


def read(taken: Sequence[Shot], lights: Mapping[str, Mapping[str, np.ndarray]]) -> Outcome:
    """Compare with the reflected spectrum under the lamp, adapted to its white."""
    albedo = {shot.name: lights[shot.name]["combined"].mean(axis=(0, 1)) for shot in taken}
    spectra = {
        case: spectrum(model.specimen(*case), WAVELENGTHS, angle=0.0).total
        for case in product(SKINS, SEEN)
    }
    rows, readings = [], []
    for lamp in LAMPS:
        weights = rec709_weights_under(WAVELENGTHS, lamp)
        made, usual = [], []
        for case, light in spectra.items():
            said, own = weights @ light, albedo[_name(lamp, *case)]
            made.append(_reading("table for ", lamp, case, own, said))
            usual.append(_reading("lamp ", lamp, case, under(albedo[_name("", *case)], lamp), said))
        rows.append(Row.of(made, f"table for {lamp} under a white lamp", MADE_FOR))
        rows.append(Row.of(usual, f"table for D65 under a lamp of the colour of {lamp}"))
        readings += [*made, *usual]
    return Outcome(sorted(rows, key=lambda row: row.met is None), readings)


def _reading(
    what: str, lamp: str, case: tuple[str, str], shown: np.ndarray, said: np.ndarray
) -> Reading:
    apart = difference(shown, said)[None]
    return Reading("illuminants", f"{what}{lamp}, {' '.join(case)}", shown[None], said[None], apart)


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
