"""DJ06: Donner and Jensen 2006, "A Spectral BSSRDF for Shading Human Skin" (EGSR, 409 to 417).

Two layers, a melanin-bearing epidermis of 0.25 mm over a bottomless dermis with blood, lit by the
multipole diffusion of Donner and Jensen 2005, "Light Diffusion in Multi-Layered Translucent
Materials" (ACM Transactions on Graphics 24, 1032 to 1039). Four numbers say what a skin is.

The papers themselves were not at hand. The absorption of both melanins and of bloodless tissue is
that on which independent programs written after the paper agree; the scattering, the thickness,
the refractive index of 1.4 in both layers and the oxygenation are those of one of them,
pbrt-skin-bssrdf, and the multipole's equations those of two (the other is RISE). Lengths are in mm
and coefficients in 1/mm, as in the papers; only `stack` is in cm, like the project.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, fields
from functools import partial

import numpy as np
from scipy.special import j0

from hylios.errors import InputError, require_range
from hylios.spectra import published_spectra
from hylios.tissue import Layer, Stack

EPIDERMIS_THICKNESS = 0.25
REFRACTIVE_INDEX = 1.4
OXYGENATION = 0.75
"""Share of the haemoglobin that carries oxygen."""

HAEMOGLOBIN, HAEMOGLOBIN_WEIGHT = 150.0, 64500.0
"""Concentration in whole blood in g/L, and molar weight in g/mol (Prahl's compilation)."""

ANISOTROPY = 0.8
"""Mean cosine of `stack`'s scatterers; an assumption, for diffusion needs no phase function."""


@dataclass(frozen=True)
class Parameters:
    """A skin of DJ06; all are fractions.

    Attributes
    ----------
    melanin : float
        Volume fraction of melanin in the epidermis, C_m, 0 to 0.5.
    eumelanin_share : float
        Of the melanin, beta_m, 0 to 1; the rest is pheomelanin.
    haemoglobin : float
        Volume fraction of whole blood in the dermis, C_h, 0 to 0.1.
    oiliness : float
        Factor on the surface's reflection, rho_s, 0 to 1; the default is pbrt-skin-bssrdf's.

    Raises
    ------
    InputError
        If one lies outside its range.
    """

    melanin: float
    eumelanin_share: float
    haemoglobin: float
    oiliness: float = 0.3

    def __post_init__(self):
        highest = {"melanin": 0.5, "haemoglobin": 0.1}
        for name in (field.name for field in fields(self)):
            require_range(name, getattr(self, name), 0.0, highest.get(name, 1.0))


NCSU_117 = Parameters(melanin=0.017, eumelanin_share=0.0, haemoglobin=0.0038)
"""An assumption in place of the paper's fit to curve 117 of the NCSU database (figure 6.2).

Established is only that the fit had no eumelanin, which the thesis reports. The other two numbers
are fitted by least squares to hylios' S1, which stands for that curve in figure 6.2: 400 to 700 nm,
45 degrees, RMSE 0.049. For the paper's three heads pbrt-skin-bssrdf has melanin, eumelanin share
and haemoglobin as 0.005, 0.7, 0.005 (light), 0.15, 0, 0.01 and 0.5, 0.7, 0.05 (dark).
"""


@dataclass(frozen=True)
class Medium:
    """Absorption and reduced scattering coefficients in 1/mm at W wavelengths, (W,) each."""

    absorption: np.ndarray
    reduced_scattering: np.ndarray

    @property
    def mean_free_path(self) -> np.ndarray:
        """Transport mean free path, l = 1 / sigma_t', in mm."""
        return 1.0 / (self.absorption + self.reduced_scattering)

    @property
    def albedo(self) -> np.ndarray:
        """Reduced albedo alpha'."""
        return self.reduced_scattering * self.mean_free_path

    def decay(self, frequency: np.ndarray | float) -> np.ndarray:
        """Rate in 1/mm at which light varying with a radial frequency in 1/mm decays with depth.

        At frequency 0 it is sigma_tr = sqrt(3 sigma_a sigma_t').
        """
        return np.sqrt(3.0 * self.absorption / self.mean_free_path + np.square(frequency))


def media(parameters: Parameters, wavelengths: Iterable[float] | float) -> tuple[Medium, Medium]:
    """Epidermis and dermis at wavelengths in nm.

    Raises
    ------
    InputError
        If a wavelength lies outside 380 to 780 nm.
    """
    length = np.atleast_1d(np.asarray(wavelengths, dtype=float))
    for wavelength in length:
        require_range("wavelength", wavelength, 380.0, 780.0, "nm")
    spectra = published_spectra()
    eumelanin = 6.6e10 * length**-3.33
    pheomelanin = 2.9e14 * length**-4.75
    baseline = 0.0244 + 8.53 * np.exp(-(length - 154.0) / 66.2)
    molar = OXYGENATION * spectra["oxyhemoglobin"].at(length)
    molar = molar + (1.0 - OXYGENATION) * spectra["deoxyhemoglobin"].at(length)
    blood = 0.1 * np.log(10.0) * molar * HAEMOGLOBIN / HAEMOGLOBIN_WEIGHT
    share = parameters.eumelanin_share
    melanin = share * eumelanin + (1.0 - share) * pheomelanin
    scattering = 14.74 * length**-0.22 + 2.2e11 * length**-4.0
    return (
        Medium(_mixed(parameters.melanin, melanin, baseline), scattering),
        Medium(_mixed(parameters.haemoglobin, blood, baseline), 0.5 * scattering),
    )


def _mixed(fraction: float, absorber: np.ndarray, baseline: np.ndarray) -> np.ndarray:
    return fraction * absorber + (1.0 - fraction) * baseline


def diffuse_fresnel(index: float) -> float:
    """Share of diffuse light inside a medium that its surface reflects back (Egan and Hilgeman).

    `index` is the medium's relative to what lies beyond, 1 or more. The polynomial leaves 0.0017
    at 1; a boundary without a step reflects nothing here.
    """
    if index == 1.0:
        return 0.0
    return -1.4399 / index**2 + 0.7099 / index + 0.6681 + 0.0636 * index


def extrapolation(medium: Medium, index: float) -> np.ndarray:
    """Distance z_b = 2 A D in mm beyond a boundary at which the fluence is taken as 0, (W,)."""
    reflected = diffuse_fresnel(index)
    return 2.0 / 3.0 * (1.0 + reflected) / (1.0 - reflected) * medium.mean_free_path


def half_space(medium: Medium, index: float, frequency: np.ndarray | float = 0.0) -> np.ndarray:
    """Reflectance of a bottomless medium at radial frequencies in 1/mm: the dipole, transformed.

    The Hankel transform of a pole's z (1 + sigma_tr d) exp(-sigma_tr d) / (4 pi d^3) is
    exp(-|z| q) / 2 with the sign of z, q = sqrt(sigma_tr^2 + s^2). At frequency 0 this is the
    total diffuse reflectance (equation 15 of Jensen et al. 2001).
    """
    source = medium.mean_free_path
    image = source + 2.0 * extrapolation(medium, index)
    decay = medium.decay(frequency)
    return 0.5 * medium.albedo * (np.exp(-decay * source) + np.exp(-decay * image))


def slab(
    medium: Medium,
    thickness: float,
    index_above: float,
    index_below: float,
    frequency: np.ndarray | float = 0.0,
) -> tuple[np.ndarray, np.ndarray]:
    """Reflectance and transmittance of a slab lit from above, at radial frequencies in 1/mm.

    The multipole of Donner and Jensen 2005 with all its dipoles: each of the four kinds of poles
    is a geometric series. Indices are the slab's relative to what lies above and below.

    Raises
    ------
    InputError
        If the slab is no thicker than a mean free path: the source would lie below it.
    """
    source = medium.mean_free_path
    if np.any(source >= thickness):
        raise InputError(
            f"the slab is {thickness:g} mm thick; allowed is more than its transport mean free "
            f"path, {source.max():g} mm."
        )
    above, below = extrapolation(medium, index_above), extrapolation(medium, index_below)
    image = source + 2.0 * above
    period = 2.0 * (thickness + above + below)
    # where nothing absorbs, the series have limits that a decay of 1e-7 meets to 12 digits
    decay = np.maximum(medium.decay(frequency), 1e-7 / period)

    def between(near, far):
        return np.exp(-decay * near) * -np.expm1(-decay * (far - near)) / -np.expm1(-decay * period)

    reflected = between(source, period - source) + between(image, period - image)
    through = between(thickness - source, period - thickness + source) + between(
        period - thickness - image, thickness + image
    )
    return 0.5 * medium.albedo * reflected, 0.5 * medium.albedo * through


def two_layers(
    epidermis: Medium, dermis: Medium, frequency: np.ndarray | float = 0.0
) -> np.ndarray:
    """Reflectance of the epidermis over the dermis at radial frequencies in 1/mm.

    By adding, which in frequency space is a product where distances would be folded (Donner and
    Jensen 2005): R1 + T1 R2 T1' / (1 - R2 R1'), the dashes for the epidermis lit from below.
    """
    down = slab(epidermis, EPIDERMIS_THICKNESS, REFRACTIVE_INDEX, 1.0, frequency)
    up = slab(epidermis, EPIDERMIS_THICKNESS, 1.0, REFRACTIVE_INDEX, frequency)
    below = half_space(dermis, 1.0, frequency)
    return down[0] + down[1] * below * up[1] / (1.0 - below * up[0])


def diffuse_reflectance(parameters: Parameters, wavelengths: Iterable[float] | float) -> np.ndarray:
    """Share of the light that has entered the skin which leaves it again, at W wavelengths, (W,).

    Raises
    ------
    InputError
        If a wavelength (nm) is out of range.
    """
    return two_layers(*media(parameters, wavelengths))


def reflectance(
    parameters: Parameters, wavelengths: Iterable[float] | float, angle: float
) -> np.ndarray:
    """Directional-hemispherical reflectance at W wavelengths (nm), (W,).

    The surface reflects the oiliness times Fresnel's share at that angle; the rest enters. The
    paper's surface is rough (Torrance and Sparrow, facets after Beckmann with m = 0.35), which is
    left out: it moves Fresnel's share by less than .001 up to 45 degrees and by .014 at 60. So is
    its BSSRDF's second factor, for light on its way out: the multipole's flux has left already.

    Raises
    ------
    InputError
        If a wavelength or the angle (degrees, 0 to 89.99) is out of range.
    """
    surface = parameters.oiliness * fresnel(angle)
    return surface + (1.0 - surface) * diffuse_reflectance(parameters, wavelengths)


def fresnel(angle: float) -> float:
    """Reflectance of the flat surface for unpolarised light at an angle in degrees.

    Raises
    ------
    InputError
        If the angle lies outside 0 to 89.99.
    """
    require_range("angle of incidence", angle, 0.0, 89.99, "degrees")
    cosine = np.cos(np.radians(angle))
    beyond = np.sqrt(1.0 - (np.sin(np.radians(angle)) / REFRACTIVE_INDEX) ** 2)
    across = (cosine - REFRACTIVE_INDEX * beyond) / (cosine + REFRACTIVE_INDEX * beyond)
    along = (beyond - REFRACTIVE_INDEX * cosine) / (beyond + REFRACTIVE_INDEX * cosine)
    return float(0.5 * (across**2 + along**2))


PANELS, NODES, PHASE = 600, 16, 20.0
"""Least number of pieces in which `inverse_hankel` integrates over frequencies, Gauss's nodes in
each, and how far in radians a piece may reach in the phase of the farthest distance's waves."""


def inverse_hankel(
    transformed: Callable[[np.ndarray], np.ndarray], highest: float, distances: np.ndarray
) -> np.ndarray:
    """The radial function in 1/mm^2, (N,), whose Hankel transform is given, up to a frequency.

    The frequencies are in 1/mm, the distances in mm, (N,); beyond `highest` the transform must be
    as good as 0.
    """
    panels = max(PANELS, int(np.ceil(highest * np.max(distances, initial=0.0) / PHASE)))
    edges = np.linspace(0.0, highest, panels + 1)
    node, weight = np.polynomial.legendre.leggauss(NODES)
    half = 0.5 * np.diff(edges)[:, None]
    frequency = (edges[:-1, None] + half * (1.0 + node)).ravel()
    measure = (half * weight).ravel() * frequency / (2.0 * np.pi)
    return j0(distances[:, None] * frequency) @ (transformed(frequency) * measure)


REACH = 40.0
"""Depth of the source times the highest frequency of `profile`; exp(-40) is nothing."""


def profile(parameters: Parameters, wavelength: float, radii: Iterable[float]) -> np.ndarray:
    """Radial exitance R(r) in 1/mm^2 of light that has entered at one point; radii in mm, (N,).

    Good to about 1e-12 / mm^2.

    Raises
    ------
    InputError
        If the wavelength (nm) or a radius (0 to 50 mm) is out of range.
    """
    distances = np.asarray(radii, dtype=float)
    for distance in distances:
        require_range("radius", distance, 0.0, 50.0, "mm")
    epidermis, dermis = media(parameters, wavelength)
    highest = REACH / float(epidermis.mean_free_path[0])
    return inverse_hankel(partial(two_layers, epidermis, dermis), highest, distances)


def stack(parameters: Parameters, wavelength: float, anisotropy: float = ANISOTROPY) -> Stack:
    """The same optical properties for this project's own random walk (`hylios.transport`).

    Henyey-Greenstein scatterers with the same reduced scattering under a flat surface, which
    reflects as Fresnel has it, whatever the oiliness.

    Raises
    ------
    InputError
        If the wavelength (nm) or the anisotropy (0 to 0.99) is out of range.
    """
    require_range("anisotropy", anisotropy, 0.0, 0.99)
    depths = (0.1 * EPIDERMIS_THICKNESS, np.inf)
    layers = (
        Layer(
            thickness=depth,
            refractive_index=REFRACTIVE_INDEX,
            absorption=10.0 * float(medium.absorption[0]),
            scattering=10.0 * float(medium.reduced_scattering[0]) / (1.0 - anisotropy),
            anisotropy=anisotropy,
        )
        for depth, medium in zip(depths, media(parameters, wavelength), strict=True)
    )
    return Stack(tuple(layers), index_below=REFRACTIVE_INDEX)
