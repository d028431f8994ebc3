"""Tanning over time: melanin and thickness of the epidermis after ultraviolet doses.

Chapter 5 of the thesis, in steps of one hour. Doses are in SED (1 SED = 100 J/m^2 at 298 nm),
times in hours. Layers are ordered as the thesis numbers them: basale, spinosum, granulosum. numpy
only.
"""

from hylios.tanning.darkening import ImmediateDarkening
from hylios.tanning.dynamics import (
    PIGMENTATIONS,
    TYPICAL_PIGMENTATION,
    MelaninDynamics,
    ThicknessDynamics,
    minimal_erythema_dose,
    minimal_melanogenesis_dose,
)
from hylios.tanning.erythema import Burns, ErythemaDynamics
from hylios.tanning.exposures import LARGEST_DOSE, LONGEST_HOURS, Exposures
from hylios.tanning.kinetics import KINETICS, Kinetics
from hylios.tanning.measured import MeasuredDynamics
from hylios.tanning.peeling import (
    BLISTERING,
    Peeling,
    first_blistering_day,
    peeled_shares,
    without_peeled,
)
from hylios.tanning.simulation import hill, simulate, simulate_in_parts, states_at
from hylios.tanning.spread import Spread, spread_of, usual_thickness
from hylios.tanning.tanning_history import TanningHistory

__all__ = [
    "BLISTERING",
    "KINETICS",
    "LARGEST_DOSE",
    "LONGEST_HOURS",
    "PIGMENTATIONS",
    "TYPICAL_PIGMENTATION",
    "Burns",
    "ErythemaDynamics",
    "Exposures",
    "ImmediateDarkening",
    "Kinetics",
    "MeasuredDynamics",
    "MelaninDynamics",
    "Peeling",
    "Spread",
    "TanningHistory",
    "ThicknessDynamics",
    "first_blistering_day",
    "hill",
    "minimal_erythema_dose",
    "minimal_melanogenesis_dose",
    "peeled_shares",
    "simulate",
    "simulate_in_parts",
    "spread_of",
    "states_at",
    "usual_thickness",
    "without_peeled",
]
