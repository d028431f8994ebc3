"""Adding the layers of a stack, from its floor up to the surface.

`Below` says what becomes of light that goes down at a depth. Every layer or face above lets some
of it through, and reflects some of what comes back.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from hylios.adding.meetings import met_in_layer
from hylios.adding.optics import Optics, Pattern, groups, is_medium, joined_optics, optics
from hylios.adding.scattering import once_per_traversal, response
from hylios.adding.surface import LEAK, fresnel
from hylios.errors import InputError, require_range, require_whole
from hylios.skin.specimen import Specimen, require_specimen
from hylios.threads import one_thread
from hylios.tissue import Model, Stack
from hylios.tissue.stacks import joined, some_of, stacks_of

NODES = 22
"""Directions by default: within 2.5e-4 of what many more give, 1e-4 rms."""

TOGETHER = 160
"""Stacks solved at once, for their matrices to stay in a processor's cache: as many as the look of
a changed skin needs (`hylios.changed_table`), for a few more take as long as many."""


Film = float | None | Sequence[float | None]
"""Refractive index of a film on the surface, None for none; or several, each in turn."""


@dataclass(frozen=True)
class Reflectance:
    """Directional-hemispherical reflectance of S stacks.

    Attributes
    ----------
    surface, subsurface, transmittance : (S,) arrays, (A, S) for several angles, (F, ...) for films
        Share of the light that the surface reflects, that leaves through it after having been
        inside, and that leaves below.
    """

    surface: NDArray[np.float64]
    subsurface: NDArray[np.float64]
    transmittance: NDArray[np.float64]

    @property
    def total(self) -> NDArray[np.float64]:
        """Reflectance."""
        return self.surface + self.subsurface

    @property
    def absorptance(self) -> NDArray[np.float64]:
        """Share of the light that is absorbed: the rest."""
        return 1.0 - self.total - self.transmittance


@dataclass(frozen=True)
class Below:
    """What becomes of light that goes down in M directions at some depth of S stacks.

    Attributes
    ----------
    returned : (S, M, M) array
        Share of light in one direction that comes back in another.
    lost : (S, M) array
        Share that leaves the stack below.
    """

    returned: np.ndarray
    lost: np.ndarray


def solve(
    stacks: Sequence[Stack],
    angle: float | Sequence[float] = 8.0,
    nodes: int = NODES,
    *,
    film: Film = None,
) -> Reflectance:
    """Reflectance and absorptance of stacks, without random numbers.

    The model is that of `hylios.transport`. What differs are the means that stand for melanosomes
    drawn again (`hylios.tissue.melanosome_encounters`), and the finite number of directions. A
    stack's result does not depend on the others. Stacks that differ only in thickness, absorption
    and amounts, from each other or from others solved before, are solved faster.

    Parameters
    ----------
    stacks : sequence of Stack
        Where a layer with melanosomes has no `survival`, it is looked up
        (`hylios.tissue.melanosome_survival`).
    angle : float or sequence of float
        Of incidence, in degrees, 0 to 89.99; several take little longer than one.
    nodes : int
        Directions, 6 to 200.
    film : float or sequence of float or None, optional
        Refractive index of a film on the surface (`hylios.adding.film`), up to 2: 1.33 for water,
        1.4 to 1.47 for oil; beyond the uppermost layer's it may be off by .003. What it reflects is
        the surface's. Several take little longer than one; None among them is no film.

    Raises
    ------
    InputError
        If an argument is out of range, a layer has no finite thickness, fibres that scatter once
        per traversal share a layer with other scatterers, or the survival in melanosomes is not
        given and cannot be looked up.
    """
    shares = np.empty((3, *_require(angle, nodes, film), len(stacks)))
    with one_thread():
        for alike in _alike(stacks):
            together = joined([stacks[number] for number in alike])
            shares[..., alike] = _shares(together, angle, nodes, film)
    return _reflectance(shares, angle, film)


def solve_specimens(
    specimens: Sequence[Specimen],
    wavelengths: np.ndarray,
    angle: float | Sequence[float] = 8.0,
    nodes: int = NODES,
    *,
    film: Film = None,
    model: Model | None = None,
) -> Reflectance:
    """As `solve`, of the stacks of N specimens at W wavelengths in nm; shares are (..., N, W).

    Faster than with stacks made one by one.
    """
    shares = np.empty((3, *_require(angle, nodes, film), len(specimens), len(wavelengths)))
    arranged: dict[str, list[int]] = {}
    for number, specimen in enumerate(specimens):
        arrangement = require_specimen(specimen).melanosome_arrangement
        arranged.setdefault(arrangement, []).append(number)
    with one_thread():
        for alike in arranged.values():
            together = stacks_of([specimens[number] for number in alike], wavelengths, model)
            some = _shares(together, angle, nodes, film)
            shares[..., alike, :] = some.reshape(*some.shape[:-1], len(alike), -1)
    return _reflectance(shares, angle, film)


def _require(angle: float | Sequence[float], nodes: int, film: Film) -> tuple[int, int]:
    """Numbers of films and angles, if these and the nodes can be used."""
    require_whole("number of nodes", nodes, 6, 200)
    angles = np.asarray(angle, dtype=float)
    if angles.ndim > 1 or not angles.size:
        raise InputError(f"angles have shape {angles.shape}; expected one row, not empty.")
    for degrees in np.atleast_1d(angles):
        require_range("angle of incidence", float(degrees), 0.0, 89.99, "degrees")
    return len(_films(film)), angles.size


def _reflectance(shares: np.ndarray, angle: float | Sequence[float], film: Film) -> Reflectance:
    """From shares (3, F, A, ...), without the axes of what there is only one of."""
    shares = shares if np.ndim(angle) else shares[:, :, 0]
    return Reflectance(*(shares if isinstance(film, Sequence) else shares[:, 0]))


def _alike(stacks: Sequence[Stack]) -> list[list[int]]:
    """Numbers of the stacks that are alike in all that is no number."""
    alike: dict[tuple, list[int]] = {}
    for number, stack in enumerate(stacks):
        kind = len(stack.layers), stack.lambertian_floor, *stack.readings.values()
        alike.setdefault(kind, []).append(number)
    return list(alike.values())


def _shares(stacks: Stack, angle: float | Sequence[float], nodes: int, film: Film) -> np.ndarray:
    """Surface, subsurface and transmitted shares (3, F, A, S) of stacks whose numbers are (S,)."""
    films, angles = _films(film), tuple(np.radians(np.atleast_1d(angle)).tolist())
    shares = np.empty((3, len(films), len(angles), np.size(stacks.roughness)))
    if not shares.size:
        return shares  # of no wavelengths, as a table without bands has them
    for shared, (members, constants, which) in groups(stacks, nodes, films).items():
        parts = [optics(own, shared, angles) for own in constants]
        for first in range(0, len(members), TOGETHER):
            some = slice(first, first + TOGETHER)
            kept, place = np.unique(which[some], return_inverse=True)
            shares[..., members[some]] = _added_up(
                some_of(stacks, members[some]),
                shared,
                joined_optics([parts[number] for number in kept], place.reshape(-1)),
                np.array([constants[number].indices for number in kept])[place.reshape(-1)],
            )
    return shares


def _films(film: Film) -> tuple[float | None, ...]:
    """Refractive indices of films, None where there is none."""
    films = film if isinstance(film, Sequence) else (film,)
    if not films:
        raise InputError("films are an empty list; expected at least one, which None may be.")
    return tuple(films)


def _added_up(stacks: Stack, shared: Pattern, parts: Optics, indices: np.ndarray) -> np.ndarray:
    """Surface, subsurface and transmitted shares, (3, F, A, S), of stacks of one pattern.

    `indices` (S, L + 2) are those of `OpticalConstants`.
    """
    cosines, deepest = parts.cosines, len(shared.kinds) - 1
    floor_cosines = cosines[shared.ranks[deepest + 1]]
    below = _floor(shared.floor, *floor_cosines, indices[:, -2:], _row(stacks.floor_reflectance))
    for number in range(deepest, -1, -1):
        rank, rank_above = shared.ranks[number + 1], shared.ranks[number]
        below = _through_layer(number, stacks, shared.kinds[number], parts, *cosines[rank], below)
        if number > 0 and rank_above != rank:
            reflectance, _ = fresnel(
                cosines[rank][0], indices[:, number + 1, None], indices[:, number, None]
            )
            below = _through_face(reflectance, cosines[rank_above][0].shape[1], below)
    return _through_surface(parts, below)


def _floor(
    kind: str, cosine: np.ndarray, weight: np.ndarray, indices: np.ndarray, share: np.ndarray
) -> Below:
    """`Below` the lower face of the last layer; `indices` (S, 2) are those of its two sides.

    A diffuse floor reflects `share` (S,) of what meets it.
    """
    if kind == "open":
        reflectance, _ = fresnel(cosine, indices[:, :1], indices[:, 1:])
        return Below(reflectance[:, :, None] * np.eye(cosine.shape[1]), 1.0 - reflectance)
    if kind == "normal":
        spread = np.broadcast_to((cosine * weight)[:, None, :], (*cosine.shape, cosine.shape[1]))
    else:
        # the cosine distribution about the mirrored ray, over the azimuths at which it is not 0
        along = cosine[:, :, None] * cosine[:, None, :]
        sine = np.sqrt(1.0 - cosine**2)
        across = sine[:, :, None] * sine[:, None, :]
        widest = np.arccos(np.clip(-along / np.maximum(across, 1e-300), -1.0, 1.0))
        spread = (along * widest + across * np.sin(widest)) * weight[:, None, :]
    returned = share[:, None, None] * spread / spread.sum(axis=2, keepdims=True)
    return Below(returned, np.broadcast_to(1.0 - share[:, None], cosine.shape))


def _through_layer(
    number: int,
    stacks: Stack,
    kinds: tuple[str, ...],
    parts: Optics,
    cosine: np.ndarray,
    weight: np.ndarray,
    below: Below,
) -> Below:
    """`Below` the upper face of the layer with that number, from that at its lower face."""
    layer = stacks.layers[number]
    thickness, absorption = _row(layer.thickness), _row(layer.absorption)
    rate, once, twice, factor = met_in_layer(layer, stacks)
    if "melanosomes" not in kinds:
        absorption = absorption + rate - rate * (once + twice)
    if not kinds:
        depth = np.multiply(absorption, thickness)
        passed = np.exp(-depth[:, None] / cosine)
        returned = passed[:, :, None] * below.returned * passed[:, None, :]
        return Below(returned, passed * below.lost)
    if is_medium(kinds):
        scattering, fibres, rate = _row(layer.scattering), _row(layer.rayleigh), rate * factor
        events = {
            "melanosomes": (rate, [rate * once, rate * twice]),
            "scatterers": (scattering, [scattering]),
            "fibres": (fibres, [fibres]),
        }
        extinction = absorption + sum(events[kind][0] for kind in kinds)
        kept = [share for kind in kinds for share in events[kind][1]]
        reflected, passed = response(parts.media[number], thickness, extinction, kept)
    else:
        fibres = _row(layer.rayleigh)
        reflected, passed = once_per_traversal(cosine, weight, thickness, absorption, fibres)
    upwards = _solved(
        reflected @ below.returned, passed, (reflected @ below.lost[:, :, None])[:, :, 0]
    )
    downwards = passed @ below.returned
    return Below(
        reflected + downwards @ upwards.returned,
        (downwards @ upwards.lost[:, :, None] + passed @ below.lost[:, :, None])[:, :, 0],
    )


def _row(number: Any) -> np.ndarray:
    """A number of a stack or layer, which is an array."""
    return number


def _through_face(reflectance: np.ndarray, count: int, below: Below) -> Below:
    """`Below` for light above a flat face, in `count` directions, from that under the face.

    `reflectance` (S, M) is that for light from below. Directions that only one side has are
    reflected totally.
    """
    stacks, fewer = reflectance.shape[0], min(reflectance.shape[1], count)
    both = np.arange(fewer)
    passed = 1.0 - reflectance[:, both]
    entering = np.zeros((stacks, reflectance.shape[1], count))
    entering[:, both, both] = passed
    upwards = _solved(reflectance[:, :, None] * below.returned, entering, reflectance * below.lost)
    returned, lost = np.zeros((stacks, count, count)), np.zeros((stacks, count))
    returned[:, both] = passed[:, :, None] * (below.returned[:, both] @ upwards.returned)
    onwards = (below.returned @ upwards.lost[:, :, None])[:, :, 0] + below.lost
    lost[:, both] = passed * onwards[:, both]
    total = np.ones((stacks, count))
    total[:, both] = reflectance[:, both]
    returned += total[:, :, None] * np.eye(count)
    return Below(returned, lost)


def _through_surface(parts: Optics, below: Below) -> np.ndarray:
    """Surface, subsurface and transmitted shares, (3, F, A, S)."""
    shares = []
    for film in range(parts.surface.shape[1]):
        mirrored, let_out, surface, entering = (
            getattr(parts, name)[:, film] for name in ("mirrored", "let_out", "surface", "entering")
        )
        ends = _solved(below.returned @ mirrored, below.returned @ let_out[:, :, None], below.lost)
        leaving, lost = entering @ ends.returned, entering @ ends.lost[:, :, None]
        shares.append([surface.T, leaving[:, :, 0].T, lost[:, :, 0].T])
    return np.array(shares).swapaxes(0, 1)


def _solved(around: np.ndarray, returned: np.ndarray, lost: np.ndarray) -> Below:
    """The sum over all times that light goes around, of what comes after; one solution for both."""
    unit = (1.0 + LEAK) * np.eye(around.shape[1])
    solution = np.linalg.solve(unit - around, np.concatenate([returned, lost[:, :, None]], axis=2))
    return Below(solution[:, :, :-1], solution[:, :, -1])
