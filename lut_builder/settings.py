"""How accurately a table is built, what it holds, and for which scene."""

from dataclasses import dataclass

import numpy as np

from hylios.adding.absorptance import STEP_NM
from hylios.adding.solver import NODES
from hylios.errors import InputError, require_range, require_whole
from hylios.quadrature import FEWEST, MOST
from hylios.table import INTERPOLATIONS

VISIBLE = "visible"
"""The band that makes colours and the profile of a shader."""

BANDS_NM = (365.0, 1100.0, 1650.0)
"""The thesis's wavelengths in the ultraviolet and the infrared (figures 6.8 to 6.11)."""

MOST_KNOTS, MOST_AXES, MOST_STATES = 100, 4, 20_000
MOST_BANDS = 100
FIRST_NM, LAST_NM = 250.0, 2500.0
"""First and last wavelength of the absorbers' spectra."""

FEWEST_NODES, MOST_NODES = 6, 200
LEAST_PROFILE_ERROR, MOST_PROFILE_ERROR = 5e-4, 0.1
FEWEST_PROFILE_STATES, MOST_PROFILE_STATES = 8, 1000


@dataclass(frozen=True)
class Settings:
    """What a table holds, and how accurately.

    Attributes
    ----------
    knots : tuple of int
        Numbers of knots of melanin, thickness, spread and blood; an axis left out has one. With
        one of spread, tans are by the thesis's kinetics alone.
    colour_wavelengths : int
        From which colours are made (`hylios.quadrature.skin_quadrature`); 0 for no colours.
    bands : tuple of float
        Single wavelengths in nm, whose reflectance the table holds.
    profile_error : float
        Standard error of the cumulative diffusion profile at a wavelength, of light skin; dark
        skin's is larger, as it shows less (`hylios.transport.shared_profiles.needed_samples`). 0
        for no profile.
    profile_wavelengths : int
        From which the colour channels' profiles are made.
    profile_states : int
        States whose profiles are walked, for near share and far width of all.
    nodes : int
        Directions of the deterministic solver.
    interpolation : str
        How the table is read between its knots.
    half : bool
        Whether the file holds numbers of 16 bits.

    Raises
    ------
    InputError
        If a value is out of range, or the table would hold nothing.
    """

    knots: tuple[int, ...]
    colour_wavelengths: int = 8
    bands: tuple[float, ...] = BANDS_NM
    profile_error: float = 0.006
    profile_wavelengths: int = 8
    profile_states: int = 40
    nodes: int = NODES
    interpolation: str = "pchip"
    half: bool = False

    def __post_init__(self):
        require_whole("number of axes", len(self.knots), 1, MOST_AXES)
        for count in self.knots:
            require_whole("number of knots", count, 1, MOST_KNOTS)
        require_range("number of states", self.states, 1, MOST_STATES)
        if self.colour_wavelengths != 0:
            require_whole("number of wavelengths", self.colour_wavelengths, FEWEST, MOST)
        elif not self.bands:
            raise InputError("a table without the visible has no band; at least one is needed.")
        require_whole("number of the profile's wavelengths", self.profile_wavelengths, FEWEST, MOST)
        require_whole(
            "number of the profile's states",
            self.profile_states,
            FEWEST_PROFILE_STATES,
            MOST_PROFILE_STATES,
        )
        require_whole("number of bands", len(self.bands), 0, MOST_BANDS)
        for band in self.bands:
            require_range("band", band, FIRST_NM, LAST_NM, "nm")
        if len({f"{band:g}" for band in self.bands}) < len(self.bands):
            listed = ", ".join(f"{band:g}" for band in self.bands)
            raise InputError(f"bands are {listed} nm; allowed is no band twice.")
        if self.profile_error != 0.0:
            require_range(
                "error of the profile", self.profile_error, LEAST_PROFILE_ERROR, MOST_PROFILE_ERROR
            )
        require_whole("number of nodes", self.nodes, FEWEST_NODES, MOST_NODES)
        if self.interpolation not in INTERPOLATIONS:
            raise InputError(
                f"interpolation is {self.interpolation!r}; allowed are {', '.join(INTERPOLATIONS)}."
            )

    @property
    def has_profile(self) -> bool:
        """Whether the table holds near share and far width of the diffusion profile."""
        return self.colour_wavelengths > 0 and self.profile_error > 0.0

    @property
    def absorptance_step(self) -> float:
        """Between wavelengths of the untanned skin's absorptance in nm; more in a quick table."""
        return 6.0 if self.nodes < NODES else STEP_NM

    @property
    def states(self) -> int:
        """Number of knots in all."""
        return int(np.prod(self.knots))


PRESETS = {
    "preview": Settings(
        knots=(9, 2, 1, 4),
        colour_wavelengths=4,
        profile_error=0.05,
        profile_states=12,
        nodes=18,
    ),
    "standard": Settings(knots=(16, 4, 3, 5), colour_wavelengths=10, profile_error=0.01),
    "reference": Settings(
        knots=(28, 5, 4, 8),
        colour_wavelengths=18,
        profile_error=0.005,
        profile_wavelengths=12,
        profile_states=160,
    ),
}
"""`lut-builder trade` measures them beside the front of time against error."""
