"""Skin tables of smooth analytic values."""

from dataclasses import asdict, replace

import numpy as np

from hylios.skin import UNTANNED
from hylios.skin.specimen import SPECIMENS
from hylios.table import LookAxes, SkinTable, StateAxes
from hylios.tanning import PIGMENTATIONS, spread_of

UNTANNED_COLOUR = np.array([0.62, 0.41, 0.31])
UNTANNED_WIDTH = np.array([1.6, 0.7, 0.45])
NEAR_SHARE = np.array([0.34, 0.47, 0.62])
BY_ANGLE = {45: [0.97, 0.96, 0.95], 60: [0.93, 0.92, 0.9], 70: [0.86, 0.84, 0.82]}
"""Colour at an angle over that at 8 degrees."""

MMD, MED = 4.9, 2.9
ROUGHNESS = 0.4


def provenance(pigmentation: str) -> dict:
    specimen = replace(SPECIMENS["S3"], surface_fold_aspect_ratio=ROUGHNESS**2)
    return {
        "specimen": "S3",
        "specimen_parameters": asdict(specimen),
        "pigmentation": pigmentation,
        "untanned_state": UNTANNED["steady_state"],
        "mmd_sed": MMD,
        "med_sed": MED,
        "bands_nm": [365, 1100, 1650],
        "absorptance": {"wavelengths_nm": [280.0, 340.0, 400.0], "values": [0.97, 0.9, 0.7]},
        "software": "test",
    }


def colour_of(states: np.ndarray) -> np.ndarray:
    """It falls exponentially with melanin and blood, and a little with the thickness."""
    melanin, thickness, blood = states[..., :3].sum(-1), states[..., 3], states[..., 4]
    changes = (
        np.multiply.outer(melanin - 1.0, [-0.3, -0.5, -0.6])
        + np.multiply.outer(np.log(thickness), [-0.05, -0.1, -0.1])
        + np.multiply.outer(blood - 1.0, [-0.005, -0.08, -0.05])
    )
    return UNTANNED_COLOUR * np.exp(changes)


def smooth_table(pigmentation: str = "intermediate") -> SkinTable:
    """A table of format 4, with all planes that a shader can show."""
    sheet = spread_of(PIGMENTATIONS[pigmentation], mmd=MMD, med=MED)
    axes = LookAxes(
        sheet=sheet,
        measured=sheet,
        aside=sheet.directions[:, 0],
        knots=(
            np.concatenate([np.linspace(-6.0, -1.0, 6), np.linspace(-0.8, 1.8, 27)]),
            np.array([0.0, 0.1, 0.25]),
            np.array([0.0]),
            np.linspace(0.0, np.log(12.0), 12),
        ),
    )
    states = axes.knot_states()
    colour = colour_of(states)
    planes = {
        "subsurface_colour": colour,
        "total_colour": colour + 0.047,
        "band_reflectance": 0.06 + colour[..., [2, 0, 1]] * [0.4, 1.2, 0.5],
        "near_share": np.broadcast_to(NEAR_SHARE, colour.shape),
        "far_width": UNTANNED_WIDTH * np.sqrt(states[..., 3:4]),
    }
    for angle, ratio in BY_ANGLE.items():
        planes[f"subsurface_colour_{angle}"] = colour * ratio
    return SkinTable(axes, planes, provenance(pigmentation), "pchip")


def former_table(pigmentation: str = "intermediate") -> SkinTable:
    """A table of format 3: over a state's own numbers, with one width and without blood."""
    steady = PIGMENTATIONS[pigmentation].steady_state()
    axes = StateAxes(
        untanned=np.append(steady / steady.sum(), 1.0),
        basis=np.eye(4),
        knots=(
            np.linspace(-1.2, 0.4, 9),
            np.linspace(0.0, 1.5, 9),
            np.linspace(0.0, 2.2, 9),
            np.linspace(0.0, 0.25, 3),
        ),
    )
    states = axes.knot_states()
    colour = colour_of(np.concatenate([states, np.ones((*states.shape[:-1], 1))], axis=-1))
    planes = {
        "subsurface_colour": colour,
        "total_colour": colour + 0.047,
        "profile_width": UNTANNED_WIDTH * np.sqrt(states[..., 3:4]),
    }
    return SkinTable(axes, planes, provenance(pigmentation), "pchip")
