"""The radial exitance R(r): how far from a pencil beam light leaves the skin."""

from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray

from hylios.burley import burley_share_within, burley_width, burley_width_error
from hylios.errors import InputError, require_range, require_whole
from hylios.skin.specimen import Specimen
from hylios.tissue import Model, Stack
from hylios.transport.events import SUBSURFACE
from hylios.transport.simulate import Rays, share_error
from hylios.transport.tallies import stream_key, tallied

SMALLEST_MM, LARGEST_MM, RINGS = 0.01, 100.0, 60
MOST_RINGS = 10_000


@dataclass(frozen=True)
class Rings:
    """Rings about the place where a beam comes in, their radii in equal steps of the logarithm.

    Attributes
    ----------
    smallest, largest : float
        Outer radius in mm of the first ring, which starts at 0, and of the last.
    count : int
        2 to 10,000.

    Raises
    ------
    InputError
        If one is out of range.
    """

    smallest: float = SMALLEST_MM
    largest: float = LARGEST_MM
    count: int = RINGS

    def __post_init__(self):
        smallest = require_range("smallest radius", self.smallest, 1e-6, 1e3, "mm")
        require_range("largest radius", self.largest, 1.001 * smallest, 1e6, "mm")
        require_whole("number of rings", self.count, 2, MOST_RINGS)

    @property
    def edges(self) -> NDArray[np.float64]:
        """Radii (N + 1,) in mm, the first 0."""
        return np.concatenate([[0.0], np.geomspace(self.smallest, self.largest, self.count)])


USUAL_RINGS = Rings()


@dataclass(frozen=True)
class RadialExitance:
    """Light that leaves after having been inside, by distance from where a pencil beam came in.

    R(r) is the share of the beam's light that leaves per area at distance r, averaged over all
    directions along the surface. In a ring from r_1 to r_2 that k of n rays left through,
    R = k / (n pi (r_2^2 - r_1^2)). The sum of R times area over the rings, plus `beyond`, is the
    subsurface reflectance.

    Attributes
    ----------
    angle : float
        Of incidence, in degrees.
    rays : int
    edges : (N + 1,) array
        Of the rings, in mm: 0, then in equal steps of the logarithm.
    counts : (N + 1,) int array
        Rays that left through each ring; the last element counts those beyond the last ring.
    """

    angle: float
    rays: int
    edges: NDArray[np.float64]
    counts: NDArray[np.float64]

    @property
    def area(self) -> NDArray[np.float64]:
        """Areas of the rings, (N,) in mm^2."""
        return np.pi * np.diff(self.edges**2)

    @property
    def exitance(self) -> NDArray[np.float64]:
        """R of each ring, (N,) in 1/mm^2."""
        return self.counts[:-1] / self.rays / self.area

    @property
    def standard_error(self) -> NDArray[np.float64]:
        """Standard error of R, (N,) in 1/mm^2; not 0 where no ray came (`share_error`)."""
        return share_error(self.counts[:-1], self.rays) / self.area

    @property
    def beyond(self) -> float:
        """Share of the beam's light that leaves farther out than the last ring."""
        return float(self.counts[-1] / self.rays)

    @property
    def subsurface(self) -> float:
        """Share of the beam's light that leaves after having been inside."""
        return float(self.counts.sum() / self.rays)

    @property
    def burley_width(self) -> float:
        """Width d in mm of the Burley profile nearest to R (`hylios.burley.burley_width`).

        Raises
        ------
        InputError
            If no ray came back from inside.
        """
        self._require_light()
        return float(burley_width(self.edges, self.counts))

    @property
    def burley_width_error(self) -> float:
        """Standard error of `burley_width` in mm from the noise of the counts.

        Raises
        ------
        InputError
            If no ray came back from inside.
        """
        self._require_light()
        return burley_width_error(self.edges, self.counts)

    @property
    def burley(self) -> NDArray[np.float64]:
        """Mean of the fitted Burley profile over each ring, (N,) in 1/mm^2, with all the light.

        Raises
        ------
        InputError
            If no ray came back from inside.
        """
        within = burley_share_within(self.edges, self.burley_width)
        return self.subsurface * np.diff(within) / self.area

    def _require_light(self) -> None:
        if not self.counts.any():
            raise InputError(
                f"none of {self.rays} rays came back from inside the skin; a profile needs more."
            )


def profile(
    specimen: Specimen,
    wavelength: float,
    *,
    angle: float = 0.0,
    rings: Rings = USUAL_RINGS,
    rays: int = 1_000_000,
    seed: int = 1,
    threads: int | None = None,
    model: Model | None = None,
) -> RadialExitance:
    """Radial exitance of a specimen at one wavelength under a pencil beam.

    Parameters
    ----------
    wavelength : float
        nm, 250 to 2500.
    angle : float
        Of incidence, in degrees, 0 to 89.99.
    rings : Rings
        In which light is counted.
    threads, model
        As in `hylios.transport.simulate.spectrum`.

    Raises
    ------
    InputError
        If an argument is out of range.

    Examples
    --------
    >>> import hylios
    >>> profile = hylios.profile(hylios.specimen("S3"), 633, rays=2000)
    >>> print(f"Burley's d is {profile.burley_width:.0f} mm")
    Burley's d is 1 mm
    """
    return radial_exitance(
        Stack.of(specimen, wavelength, model),
        angle=angle,
        rings=rings,
        rays=rays,
        key=stream_key(seed, wavelength),
        threads=threads,
    )


def radial_exitance(
    stack: Stack,
    *,
    angle: float = 0.0,
    rings: Rings = USUAL_RINGS,
    rays: int = 1_000_000,
    key: tuple[int, ...] = (1,),
    threads: int | None = None,
) -> RadialExitance:
    """Radial exitance of a stack of layers; `key` names the random numbers, the rest as `profile`.

    Raises
    ------
    InputError
        If an argument is out of range.
    """
    edges = rings.edges

    def tally(traced: Rays) -> np.ndarray:
        distance = traced.distance[traced.outcome == SUBSURFACE]
        ring = np.searchsorted(edges, distance, side="right") - 1
        return np.bincount(ring, minlength=edges.size)

    counts = tallied(tally, stack, rays=rays, angle=angle, key=key, threads=threads)
    return RadialExitance(angle=angle, rays=rays, edges=edges, counts=counts)
