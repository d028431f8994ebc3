"""Skins to measure on, and others to choose wavelengths by."""

from dataclasses import replace

import numpy as np

from hylios.specimen import EPIDERMIS, SPECIMENS, Specimen, tanned
from hylios.tanning import Exposures, simulate
from hylios.tissue import stack
from lut_builder.states import skin

DOSE = 30.0  # SED, on day 0
DAYS = (0, 2, 10, 30)
"""Of a tan; day 0 is the skin before it, with melanin as the tanning model spreads it (5.16)."""

FRESNEL = 0.046
"""Reflectance of skin's surface for light straight on (index 1.55)."""

TURNED_BACK = 0.6
"""Share of diffuse light that skin's surface turns back inside."""


def tan(specimen: Specimen) -> list[Specimen]:
    """A specimen on `DAYS` of a tan, by its usual way of tanning."""
    made_for = skin(specimen)
    history = simulate(
        Exposures([0], [DOSE]),
        made_for.dynamics,
        mmd=made_for.mmd,
        med=made_for.med,
        hours=24 * max(DAYS),
    )
    states = history.states[24 * np.array(DAYS)]
    return [tanned(specimen, state[:3], state[3]) for state in states]


def measured() -> tuple[list[Specimen], list[Specimen]]:
    """S1 to S4, and the tans of all four."""
    return list(SPECIMENS.values()), [each for one in SPECIMENS.values() for each in tan(one)]


def random_skins(count: int, seed: int) -> list[Specimen]:
    """Skins drawn at random around S1 to S4, from hardly any melanin to more than S4's.

    What colours skin varies: melanin, its form and place, blood and its oxygenation, the rarer
    pigments, and thickness.
    """
    random = np.random.default_rng(seed)

    def between(low: float, high: float) -> float:
        return float(np.exp(random.uniform(np.log(low), np.log(high))))

    def drawn() -> Specimen:
        usual = list(SPECIMENS.values())[random.integers(len(SPECIMENS))]
        # Three layers at 3 x 25 % at most hold it, whatever the shares.
        shares = 3.0 * between(0.2, 30.0) * random.dirichlet([1.0, 1.0, 1.0])
        inside = random.uniform()
        melanin = {}
        for layer, share in zip(EPIDERMIS, shares, strict=True):
            melanin[f"{layer}_melanosomes"] = float(share * inside)
            melanin[f"{layer}_colloidal_melanin"] = float(share * (1.0 - inside))
        blood = between(0.2, 5.0)
        return replace(
            usual,
            **melanin,
            eumelanin_concentration=between(20.0, 100.0),
            papillary_blood=blood,
            reticular_blood=blood,
            oxygenated_blood=random.uniform(50.0, 98.0),
            methemoglobin=between(0.3, 6.0),
            carboxyhemoglobin=between(0.3, 6.0),
            blood_bilirubin=between(0.001, 0.03),
            epidermis_beta_carotene=between(5e-5, 1e-3),
            papillary_thickness=usual.papillary_thickness * between(0.6, 1.6),
            reticular_thickness=usual.reticular_thickness * between(0.6, 1.6),
        )

    return [drawn() for _ in range(count)]


def unscattered(specimen: Specimen, wavelengths: np.ndarray) -> np.ndarray:
    """Reflectance (W,) of skin that absorbs but does not scatter, over its white floor.

    A closed form with spectra like skin's: light straight down through all absorbers, diffuse
    up again, and turned back by the surface as often as it comes.
    """
    contents = [0.01 * getattr(specimen, f"{layer}_melanosomes") for layer in EPIDERMIS]
    depths = []
    for wavelength in wavelengths:
        layers = stack(specimen, float(wavelength)).layers
        depth = sum(each.thickness * each.absorption for each in layers)
        for each, content in zip(layers[1:4], contents, strict=True):
            depth += each.thickness * content * each.melanin_absorption
        depths.append(depth)
    down, up = np.exp(-np.array(depths)), np.exp(-1.7 * np.array(depths))
    inside = down * up * (1.0 - TURNED_BACK) / (1.0 - TURNED_BACK * up**2)
    return FRESNEL + (1.0 - FRESNEL) * inside
