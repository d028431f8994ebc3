"""A film of liquid on the rough surface: water, oil or sunscreen.

Its upper face is flat, and it fills the surface's folds, so that light meets the rough surface in
the film. The film neither absorbs nor scatters, and is too thin to matter otherwise. Light that the
rough surface sends back up, or lets out of the skin, is partly reflected by the upper face and
meets the surface again, any number of times.
"""

import numpy as np

from hylios.adding.directions import Directions
from hylios.adding.surface import LEAK, TURNS, fresnel, scattered


def through_film(
    made: Directions,
    segments: int,
    film: int,
    above: float,
    roughness: float,
    angles: np.ndarray,
):
    """The surface and a film on it as one, in the terms of `surface.from_inside`.

    Parameters
    ----------
    segments, film : int
        Of the uppermost layer, with N nodes, and of the film.
    above : float
        Refractive index outside.
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
    index = np.sqrt(made.bounds[film])
    inner, _ = made.cosines(segments)
    within, _ = made.cosines(film)
    turns = max(TURNS, *(made.counts[last - 1] - 1 for last in (segments, film)))
    mirrored, out = scattered(made, inner, segments, film, roughness, turns)
    again, into = scattered(made, within, film, segments, roughness, turns)
    face, _ = fresnel(within, index, above)
    # light that goes up in the film, summed over all times that face and surface send it back
    upwards = np.linalg.inv((1.0 + LEAK) * np.eye(face.size) - face[:, None] * again)
    let_out, back = upwards @ (1.0 - face), upwards @ (face[:, None] * into)
    first, beyond = fresnel(np.cos(angles), above, index)
    reflected, entering = scattered(made, beyond, film, segments, roughness, turns)
    return (
        mirrored + out @ back,
        out @ let_out,
        first + (1.0 - first) * (reflected @ let_out),
        (1.0 - first)[:, None] * (entering + reflected @ back),
    )
