"""Regions of skin: how cheeks, palms, freckles and others differ from the skin around them.

A region of weight w (its strength times its mask) has the melanin exp(u (1 + (t - 1) min(w, 1)))
f^w, where u is the tan around it as a logarithm, f the region's `melanin` and t its `tan`; without
melanin (f = 0) f^w is 1 - w. Blood, and what the tissue below reflects, are changed by their
factors to the power w; the sun's redness is that around the region times its tan's share t, at most
all: what does not tan does not redden. Regions that lie over each other multiply. numpy only.

`sites.csv` has what `hylios.lab.site_fits` fitted to people, `regions.csv` the rest and the marks.
"""

from collections.abc import Mapping
from dataclasses import dataclass, replace
from functools import cache
from types import MappingProxyType

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hylios.errors import InputError, require_range
from hylios.packaged import texts_of
from hylios.skin.physiology import MOST_EPIDERMAL_MELANIN
from hylios.skin.skin import MOST_BLOOD, flushed
from hylios.skin.specimen import EPIDERMIS, Specimen, require_specimen

DARK_GROUP = "AF"
"""Group of `sites.csv` whose skin is dark; all others are light."""

MOST_BELOW = 99.9
"""Most that the tissue below the dermis reflects, in %."""

MOST_WEIGHT = 10.0
"""Largest weight of a region."""

UM = 1e-4
"""A micrometre in cm."""


@dataclass(frozen=True)
class Site:
    """What people's skin is like at a site of the body, over their inner arm.

    Attributes
    ----------
    group, name : str
    subjects : int
    arm_melanin : float
        Of the group's inner arm, % of the epidermis.
    melanin, blood, below : float
        As `Region` has them; in light skin and in dark skin they are geometric means over groups.
    rmse, ciede2000 : float
        By which a skin of these three numbers misses what was measured, 400 to 700 nm.
    oxygenation, free_rmse : float
        Oxygenated share of all blood in %, and the misfit, where both are fitted freely.
    """

    group: str
    name: str
    subjects: int
    arm_melanin: float
    melanin: float
    blood: float
    below: float
    rmse: float
    ciede2000: float
    oxygenation: float
    free_rmse: float


@dataclass(frozen=True)
class Region:
    """How a region differs from the skin around it, at weight 1.

    Attributes
    ----------
    melanin, blood, below : float
        Over those around it, without sun; `below` is what the tissue below the dermis reflects.
    tan : float
        Logarithm of the melanin that sun adds, over that around it.
    corneum : float
        Least thickness of the corneum in um, 0 for that around it.
    marks : mapping of str to str
        By name of a number: A of a publication, F fitted to spectra, E an estimate, - no change.
    """

    melanin: float
    blood: float
    below: float
    tan: float
    corneum: float
    marks: Mapping[str, str]

    @property
    def is_estimate(self) -> bool:
        """Whether one of its numbers is."""
        return "E" in self.marks.values()

    def of_state(
        self, u: ArrayLike, b: ArrayLike, weight: ArrayLike = 1.0
    ) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
        """Melanin over that of untanned skin, and logarithm of blood, of the region.

        Parameters
        ----------
        u, b : arrays
            Logarithms of melanin and blood around it, over those without sun.
        """
        u, b, weight = (np.asarray(values, float) for values in (u, b, weight))
        melanin = np.exp(self.own_tan(u, weight)) * self._more_melanin(weight)
        redness = b * np.minimum(self.own_tan(1.0, weight), 1.0)
        return melanin, redness + weight * np.log(self.blood)

    def own_tan(self, u: ArrayLike, weight: ArrayLike = 1.0) -> NDArray[np.float64]:
        """Logarithm of the melanin that sun has added, where it is u around the region."""
        return np.asarray(u) * (1.0 + (self.tan - 1.0) * np.minimum(weight, 1.0))

    def own_states(self, states: ArrayLike, weight: float = 1.0) -> NDArray[np.float64]:
        """States (N, 5) of the skin around the region with the tan and redness of the region.

        `of` makes the region's specimens of those in them. Melanin keeps its places.

        Parameters
        ----------
        states : (N, 4) or (N, 5) array
            Of the skin around it, as `hylios.Skin.at` takes them.

        Examples
        --------
        >>> import hylios
        >>> from hylios.skin.regions import region
        >>> skin = hylios.skin_type("II")
        >>> tanned = skin.states(hylios.Exposures([0], [11.0]), [240.0])
        >>> mole = region("moles", skin.specimen.pigmentation)
        >>> float(mole.own_states(tanned)[0, :3].sum().round(6))
        1.0
        """
        around = np.atleast_2d(np.asarray(states, float))
        own = np.ones((len(around), 5))
        own[:, : around.shape[1]] = around
        total = own[:, :3].sum(axis=1, keepdims=True)
        tan = np.log(np.where(total > 0.0, total, 1.0))
        own[:, :3] *= np.exp(self.own_tan(tan, weight) - tan)
        own[:, 4] **= np.minimum(self.own_tan(1.0, weight), 1.0)
        return own

    def of(self, specimen: Specimen, weight: float = 1.0) -> Specimen:
        """The specimen of the region where the skin around it is a specimen.

        What would be more melanin or blood than skin holds is held at the most; added blood is
        arterial (`hylios.skin.skin.flushed`).

        Parameters
        ----------
        specimen : Specimen
            Without a tan, or in that which the region has (`own_tan`).

        Raises
        ------
        InputError
            If that is no specimen, or the weight is out of range.

        Examples
        --------
        >>> import hylios
        >>> from hylios.skin.regions import region
        >>> skin = hylios.specimen("II")
        >>> palm = region("palms", skin.pigmentation).of(skin)
        >>> palm.corneum_thickness
        0.0173
        """
        require_specimen(specimen)
        require_range("weight of the region", weight, 0.0, MOST_WEIGHT)
        blood = min(self.blood**weight, MOST_BLOOD)
        below = self.below**weight * specimen.hypodermis_reflectance
        corneum = self.corneum * UM * min(weight, 1.0)
        return replace(
            flushed(specimen, blood),
            **_melanin(specimen, float(self._more_melanin(np.array(weight)))),
            hypodermis_reflectance=min(below, max(MOST_BELOW, specimen.hypodermis_reflectance)),
            corneum_thickness=max(corneum, specimen.corneum_thickness),
        )

    def _more_melanin(self, weight: NDArray[np.float64]) -> NDArray[np.float64]:
        """Melanin over that of skin around it in the region's own tan."""
        if self.melanin == 0.0:
            return np.maximum(1.0 - weight, 0.0)
        return self.melanin**weight


def region(name: str, melanin: float) -> Region:
    """A region of skin by its name, in skin of so much melanin.

    Parameters
    ----------
    name : str
        One of `REGIONS`.
    melanin : float
        Of the skin without sun, as a share of the epidermis (`Specimen.pigmentation`). What was
        fitted to light and dark people is taken straight in between, in logarithms.

    Raises
    ------
    InputError
        If there is no region of that name, or no skin has so much melanin.
    """
    if name not in REGIONS:
        raise InputError(
            f"there is no region {str(name)[:60]!r} of skin; there are {', '.join(REGIONS)}."
        )
    require_range("melanin of the skin", melanin, 0.0, 1.0)
    row = _rows()[name]
    marks = {number: row[f"{number}_mark"] for number in NUMBERS}
    numbers = {number: float(row[number]) for number in NUMBERS if row[number]}
    if row["site"]:
        of_site, stands_in = _of_site(row["site"], melanin)
        numbers |= of_site
        marks |= dict.fromkeys(of_site, "E") if stands_in else {}
    return Region(**numbers, marks=MappingProxyType(marks))


NUMBERS = ("melanin", "blood", "below", "tan", "corneum")


def _of_site(site: str, melanin: float) -> tuple[dict[str, float], bool]:
    """Numbers of a site in skin of so much melanin, and whether lighter people's stand for them."""
    ends = [[it for it in sites() if (it.group == DARK_GROUP) == is_dark] for is_dark in (0, 1)]
    anchors = [np.mean([np.log(it.arm_melanin) for it in end]) for end in ends]
    rows = [[it for it in end if it.name == site] for end in ends]
    light, dark = (
        [np.mean([np.log(getattr(it, name)) for it in some or rows[0]]) for name in NUMBERS[:3]]
        for some in rows
    )
    place = np.log(max(100.0 * melanin, 1e-6))
    part = float(np.clip((place - anchors[0]) / (anchors[1] - anchors[0]), 0.0, 1.0))
    between = np.exp(np.array(light) * (1.0 - part) + np.array(dark) * part)
    darkest = max(it.arm_melanin for it in sites() if it.name == site)
    stands_in = not rows[1] and 100.0 * melanin > darkest
    return dict(zip(NUMBERS, map(float, between), strict=False)), stands_in


def _melanin(specimen: Specimen, factor: float) -> dict[str, float]:
    """The specimen's melanin by parameters, times a factor as far as skin holds so much."""
    if specimen.pigmentation > 0.0:
        factor = min(factor, max(MOST_EPIDERMAL_MELANIN / specimen.pigmentation, 1.0))
    changes = {}
    for layer, content in zip(reversed(EPIDERMIS), specimen.melanin, strict=True):
        held = min(factor, 1.0 / content) if content > 0.0 else factor
        for form in ("melanosomes", "colloidal_melanin"):
            changes[f"{layer}_{form}"] = held * getattr(specimen, f"{layer}_{form}")
    return changes


@cache
def sites() -> tuple[Site, ...]:
    """What was fitted to people, by group and site, from `sites.csv`."""
    return tuple(
        Site(
            group=row["group"],
            name=row["site"],
            subjects=int(row["subjects"]),
            **{name: float(value) for name, value in row.items() if name not in _TEXTS},
        )
        for row in texts_of("hylios.skin", "sites.csv")
    )


_TEXTS = ("group", "site", "subjects")


@cache
def _rows() -> dict[str, dict[str, str]]:
    return {row["region"]: row for row in texts_of("hylios.skin", "regions.csv")}


REGIONS: tuple[str, ...] = tuple(_rows())
"""Names of the regions of skin."""
