"""The ways in which melanin may follow the sun, by name."""

from types import MappingProxyType

from hylios.tanning.dynamics import MelaninDynamics
from hylios.tanning.measured import MeasuredDynamics

KINETICS = MappingProxyType(
    {
        "thesis": "chapter 5 of the thesis",
        "measured": "fitted to how people's tans come and go; ESTIMATE between what was measured",
    }
)
"""What a skin's melanin follows, by name."""

Kinetics = MelaninDynamics | MeasuredDynamics
"""The dynamics of either."""
