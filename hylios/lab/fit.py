"""A specimen that reflects like measured skin: bounded least squares over some of its parameters.

What may change are single parameters, or groups of parameters that go up and down together
(`GROUPS`). A group has one unknown: the logarithm of the factor by which it differs from the
specimen where the fit starts. The physiological ranges bound it. Light comes from `hylios.adding`,
which has no noise and so has slopes.

Reflectance does not determine everything about skin: melanin and the thickness of the layer that
holds it, for one, act nearly as their product. So every unknown is also drawn weakly to its start
(Tikhonov's regularisation: as if `EXPECTED_SPREAD` of its range were its standard deviation among
people), and the result says how much of that spread the data leave.
"""

from collections.abc import Callable, Iterable, Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike, NDArray
from scipy.optimize import least_squares

from hylios.adding import spectra
from hylios.errors import InputError, as_numbers, require_range
from hylios.lab.free_parameters import USUAL, Unknowns, unknowns_of
from hylios.quadrature import skin_quadrature
from hylios.skin.specimen import Specimen, require_specimen
from hylios.threads import one_thread
from hylios.tissue import Model

DETERMINED = 0.5
"""The data determine an unknown where they leave less than this share of its expected spread."""

CONFOUNDED = 0.9
"""Correlation from which two unknowns are said to be told apart badly."""

STEP = 1e-4
"""Step of the unknowns from which slopes are taken."""

MARGIN = 0.05
"""Least distance of the start from the bounds, as a share of theirs; at a bound a fit is stuck."""

TOLERANCE, MOST_STEPS = 1e-4, 60
"""The fit ends when a step changes the misfit or the unknowns by less, or after so many."""

SPECTRAL_UNCERTAINTY = 0.01
"""Standard deviation in reflectance by which model and measurement are expected to differ."""

COLOUR_COUNT = 8
"""Wavelengths that a colour is computed from; they cost it .04 CIEDE2000 at most."""

COLOUR_UNCERTAINTY = 1.0
"""Standard deviation in L*a*b* by which model and measured colour are expected to differ."""

SOLVED_TOGETHER = 1024
"""Wavelengths of specimens that are solved at once, for memory."""

Advance = Callable[[int], object]

Observe = Callable[[Sequence[Specimen]], np.ndarray]
"""What would be measured of each specimen: (S, M) for M measured numbers."""


@dataclass(frozen=True)
class Free:
    """Result of a fit for one unknown.

    Attributes
    ----------
    name : str
        Of a group or a single parameter.
    factor : float
        Relative to the specimen that the fit started from.
    low, high : float
        Bounds of the factor.
    spread : float
        Standard deviation of the factor's logarithm, data and expectation together.
    left : float
        That, as a share of what was expected without data: 1 where the data say nothing.
    """

    name: str
    factor: float
    low: float
    high: float
    spread: float
    left: float

    @property
    def determined(self) -> bool:
        """Whether the data determine it: they leave little of what was open, off its bounds."""
        return self.left < DETERMINED and not self.at_bound

    @property
    def at_bound(self) -> bool:
        """Whether it lies at an end of its range, where the data may want it beyond."""
        return not 1.001 * self.low < self.factor < self.high / 1.001


@dataclass(frozen=True)
class Fit:
    """Result of a fit.

    Attributes
    ----------
    specimen : Specimen
    free : tuple of Free
    observed : (M,) array
        What would be measured of the specimen.
    residual : (M,) array
        That, minus what was measured.
    confounded : tuple of (str, str, float)
        Pairs of unknowns that the data tell apart badly, with their correlation.
    evaluations : int
        Specimens of which light was computed.
    """

    specimen: Specimen
    free: tuple[Free, ...]
    observed: NDArray[np.float64]
    residual: NDArray[np.float64]
    confounded: tuple[tuple[str, str, float], ...]
    evaluations: int

    @property
    def rmse(self) -> float:
        """Root of the mean squared residual."""
        return float(np.sqrt(np.mean(self.residual**2)))

    def remarks(self) -> list[str]:
        """What the data do not determine, a line each."""
        lines = []
        for unknown in self.free:
            if unknown.at_bound:
                lines.append(
                    f"{unknown.name} is at an end of its physiological range: "
                    f"{unknown.factor:.3g} times the start's, of {unknown.low:.3g} to "
                    f"{unknown.high:.3g}."
                )
            elif not unknown.determined:
                lines.append(
                    f"{unknown.name} is not determined: the data leave "
                    f"{100.0 * unknown.left:.0f} % of what was open."
                )
        for first, second, correlation in self.confounded:
            lines.append(
                f"{first} and {second} are told apart badly: correlation {correlation:.2f}."
            )
        return lines


def fit(
    start: Specimen,
    observe: Observe,
    measured: np.ndarray,
    uncertainty: np.ndarray | float,
    free: Iterable[str] = USUAL,
) -> Fit:
    """The specimen nearest to what was measured.

    Parameters
    ----------
    start : Specimen
        Where the fit starts, and what it stays near where the data say nothing.
    observe : function
        From specimens to what would be measured of them.
    measured, uncertainty : (M,) arrays
        And its standard deviation, the model's own shortcomings included.
    free : names of `GROUPS` or of parameters

    Raises
    ------
    InputError
        If a name is unknown, named twice, or its parameters are all 0 at the start.
    """
    unknowns = unknowns_of(require_specimen(start), tuple(free))

    def misfit(logarithms: np.ndarray) -> NDArray[np.float64]:
        """(P, M + K) weighted residuals of (P, K) unknowns."""
        seen = observe([unknowns.specimen(row) for row in logarithms])
        return np.hstack([(seen - measured) / uncertainty, logarithms / unknowns.expected])

    def slopes(logarithms: np.ndarray) -> NDArray[np.float64]:
        inwards = np.where(logarithms + STEP > np.log(unknowns.high), -STEP, STEP)
        moved = misfit(np.vstack([logarithms, logarithms + np.diag(inwards)]))
        return ((moved[1:] - moved[0]) / inwards[:, None]).T

    least, most = np.log(unknowns.low), np.log(unknowns.high)
    margin = MARGIN * unknowns.room
    with one_thread():
        solution = least_squares(
            lambda logarithms: misfit(logarithms[None])[0],
            np.clip(0.0, least + margin, most - margin),
            jac=slopes,  # type: ignore[arg-type]  # scipy's stubs know only its names of methods
            bounds=(least, most),
            xtol=TOLERANCE,
            ftol=TOLERANCE,
            max_nfev=MOST_STEPS,
        )
    specimen = unknowns.specimen(solution.x)
    observed = observe([specimen])[0]
    free_parameters, confounded = _determined(unknowns, solution.x, solution.jac)
    return Fit(
        specimen=specimen,
        free=free_parameters,
        observed=observed,
        residual=observed - measured,
        confounded=confounded,
        evaluations=int(solution.nfev + solution.njev * (1 + len(unknowns.names))),
    )


def _determined(
    unknowns: Unknowns, logarithms: np.ndarray, slopes: np.ndarray
) -> tuple[tuple[Free, ...], tuple[tuple[str, str, float], ...]]:
    """Unknowns with what the data say of them, and pairs that they tell apart badly.

    Parameters
    ----------
    logarithms : (K,) array
        Of the factors where the fit ended.
    slopes : (M + K, K) array
        Of the weighted residuals there.
    """
    covariance = np.linalg.inv(slopes.T @ slopes)
    spread = np.sqrt(np.diag(covariance))
    correlation = covariance / np.outer(spread, spread)
    names, left = unknowns.names, spread / unknowns.expected
    numbers = zip(np.exp(logarithms), unknowns.low, unknowns.high, spread, left, strict=True)
    free = tuple(Free(name, *map(float, row)) for name, row in zip(names, numbers, strict=True))
    confounded = tuple(
        (names[first], names[second], float(correlation[first, second]))
        for first in range(len(names))
        for second in range(first)
        if abs(correlation[first, second]) > CONFOUNDED
    )
    return free, confounded


def _require_shares(name: str, values: np.ndarray) -> None:
    for value in values:
        require_range(name, float(value), 0.0, 1.0)


def _observed(
    specimens: Sequence[Specimen],
    wavelengths: np.ndarray,
    angle: float,
    model: Model | None,
    advance: Advance,
) -> NDArray[np.float64]:
    """Reflectance (S, W) of specimens, a part of the wavelengths after the other."""
    size = max(SOLVED_TOGETHER // len(specimens), 1)
    parts = []
    for first in range(0, wavelengths.size, size):
        some = wavelengths[first : first + size]
        parts.append(spectra(specimens, some, angle=angle, model=model).total)
        advance(len(specimens) * some.size)
    return np.hstack(parts)


def fit_spectrum(
    start: Specimen,
    wavelengths: ArrayLike,
    reflectance: ArrayLike,
    *,
    free: Iterable[str] = USUAL,
    angle: float = 8.0,
    model: Model | None = None,
    advance: Advance = lambda solved: None,
) -> Fit:
    """The specimen whose directional-hemispherical reflectance is nearest to a measured one.

    Parameters
    ----------
    wavelengths, reflectance : (W,) arrays
        nm, and 0 to 1.
    angle : float
        Of incidence, in degrees.
    advance : function
        Told how many more wavelengths of specimens have been solved.

    Raises
    ------
    InputError
        As `fit`; and if the arrays do not agree, a reflectance is not 0 to 1, or a wavelength or
        the angle is out of range.

    Examples
    --------
    >>> import hylios
    >>> wavelengths = range(400, 701, 50)
    >>> measured = hylios.solve_spectrum(hylios.specimen("IV"), wavelengths).total
    >>> fit = hylios.fit_spectrum(
    ...     hylios.specimen("III"), wavelengths, measured, free=["melanin", "blood"]
    ... )
    >>> print(f"misses by {fit.rmse:.3f}")
    misses by 0.003
    """
    nm = as_numbers("wavelengths", wavelengths)
    measured = as_numbers("reflectances", reflectance)
    if nm.ndim != 1 or not nm.size or measured.shape != nm.shape:
        raise InputError(
            f"wavelengths and reflectance have shapes {nm.shape} and {measured.shape}; "
            "expected one row of equal length, not empty."
        )
    _require_shares("a reflectance to fit", measured)

    def observe(specimens: Sequence[Specimen]) -> NDArray[np.float64]:
        return _observed(specimens, nm, angle, model, advance)

    return fit(start, observe, measured, SPECTRAL_UNCERTAINTY, free)


def fit_colour(
    start: Specimen,
    srgb: ArrayLike,
    *,
    free: Iterable[str] = USUAL,
    angle: float = 8.0,
    model: Model | None = None,
    advance: Advance = lambda solved: None,
) -> Fit:
    """The specimen of a colour: three numbers, so most of it is left as in `start`.

    Parameters
    ----------
    srgb : (3,) array
        0 to 1, seen under D65. The fit is in L*a*b*.
    advance
        As in `fit_spectrum`.

    Raises
    ------
    InputError
        As `fit`; and if the colour is not three numbers from 0 to 1, or the angle is out of range.

    Examples
    --------
    >>> import hylios
    >>> fit = hylios.fit_colour(hylios.specimen("III"), [0.7, 0.6, 0.5], free=["melanin"])
    >>> fit.free[0].name, fit.free[0].determined
    ('melanin', True)
    """
    encoded = as_numbers("parts of a colour to fit", srgb)
    if encoded.shape != (3,):
        raise InputError(f"a colour to fit has shape {encoded.shape}; expected (3,).")
    _require_shares("a part of a colour to fit", encoded)
    from hylios.lab.colour import lab, linear_of_srgb  # colour-science takes a second

    few = skin_quadrature(COLOUR_COUNT)

    def observe(specimens: Sequence[Specimen]) -> NDArray[np.float64]:
        seen = _observed(specimens, few.wavelengths, angle, model, advance)
        return lab(seen @ few.weights.T)

    return fit(start, observe, lab(linear_of_srgb(encoded)), COLOUR_UNCERTAINTY, free)
