"""Fits the untanned specimens of the six skin types to people and writes `fitted.toml` anew.

Run it as `python -m hylios.lab.phototype_fits`.
"""

import argparse
import sys
from pathlib import Path

from hylios.errors import InputError
from hylios.files import written_beside
from hylios.lab.colour import difference, linear_rec709
from hylios.lab.fit import Fit, fit_spectrum
from hylios.skin import phototypes
from hylios.skin.phototypes import PHOTOTYPES, people, start

TARGET = Path(phototypes.__file__).with_name("fitted.toml")

FREE = ("melanin", "blood", "oxygenation", "hypodermis")
"""What changes from type to type; what else `hylios.lab.fit` may change, such data leave open."""

FITTED = ("papillary_blood", "reticular_blood", "oxygenated_blood", "hypodermis_reflectance")
"""Fields that follow from `FREE`, besides melanin."""

HEADING = """\
# Fitted to inner_arm.csv; made by python -m hylios.lab.phototype_fits, not by hand.
# melanin: % of the epidermis; the rest as in hylios.skin.specimen; rmse and ciede2000: what is
# left, 400 to 700 nm at 8 degrees, surface included.
"""


def fitted(name: str) -> Fit:
    """The fit of a type's specimen to the people that stand for it."""
    measured = people(name)
    return fit_spectrum(start(name), measured.wavelengths, measured.reflectance, free=FREE)


def as_toml(name: str, fit: Fit) -> str:
    """A type's table of `fitted.toml`, with what the fit leaves open."""
    measured = people(name)
    colours = (
        linear_rec709(measured.wavelengths, spectrum)
        for spectrum in (fit.observed, measured.reflectance)
    )
    values = {
        "rmse": f"{fit.rmse:.4f}",
        "ciede2000": f"{difference(*colours):.2f}",
        "melanin": f"{100.0 * fit.specimen.pigmentation:.5g}",
        **{name: f"{getattr(fit.specimen, name):.5g}" for name in FITTED},
    }
    remarks = (f"# {remark}" for remark in fit.remarks())
    lines = (f"{key} = {value}" for key, value in values.items())
    return "\n".join([*remarks, f"[{name}]", *lines]) + "\n"


def main() -> int:
    """Fit all six and write."""
    tables = [as_toml(name, fitted(name)) for name in PHOTOTYPES]
    try:
        with written_beside(TARGET) as beside:
            beside.write_text("\n".join([HEADING, *tables]), encoding="utf-8")
    except InputError as error:
        print(f"error: {error}", file=sys.stderr)
        return 2
    print(f"wrote {TARGET}")
    return 0


if __name__ == "__main__":
    argparse.ArgumentParser("python -m hylios.lab.phototype_fits", description=__doc__).parse_args()
    sys.exit(main())
