"""Reflection and refraction at flat interfaces and at the rough surface, as matrices.

The rules of `hylios.transport.interfaces`, averaged over the surface's normals instead of drawn.
"""

from dataclasses import dataclass, replace

import numpy as np

from hylios.adding.directions import Directions, interpolation, legendre_roots

FLAT = 1e-6
"""Roughness up to which a surface is taken as flat."""

LEAK = 1e-14
"""Share of light that is lost wherever reflections between two parts are added up. So light that
is trapped between them and meets nothing there, which none gets to, has an end."""

TILTS, TURNS = 4, 5
"""Normals over which the rough surface is averaged: polar angles, and azimuths, of each part of
their ranges in which the same happens to a ray. With many nodes more azimuths are taken, for light
that grazes: nearly as many as it has nodes."""

ENTRY_TILTS, ENTRY_TURNS = 5, 4
"""Normals of the rough surface, likewise, for light that comes in."""


def fresnel(cosine, index_from, index_to) -> tuple[np.ndarray, np.ndarray]:
    """Reflectance for unpolarised light, and cosine beyond; 1 and 0 in total reflection."""
    ratio = index_from / index_to
    squared = 1.0 - ratio * ratio * (1.0 - cosine * cosine)
    beyond = np.sqrt(np.maximum(squared, 0.0))
    across = _contrast(index_from * cosine, index_to * beyond)
    along = _contrast(index_from * beyond, index_to * cosine)
    reflectance = np.where(squared <= 0.0, 1.0, 0.5 * (across * across + along * along))
    return np.asarray(reflectance), beyond


def _contrast(one, other):
    return (one - other) / np.maximum(one + other, 1e-300)


def from_inside(made: Directions, segments: int, above: float, roughness: float):
    """Reflection at the surface of light from inside, (N, N), and the share let out, (N,).

    Parameters
    ----------
    segments : int
        Of the uppermost layer.
    above : float
        Refractive index outside.
    """
    cosine, _ = made.cosines(segments)
    count, squared = cosine.size, made.bounds[segments]
    index = np.sqrt(squared)
    if roughness <= FLAT:
        reflectance, _ = fresnel(cosine, index, above)
        return np.diag(reflectance), 1.0 - reflectance
    edges = np.sqrt(np.maximum(1.0 - made.bounds[1 : segments + 1] / squared, 0.0))
    turns = max(TURNS, made.counts[segments - 1] - 1)
    met = _rough(cosine, index / above, roughness, edges, np.zeros(1), (TILTS, turns))
    matrix = interpolation(made, squared * (1.0 - met.back**2), met.reflected, met.ray, count)
    return matrix[:, :count], met.by_ray(met.crossed, count)


def from_outside(
    made: Directions, segments: int, above: float, roughness: float, angles: np.ndarray
):
    """Share that the surface reflects, (A,), and where what enters goes, (A, N).

    Parameters
    ----------
    angles : (A,) array
        Of incidence, in radians.
    """
    cosine, squared, rays = np.cos(angles), made.bounds[segments], len(angles)
    count, index = made.within(segments), np.sqrt(squared)
    if roughness <= FLAT:
        met = _flat(cosine, above, index)
        rows = interpolation(made, squared * (1.0 - met.beyond**2), met.crossed, met.ray, rays)
        return met.reflected[:, 0], rows[:, :count]
    edges = np.sqrt(np.maximum(1.0 - made.bounds[1 : segments + 1] / squared, 0.0))
    met = _rough(cosine, above / index, roughness, np.zeros(1), edges, (ENTRY_TILTS, ENTRY_TURNS))
    rows = interpolation(made, squared * (1.0 - met.beyond**2), met.crossed, met.ray, rays)
    return met.by_ray(met.reflected, rays), rows[:, :count]


def scattered(
    cosine: np.ndarray,
    here: tuple[Directions, int],
    beyond: tuple[Directions, int],
    roughness: float,
    turns: int,
):
    """Where the surface sends light (R,) that meets it in one medium, to another medium.

    Parameters
    ----------
    cosine : (R,) array
        Of the light, in the medium that it comes from.
    here, beyond
        Directions, and the number of segments, in the medium that it comes from, with N nodes, and
        in that beyond the surface, with M.
    turns : int
        Azimuths of the normals.

    Returns
    -------
    (R, N), (R, M) arrays
        Shares reflected and let through, by direction.
    """
    (squared, edges), (squared_beyond, edges_beyond) = (
        _edge_cosines(*side) for side in (here, beyond)
    )
    index, index_beyond = np.sqrt(squared), np.sqrt(squared_beyond)
    if roughness <= FLAT:
        met = _flat(cosine, index, index_beyond)
    else:
        ratio = index / index_beyond
        met = _rough(cosine, ratio, roughness, edges, edges_beyond, (TILTS, turns))
    result = []
    for (made, segments), limit, place, share in (
        (here, squared, met.back, met.reflected),
        (beyond, squared_beyond, met.beyond, met.crossed),
    ):
        rows = interpolation(made, limit * (1.0 - place**2), share, met.ray, len(cosine))
        result.append(rows[:, : made.within(segments)])
    return result


def _edge_cosines(made: Directions, segments: int) -> tuple[float, np.ndarray]:
    """Squared refractive index of a medium, and the cosines at which its segments end."""
    squared = made.bounds[segments]
    return squared, np.sqrt(np.maximum(1.0 - made.bounds[1 : segments + 1] / squared, 0.0))


@dataclass(frozen=True)
class _Met:
    """What becomes of rays that meet the surface, in K groups of P of its normals.

    Attributes
    ----------
    ray : (K,) array of int
        Which ray meets the normals of a group, ascending.
    reflected, crossed : (K, P) arrays
        Shares by normal.
    back, beyond : (K, P) arrays
        Cosines of the rays that are reflected and that have crossed.
    """

    ray: np.ndarray
    reflected: np.ndarray
    crossed: np.ndarray
    back: np.ndarray
    beyond: np.ndarray

    def by_ray(self, shares: np.ndarray, rays: int) -> np.ndarray:
        """Sums (rays,) of shares (K, P)."""
        return np.bincount(self.ray, shares.sum(axis=1), minlength=rays)


def _flat(cosine: np.ndarray, index: float, index_beyond: float) -> _Met:
    """At a flat surface: one normal."""
    reflected, passed = fresnel(cosine, index, index_beyond)
    columns = (reflected, 1.0 - reflected, cosine, passed)
    return _Met(np.arange(cosine.size), *(column[:, None] for column in columns))


def _rough(cosine, ratio, roughness, back_edges, beyond_edges, normals) -> _Met:
    """At the rough surface, for each of its normals (4.8) but those that nothing is in.

    Normals that face away from the ray, or would send it to the wrong side, are drawn again in
    the walk: here they are left out and the rest weighs 1 in all.

    Parameters
    ----------
    cosine : (N,) array
        Between the rays and the mean normal.
    ratio : float
        Of the refractive indices, from to.
    back_edges, beyond_edges : (E,) arrays
        Cosines of reflected and refracted rays at which the average is cut.
    normals : tuple of int
        Tilts and azimuths.
    """
    psi, weight = _tilts(cosine, ratio, roughness, back_edges, beyond_edges, normals[0])
    size = np.hypot(np.cos(psi), roughness * np.sin(psi))
    upright, tilted = np.cos(psi) / size, roughness * np.sin(psi) / size
    # facing = level - swing cos(turn)
    level = cosine[:, None] * upright
    swing = np.sqrt(1.0 - cosine * cosine)[:, None] * tilted
    edges = _edges(cosine[:, None], ratio, upright, back_edges, beyond_edges)
    bounds = _turn_bounds(level, swing, edges)
    ray, tilt, part = np.nonzero(np.diff(bounds) * weight[..., None] > 0.0)
    turn, share = _between(bounds[ray, tilt, part], bounds[ray, tilt, part + 1], normals[1])
    upright, level, swing, weight = (
        values[ray, tilt][:, None]
        for values in (upright, level, swing, weight * np.sin(psi) * size)
    )
    cosine = cosine[ray][:, None]
    chance, facing = weight * share, level - swing * np.cos(turn)
    reflectance, refracted = fresnel(np.maximum(facing, 0.0), ratio, 1.0)
    back = 2.0 * facing * upright - cosine
    beyond = ratio * cosine + (refracted - ratio * facing) * upright
    fits = facing > 0.0
    reflected = np.where(fits & (back > 0.0), chance * reflectance, 0.0)
    crossed = np.where(fits & (beyond > 0.0), chance * (1.0 - reflectance), 0.0)
    met = _Met(ray, reflected, crossed, back, beyond)
    whole = met.by_ray(reflected + crossed, len(psi))[ray][:, None]
    return replace(met, reflected=reflected / whole, crossed=crossed / whole)


def _edges(cosine, ratio, upright, back, beyond):
    """Cosines between ray and normal at which what happens changes, (N, T, E).

    Where a facet begins to face the ray, ceases to reflect it totally, and sends it to the given
    cosines.
    """
    cosine, upright = cosine[..., None], upright[..., None]
    zero = np.zeros_like(upright)
    total = np.sqrt(max(0.0, 1.0 - 1.0 / (ratio * ratio)))
    reflecting = 0.5 * (cosine + back) / upright
    # beyond = ratio cosine + (refracted - ratio facing) upright, solved for facing
    less = (beyond - ratio * cosine) / upright
    less = np.where(np.abs(less) < 1e-12, 1e-12, less)
    refracting = (1.0 - ratio * ratio - less * less) / (2.0 * ratio * less)
    refracting = np.where(ratio * refracting + less >= 0.0, refracting, 0.0)
    return np.concatenate([zero, zero + total, reflecting, refracting], axis=2)


def _turn_bounds(level, swing, edges):
    """Azimuths of normals between which the same happens, ascending, (N, T, parts + 1)."""
    level, swing = level[..., None], swing[..., None]
    turned = np.arccos(np.clip((level - edges) / np.maximum(swing, 1e-12), -1.0, 1.0))
    last = np.full_like(turned[..., :1], np.pi)
    return np.concatenate([np.sort(turned, axis=2), last], axis=2)


def _tilts(cosine, ratio, roughness, back, beyond, count):
    """Polar angles of normals and their weights, (N, T), cut like the azimuths.

    An edge is met at some azimuth from the tilt on at which it is met in the plane of incidence.
    The angle is psi, with tan(tilt) = roughness tan(psi), in which 4.8 is smooth.
    """
    angle = np.arccos(cosine)[:, None]
    total = np.arcsin(min(1.0, 1.0 / ratio))
    back, beyond = np.arccos(back), np.arccos(beyond)
    across, along = ratio * np.sin(angle), ratio * np.cos(angle) - np.cos(beyond)
    tilts = [
        0.5 * np.pi - angle,
        np.abs(total - angle),
        total + angle,
        0.5 * np.abs(back - angle),
        0.5 * (back + angle),
        np.arctan2(np.abs(across - np.sin(beyond)), np.abs(along)),
        np.arctan2(across + np.sin(beyond), np.abs(along)),
    ]
    tilts = np.clip(np.concatenate(tilts, axis=1), 0.0, 0.5 * np.pi)
    edges = np.sort(np.arctan2(np.sin(tilts), roughness * np.cos(tilts)), axis=1)
    first = np.zeros_like(angle)
    edges = np.concatenate([first, edges, first + 0.5 * np.pi], axis=1)
    psi, weight = _between(edges[:, :-1], edges[:, 1:], count)
    return psi.reshape(cosine.size, -1), weight.reshape(cosine.size, -1)


def _between(first, last, count):
    """Points and weights, on a further axis, of integrals in `count` points from first to last."""
    place, weight = legendre_roots(count)
    half = 0.5 * (1.0 + place)
    # crowding at the edges, some of which are roots of what is averaged
    place, weight = half * half * (3.0 - 2.0 * half), 3.0 * weight * half * (1.0 - half)
    length = (last - first)[..., None]
    return first[..., None] + length * place, length * weight
