"""The pieces of work that a table is made of: colours of some states, profiles at a wavelength.

Each is a function from arrays and descriptions to named arrays, with its random numbers seeded by
what it is: so pieces can be computed in any order, anywhere, and again.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from hylios.adding import spectra
from hylios.adding.absorptance import tabulated
from hylios.adding.solver import NODES
from hylios.quadrature import skin_quadrature
from hylios.skin import Skin
from hylios.skin.specimen import Specimen
from hylios.table import StateAxes
from hylios.tissue import Model
from lut_builder.settings import Settings

ANGLE = 8.0
"""Angle of incidence in degrees, as reflectance is measured."""

STATES_TOGETHER = 24
"""States in one piece of colours."""

ULTRAVIOLET_SECONDS, COLOUR_SECONDS = 0.9, 1e-3
PROFILE_SECONDS, PATH_SECONDS = 0.3, 3e-6
"""About how long work takes on one core: the absorptance, a wavelength of a state, any profile, and
an effective path of a state. Paths take a third in light skin, four times as much in dark skin."""


@dataclass(frozen=True)
class Request:
    """What a table is to be.

    Attributes
    ----------
    skin : Skin
    settings : Settings
    axes : StateAxes
    knot_states : (*axes.shape, 4) array
        Tanning states at the knots.
    needed : bool array of shape `axes.shape`
        Knots to compute.
    whole : int
        Number of states that the skin's table for any sun has.
    within : float or None
        Of a table for one scene: how far its states lie at most from those that a lookup of
        `knot_states` gives for them, in the logarithm of one of the four numbers.
    seed : int
    model : Model
        Spectra and readings.
    """

    skin: Skin
    settings: Settings
    axes: StateAxes
    knot_states: np.ndarray
    needed: np.ndarray
    whole: int
    within: float | None = None
    seed: int = 1
    model: Model = field(default_factory=Model)

    @property
    def states(self) -> np.ndarray:
        """Tanning states to compute, (N, 4)."""
        return self.knot_states[self.needed]


@dataclass(frozen=True)
class Piece:
    """A piece of a table.

    Attributes
    ----------
    name : str
        Of its own among the request's.
    kind : str
        "colours" of states `first` up to `last`, a "profile" at `wavelength` nm of all states, or
        the untanned skin's "absorptance".
    size : float
        Seconds that it takes on one core, about, for the time left.
    """

    name: str
    kind: str
    size: float
    first: int = 0
    last: int = 0
    wavelength: float = 0.0


def pieces(request: Request) -> list[Piece]:
    """All pieces of a request, the longest first."""
    listed = [
        Piece("absorptance", "absorptance", ULTRAVIOLET_SECONDS),
        *_profiles(request),
        *_colours(request),
    ]
    return sorted(listed, key=lambda piece: -piece.size)


def wavelengths(settings: Settings) -> np.ndarray:
    """Wavelengths in nm of the colours, then of the bands."""
    count = settings.colour_wavelengths
    visible = skin_quadrature(count).wavelengths if count else np.zeros(0)
    return np.concatenate([visible, settings.bands])


def computed(request: Request, piece: Piece) -> dict[str, np.ndarray]:
    """The arrays of a piece, on one core.

    Colours give `surface` and `subsurface` (states, wavelengths); a profile gives `light` and
    `squares` (states, bins), `rays` and `anew`, as `hylios.transport.shared_profiles.Profiles` has
    them; the absorptance gives `wavelengths` and `values`, as
    `hylios.sun.action_spectra.Absorptance` has them.

    Raises
    ------
    InputError
        If the skin's melanosomes cannot be solved for (`hylios.adding.solve`).
    """
    if piece.kind == "colours":
        return _solved(request, request.states[piece.first : piece.last])
    if piece.kind == "absorptance":
        return _absorbed(request)
    return _walked(request, piece.wavelength)


def _absorbed(request: Request) -> dict[str, np.ndarray]:
    table = tabulated(request.skin.specimen, model=request.model)
    return {"wavelengths": table.wavelengths, "values": table.values}


def _walked(request: Request, wavelength: float) -> dict[str, np.ndarray]:
    from hylios.transport.shared_profiles import skin_profiles  # numba

    (profiles,) = skin_profiles(
        _specimens(request, request.states),
        [wavelength],
        error=request.settings.profile_error,
        angle=ANGLE,
        seed=request.seed,
        threads=1,
        model=request.model,
    )
    return {
        "light": profiles.light,
        "squares": profiles.squares,
        "rays": profiles.rays,
        "anew": profiles.anew,
    }


def _profiles(request: Request) -> Iterator[Piece]:
    settings = request.settings
    if settings.has_profile:
        paths = len(request.states) * 0.25 / settings.profile_error**2
        size = PROFILE_SECONDS + paths * PATH_SECONDS
        for band in skin_quadrature(settings.profile_wavelengths).wavelengths:
            name = f"profile-{band:g}nm"
            yield Piece(name, "profile", size, wavelength=float(band))


def _colours(request: Request) -> Iterator[Piece]:
    settings = request.settings
    seconds = COLOUR_SECONDS * (settings.nodes / NODES) ** 2 * wavelengths(settings).size
    count = len(request.states)
    for first in range(0, count, STATES_TOGETHER):
        last = min(first + STATES_TOGETHER, count)
        yield Piece(f"colours-{first}", "colours", seconds * (last - first), first, last)


def _solved(request: Request, states: np.ndarray) -> dict[str, np.ndarray]:
    light = spectra(
        _specimens(request, states),
        wavelengths(request.settings),
        angle=ANGLE,
        nodes=request.settings.nodes,
        model=request.model,
    )
    return {"surface": light.surface, "subsurface": light.subsurface}


def _specimens(request: Request, states: np.ndarray) -> list[Specimen]:
    return [request.skin.at(state) for state in states]
