"""A specimen that reflects like measured skin: bounded least squares over some of its parameters.

What is free are groups of parameters that go up and down together, `GROUPS`, or single parameters
by name. Each has one unknown, the logarithm of the factor by which it differs from the specimen
that the fit starts from, bounded by the physiological ranges. Light comes from `hylios.adding`,
which has no noise and so has slopes.

Skin's reflectance does not determine everything about it: melanin and the thickness of the layer
that holds it, for one, act nearly as their product. So each unknown is also drawn weakly to its
start (Tikhonov's regularisation: as if `EXPECTED_SPREAD` of its range were its standard deviation
among people), and the result says how much of that spread the data leave.
"""

from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from types import MappingProxyType

import numpy as np
from scipy.optimize import least_squares

from hylios.adding import spectra
from hylios.errors import InputError, require_range
from hylios.quadrature import skin_quadrature
from hylios.skin.physiology import PHYSIOLOGY
from hylios.skin.specimen import EPIDERMIS, Specimen, parameters
from hylios.threads import one_thread
from hylios.tissue import Model

GROUPS: Mapping[str, tuple[str, ...]] = MappingProxyType(
    {
        "melanin": tuple(
            f"{layer}_{form}"
            for form in ("melanosomes", "colloidal_melanin")
            for layer in EPIDERMIS
        ),
        "melanosomes": tuple(f"{layer}_melanosomes" for layer in EPIDERMIS),
        "colloidal_melanin": tuple(f"{layer}_colloidal_melanin" for layer in EPIDERMIS),
        "blood": ("papillary_blood", "reticular_blood"),
        "oxygenation": ("oxygenated_blood",),
        "water": ("corneum_water", "epidermis_water", "papillary_water", "reticular_water"),
        "lipids": ("corneum_lipids", "epidermis_lipids", "papillary_lipids", "reticular_lipids"),
        "corneum": ("corneum_thickness",),
        "epidermis": tuple(f"{layer}_thickness" for layer in EPIDERMIS),
        "dermis": ("papillary_thickness", "reticular_thickness"),
        "hypodermis": ("hypodermis_reflectance",),
    }
)
"""Parameters that a fit changes by one common factor."""

USUAL = (
    "melanin",
    "blood",
    "oxygenation",
    "water",
    "corneum",
    "epidermis",
    "dermis",
    "hypodermis",
)
"""What is free unless something else is asked for."""

EXPECTED_SPREAD = 0.25
"""Standard deviation expected of an unknown before any data, as a share of its bounds' distance."""

LEAST_FACTOR = 1e-3
"""Smallest factor of a group whose physiological range begins at 0."""

DETERMINED = 0.5
"""The data determine an unknown where they leave less than this share of its expected spread."""

CONFOUNDED = 0.9
"""Correlation from which two unknowns are said to be told apart badly."""

STEP = 1e-4
"""Of the unknowns, for the slopes."""

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

Observe = Callable[[Sequence[Specimen]], np.ndarray]
"""What would be measured of each specimen: (S, M) for M measured numbers."""


@dataclass(frozen=True)
class Free:
    """One unknown of a fit, as it came out.

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
    """What came of a fit.

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
    observed: np.ndarray
    residual: np.ndarray
    confounded: tuple[tuple[str, str, float], ...]
    evaluations: int

    @property
    def rmse(self) -> float:
        """Root of the mean squared residual."""
        return float(np.sqrt(np.mean(self.residual**2)))

    def remarks(self) -> list[str]:
        """What the data do not determine, a line each."""
        lines = []
        for each in self.free:
            if each.at_bound:
                lines.append(
                    f"{each.name} is at an end of its physiological range: {each.factor:.3g} "
                    f"times the start's, of {each.low:.3g} to {each.high:.3g}."
                )
            elif not each.determined:
                lines.append(
                    f"{each.name} is not determined: the data leave {100.0 * each.left:.0f} % of "
                    "what was open."
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
    names = tuple(free)
    if not names:
        raise InputError("nothing is free; a fit needs at least one parameter or group to change.")
    low, high = np.array([_bounds(start, name) for name in names]).T
    if len({field for name in names for field in _fields(name)}) < sum(
        len(_fields(name)) for name in names
    ):
        raise InputError(f"free parameters are {', '.join(names)}; allowed is each only once.")
    room = np.log(high / low)
    expected = EXPECTED_SPREAD * room
    evaluations = 0

    def misfit(unknowns: np.ndarray) -> np.ndarray:
        """(P, M + K) weighted residuals of (P, K) unknowns."""
        nonlocal evaluations
        evaluations += len(unknowns)
        seen = observe([scaled(start, names, np.exp(each)) for each in unknowns])
        return np.hstack([(seen - measured) / uncertainty, unknowns / expected])

    def slopes(unknowns: np.ndarray) -> np.ndarray:
        inwards = np.where(unknowns + STEP > np.log(high), -STEP, STEP)
        moved = misfit(np.vstack([unknowns, unknowns + np.diag(inwards)]))
        return ((moved[1:] - moved[0]) / inwards[:, None]).T

    with one_thread():
        found = least_squares(
            lambda unknowns: misfit(unknowns[None])[0],
            np.clip(0.0, np.log(low) + MARGIN * room, np.log(high) - MARGIN * room),
            jac=slopes,  # type: ignore[arg-type]  # scipy's stubs know only its names of methods
            bounds=(np.log(low), np.log(high)),
            xtol=TOLERANCE,
            ftol=TOLERANCE,
            max_nfev=MOST_STEPS,
        )
    covariance = np.linalg.inv(found.jac.T @ found.jac)
    spread = np.sqrt(np.diag(covariance))
    correlation = covariance / np.outer(spread, spread)
    specimen = scaled(start, names, np.exp(found.x))
    observed = observe([specimen])[0]
    return Fit(
        specimen=specimen,
        free=tuple(
            Free(name, *(float(each) for each in numbers))
            for name, *numbers in zip(
                names, np.exp(found.x), low, high, spread, spread / expected, strict=True
            )
        ),
        observed=observed,
        residual=observed - measured,
        confounded=tuple(
            (names[first], names[second], float(correlation[first, second]))
            for first in range(len(names))
            for second in range(first)
            if abs(correlation[first, second]) > CONFOUNDED
        ),
        evaluations=evaluations,
    )


def scaled(start: Specimen, names: Sequence[str], factors: np.ndarray) -> Specimen:
    """The specimen with the parameters of each named group multiplied by its factor."""
    changes = {
        field: getattr(start, field) * float(factor)
        for name, factor in zip(names, factors, strict=True)
        for field in _fields(name)
    }
    return replace(start, **changes)


def _fields(name: str) -> tuple[str, ...]:
    single = [each.name for each in parameters()]
    if name in GROUPS:
        return GROUPS[name]
    if name in single:
        return (name,)
    raise InputError(
        f"there is nothing called {name!r} to fit; there are {', '.join([*GROUPS, *single])}."
    )


def _bounds(start: Specimen, name: str) -> tuple[float, float]:
    """Least and greatest factor that keep a group's parameters in their physiological ranges."""
    low, high = LEAST_FACTOR, np.inf
    for field in _fields(name):
        value, limits = getattr(start, field), PHYSIOLOGY[field]
        if value > 0.0:
            low, high = max(low, limits.low / value), min(high, limits.high / value)
    if not np.isfinite(high):
        raise InputError(f"{name} is 0 at the start of the fit; allowed is more than 0.")
    if not low < high:
        raise InputError(
            f"{name} of {start.name} lies outside its physiological range; allowed is a start "
            "within it."
        )
    return low, high


def _require_shares(name: str, values: np.ndarray) -> None:
    for each in values:
        require_range(name, float(each), 0.0, 1.0)


def fit_spectrum(
    start: Specimen,
    wavelengths: np.ndarray,
    reflectance: np.ndarray,
    *,
    free: Iterable[str] = USUAL,
    angle: float = 8.0,
    model: Model | None = None,
) -> Fit:
    """The specimen whose directional-hemispherical reflectance is nearest to a measured one.

    Parameters
    ----------
    wavelengths, reflectance : (W,) arrays
        nm, and 0 to 1.
    angle : float
        Of incidence, in degrees.

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
    wavelengths = np.asarray(wavelengths, dtype=float)
    reflectance = np.asarray(reflectance, dtype=float)
    if wavelengths.ndim != 1 or not wavelengths.size or reflectance.shape != wavelengths.shape:
        raise InputError(
            f"wavelengths and reflectance have shapes {wavelengths.shape} and {reflectance.shape}; "
            "expected one row of equal length, not empty."
        )
    _require_shares("a reflectance to fit", reflectance)

    def observe(specimens: Sequence[Specimen]) -> np.ndarray:
        found = spectra(specimens, wavelengths, angle=angle, model=model)
        return found.total

    return fit(start, observe, reflectance, SPECTRAL_UNCERTAINTY, free)


def fit_colour(
    start: Specimen,
    srgb: np.ndarray,
    *,
    free: Iterable[str] = USUAL,
    angle: float = 8.0,
    model: Model | None = None,
) -> Fit:
    """The specimen of a colour: three numbers, so most of it is left as in `start`.

    Parameters
    ----------
    srgb : (3,) array
        0 to 1, seen under D65. The fit is in L*a*b*.

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
    srgb = np.asarray(srgb, dtype=float)
    if srgb.shape != (3,):
        raise InputError(f"a colour to fit has shape {srgb.shape}; expected (3,).")
    _require_shares("a part of a colour to fit", srgb)
    from hylios.lab.colour import lab, linear_of_srgb  # colour-science takes a second

    few = skin_quadrature(COLOUR_COUNT)

    def observe(specimens: Sequence[Specimen]) -> np.ndarray:
        seen = spectra(specimens, few.wavelengths, angle=angle, model=model)
        return lab(seen.total @ few.weights.T)

    return fit(start, observe, lab(linear_of_srgb(srgb)), COLOUR_UNCERTAINTY, free)
