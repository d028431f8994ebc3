"""How a skin reddens in the sun: its own numbers of `ErythemaDynamics`, by the light model."""

from dataclasses import replace
from functools import lru_cache

import numpy as np

from hylios.adding.colours import colours
from hylios.adding.solver import solve
from hylios.colour_difference import lab
from hylios.errors import InputError
from hylios.skin import Skin
from hylios.skin.specimen import EPIDERMIS, Specimen
from hylios.tanning import Burns, ErythemaDynamics, Exposures
from hylios.tissue import Model, Stack

JUST_SEEN = 2.5
"""Change of a* at which redness is just seen a day after 1 MED (COLIPA's threshold of a
chromameter, Skin Res. Technol.)."""

DAY = 24

BLOOD_AT_MED = 1.5, 2.5
"""Least and most blood, relative to the skin's own, that 1 MED brings about (Wan, Jaenicke and
Parrish, Photochem. Photobiol. 37, 547, 1983). In dark skin the most is not seen: its a* rises
less."""

BLOODS = np.linspace(1.0, BLOOD_AT_MED[1], 7)

ERYTHEMAL_NM = 306.0
"""Where sunlight at noon reddens most, weighted by the action of erythema (ISO/CIE 17166)."""

TANS = (1.0, 1.0), (1.5, 1.0), (1.0, 1.2)
"""Relative melanin and thickness of the epidermis by which its shield is told."""


def erythema(skin: Skin, model: Model | None = None) -> ErythemaDynamics:
    """How a skin's blood responds to its doses; ESTIMATE but where a source is named.

    The sensitivity is such that a* is `JUST_SEEN` higher a day after 1 MED, within `BLOOD_AT_MED`.
    The shield is the ultraviolet of `ERYTHEMAL_NM` that the tanned epidermis lets through to the
    dermis, relative to the untanned one: its logarithm is straight in melanin and in thickness
    within .02 up to twice the melanin.

    Parameters
    ----------
    model
        As in `hylios.tissue.Stack.of`.

    Raises
    ------
    InputError
        If that is no skin, or it cannot be solved (`hylios.adding.solve`).

    Examples
    --------
    Blood of the dermis a day after 2 MED, relative to its own:

    >>> from dataclasses import replace
    >>> import hylios
    >>> skin = replace(hylios.skin_type("II"), thickening="epidermis")
    >>> exposures = hylios.Exposures([0], [2 * skin.med])
    >>> state = skin.states(exposures, times=[24], erythema=hylios.erythema(skin))[0]
    >>> print(f"{state[4]:.1f} times")
    3.2 times
    """
    if not isinstance(skin, Skin):
        raise InputError(
            f"the skin is {str(skin)[:60]!r}; expected a Skin, such as hylios.skin_type('II')."
        )
    return _erythema(skin, model or Model())


@lru_cache(maxsize=64)
def _erythema(skin: Skin, model: Model) -> ErythemaDynamics:
    melanin, thickness = _shield(skin, model)
    return replace(
        ErythemaDynamics(),
        sensitivity=_sensitivity(skin, model),
        melanin_shield=melanin,
        thickness_shield=thickness,
    )


def _sensitivity(skin: Skin, model: Model) -> float:
    """Factor on the signals with which 1 MED is just seen after a day."""
    states = [[*skin.untanned_melanin, 1.0, blood] for blood in BLOODS]
    redness = lab(colours(skin, np.array(states), model=model).total)[:, 1]
    rise = np.maximum.accumulate(redness - redness[0])
    wanted = np.interp(JUST_SEEN, rise, BLOODS) if rise[-1] > JUST_SEEN else BLOODS[-1]
    wanted = max(float(wanted), BLOOD_AT_MED[0])
    usual = ErythemaDynamics()
    burns = Burns.of(Exposures([0], [1.0]), usual, 1.0)
    one = np.ones((1, 1))
    reached = burns.blood(one, one, one, np.array([0, DAY]))[-1, 0]

    def signal(blood: float) -> float:
        return (blood - 1.0) / (usual.added_blood + 1.0 - blood)

    return signal(wanted) / signal(float(reached))


def _shield(skin: Skin, model: Model) -> tuple[float, float]:
    """Logarithm by which the shield of the epidermis rises for each whole of melanin, thickness."""
    specimens = [skin.at([*(more * skin.untanned_melanin), thick]) for more, thick in TANS]
    through = solve([_epidermis(own, model) for own in specimens]).transmittance
    depth = -np.log(np.maximum(through, 1e-30))
    by_melanin, by_thickness = depth[1:] - depth[0]
    return (
        max(float(by_melanin) / (TANS[1][0] - 1.0), 0.0),
        max(float(by_thickness) / (TANS[2][1] - 1.0), 0.0),
    )


def _epidermis(specimen: Specimen, model: Model) -> Stack:
    """Corneum and epidermis alone, over a dermis that returns nothing."""
    whole = Stack.of(specimen, ERYTHEMAL_NM, model)
    count = 1 + len(EPIDERMIS)
    return replace(
        whole,
        layers=whole.layers[:count],
        lambertian_floor=False,
        index_below=whole.layers[count].refractive_index,
    )
