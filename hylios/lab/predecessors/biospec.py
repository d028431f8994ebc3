"""BioSpec: Krishnaswamy and Baranoski 2004, "A Biophysically-Based Spectral Model of Light
Interaction with Human Skin" (Computer Graphics Forum 23, 331 to 340).

Rays walk through stratum corneum, one epidermis with its melanin spread evenly, papillary and
reticular dermis. Each layer turns a ray once as it enters and absorbs it or not on the whole
straight way to the far face (Beer and Lambert); below the dermis everything is reflected.

The paper itself was not at hand: the rules and the numbers here are those of its author's own
program (A. Krishnaswamy's renderer RISE, files BioSpecSkin*, as first published). Where that has a
slip which its later versions mend, it is mended here too: the papillary dermis's thickness used
for the corneum's, the blood of the two dermal layers exchanged, a wavelength in cm ten times too
long. Light that the corneum turns straight back meets the surface like any other (the program lets
it out, which matters at grazing incidence only). `Parameters` and `_turn_in_dermis` describe
two more readings. Not established: whether the paper counts, as later versions of the program do,
a baseline absorption of all tissue.
"""

import math
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, fields
from functools import cache
from types import MappingProxyType

import numpy as np
from numba import njit

from hylios.errors import InputError, require_range, require_whole
from hylios.packaged import numbers_of
from hylios.spectra import published_spectra
from hylios.tissue.absorbers import BETA_CAROTENE_WEIGHT, BILIRUBIN_WEIGHT, HEMOGLOBIN_WEIGHT
from hylios.transport.compiling import kernel
from hylios.transport.generator import stream, uniform
from hylios.transport.interfaces import meet_interface
from hylios.transport.sampling import free_path, lambertian_cosine, rayleigh_cosine, turned

FIBRE_INDEX, FIBRE_RADIUS, FIBRE_VOLUME = 1.5, 2.5e-6, 0.21
"""Collagen fibres of the dermis: refractive index, radius in cm, volume fraction."""

GONIOMETRIC_WAVELENGTHS = (302.0, 365.0, 436.0, 546.0)
"""Wavelengths in nm at which both corneum and epidermis were measured; beyond, the ends hold."""


def _parameter(default: float, unit: str, low: float, high: float):
    return field(default=default, metadata={"unit": unit, "low": low, "high": high})


@dataclass(frozen=True, kw_only=True)
class Parameters:
    """A skin of BioSpec; the defaults are the author's program's for its lightest skin.

    Attributes
    ----------
    melanosomes : float
        Volume of the epidermis that is melanosomes, in %; people have 1.3 to 43. The program's
        scene has 1.9, 5.2, 12 and 42 from light to dark.
    eumelanin, pheomelanin : float
        Concentration in the melanosomes, mg/mL.
    papillary_blood, reticular_blood : float
        Volume of the layer that is blood, in %; people have 0.2 to 5.
    oxygenated : float
        Share of the haemoglobin that carries oxygen, in %.
    haemoglobin, bilirubin : float
        Concentration in whole blood, mg/mL.
    corneum_carotene, epidermis_carotene, dermis_carotene : float
        Concentration of beta-carotene, mg/mL.
    corneum_thickness, epidermis_thickness, papillary_thickness, reticular_thickness : float
        cm; people have 0.001 to 0.004 and 0.008 to 0.02 of the first two.
    corneum_index, epidermis_index, papillary_index, reticular_index : float
        Refractive index, the same at every wavelength.
    fold_aspect_ratio : float
        Of the surface's folds; 0 is a mirror.
    extinction : str
        What the tables' decadic extinctions mean in Beer and Lambert's law: `decadic` puts them
        in as they are, as the author's program did and as its melanosome contents suppose;
        `natural` multiplies them by ln 10, as it does since.

    Raises
    ------
    InputError
        If a number lies outside its range or the extinction is neither word.
    """

    melanosomes: float = _parameter(1.9, "%", 0.0, 100.0)
    eumelanin: float = _parameter(80.0, "mg/mL", 0.0, 1500.0)
    pheomelanin: float = _parameter(12.0, "mg/mL", 0.0, 1500.0)
    papillary_blood: float = _parameter(1.2, "%", 0.0, 100.0)
    reticular_blood: float = _parameter(0.91, "%", 0.0, 100.0)
    oxygenated: float = _parameter(75.0, "%", 0.0, 100.0)
    haemoglobin: float = _parameter(150.0, "mg/mL", 0.0, 500.0)
    bilirubin: float = _parameter(0.005, "mg/mL", 0.0, 10.0)
    corneum_carotene: float = _parameter(2.1e-4, "mg/mL", 0.0, 10.0)
    epidermis_carotene: float = _parameter(2.1e-4, "mg/mL", 0.0, 10.0)
    dermis_carotene: float = _parameter(7.0e-5, "mg/mL", 0.0, 10.0)
    corneum_thickness: float = _parameter(0.001, "cm", 1e-8, 10.0)
    epidermis_thickness: float = _parameter(0.01, "cm", 1e-8, 10.0)
    papillary_thickness: float = _parameter(0.02, "cm", 1e-8, 10.0)
    reticular_thickness: float = _parameter(0.18, "cm", 1e-8, 10.0)
    corneum_index: float = _parameter(1.55, "1", 1.0, 4.0)
    epidermis_index: float = _parameter(1.4, "1", 1.0, 4.0)
    papillary_index: float = _parameter(1.36, "1", 1.0, 4.0)
    reticular_index: float = _parameter(1.38, "1", 1.0, 4.0)
    fold_aspect_ratio: float = _parameter(0.75, "1", 0.0, 10.0)
    extinction: str = "decadic"

    def __post_init__(self):
        for parameter in fields(self):
            limits = parameter.metadata
            if limits:
                value = getattr(self, parameter.name)
                require_range(parameter.name, value, limits["low"], limits["high"], limits["unit"])
        if self.extinction not in ("decadic", "natural"):
            raise InputError(f"extinction is {self.extinction!r}; allowed is decadic, natural.")


NCSU_113 = Parameters()
"""The program's lightest skin, in place of what its authors took for curve 113 of the NCSU database
(figure 6.2): an assumption, for which skin that was could not be established."""


@cache
def goniometry() -> Mapping[str, np.ndarray]:
    """The table of Bruls and van der Leun, `bruls_goniometry.csv`: (14,) arrays by column.

    `angle_deg`, and for each tissue and wavelength in nm the share in % of the transmitted light
    that leaves within that angle of its direction.
    """
    names, table = numbers_of("hylios.lab.predecessors", "bruls_goniometry.csv")
    return MappingProxyType(dict(zip(names, table.T, strict=True)))


TABLE_SIZE = 1001


def scattering_angles(wavelength: float) -> np.ndarray:
    """Angles in degrees by which corneum and epidermis turn rays at a wavelength in nm, (2, 1001).

    Column i is the angle that a share i / 1000 of the rays does not exceed: between the table's
    rows linear in the share, between its wavelengths linear in the wavelength.
    """
    table = goniometry()
    share = np.linspace(0.0, 100.0, TABLE_SIZE)
    result = np.empty((2, TABLE_SIZE))
    for row, tissue in enumerate(("stratum_corneum", "epidermis")):
        measured = [
            np.interp(share, table[f"{tissue}_{length:.0f}"], table["angle_deg"])
            for length in GONIOMETRIC_WAVELENGTHS
        ]
        upper = np.searchsorted(GONIOMETRIC_WAVELENGTHS[1:-1], wavelength) + 1
        first, last = GONIOMETRIC_WAVELENGTHS[upper - 1], GONIOMETRIC_WAVELENGTHS[upper]
        weight = np.clip((wavelength - first) / (last - first), 0.0, 1.0)
        result[row] = (1.0 - weight) * measured[upper - 1] + weight * measured[upper]
    return result


def absorption(parameters: Parameters, wavelength: float) -> np.ndarray:
    """Absorption coefficients in 1/cm of the four layers from the surface down, (4,).

    Melanin counts with the melanosomes' volume and carotene with the rest of the epidermis;
    blood counts with its volume and carotene with the whole dermis.
    """
    at = {name: spectrum.at(wavelength) for name, spectrum in published_spectra().items()}
    carotene = at["beta_carotene"] / BETA_CAROTENE_WEIGHT
    oxygenated = 0.01 * parameters.oxygenated
    haemoglobin = oxygenated * at["oxyhemoglobin"] + (1.0 - oxygenated) * at["deoxyhemoglobin"]
    blood = (
        haemoglobin * parameters.haemoglobin / HEMOGLOBIN_WEIGHT
        + at["bilirubin"] * parameters.bilirubin / BILIRUBIN_WEIGHT
    )
    melanin = at["eumelanin"] * parameters.eumelanin + at["pheomelanin"] * parameters.pheomelanin
    melanosomes = 0.01 * parameters.melanosomes
    extinction = np.array(
        [
            carotene * parameters.corneum_carotene,
            melanosomes * melanin + (1.0 - melanosomes) * carotene * parameters.epidermis_carotene,
            0.01 * parameters.papillary_blood * blood + carotene * parameters.dermis_carotene,
            0.01 * parameters.reticular_blood * blood + carotene * parameters.dermis_carotene,
        ]
    )
    return extinction * (np.log(10.0) if parameters.extinction == "natural" else 1.0)


def rayleigh_coefficient(index: float, wavelength: float) -> float:
    """Scattering coefficient in 1/cm of the fibres in a dermis of a refractive index.

    8 pi^3 ((n_f / n)^2 - 1)^2 / (3 N lambda^4), N fibres per volume taken as spheres.
    """
    number = FIBRE_VOLUME / (4.0 / 3.0 * np.pi * FIBRE_RADIUS**3)
    contrast = ((FIBRE_INDEX / index) ** 2 - 1.0) ** 2
    return float(8.0 * np.pi**3 * contrast / (3.0 * number * (wavelength * 1e-7) ** 4))


CORNEUM, EPIDERMIS, PAPILLARY, RETICULAR = range(4)
THICKNESS, INDEX, ABSORPTION, RAYLEIGH = range(4)
SURFACE, SUBSURFACE, ABSORBED, LOST = range(4)
"""How a ray ends; LOST after `MOST_LAYERS` layers."""

MOST_LAYERS = 1_000_000

UP, DOWN = (0.0, 0.0, -1.0), (0.0, 0.0, 1.0)


@njit
def fold_cosine(state, aspect):
    """Cosine of the angle by which the folds turn a mirrored ray (Trowbridge and Reitz 1975).

    cos^2 = (s^2 / sqrt(s^4 + xi (1 - s^4)) - 1) / (s^2 - 1), which is xi itself where s is 1.
    """
    drawn, squared = uniform(state), aspect * aspect
    if abs(squared - 1.0) < 1e-6:
        return math.sqrt(drawn)
    mixed = squared * squared + drawn * (1.0 - squared * squared)
    return math.sqrt(max(0.0, (squared / math.sqrt(mixed) - 1.0) / (squared - 1.0)))


@njit
def _turn_by_table(state, ray, angles):
    position = uniform(state) * (angles.size - 1)
    below = int(position)
    angle = angles[below] + (position - below) * (angles[below + 1] - angles[below])
    return turned(state, ray, math.cos(math.radians(angle)))


@njit
def _turn_in_dermis(state, ray, layer):
    """Rayleigh scattering, at most once on the way down; else, and upwards, a diffuse direction.

    Rayleigh's phase function is drawn with the measure sin(alpha), without which the author's
    program of 2006 has it.
    """
    if ray[2] > 0.0:
        if free_path(state, layer[RAYLEIGH]) < layer[THICKNESS] / ray[2]:
            return turned(state, ray, rayleigh_cosine(state))
        return turned(state, DOWN, lambertian_cosine(state))
    return turned(state, UP, lambertian_cosine(state))


@njit
def _turn(state, ray, here, layer, angles):
    """The direction in which a ray that has entered a layer crosses it."""
    if here >= PAPILLARY:
        return _turn_in_dermis(state, ray, layer)
    crossing = _turn_by_table(state, ray, angles[here])
    while here == EPIDERMIS and crossing[2] * ray[2] <= 0.0:
        crossing = _turn_by_table(state, ray, angles[here])
    return crossing


@njit
def _walk_one(layers, angles, aspect, ray, state):
    crossed, entered = meet_interface(state, ray, 1.0, layers[CORNEUM, INDEX])
    if not crossed:
        reflected = turned(state, entered, fold_cosine(state, aspect))
        return SURFACE if reflected[2] < 0.0 else ABSORBED
    ray, here = entered, CORNEUM
    for _ in range(MOST_LAYERS):
        layer = layers[here]
        crossing = _turn(state, ray, here, layer, angles)
        # a ray that its layer turns back leaves by the face through which it came
        back = crossing[2] * ray[2] <= 0.0
        ray = crossing
        if not back and free_path(state, layer[ABSORPTION]) * abs(ray[2]) <= layer[THICKNESS]:
            return ABSORBED
        beyond = here + 1 if ray[2] > 0.0 else here - 1
        if beyond > RETICULAR:
            ray = (ray[0], ray[1], -ray[2])
            continue
        index = layers[beyond, INDEX] if beyond >= CORNEUM else 1.0
        crossed, ray = meet_interface(state, ray, layer[INDEX], index)
        if crossed and beyond < CORNEUM:
            return SUBSURFACE
        here = beyond if crossed else here
    return LOST


@kernel
def walk(sources):
    """The compiled kernel; its arguments are those of `trace`."""

    def trace(layers, angles, aspect, sine, cosine, rays, state, ends):
        """Walk rays from an angle of incidence and count in `ends`, (4,) integers, how they end.

        `layers` is (4, 4): thickness in cm, refractive index, absorption and Rayleigh coefficients
        in 1/cm; `angles` is from `scattering_angles`.
        """
        _ = sources  # makes the kernel a closure over it, see `compiling`
        for _ray in range(rays):
            ends[_walk_one(layers, angles, aspect, (sine, 0.0, cosine), state)] += 1

    return trace


def reflectance(
    parameters: Parameters,
    wavelengths: Iterable[float] | float,
    angle: float,
    rays: int,
    seed: int = 1,
) -> np.ndarray:
    """Directional-hemispherical reflectance at W wavelengths, (W,).

    Parameters
    ----------
    wavelengths : iterable of float
        nm, 380 to 780.
    angle : float
        Of incidence, in degrees, 0 to 89.99.
    rays : int
        Per wavelength.
    seed : int
        A wavelength's result depends on it, on the rays and on itself alone.

    Raises
    ------
    InputError
        If a wavelength, the angle, the rays or the seed is out of range.
    RuntimeError
        If a ray was lost between the layers.
    """
    row = np.atleast_1d(np.asarray(wavelengths, dtype=float))
    for wavelength in row:
        require_range("wavelength", wavelength, 380.0, 780.0, "nm")
    require_range("angle of incidence", angle, 0.0, 89.99, "degrees")
    rays = require_whole("number of rays", rays, 1, 10**10)
    seed = require_whole("seed", seed, 0, 2**63)
    radians = np.radians(angle)
    counts = np.zeros((row.size, LOST + 1), np.int64)
    for wavelength, ends in zip(row, counts, strict=True):
        walk(
            _layers(parameters, wavelength),
            scattering_angles(wavelength),
            parameters.fold_aspect_ratio,
            np.sin(radians),
            np.cos(radians),
            rays,
            stream(seed, round(wavelength * 1000)),
            ends,
        )
    if counts[:, LOST].any():
        raise RuntimeError("a ray found no way out of the layers")
    return (counts[:, SURFACE] + counts[:, SUBSURFACE]) / rays


def _layers(parameters: Parameters, wavelength: float) -> np.ndarray:
    """Thickness, refractive index, absorption and Rayleigh coefficients by layer, (4, 4)."""
    indices = (
        parameters.corneum_index,
        parameters.epidermis_index,
        parameters.papillary_index,
        parameters.reticular_index,
    )
    thicknesses = (
        parameters.corneum_thickness,
        parameters.epidermis_thickness,
        parameters.papillary_thickness,
        parameters.reticular_thickness,
    )
    fibres = [0.0, 0.0, *(rayleigh_coefficient(index, wavelength) for index in indices[PAPILLARY:])]
    return np.column_stack([thicknesses, indices, absorption(parameters, wavelength), fibres])
