"""A skin's table with another biology, at once: nearly what building it anew would give.

More melanin or blood is another place on the table's axes. All other change is solved for a few
states that tans lead through, and the table is multiplied by polynomials that have gone through
the logarithm of what they are off. Near share and far width are those at the other place: they
follow from a random walk only. numpy only.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields, replace

import numpy as np
from numpy.typing import ArrayLike, NDArray

from hylios.adding import spectra
from hylios.errors import InputError, as_numbers
from hylios.quadrature import skin_quadrature
from hylios.skin import Skin
from hylios.skin.biology import Biology
from hylios.skin.skin import MOST_BLOOD
from hylios.skin.specimen import Specimen
from hylios.table.axes import LookAxes
from hylios.table.provenance import own_spectra, skin_of
from hylios.table.skin_table import SkinTable
from hylios.tanning.spread import Spread, spread_of
from hylios.tissue import Model

COLOUR, TOTAL, WET = "subsurface_colour", "total_colour", "wet_subsurface_colour"
BANDS = "band_reflectance"
ANGLES = (8.0, 45.0, 60.0, 70.0)
WAVELENGTHS = 8

FRECKLE = 0.95
"""How far a table's last knot of melanin lies beyond what tans reach, in the logarithm, about."""

FAINTEST = 1e-5
"""Least colour of which the logarithm is taken."""

RIDGE = 1e-6
"""Weight of the coefficients, squared, for each state."""


PLACES = np.array(
    [
        *((x, 0.5, 0.0) for x in (-1.0, -0.7, 0.0, 0.7, 1.0)),
        (-0.3, 0.0, 0.0),
        (0.8, 0.0, 0.0),
        (0.8, 1.0, 0.0),
        *((x, 0.5, z) for x in (-0.8, 0.8) for z in (0.45, 1.0)),
    ]
)
"""States that are solved, by x, y and z: x from -1 to 1 of melanin's square root, y of the
thickness that skin reaches with so much melanin, z of the logarithm of blood, from 0 to 1."""

OWN_BLOOD = ((0, 0, 0), (1, 0, 0), (2, 0, 0), (3, 0, 0), (0, 1, 0), (1, 1, 0))
MORE_BLOOD = ((0, 0, 1), (0, 0, 2), (1, 0, 1), (1, 0, 2))
"""Powers of x, y and z in the polynomials: of skin with its own blood, and of what more adds."""

OWN = 8
"""How many of the states have the skin's own blood; they come first."""

LEAST_ROOT = 0.85
"""Square root of melanin at x of -1, relative to the skin's without sun."""

PALE_ROOT = 0.25
"""Square root of the melanin of paler skin that is solved."""


@dataclass(frozen=True, eq=False)
class Correction:
    """By what a changed table's planes are multiplied.

    Attributes
    ----------
    low, high : float
        Square roots of the melanin at x of -1 and 1.
    thickest, bloodiest : float
        Logarithms of thickness and blood at y and z of 1.
    beyond : (B,) array
        Square roots of melanin below and above these, ascending, in the order of `ends`.
    coefficients : mapping of names to (T, components) arrays
        Of the planes' logarithms; the later terms may be left out.
    ends : mapping of names to (B, components) arrays
        What is added to the polynomials' logarithm there, and straight in between.
    """

    low: float
    high: float
    thickest: float
    bloodiest: float
    beyond: NDArray[np.float64]
    coefficients: Mapping[str, NDArray[np.float64]] = field(default_factory=dict)
    ends: Mapping[str, NDArray[np.float64]] = field(default_factory=dict)

    def terms(
        self, coordinates: np.ndarray, powers: Sequence[tuple[int, int, int]]
    ) -> NDArray[np.float64]:
        """The terms (..., T) at coordinates (..., 4) on a table's axes."""
        melanin, thickness, _, blood = np.moveaxis(coordinates, -1, 0)
        root = np.clip(np.exp(0.5 * melanin), self.low, self.high)
        x = 2.0 * (root - self.low) / (self.high - self.low) - 1.0
        y = np.clip(thickness / self.thickest, 0.0, 1.0)
        z = np.clip(blood / self.bloodiest, 0.0, 1.0)
        return np.stack([x**i * y**j * z**k for i, j, k in powers], axis=-1)

    def factors(self, coordinates: np.ndarray) -> dict[str, NDArray[np.float64]]:
        """Factors (..., components) of planes by name, at coordinates (..., 4)."""
        terms = self.terms(coordinates, (*OWN_BLOOD, *MORE_BLOOD))
        weights = self.weights(coordinates)
        logarithms = {name: terms[..., : len(own)] @ own for name, own in self.coefficients.items()}
        for name, ends in self.ends.items():
            logarithms[name] += weights @ ends
        return {name: np.exp(logarithm) for name, logarithm in logarithms.items()}

    def weights(self, coordinates: np.ndarray) -> NDArray[np.float64]:
        """Weights (..., B) of `ends` at coordinates (..., 4): 0 where the polynomials hold."""
        root = np.exp(0.5 * coordinates[..., 0])
        knots = np.sort([*self.beyond, self.low, self.high])
        return np.stack(
            [np.interp(root, knots, (knots == own).astype(float)) for own in self.beyond], axis=-1
        )


@dataclass(frozen=True)
class ChangedTable(SkinTable):
    """A skin's table with another biology; looked up as any other.

    Its `planes` are the skin's own.

    Attributes
    ----------
    table : SkinTable
        The skin's own.
    melanin, blood : float
        How much more of both there is in the skin without sun.
    correction : Correction or None
    """

    table: SkinTable = field(kw_only=True)
    melanin: float = field(kw_only=True)
    blood: float = field(kw_only=True)
    correction: Correction | None = None

    def lookup(
        self, states: ArrayLike, names: Sequence[str] | None = None
    ) -> dict[str, NDArray[np.float64]]:
        """As `SkinTable.lookup`."""
        states = np.array(as_numbers("tanning states", states))
        planes = self.table.lookup(self._moved(states), names)
        if self.correction is not None:
            factors = self.correction.factors(self.axes.coordinates(states))
            for name in planes:
                if name in factors:
                    planes[name] = planes[name] * factors[name]
        return planes

    def _moved(self, states: np.ndarray) -> np.ndarray:
        """States of the skin itself that look nearly as those of the changed skin."""
        if states.shape[-1] == 4:
            states = np.concatenate([states, np.ones((*states.shape[:-1], 1))], axis=-1)
        moved = states.copy()
        moved[..., :3] *= self.melanin
        if self.blood > 1.0:
            # what lies beyond the table's most blood is squeezed into it, without a bend
            least = np.log(self.blood)
            shrunk = 1.0 - least / np.log(MOST_BLOOD)
            moved[..., 4] = np.exp(least + shrunk * np.log(states[..., 4]))
        return moved


def changed_table(
    table: SkinTable, biology: Biology, *, rough: bool = False, bands: bool = False
) -> SkinTable:
    """A skin's table with another biology; the table itself where nothing changes.

    The skin keeps its kinetics, its sensitivity to the sun and what it absorbs of ultraviolet.

    Parameters
    ----------
    rough : bool
        Whether to solve only tans with the skin's own blood, in half the time. Flushed skin,
        freckles and skin far paler are then changed as those are.
    bands : bool
        Whether the reflectance at single wavelengths is solved too; without, it is that of
        another place on the table.

    Raises
    ------
    InputError
        If the table is of an early format, was made with spectra of the user's own, or does not
        describe its skin.
    """
    if not isinstance(table.axes, LookAxes):
        raise InputError(
            "the table has axes of an earlier format; biology needs a table built by this version."
        )
    if own_spectra(table.provenance):
        raise InputError(
            "the table was made with spectra of one's own, which it does not hold; build it anew "
            "with another biology."
        )
    skin = skin_of(table.provenance)
    specimen = biology.of(skin.specimen)
    if specimen == skin.specimen:
        return table
    moved = ChangedTable(
        **{one.name: getattr(table, one.name) for one in fields(SkinTable)},
        table=table,
        melanin=min(_ratio(specimen, skin.specimen), np.exp(FRECKLE)),
        blood=specimen.papillary_blood / skin.specimen.papillary_blood,
    )
    changed = replace(skin, specimen=specimen)
    return replace(
        moved,
        provenance={**table.provenance, "specimen_parameters": vars(specimen)},
        correction=_correction(moved, changed, rough, bands),
    )


def _ratio(one: Specimen, other: Specimen) -> float:
    """How much more melanin there is in a specimen than in another."""
    held, own = (float(it.melanin @ it.epidermal_thickness) for it in (one, other))
    return held / own if own > 0.0 else 1.0


def _correction(moved: ChangedTable, changed: Skin, rough: bool, bands: bool) -> Correction:
    """What takes a table looked up at other places to the changed skin."""
    sheet = spread_of(changed.dynamics, mmd=changed.mmd, med=changed.med)
    top = float(moved.axes.knots[0][-1])
    high = max(float(np.exp(0.5 * (top - FRECKLE))), LEAST_ROOT + 0.1)
    correction = Correction(
        low=LEAST_ROOT,
        high=high,
        thickest=max(float(sheet.thicknesses[-1]), 0.01),
        bloodiest=float(np.log(MOST_BLOOD)),
        beyond=np.array([PALE_ROOT, *_freckles(high, top - np.log(max(moved.melanin, 1.0)), top)]),
    )
    states = _states(correction, sheet)[: OWN if rough else None]
    solved = _solved(changed, states, moved)
    if bands and BANDS in moved.planes:
        solved[BANDS] = _solved_bands(changed, states, moved)
    told = moved.lookup(states, list(solved))
    coordinates = moved.axes.coordinates(states)
    own, more = (correction.terms(coordinates, powers) for powers in (OWN_BLOOD, MORE_BLOOD))
    plain, blood, ends = slice(0, OWN), slice(OWN, len(PLACES)), slice(len(PLACES), None)
    coefficients, beyond = {}, {}
    for name in solved:
        off = np.log(np.maximum(solved[name], FAINTEST) / np.maximum(told[name], FAINTEST))
        coefficients[name] = _fitted(own[plain], off[plain])
        if not rough:
            off = off - own @ coefficients[name]
            added = _fitted(more[blood], off[blood])
            coefficients[name] = np.concatenate([coefficients[name], added])
            beyond[name] = off[ends]
    if WET in moved.planes and COLOUR in coefficients:
        coefficients[WET] = coefficients[COLOUR]
        beyond |= {WET: beyond[COLOUR]} if COLOUR in beyond else {}
    return replace(correction, coefficients=coefficients, ends=beyond)


def _freckles(high: float, last: float, top: float) -> list[float]:
    """Square roots of melanin beyond what tans reach.

    One is the table's last, another where melanin moved by the change leaves the table.
    """
    end = max(float(np.exp(0.5 * top)), high + 0.1)
    bend = float(np.exp(0.5 * last))
    return [bend, end] if high + 0.02 < bend < end - 0.02 else [end]


def _fitted(terms: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Coefficients (T, components) with which terms (N, T) come nearest to values."""
    normal = terms.T @ terms + RIDGE * len(terms) * np.eye(terms.shape[1])
    return np.linalg.solve(normal, terms.T @ values)


def _states(correction: Correction, sheet: Spread) -> np.ndarray:
    """States (N, 5) that tans lead through, at `PLACES`, and those beyond."""
    x, y, z = PLACES.T
    roots = correction.low + 0.5 * (x + 1.0) * (correction.high - correction.low)
    melanin = 2.0 * np.log(np.concatenate([roots, correction.beyond]))
    middle = np.full(len(correction.beyond), 0.5)
    thickness = np.concatenate([y, middle]) * np.interp(melanin, sheet.least, sheet.thicknesses)
    blood = np.concatenate([z * correction.bloodiest, 0.0 * middle])
    return sheet.states(melanin, thickness, blood)


def _angles(table: SkinTable) -> dict[str, tuple[str, int]]:
    """Planes of colours in a table: what of the light they hold, and the number of their angle."""
    planes = {TOTAL: ("total", 0), f"{TOTAL}_45": ("total", 1), COLOUR: ("subsurface", 0)}
    planes |= {
        f"{COLOUR}_{angle:g}": ("subsurface", number + 1) for number, angle in enumerate(ANGLES[1:])
    }
    return {name: light for name, light in planes.items() if name in table.planes}


def _solved(changed: Skin, states: np.ndarray, table: SkinTable) -> dict[str, np.ndarray]:
    """Colours (N, 3) of states by the name of their plane."""
    quadrature = skin_quadrature(WAVELENGTHS)
    light = spectra(
        [changed.at(state) for state in states],
        quadrature.wavelengths,
        angle=ANGLES,
        model=_model(table),
    )
    return {
        name: getattr(light, what)[number] @ quadrature.weights.T
        for name, (what, number) in _angles(table).items()
    }


def _solved_bands(changed: Skin, states: np.ndarray, table: SkinTable) -> np.ndarray:
    """Reflectance (N, B) of states at the wavelengths of the table's bands."""
    return spectra(
        [changed.at(state) for state in states], table.provenance["bands_nm"], model=_model(table)
    ).total


def _model(table: SkinTable) -> Model:
    return Model(readings=table.provenance.get("readings", {}))
