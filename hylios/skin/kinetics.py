"""How a person's skin tans by the measured kinetics: how much new melanin, and where.

`hylios.tanning.measured` has what holds for everyone. Here is what differs: one MMD, the least dose
whose tan can be seen, must be seen in every skin, and a tan has the hue that it has in people.
"""

from types import MappingProxyType

import numpy as np

from hylios.skin.specimen import Specimen
from hylios.tanning import MeasuredDynamics, MelaninDynamics

PALE_GAIN, GAIN_EXPONENT = 0.00345, 6.27
"""Volume fraction of new melanin at the peak after one MMD, and how it grows with the melanin that
there is: PALE_GAIN exp(GAIN_EXPONENT p). It darkens types II to VI by .8 of L*, the least that
people see (PMID 31206816). Measured by reflectance, the gain does not depend on the skin's own
melanin (Ravnbak et al., Acta Derm Venereol 88:223, 2008); in volume it grows by 3.4 from II to VI,
where the thesis's 5.16 has it grow by 7.2."""

MOST_GAINS = 20.0
"""New melanin that no sun exceeds, in gains of one MMD. ESTIMATE."""

LEAST_MELANIN = 0.013
"""Melanin fraction of the epidermis that the gain counts at least, as 3.1 and 3.2 do."""

PLACES = MappingProxyType(
    {
        "low": (0.0, 0.3, 0.7),
        "intermediate": (1.0, 0.0, 0.0),
        "high": (1.6, -0.465, -0.135),
    }
)
"""Shares of new melanin in basale, spinosum, granulosum, by the set of table 6.4.

In light skin it lies as that set itself moves it at its peak, upwards (Tadokoro et al., J Invest
Dermatol 124:1326, 2005, saw it move so in a week): of all places that reddens and yellows the most,
as people redden and yellow. In dark skin a tan stays in the basale, and what lies above is shed
faster than it is made: so it keeps the skin's a*, as people's does; placed as the thesis's sets
place it, it greys type VI by 4 of a*. ESTIMATE: the places are those that meet people's hues."""

FILLED = 0.97
"""Of a layer, or of what it has to lose, that new melanin takes at most."""


def measured_dynamics(
    specimen: Specimen, dynamics: MelaninDynamics, pigmentation: str
) -> MeasuredDynamics:
    """The measured kinetics of a specimen that by the thesis tans with some dynamics.

    Without sun melanin lies as those dynamics have it. What makes no melanin in the sun by the
    thesis, as type I, makes none here; otherwise its rates do not matter.

    Parameters
    ----------
    pigmentation : str
        Set of table 6.4: low, intermediate or high.
    """
    steady = dynamics.steady_state()
    untanned = steady / steady.sum()
    untanned[0] = 1.0 - untanned[1:].sum()
    level = max(specimen.pigmentation, LEAST_MELANIN)
    gain = PALE_GAIN * float(np.exp(GAIN_EXPONENT * level)) / level
    places = PLACES[pigmentation]
    return MeasuredDynamics(
        untanned=tuple(untanned.tolist()),
        places=places,
        gain=gain if any(dynamics.extra_production) else 0.0,
        most=min(MOST_GAINS * gain, _room(specimen, untanned, np.array(places))),
    )


def _room(specimen: Specimen, untanned: np.ndarray, places: np.ndarray) -> float:
    """New melanin with which a layer is full or another empty, relative to the untanned total."""
    thickness = specimen.epidermal_thickness
    total = max(specimen.pigmentation, LEAST_MELANIN) * thickness.sum()
    with np.errstate(divide="ignore"):
        full = np.where(places > 0.0, (FILLED * thickness / total - untanned) / places, np.inf)
        empty = np.where(places < 0.0, -FILLED * untanned / places, np.inf)
    return float(max(np.min([full, empty]), 1e-3))
