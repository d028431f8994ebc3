"""Any tan of a skin from a few of them: kriging over how much melanin there is and how thick it is.

Numbers are linear in what a state means for the skin, plus what falls off with the distance to the
tans that were solved (universal kriging: N. Cressie, Statistics for Spatial Data, 1993, section
3.4). Melanin that a layer cannot hold is cut, which bends the look of the darkest skins; told by
the melanin that is left, it does not bend. numpy only.
"""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace

import numpy as np
from numpy.typing import NDArray

from hylios.skin import Skin
from hylios.tanning.spread import Spread

PLACES = np.array(
    [
        *((x, 0.0) for x in (-1.0, -0.25, 0.0, 0.5)),
        *((x, 0.25) for x in (0.5, 1.0)),
        *((x, 0.75) for x in (-0.75, 1.0)),
        *((x, 1.0) for x in (-0.5, 0.5)),
        (-0.6, 0.3),
        (0.0, 0.3),
        (0.5, 0.6),
    ]
)
"""Tans that are solved, by x and y: x from -1 to 1 of melanin's square root, y the share of the
thickness that skin reaches with so much melanin. An exchange among 45 places led to the first ten,
for types II to VI with twelve random settings of the biology; the last three are where type VI,
whose melanin spreads otherwise while a tan rises, was farthest off (.07 CIEDE2000, now .02)."""

LENGTHS = (1.2, 2.4)
"""Distances of x, and of thickness from -1 to 1, over which the look is alike."""

NUGGET, FLAT = 1e-4, 1e-6
"""What is added to the covariances of a tan with itself, and taken for how little is known of the
linear part."""

LEAST_SPAN = 0.1
"""Least span of melanin's square root that is told apart."""

NO_MELANIN = 1e-12
"""Melanin of a layer, of the skin's, below which there is none."""


@dataclass(frozen=True, eq=False)
class TanFit:
    """Numbers of a skin's tans, by the natural logarithms of melanin (u) and thickness (v).

    Attributes
    ----------
    skin : Skin
    sheet : Spread
        Of its kinetics.
    high : float
        Square root of the most melanin that tans reach.
    coefficients : mapping of names to (T, components) arrays
        Of `terms`.
    """

    skin: Skin
    sheet: Spread
    high: float
    coefficients: Mapping[str, NDArray[np.float64]] = field(default_factory=dict)

    @property
    def span(self) -> float:
        """Span of melanin's square root from the skin without sun to the darkest tan."""
        return max(self.high - 1.0, LEAST_SPAN)

    @property
    def thickest(self) -> float:
        """Largest v, above 0."""
        return max(float(self.sheet.thicknesses[-1]), 0.01)

    def x(self, melanin: np.ndarray) -> NDArray[np.float64]:
        """Place from -1 to 1 of u (...) among tans; the nearest, where it is none's."""
        return 2.0 * (np.exp(0.5 * self._within(melanin)) - 1.0) / self.span - 1.0

    def tans(self, places: np.ndarray) -> NDArray[np.float64]:
        """u and v (..., 2) at places x and y (..., 2) as in `PLACES`."""
        x, y = np.moveaxis(places, -1, 0)
        melanin = 2.0 * np.log(1.0 + 0.5 * (x + 1.0) * self.span)
        reached = np.interp(melanin, self.sheet.least, self.sheet.thicknesses)
        return np.stack([melanin, y * reached], axis=-1)

    def nearest(self, melanin: np.ndarray, thickness: np.ndarray) -> NDArray[np.float64]:
        """u and v (..., 2) of the tans nearest to others (...)."""
        return np.stack(
            [self._within(melanin), np.clip(thickness, 0.0, self.thickest)],
            axis=-1,
        )

    def states(self, tans: np.ndarray) -> NDArray[np.float64]:
        """Tanning states (..., 5) at u and v (..., 2)."""
        return self.sheet.states(tans[..., 0], tans[..., 1])

    def terms(self, tans: np.ndarray) -> NDArray[np.float64]:
        """What numbers are made of, (..., T), at u and v (..., 2)."""
        nodes, others = self._scaled(self.tans(PLACES)), self._scaled(tans)
        squared = ((others[..., None, :] - nodes) ** 2).sum(axis=-1)
        return np.concatenate([np.exp(-0.5 * squared), self._linear(tans)], axis=-1)

    def fitted(self, values: Mapping[str, np.ndarray]) -> "TanFit":
        """This with numbers (N, components) by name at `PLACES`."""
        terms = self.terms(self.tans(PLACES))
        count = len(terms)
        alike, linear = terms[:, :count], terms[:, count:]
        parts = linear.shape[1]
        whole = np.block(
            [[alike + NUGGET * np.eye(count), linear], [linear.T, -FLAT * np.eye(parts)]]
        )
        joined = np.concatenate(list(values.values()), axis=1)
        coefficients = np.linalg.solve(whole, np.pad(joined, ((0, parts), (0, 0))))
        ends = np.cumsum([own.shape[1] for own in values.values()])[:-1]
        return replace(
            self,
            coefficients=dict(zip(values, np.split(coefficients, ends, axis=1), strict=True)),
        )

    def numbers(self, tans: np.ndarray) -> dict[str, NDArray[np.float64]]:
        """Numbers (..., components) by name, at u and v (..., 2)."""
        terms = self.terms(tans)
        return {name: terms @ own for name, own in self.coefficients.items()}

    def _within(self, melanin: np.ndarray) -> np.ndarray:
        return np.clip(melanin, 0.0, 2.0 * np.log(1.0 + self.span))

    def _scaled(self, tans: np.ndarray) -> np.ndarray:
        places = [self.x(tans[..., 0]), 2.0 * tans[..., 1] / self.thickest - 1.0]
        return np.stack(places, axis=-1) / LENGTHS

    def _linear(self, tans: np.ndarray) -> np.ndarray:
        """1, melanin's square root, v, and how the melanin is spread: of what the layers hold."""
        states, specimen = self.states(tans), self.skin.specimen
        own = specimen.melanin @ specimen.epidermal_thickness
        held = self.skin.contents(states) * specimen.epidermal_thickness * states[..., 3, None]
        relative = held / max(own, NO_MELANIN) + NO_MELANIN
        return np.stack(
            [
                np.ones(tans.shape[:-1]),
                np.sqrt(relative.sum(axis=-1)),
                tans[..., 1],
                np.log(relative[..., 0] / relative[..., 1]),
            ],
            axis=-1,
        )
