"""Ranges of the parameters of skin in living people, and their sources.

The ranges hold for thin skin (palms and soles have their own end, `thick`) of people who are well
or have a condition that shows in the skin: no melanin at all (vitiligo) is within them, and so are
smokers' blood and jaundice of the newborn. A number that no measurement supports is marked
ESTIMATE. "Thesis" is T. F. Chen's; its numbers in brackets are those of its bibliography. The
numbers and their sources stand in `physiology.toml`.
"""

import tomllib
from collections.abc import Mapping
from dataclasses import dataclass
from importlib.resources import files
from types import MappingProxyType


@dataclass(frozen=True)
class Physiology:
    """The physiological range of a parameter, in the parameter's unit.

    Attributes
    ----------
    low, high : float
        Both ends belong to the range.
    source : str
        Where the range comes from, with ESTIMATE where it is one.
    cited : str
        What the thesis cites for its own values, in table 6.1 or 6.2.
    thick : float, optional
        High end in palms and soles, where it is another.
    """

    low: float
    high: float
    source: str
    cited: str
    thick: float | None = None

    @property
    def most(self) -> float:
        """High end over all skin, palms and soles among it."""
        return self.high if self.thick is None else self.thick

    def holds(self, value: float) -> bool:
        """Whether a value lies within the range, or in that of palms and soles."""
        return self.low <= value <= self.most


MOST_EPIDERMAL_MELANIN = 0.43
"""Volume fraction of melanin in the whole epidermis of the darkest skin (thesis, section 3.4)."""


def _read() -> Mapping[str, Physiology]:
    text = files("hylios.skin").joinpath("physiology.toml").read_text(encoding="utf-8")
    ranges = tomllib.loads(text)
    shared = ranges.pop("sources")
    return MappingProxyType(
        {
            name: Physiology(**{**told, "source": shared.get(told["source"], told["source"])})
            for name, told in ranges.items()
        }
    )


PHYSIOLOGY: Mapping[str, Physiology] = _read()
"""The physiological range of every numeric parameter of `hylios.skin.specimen.Specimen` by name."""
