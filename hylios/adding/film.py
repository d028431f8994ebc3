"""A film of liquid on the rough surface: water, oil or sunscreen.

Its upper face is flat, and it fills the surface's folds, so that light meets the rough surface in
the film. The film neither absorbs nor scatters, and is too thin to matter otherwise. Light that the
rough surface sends back up, or lets out of the skin, is partly reflected by the upper face and
meets the surface again, any number of times.
"""

import numpy as np

from hylios.adding.directions import Directions, node_counts
from hylios.adding.surface import LEAK, TURNS, fresnel, scattered


def through_film(
    made: Directions,
    segments: int,
    film: float,
    above: float,
    roughness: float,
    angles: np.ndarray,
):
    """The surface and a film on it as one, in the terms of `surface.from_inside`.

    Parameters
    ----------
    made, segments
        Directions in the skin, with N nodes in its uppermost layer, which has those segments.
    film, above : float
        Refractive indices of the film and outside.
    angles : (A,) array
        Of incidence, in radians.

    Returns
    -------
    mirrored, let_out : (N, N), (N,) arrays
        Light from inside the skin that comes back into it, and the share let out.
    surface, entering : (A,), (A, N) arrays
        Share of light from outside that the film and the surface reflect, and where what enters
        the skin goes.
    """
    inside, within = (made, segments), _directions(made, segments, film, above)
    up, _ = made.cosines(segments)
    in_film, _ = within[0].cosines(within[1])
    turns = max(TURNS, made.counts[segments - 1] - 1, within[0].counts[-1] - 1)
    mirrored, out = scattered(up, inside, within, roughness, turns)
    again, into = scattered(in_film, within, inside, roughness, turns)
    face, _ = fresnel(in_film, film, above)
    # light that goes up in the film, summed over all times that face and surface send it back
    upwards = np.linalg.inv((1.0 + LEAK) * np.eye(face.size) - face[:, None] * again)
    let_out, back = upwards @ (1.0 - face), upwards @ (face[:, None] * into)
    first, beyond = fresnel(np.cos(angles), above, film)
    reflected, entering = scattered(beyond, within, inside, roughness, turns)
    return (
        mirrored + out @ back,
        out @ let_out,
        first + (1.0 - first) * (reflected @ let_out),
        (1.0 - first)[:, None] * (entering + reflected @ back),
    )


def _directions(
    made: Directions, segments: int, film: float, above: float
) -> tuple[Directions, int]:
    """Directions of light in the film, cut where its face and the skin reflect totally.

    It has nodes of its own: in the skin, what the film lets out is smooth where it ends, for the
    rough surface turns light by more than that.
    """
    skin = float(np.sqrt(made.bounds[segments]))
    indices = [above, *([skin] if above < skin < film else []), film]
    bounds = np.array([0.0, *indices]) ** 2
    return Directions(bounds, node_counts(bounds, made.within(segments))), len(indices)
