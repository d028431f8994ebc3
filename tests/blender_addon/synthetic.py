"""A skin table of smooth analytic values."""

import numpy as np

from hylios.table import SkinTable, StateAxes
from hylios.tanning import PIGMENTATIONS

UNTANNED_COLOUR = np.array([0.62, 0.41, 0.31])
UNTANNED_WIDTH = np.array([1.6, 0.7, 0.45])


def smooth_table(pigmentation: str = "intermediate") -> SkinTable:
    """Colour falls exponentially with the melanin, profile width grows with the thickness."""
    steady = PIGMENTATIONS[pigmentation].steady_state()
    directions = np.array([[1.0, 1.0, 1.0, 0.1], [1.0, -1.0, 0.0, 0.0]]).T
    axes = StateAxes(
        untanned=np.append(steady / steady.sum(), 1.0),
        basis=np.linalg.qr(directions)[0] * [-1.0, 1.0],
        knots=(np.linspace(-0.5, 3.0, 15), np.linspace(-2.0, 2.0, 9)),
    )
    states = axes.knot_states()
    melanin, thickness = states[..., :3].sum(-1, keepdims=True), states[..., 3:]
    colour = UNTANNED_COLOUR * np.exp(np.array([-0.5, -0.8, -1.0]) * (melanin - 1.0))
    planes = {
        "subsurface_colour": colour,
        "total_colour": colour + 0.03,
        "band_reflectance": np.broadcast_to(0.5, colour.shape),
        "profile_width": UNTANNED_WIDTH * thickness,
    }
    provenance = {
        "specimen": "S3",
        "pigmentation": pigmentation,
        "mmd_sed": 4.9,
        "med_sed": 2.9,
        "bands_nm": [365, 1100, 1650],
        "absorptance": {"wavelengths_nm": [280.0, 340.0, 400.0], "values": [0.97, 0.9, 0.7]},
        "software": "test",
    }
    return SkinTable(axes, planes, provenance)
