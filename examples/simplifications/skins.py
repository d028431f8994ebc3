"""Skins on which simplifications are measured, and random ones that wavelengths are fitted to."""

from dataclasses import replace

import numpy as np

from hylios.skin import Skin
from hylios.skin.specimen import EPIDERMIS, SPECIMENS, Specimen
from hylios.tanning import Exposures

DOSE = 30.0  # SED, on day 0
DAYS = (0, 2, 10, 30)
"""Days of a tan; day 0 is the skin before, its melanin as the tanning model spreads it (5.16)."""


def tan(specimen: Specimen) -> list[Specimen]:
    """A specimen on `DAYS` of a tan, by its usual way of tanning."""
    skin = Skin.of(specimen)
    states = skin.states(Exposures([0], [DOSE]), 24.0 * np.array(DAYS))
    return [skin.at(state) for state in states]


def measured() -> tuple[list[Specimen], list[Specimen]]:
    """S1 to S4, and the tans of all four."""
    return list(SPECIMENS.values()), [
        tanned for specimen in SPECIMENS.values() for tanned in tan(specimen)
    ]


def random_skins(count: int, seed: int, most_blood: float = 5.0) -> list[Specimen]:
    """Skins drawn at random around S1 to S4, from hardly any melanin to more than S4's.

    What colours skin varies: melanin, its form and place, blood (up to `most_blood` in %) and its
    oxygenation, the rarer pigments, and thickness.
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
        blood = between(0.2, most_blood)
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
