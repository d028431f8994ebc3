"""Fits sites of the body to people, over their inner arms, and writes `sites.csv` anew.

Run it as `python -m hylios.lab.site_fits`. What was measured is in `body_sites.csv`.
"""

import argparse
import sys
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray
from scipy.optimize import least_squares

from hylios.adding import spectra
from hylios.errors import InputError
from hylios.files import written_beside
from hylios.lab.colour import difference, linear_rec709
from hylios.lab.fit import fit_spectrum
from hylios.packaged import texts_of
from hylios.skin import regions
from hylios.skin.phototypes import named_specimen
from hylios.skin.regions import MOST_BELOW, Region
from hylios.skin.skin import MOST_BLOOD
from hylios.skin.specimen import Specimen

TARGET = Path(regions.__file__).with_name("sites.csv")

STARTS = {"CA": "II", "CN": "III", "JP": "II", "IQ": "III", "AB": "III", "AF": "VI"}
"""Skin type from which the fit of a group's inner arm starts."""

FREE = ("melanin", "blood", "oxygenation", "hypodermis")
"""What is free in an inner arm, and in a site for `free_rmse`."""

ARM = "inner arm"
ANGLE = 8.0

LEAST = np.array([-2.0, 0.0, -0.5])
MOST = np.array([2.0, np.log(MOST_BLOOD), 0.5])
"""Bounds of the logarithms of melanin, blood and tissue below, over the inner arm's."""

HEADING = """\
# Fitted to hylios/lab/body_sites.csv; made by python -m hylios.lab.site_fits, not by hand.
# melanin, blood, below (what the tissue below the dermis reflects): over those of the group's inner
# arm, whose melanin in % of the epidermis is arm_melanin; added blood is arterial. rmse and
# ciede2000: what is left, 400 to 700 nm at 8 degrees, surface included. oxygenation in % and
# free_rmse: where the blood's oxygen is free too.
"""

COLUMNS = "group,site,subjects,arm_melanin,melanin,blood,below,rmse,ciede2000,oxygenation,free_rmse"


@dataclass(frozen=True, eq=False)
class Measured:
    """Mean reflectance (W,) of a site in a group of people, surface included, at nm (W,)."""

    group: str
    site: str
    subjects: int
    wavelengths: NDArray[np.float64]
    reflectance: NDArray[np.float64]


def measured() -> list[Measured]:
    """All sites of all groups, inner arms among them."""
    return [
        Measured(
            row["group"],
            row["site"],
            int(row["subjects"]),
            np.array([float(name[1:]) for name in row if name.startswith("R")]),
            np.array([float(value) for name, value in row.items() if name.startswith("R")]),
        )
        for row in texts_of("hylios.lab", "body_sites.csv")
    ]


def arm_of(one: Measured) -> Specimen:
    """The specimen fitted to a group's inner arm."""
    start = named_specimen(STARTS[one.group])
    return fit_spectrum(start, one.wavelengths, one.reflectance, free=FREE).specimen


def fitted(arm: Specimen, site: Measured) -> tuple[Region, NDArray[np.float64]]:
    """The region that is nearest to a site, and its reflectance (W,)."""

    def seen(logarithms: np.ndarray) -> NDArray[np.float64]:
        specimen = _region(logarithms).of(arm)
        return spectra([specimen], site.wavelengths, angle=ANGLE).total[0]

    top = np.log(MOST_BELOW / arm.hypodermis_reflectance)
    solution = least_squares(
        lambda logarithms: seen(logarithms) - site.reflectance,
        [0.0, 0.9, 0.0],
        bounds=(LEAST, np.minimum(MOST, [np.inf, np.inf, top])),
        diff_step=1e-3,
    )
    return _region(solution.x), seen(solution.x)


def _region(logarithms: np.ndarray) -> Region:
    return Region(*map(float, np.exp(logarithms)), tan=1.0, corneum=0.0, marks={})


def row_of(arm: Specimen, site: Measured) -> str:
    """A line of `sites.csv`."""
    region, seen = fitted(arm, site)
    start = named_specimen(STARTS[site.group])
    free = fit_spectrum(start, site.wavelengths, site.reflectance, free=FREE)
    colours = (linear_rec709(site.wavelengths, it) for it in (seen, site.reflectance))
    rmse = float(np.sqrt(np.mean((seen - site.reflectance) ** 2)))
    factors = (f"{it:.3f}" for it in (region.melanin, region.blood, region.below))
    return ",".join(
        [
            site.group,
            site.site,
            str(site.subjects),
            f"{100.0 * arm.pigmentation:.3f}",
            *factors,
            f"{rmse:.4f}",
            f"{difference(*colours):.2f}",
            f"{free.specimen.oxygenated_blood:.0f}",
            f"{free.rmse:.4f}",
        ]
    )


def table() -> str:
    """The whole of `sites.csv`."""
    everything = measured()
    arms = {one.group: arm_of(one) for one in everything if one.site == ARM}
    rows = [row_of(arms[one.group], one) for one in everything if one.site != ARM]
    return "\n".join([HEADING + COLUMNS, *rows]) + "\n"


def main() -> int:
    """Fit and write."""
    try:
        with written_beside(TARGET) as beside:
            beside.write_text(table(), encoding="utf-8")
    except InputError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    print(f"wrote {TARGET}")
    return 0


if __name__ == "__main__":
    argparse.ArgumentParser("python -m hylios.lab.site_fits", description=__doc__).parse_args()
    sys.exit(main())
