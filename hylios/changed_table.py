"""A skin's table with another biology, at once: nearly what building it anew would give.

More melanin or blood is another place on the table's axes. A few tans are solved and tell all
others (`hylios.tan_fit`). Of paler, flushed and freckled skin a few states more are solved: it
differs from the nearest tan as at the other place of the table, times polynomials that have gone
through the logarithm of what that is off. Near share and far width are those at the other place:
they follow from a random walk only. numpy only.
"""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, fields, replace

import numpy as np
from numpy.typing import NDArray

from hylios.adding import spectra
from hylios.errors import InputError
from hylios.quadrature import skin_quadrature
from hylios.skin import Skin
from hylios.skin.biology import Biology
from hylios.skin.skin import MOST_BLOOD
from hylios.skin.specimen import Specimen
from hylios.table.axes import LookAxes
from hylios.table.provenance import own_spectra, skin_of
from hylios.table.skin_table import SkinTable
from hylios.tan_fit import LEAST_SPAN, PLACES, TanFit
from hylios.tanning.spread import spread_of
from hylios.threads import one_thread
from hylios.tissue import Model

COLOUR, TOTAL, WET = "subsurface_colour", "total_colour", "wet_subsurface_colour"
BANDS = "band_reflectance"
LIKE = {WET: COLOUR}
"""Planes that change as another does."""

ANGLES = (8.0, 45.0, 60.0, 70.0)
WAVELENGTHS = 10

FRECKLE = 0.95
"""How far a table's last knot of melanin lies beyond what tans reach, in the logarithm, about."""

FAINTEST = 1e-5
"""Least colour of which the logarithm is taken."""

FLUSHED = np.array([(x, z) for x in (-0.8, 0.8) for z in (0.45, 1.0)])
"""States with more blood that are solved: x as in `hylios.tan_fit.PLACES`, and z from 0 to 1 of the
logarithm of blood. They are half as thick as skin with so much melanin gets."""

MORE_BLOOD = ((0, 1), (0, 2), (1, 1), (1, 2))
"""Powers of x and z in the polynomials."""

PALEST_ROOT, PALE_ROOT = 0.25, 0.7
"""Square roots of the melanin of paler skin that is solved, relative to the skin's without sun."""

BLOODIEST = float(np.log(MOST_BLOOD))


@dataclass(frozen=True, eq=False)
class Correction:
    """What a changed table's planes are instead of those at another place.

    Attributes
    ----------
    tans : TanFit
        Logarithms of the planes of tans with the skin's own blood.
    beyond : (B,) array
        Square roots of melanin below and above those of tans, ascending, in the order of `ends`.
    blood : mapping of names to (T, components) arrays
        Coefficients of `MORE_BLOOD`, of what is added to the logarithms with more blood.
    ends : mapping of names to (B, components) arrays
        What is added to the logarithms at the melanin of `beyond`, and straight in between.

    A rough one has no `blood`, and of `beyond` only pale skin.
    """

    tans: TanFit
    beyond: NDArray[np.float64]
    blood: Mapping[str, NDArray[np.float64]] = field(default_factory=dict)
    ends: Mapping[str, NDArray[np.float64]] = field(default_factory=dict)

    def terms(self, coordinates: np.ndarray) -> NDArray[np.float64]:
        """The terms (..., T) of `blood` at coordinates (..., 4) on a table's axes."""
        x = self.tans.x(coordinates[..., 0])
        z = np.clip(coordinates[..., 3] / BLOODIEST, 0.0, 1.0)
        return np.stack([x**i * z**k for i, k in MORE_BLOOD], axis=-1)

    def weights(self, coordinates: np.ndarray) -> NDArray[np.float64]:
        """Weights (..., B) of `ends` at coordinates (..., 4): 0 among tans."""
        root = np.exp(0.5 * coordinates[..., 0])
        knots = np.sort([*self.beyond, 1.0, self.tans.high])
        return np.stack(
            [np.interp(root, knots, (knots == own).astype(float)) for own in self.beyond], axis=-1
        )

    def added(self, coordinates: np.ndarray) -> dict[str, NDArray[np.float64]]:
        """What is added to logarithms (..., components) by name, at coordinates (..., 4)."""
        weights = self.weights(coordinates)
        sums = {name: weights @ own for name, own in self.ends.items()}
        if self.blood:
            terms = self.terms(coordinates)
            sums = {name: own + terms @ self.blood[name] for name, own in sums.items()}
        return sums


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

    def at(
        self, coordinates: np.ndarray, names: tuple[str, ...], blood: np.ndarray | None = None
    ) -> dict[str, NDArray[np.float64]]:
        """As `SkinTable.at`."""
        own = None if blood is None else self._moved_blood(blood)
        planes = self.table.at(self._moved(coordinates), names, own)
        for name, factor in self._factors(coordinates, names, blood).items():
            planes[name] = planes[name] * factor
        return planes

    def _factors(
        self, coordinates: np.ndarray, names: Sequence[str], blood: np.ndarray | None
    ) -> dict[str, NDArray[np.float64]]:
        """By what planes (..., components) at the other place are to be multiplied."""
        if self.correction is None:
            return {}
        tans = self.correction.tans
        sources = {name: LIKE.get(name, name) for name in names}
        solved = tuple(sorted({*sources.values()} & {*tans.coefficients}))
        if not solved:
            return {}
        nearest = tans.nearest(coordinates[..., 0], coordinates[..., 1])
        # as complex numbers they are sorted faster than as rows
        pairs = np.ascontiguousarray(nearest).view(np.complex128)[..., 0]
        distinct, which = np.unique(pairs, return_inverse=True)
        distinct, which = distinct.view(float).reshape(-1, 2), which.reshape(pairs.shape)
        there = self.axes.coordinates(tans.states(distinct))
        elsewhere = self.table.at(self._moved(there), solved)
        right = tans.numbers(distinct)
        if blood is not None:
            which = np.repeat(which[..., None], blood.size, axis=-1)
            coordinates = np.repeat(coordinates[..., None, :], blood.size, axis=-2)
            coordinates[..., 3] = blood
        added = self.correction.added(coordinates)
        factors = {}
        for name in solved:
            factor = np.exp(right[name]) / np.maximum(elsewhere[name], FAINTEST)
            factors[name] = factor[which] * np.exp(added.get(name, 0.0))
        return {name: factors[source] for name, source in sources.items() if source in factors}

    def _moved(self, coordinates: np.ndarray) -> np.ndarray:
        """Coordinates of the skin's own states that look nearly as those of the changed skin."""
        moved = np.array(coordinates)
        moved[..., 0] += np.log(self.melanin)
        moved[..., 3] = self._moved_blood(moved[..., 3])
        # where both sheets are as good as one, a place on either counts as on the first
        return self.axes.coordinates(self.axes.states(moved))

    def _moved_blood(self, blood: np.ndarray) -> np.ndarray:
        """Logarithms of the skin's own blood that look nearly as those of the changed skin."""
        if self.blood <= 1.0:
            return blood
        # what lies beyond the table's most blood is squeezed into it, without a bend
        least = np.log(self.blood)
        return least + (1.0 - least / np.log(MOST_BLOOD)) * blood


def changed_table(
    table: SkinTable,
    biology: Biology,
    *,
    kinetics: str = "thesis",
    rough: bool = False,
    bands: bool = False,
) -> SkinTable:
    """A skin's table with another biology; the table itself where nothing changes.

    The skin keeps its kinetics, its sensitivity to the sun and what it absorbs of ultraviolet.

    Parameters
    ----------
    kinetics : str
        By which the tans come about that are looked up (`hylios.tanning.KINETICS`): the table is
        changed most closely where they lie.
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
        describe its skin, or there is no such kinetics.
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
    skin = replace(skin_of(table.provenance), kinetics=kinetics)
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
    with one_thread():
        correction = _correction(moved, changed, rough, bands)
    return replace(
        moved,
        provenance={**table.provenance, "specimen_parameters": vars(specimen)},
        correction=correction,
    )


def _ratio(one: Specimen, other: Specimen) -> float:
    """How much more melanin there is in a specimen than in another."""
    held, own = (float(it.melanin @ it.epidermal_thickness) for it in (one, other))
    return held / own if own > 0.0 else 1.0


def _correction(moved: ChangedTable, changed: Skin, rough: bool, bands: bool) -> Correction:
    """What takes a table looked up at other places to the changed skin."""
    sheet = spread_of(changed.melanin_kinetics, mmd=changed.mmd, med=changed.med)
    top = float(moved.axes.knots[0][-1])
    high = 1.0 + max(float(np.exp(0.5 * (top - FRECKLE))) - 1.0, LEAST_SPAN)
    tans = TanFit(changed, sheet, high)
    last = top - np.log(max(moved.melanin, 1.0))
    beyond = [PALE_ROOT] if rough else [PALEST_ROOT, PALE_ROOT, *_freckles(high, last, top)]
    flushed = FLUSHED[:0] if rough else FLUSHED
    correction = Correction(tans, np.array(beyond))
    states = np.concatenate([tans.states(tans.tans(PLACES)), _others(correction, flushed)])
    solved = _solved(changed, states, moved)
    if bands and BANDS in moved.planes:
        solved[BANDS] = _solved_bands(changed, states, moved)
    logarithms = {name: np.log(np.maximum(own, FAINTEST)) for name, own in solved.items()}
    fitted = tans.fitted({name: own[: len(PLACES)] for name, own in logarithms.items()})
    correction = replace(correction, tans=fitted)
    others = states[len(PLACES) :]
    told = replace(moved, correction=correction).lookup(others, list(solved))
    off = {
        name: own[len(PLACES) :] - np.log(np.maximum(told[name], FAINTEST))
        for name, own in logarithms.items()
    }
    correction = replace(correction, ends={name: own[len(flushed) :] for name, own in off.items()})
    if rough:
        return correction
    terms = correction.terms(moved.axes.coordinates(others[: len(flushed)]))
    blood = {name: np.linalg.solve(terms, own[: len(flushed)]) for name, own in off.items()}
    return replace(correction, blood=blood)


def _freckles(high: float, last: float, top: float) -> list[float]:
    """Square roots of melanin beyond what tans reach.

    One is the table's last, another where melanin moved by the change leaves the table.
    """
    end = max(float(np.exp(0.5 * top)), high + 0.1)
    bend = float(np.exp(0.5 * last))
    return [bend, end] if high + 0.02 < bend < end - 0.02 else [end]


def _others(correction: Correction, flushed: np.ndarray) -> np.ndarray:
    """States (N, 5) besides tans: flushed, of x and z (M, 2) as in `FLUSHED`, and those beyond."""
    tans = correction.tans
    x, z = flushed.T
    more = tans.tans(np.stack([x, np.full_like(x, 0.5)], axis=-1))
    melanin = 2.0 * np.log(correction.beyond)
    thickness = 0.5 * np.interp(melanin, tans.sheet.least, tans.sheet.thicknesses)
    return np.concatenate(
        [
            tans.sheet.states(more[:, 0], more[:, 1], z * BLOODIEST),
            tans.sheet.states(melanin, thickness),
        ]
    )


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
