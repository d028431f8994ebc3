"""Reflection and refraction at flat interfaces and at the rough surface, as matrices.

The rules of `hylios.transport.interfaces`, averaged over the surface's normals instead of drawn.
"""

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
    reflected, crossed, back, _ = _rough(
        cosine, index / above, roughness, edges, np.zeros(1), (TILTS, turns)
    )
    matrix = interpolation(made, squared * (1.0 - back**2), reflected)
    return matrix[:, :count], crossed.sum(axis=1)


def from_outside(
    made: Directions, segments: int, above: float, roughness: float, angles: np.ndarray
):
    """Share that the surface reflects, (A,), and where what enters goes, (A, N).

    Parameters
    ----------
    angles : (A,) array
        Of incidence, in radians.
    """
    cosine, squared = np.cos(angles), made.bounds[segments]
    count, index = made.within(segments), np.sqrt(squared)
    if roughness <= FLAT:
        reflectance, beyond = fresnel(cosine, above, index)
        place, weight = squared * (1.0 - beyond**2), 1.0 - reflectance
        return reflectance, interpolation(made, place[:, None], weight[:, None])[:, :count]
    edges = np.sqrt(np.maximum(1.0 - made.bounds[1 : segments + 1] / squared, 0.0))
    reflected, crossed, _, beyond = _rough(
        cosine, above / index, roughness, np.zeros(1), edges, (ENTRY_TILTS, ENTRY_TURNS)
    )
    rows = interpolation(made, squared * (1.0 - beyond**2), crossed)
    return reflected.sum(axis=1), rows[:, :count]


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
        reflected, passed = fresnel(cosine, index, index_beyond)
        reflected, crossed = reflected[:, None], 1.0 - reflected[:, None]
        back, onwards = cosine[:, None], passed[:, None]
    else:
        reflected, crossed, back, onwards = _rough(
            cosine, index / index_beyond, roughness, edges, edges_beyond, (TILTS, turns)
        )
    result = []
    for (made, segments), limit, place, share in (
        (here, squared, back, reflected),
        (beyond, squared_beyond, onwards, crossed),
    ):
        rows = interpolation(made, limit * (1.0 - place**2), share)
        result.append(rows[:, : made.within(segments)])
    return result


def _edge_cosines(made: Directions, segments: int) -> tuple[float, np.ndarray]:
    """Squared refractive index of a medium, and the cosines at which its segments end."""
    squared = made.bounds[segments]
    return squared, np.sqrt(np.maximum(1.0 - made.bounds[1 : segments + 1] / squared, 0.0))


def _rough(cosine, ratio, roughness, back_edges, beyond_edges, normals):
    """What becomes of rays that meet the rough surface, for each of its normals (4.8).

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

    Returns
    -------
    reflected, crossed : (N, P) arrays
        Shares by normal.
    back, beyond : (N, P) arrays
        Cosines of the rays that are reflected and that have crossed.
    """
    psi, weight = _tilts(cosine, ratio, roughness, back_edges, beyond_edges, normals[0])
    cosine = cosine[:, None, None, None]  # rays, tilts, parts of the half circle, azimuths
    size = np.hypot(np.cos(psi), roughness * np.sin(psi))
    upright, tilted = np.cos(psi) / size, roughness * np.sin(psi) / size
    # facing = level - swing cos(turn)
    level, swing = cosine * upright, np.sqrt(1.0 - cosine * cosine) * tilted
    edges = _edges(cosine, ratio, upright, back_edges[:, None], beyond_edges[:, None])
    turn, share = _turns(level, swing, edges, normals[1])
    chance = weight * np.sin(psi) * size * share
    facing = level - swing * np.cos(turn)
    reflectance, refracted = fresnel(np.maximum(facing, 0.0), ratio, 1.0)
    back = 2.0 * facing * upright - cosine
    beyond = ratio * cosine + (refracted - ratio * facing) * upright
    fits = facing > 0.0
    reflected = np.where(fits & (back > 0.0), chance * reflectance, 0.0)
    crossed = np.where(fits & (beyond > 0.0), chance * (1.0 - reflectance), 0.0)
    whole = (reflected + crossed).sum(axis=(1, 2, 3), keepdims=True)
    shares = reflected / whole, crossed / whole, back, beyond
    return tuple(share.reshape(cosine.shape[0], -1) for share in shares)


def _edges(cosine, ratio, upright, back, beyond):
    """Cosines between ray and normal at which what happens changes, (N, T, E, 1).

    Where a facet begins to face the ray, ceases to reflect it totally, and sends it to the given
    cosines.
    """
    zero = np.zeros(np.broadcast_shapes(cosine.shape, upright.shape))
    total = np.sqrt(max(0.0, 1.0 - 1.0 / (ratio * ratio)))
    reflecting = 0.5 * (cosine + back) / upright
    # beyond = ratio cosine + (refracted - ratio facing) upright, solved for facing
    less = (beyond - ratio * cosine) / upright
    less = np.where(np.abs(less) < 1e-12, 1e-12, less)
    refracting = (1.0 - ratio * ratio - less * less) / (2.0 * ratio * less)
    refracting = np.where(ratio * refracting + less >= 0.0, refracting, 0.0)
    return np.concatenate([zero, zero + total, reflecting, refracting], axis=2)


def _turns(level, swing, edges, count):
    """Azimuths of normals and their weights, (N, T, parts, count), cut at the edges."""
    turned = np.arccos(np.clip((level - edges) / np.maximum(swing, 1e-12), -1.0, 1.0))
    last = np.full_like(turned[:, :, :1], np.pi)
    turned = np.concatenate([np.sort(turned, axis=2), last], axis=2)
    return _between(turned[..., 0], count)


def _tilts(cosine, ratio, roughness, back, beyond, count):
    """Polar angles of normals and their weights, (N, T, 1, 1), cut like the azimuths.

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
    psi, weight = _between(edges, count)
    shape = (cosine.size, -1, 1, 1)
    return psi.reshape(shape), weight.reshape(shape)


def _between(edges, count):
    """Points and weights of an integral in `count` points between edges on the last axis."""
    place, weight = legendre_roots(count)
    half = 0.5 * (1.0 + place)
    # crowding at the edges, some of which are roots of what is averaged
    place, weight = half * half * (3.0 - 2.0 * half), 3.0 * weight * half * (1.0 - half)
    length = np.diff(edges)[..., None]
    return edges[..., :-1, None] + length * place, length * weight
