"""Ultraviolet under a clear sky, 280 to 400 nm.

The direct light is dimmed by molecules, ozone and aerosol after Beer and Lambert; what is
scattered, once or many times, is added up layer by layer (`hylios.sun.atmosphere`). Cross sections
of ozone are measured (`sky.csv`), those of molecules are Bodhaine's (J. Atmos. Ocean. Technol. 16,
1854, 1999); the aerosol is that of R. Bird and C. Riordan, SERI/TR-215-2436 (1984). The low sun
shines through air that is curved (Kasten and Young 1989). Nitrogen dioxide and sulphur dioxide are
left out.

Nothing was fitted, and `tests/hylios/sun/test_sky.py` holds the errors.

- Against libRadtran's clear day in Helsinki (Lindfors et al. 2009), with 328 Dobson units, which
  the shape of its spectrum has: within .6 % of the erythemal light with the sun 37 to 52 degrees
  from the zenith, 1 to 1.5 % high at 59 degrees, and within .5 % of the UVA; at 66 to 73 degrees 2
  to 4 % high, of the UVA up to 1.3 %. One hour of the morning, at 52 degrees, is 3.7 % high (UVA
  3.3 %): there the reference itself is 3.5 % darker than in the afternoon, the sun as high. The
  usual 300 units would be 11 % more light than that day's. Bird and Riordan's own diffuse light,
  which this module had before, was 10 % low.
- Against ASTM G173's direct light, 300 to 400 nm: 2.8 % rms, median -.2 %, erythemal -3.4 %; with
  its sky, turned to its tilted surface as it was there: 5.9 % rms, median +2.3 %, erythemal +8.8 %.
  Below 300 nm it falls to half of G173's at 295 nm.
- Altitude: 8 to 10 % more erythemal light for the first kilometre. In the Alps 10.7 % were measured
  (Schmucki and Philipona, Ultraviolet radiation in the Alps: the altitude effect, 2002), elsewhere
  5 to 20 %; snow and the haze of valleys are in that.
- Against Madronich's formula for the UV index in clean air, sun up to 60 degrees from the zenith: 2
  to 12 % low, and 6 to 16 % with the aerosol of .1 that is usual here.

All of it is for a sky without clouds."""

from dataclasses import dataclass
from functools import cache, lru_cache

import numpy as np
from numpy.typing import ArrayLike

from hylios.errors import require_range
from hylios.packaged import numbers_of
from hylios.sun.atmosphere import Depths, Passage, passage

MOLECULES_PER_DOBSON = 2.6868e16  # in 1/cm^2: Loschmidt's number times 1e-3 cm


@dataclass(frozen=True)
class ClearSky:
    """What the air over a place holds, and the ground reflects.

    Attributes
    ----------
    ozone : float
        Column over the sea's level, Dobson units.
    altitude : float
        Of the place over the sea, m; what air, ozone and aerosol lie below it don't count.
    aerosol : float
        Optical depth at 500 nm over the sea's level.
    albedo : float
        Share of the light that the ground reflects (`hylios.sun.surroundings.GROUNDS`).
    """

    ozone: float = 300.0
    altitude: float = 0.0
    aerosol: float = 0.1
    albedo: float = 0.05

    def __post_init__(self):
        require_range("ozone column", self.ozone, 50.0, 700.0, "Dobson units")
        require_range("altitude", self.altitude, -500.0, 9000.0, "m")
        require_range("optical depth of the aerosol", self.aerosol, 0.0, 2.0)
        require_range("albedo of the ground", self.albedo, 0.0, 1.0)


@dataclass(frozen=True)
class Sunlight:
    """Spectral irradiance at the ground, W/m^2/nm.

    Attributes
    ----------
    wavelengths : (W,) array, nm
    direct : (..., W) array
        On a surface that faces the sun.
    diffuse : (..., W) array
        From the sky, on level ground.
    level : (..., W) array
        Both on level ground.
    """

    wavelengths: np.ndarray
    direct: np.ndarray
    diffuse: np.ndarray
    level: np.ndarray


@cache
def _columns() -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """Wavelengths in nm, extraterrestrial irradiance, ozone's cross section in cm^2."""
    wavelengths, irradiance, section = numbers_of("hylios.sun", "sky.csv")[1].T
    return wavelengths, irradiance, 1e-20 * section


def sunlight(zenith: ArrayLike, sky: ClearSky, distance: ArrayLike = 1.0) -> Sunlight:
    """Spectral irradiance under a clear sky; nothing where the sun has set.

    Parameters
    ----------
    zenith : (...) array
        Of the sun, degrees.
    distance : (...) array
        Of the sun, astronomical units.
    """
    zenith = np.asarray(zenith, dtype=float)[..., None]
    cosine = np.maximum(np.cos(np.radians(zenith)), 0.0)
    wavelengths, irradiance, _ = _columns()
    above = np.where(zenith < 90.0, irradiance / np.asarray(distance, float)[..., None] ** 2, 0.0)
    depths, through = _air(sky.ozone, sky.altitude, sky.aerosol)
    # Kasten and Young 1989; beyond 90 degrees nothing is left to attenuate.
    mass = 1.0 / (cosine + 0.50572 * np.maximum(96.07995 - zenith, 1.0) ** -1.6364)
    ozone_mass = (1.0 + 22.0 / 6370.0) / np.sqrt(cosine**2 + 44.0 / 6370.0)
    vertical = depths.molecules + depths.ozone + depths.aerosol
    slant = mass * (depths.molecules + depths.aerosol) + ozone_mass * depths.ozone
    straight = np.exp(-slant)
    # The slope at which plane layers dim the direct light as the curved air does.
    passed = np.maximum(through.at(vertical / slant), straight)
    direct = above * straight
    level = above * cosine * passed / (1.0 - sky.albedo * through.returned)
    return Sunlight(wavelengths, direct, np.maximum(level - direct * cosine, 0.0), level)


@lru_cache(maxsize=64)
def _air(ozone: float, altitude: float, aerosol: float) -> tuple[Depths, Passage]:
    """Optical depths over a place, and light through it."""
    nanometres, _, section = _columns()
    micrometres = nanometres / 1000.0
    squared = micrometres**2
    molecules = 0.0021520 * (
        (1.0455996 - 341.29061 / squared - 0.90230850 * squared)
        / (1.0 + 0.0027059889 / squared - 85.968563 * squared)
    )
    extinct = aerosol * (micrometres / 0.5) ** -1.0274
    albedo = 0.945 * np.exp(-0.095 * np.log(micrometres / 0.4) ** 2)
    over_sea = Depths(molecules, section * MOLECULES_PER_DOBSON * ozone, extinct, albedo * extinct)
    height = altitude / 1000.0
    return over_sea.above(height), passage(over_sea, height)
