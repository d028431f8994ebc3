"""The pieces of work that a table is made of: colours of some states, profiles at a wavelength.

Each is a function from arrays and descriptions to named arrays, with its random numbers seeded by
what it is: so pieces can be computed in any order, anywhere, and again.
"""

from collections.abc import Iterator
from dataclasses import dataclass, field

import numpy as np

from hylios.adding import spectra
from hylios.adding.absorptance import STEP_NM, tabulated
from hylios.adding.solver import NODES
from hylios.quadrature import skin_quadrature
from hylios.skin import Skin
from hylios.skin.specimen import Specimen
from hylios.table import LookAxes
from hylios.tissue import Model
from lut_builder.lighting import Lighting
from lut_builder.near_far_fit import design_places
from lut_builder.settings import Settings

ANGLE = 8.0
"""Angle of incidence in degrees, as reflectance is measured."""

ANGLES = (ANGLE, 45.0, 60.0, 70.0)
"""Angles of incidence in degrees of a table's colours."""

WATER = 1.33
"""Refractive index of the film on wet skin."""

STATES_TOGETHER = 24
"""States in one piece of colours."""

ULTRAVIOLET_SECONDS, SURFACE_SECONDS, COLOUR_SECONDS = 0.6, 0.05, 0.8e-3
KERNEL_SECONDS, PROFILE_SECONDS, PATH_SECONDS = 0.4, 0.03, 5e-6
"""About how long work takes on one core: the absorptance, the surface at a wavelength, a wavelength
of a state, loading the walk's kernels, any profile, and an effective path of a state. Paths take a
third in light skin, three times as much in dark skin."""


@dataclass(frozen=True)
class Request:
    """What a table is to be.

    Attributes
    ----------
    skin : Skin
    settings : Settings
    axes : LookAxes
    whole : int
        Number of states that the skin's table for any sun has.
    seed : int
    model : Model
        Spectra and readings.
    lighting : Lighting
        Of the colours.
    """

    skin: Skin
    settings: Settings
    axes: LookAxes
    whole: int
    seed: int = 1
    model: Model = field(default_factory=Model)
    lighting: Lighting = field(default_factory=Lighting)

    @property
    def states(self) -> np.ndarray:
        """Tanning states at the knots, (N, 5)."""
        return self.axes.knot_states().reshape(-1, 5)

    @property
    def walked_states(self) -> np.ndarray:
        """States (M, 5) among them whose profiles are walked; no more than there are knots."""
        count = min(self.settings.profile_states, int(np.prod(self.axes.shape)))
        return self.axes.states(design_places(self.axes, count))


@dataclass(frozen=True)
class Piece:
    """A piece of a table.

    Attributes
    ----------
    name : str
        Of its own among the request's.
    kind : str
        "colours" of states `first` up to `last`, a "profile" at `wavelength` nm of all walked
        states, or the untanned skin's "absorptance".
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
    step = request.settings.absorptance_step
    listed = [
        Piece("absorptance", "absorptance", ULTRAVIOLET_SECONDS * STEP_NM / step),
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

    Colours give `surface` and `subsurface` (angles, states, wavelengths), for `ANGLES`, and
    `wet_subsurface` (states, wavelengths) of those of the visible; a profile gives `light` and
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
    step = request.settings.absorptance_step
    table = tabulated(request.skin.specimen, model=request.model, step_nm=step)
    return {"wavelengths": table.wavelengths, "values": table.values}


def _walked(request: Request, wavelength: float) -> dict[str, np.ndarray]:
    from hylios.transport.shared_profiles import skin_profiles  # numba

    (profiles,) = skin_profiles(
        _specimens(request, request.walked_states),
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
        paths = len(request.walked_states) * 0.25 / settings.profile_error**2
        size, first = PROFILE_SECONDS + paths * PATH_SECONDS, KERNEL_SECONDS
        for band in skin_quadrature(settings.profile_wavelengths).wavelengths:
            name = f"profile-{band:g}nm"
            yield Piece(name, "profile", first + size, wavelength=float(band))
            first = 0.0


def _colours(request: Request) -> Iterator[Piece]:
    settings, count = request.settings, len(request.states)
    share = (settings.nodes / NODES) ** 2 * wavelengths(settings).size
    surfaces = SURFACE_SECONDS * share
    for first in range(0, count, STATES_TOGETHER):
        last = min(first + STATES_TOGETHER, count)
        size = COLOUR_SECONDS * share * (last - first) + surfaces
        yield Piece(f"colours-{first}", "colours", size, first, last)
        surfaces = 0.0  # kept for the other states


def _solved(request: Request, states: np.ndarray) -> dict[str, np.ndarray]:
    settings, specimens = request.settings, _specimens(request, states)
    bands = spectra(
        specimens, settings.bands, angle=ANGLES, nodes=settings.nodes, model=request.model
    )
    if not settings.colour_wavelengths:
        return {"surface": bands.surface, "subsurface": bands.subsurface}
    seen = spectra(
        specimens,
        skin_quadrature(settings.colour_wavelengths).wavelengths,
        angle=ANGLES,
        nodes=settings.nodes,
        film=(None, WATER),
        model=request.model,
    )
    return {
        "surface": np.concatenate([seen.surface[0], bands.surface], axis=-1),
        "subsurface": np.concatenate([seen.subsurface[0], bands.subsurface], axis=-1),
        "wet_subsurface": seen.subsurface[1, 0],
    }


def _specimens(request: Request, states: np.ndarray) -> list[Specimen]:
    return [request.skin.at(state) for state in states]
