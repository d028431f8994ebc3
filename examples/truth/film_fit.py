"""Fits how a film changes the colour of light that has been inside the skin.

Under a film of water, oil or sunscreen that light is a + b x its colour without one, channel by
channel, for all skins alike: what the surface returns into the skin depends on the skin only
through how bright it is. Fitted to `hylios.adding` over all skin types, melanin from half of the
untanned skin's to three and a half times, and blood up to three times, at 8 degrees of incidence.

    python -m examples.truth.film_fit blender_addon/model/film.csv

takes ten seconds.
"""

import argparse
from pathlib import Path

import numpy as np

from examples.truth import model
from examples.truth.shots import TYPES
from hylios.adding import spectra
from hylios.files import written_beside
from hylios.lab.colour import difference
from hylios.quadrature import skin_quadrature
from hylios.tissue.liquids import LIQUIDS

MELANIN, BLOODS = (0.5, 1.0, 2.0, 3.5), (1.0, 3.0)
"""Relative to the untanned skin's."""

ANGLE, WAVELENGTHS = 8.0, 8

HEAD = """\
# Colour of the light that has been inside skin under a film, over that without one: a + b x colour
# in each channel, linear Rec.709 under D65, by {angle:g} degrees of incidence. Fitted by
# examples/truth/film_fit.py to hylios.adding; CIEDE2000 from it, mean and largest over all skins:
# {errors}.
liquid,a_red,a_green,a_blue,b_red,b_green,b_blue
"""


def colours() -> tuple[np.ndarray, np.ndarray]:
    """Colours (N, 3) of skins without a film, and (F, N, 3) under the films."""
    quadrature = skin_quadrature(WAVELENGTHS)
    films = (None, *(liquid.index for liquid in LIQUIDS.values()))
    specimens = []
    for name in TYPES:
        skin = model.skin(name)
        specimens += [
            skin.at([*(melanin * skin.untanned_melanin), 1.0, blood])
            for melanin in MELANIN
            for blood in BLOODS
        ]
    light = spectra(specimens, quadrature.wavelengths, angle=ANGLE, film=films)
    dry, *wet = light.subsurface @ quadrature.weights.T
    return dry, np.array(wet)


def main(target: Path) -> None:
    """Write the CSV."""
    dry, wet = colours()
    lines, errors = [], []
    for name, under in zip(LIQUIDS, wet, strict=True):
        fits = [np.polyfit(x, y / x, 1) for x, y in zip(dry.T, under.T, strict=True)]
        slope, start = np.transpose(fits)
        apart = difference(dry * (start + slope * dry), under)
        errors.append(f"{name} {apart.mean():.2f} and {apart.max():.2f}")
        lines.append(",".join([name, *(f"{value:.4f}" for value in (*start, *slope))]))
    text = HEAD.format(angle=ANGLE, errors=", ".join(errors)) + "\n".join(lines) + "\n"
    with written_beside(target) as unfinished:
        unfinished.write_text(text)


if __name__ == "__main__":
    parser = argparse.ArgumentParser("python -m examples.truth.film_fit", description=__doc__)
    parser.add_argument("target", type=Path, help="the CSV to write")
    main(parser.parse_args().target)
