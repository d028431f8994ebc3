"""The parts of a stack's optics that stay the same however much its layers absorb and scatter.

These are directions, the rough surface and the densities of scattering. They take several times
as long as adding the layers up, so they are kept: stacks that differ only in their pigments share
them.
"""

from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from hylios.adding.directions import Directions, integrals, node_counts
from hylios.adding.film import through_film
from hylios.adding.scattering import (
    ORDER,
    Medium,
    henyey_greenstein_moments,
    medium,
    melanosome_moments,
    rayleigh_moments,
)
from hylios.adding.surface import FLAT, from_inside, from_outside
from hylios.errors import InputError, require_range
from hylios.tissue import Layer, Stack

FILM_NODES = 0.2
"""Share of nodes that are added for a film, among directions just beyond those that get out: light
that the rough surface lets through to the film's face falls off steeply there, within the angles
that its normals turn light by. It makes the skin without a film more accurate too."""

KEPT = 4096
"""Optics kept, about 20 kB each at the default number of nodes."""


@dataclass(frozen=True)
class Pattern:
    """What stacks that can be solved together have in common.

    Attributes
    ----------
    ranks : tuple of int
        Order of the refractive indices above, of the layers, and below, among all cuts.
    counts : tuple of int
        Nodes between one index and the next (`Directions`).
    kinds : tuple of tuple of str
        What scatters in each layer.
    floor : str
        How the floor reflects; "open" where light leaves there.
    """

    ranks: tuple[int, ...]
    counts: tuple[int, ...]
    kinds: tuple[tuple[str, ...], ...]
    floor: str


@dataclass(frozen=True)
class OpticalConstants:
    """The numbers from which, with its pattern, the optics of a stack follow.

    `indices` are those above, of the layers, and below; where inner faces do not reflect, light
    finds the uppermost layer's in all. `films` are those of films on the surface; None is no film.
    """

    roughness: float
    scattering_angle: float
    exponential: bool
    indices: tuple[float, ...]
    anisotropies: tuple[float, ...]
    films: tuple[float | None, ...] = (None,)

    @property
    def cuts(self) -> tuple[float, ...]:
        """Refractive indices at which directions are cut, ascending.

        Those of films only on a flat surface: a rough one blurs what happens there, and so they
        need no nodes of their own.
        """
        flat = [film for film in self.films if film is not None and self.roughness <= FLAT]
        return tuple(sorted({*self.indices, *flat}))


@dataclass(frozen=True)
class Optics:
    """Optics of a stack.

    Attributes
    ----------
    cosines : dict of rank to (cosine, weight), (M,) arrays
        Directions in a layer whose refractive index has that rank.
    media : dict of int to Medium
        Of the layers, by number, that are one.
    mirrored, let_out
        What the surface does to light from inside (`surface.from_inside`, `film.through_film`),
        with each of the films.
    surface, entering
        What it does to light from outside (`surface.from_outside`), likewise.
    """

    cosines: dict[int, tuple[np.ndarray, np.ndarray]]
    media: dict[int, Medium]
    mirrored: np.ndarray
    let_out: np.ndarray
    surface: np.ndarray
    entering: np.ndarray


def optical_constants(stack: Stack, films: tuple[float | None, ...] = (None,)) -> OpticalConstants:
    """The optical constants of a stack, with films of these refractive indices on it in turn.

    Raises
    ------
    InputError
        If a film's lies outside that above the stack to 2.
    """
    inner = tuple(layer.refractive_index for layer in stack.layers)
    if stack.readings["inner_fresnel"] == "off":
        inner = inner[:1] * len(inner)
    for film in films:
        if film is not None:
            require_range("refractive index of the film", film, stack.index_above, 2.0)
    below = inner[-1] if stack.lambertian_floor else stack.index_below
    return OpticalConstants(
        roughness=stack.roughness,
        scattering_angle=stack.scattering_angle,
        exponential=stack.readings["melanosome_scattering"] == "exponential",
        indices=(stack.index_above, *inner, below),
        anisotropies=tuple(layer.anisotropy for layer in stack.layers),
        films=tuple(None if film == stack.index_above else film for film in films),
    )


def pattern(stack: Stack, constants: OpticalConstants, nodes: int) -> Pattern:
    """The pattern of a stack with the given optical constants.

    Raises
    ------
    InputError
        If a layer's thickness is not finite, or fibres that scatter once per traversal share a
        layer with other scatterers.
    """
    cuts, filmed = constants.cuts, any(constants.films)
    ranks, counts = _ranks_and_counts(constants.indices, cuts, filmed, nodes)
    return Pattern(
        ranks=ranks,
        counts=counts,
        kinds=tuple(_kinds(layer, stack) for layer in stack.layers),
        floor=stack.readings["floor"] if stack.lambertian_floor else "open",
    )


@lru_cache(maxsize=KEPT)
def _ranks_and_counts(
    indices: tuple[float, ...], cuts: tuple[float, ...], filmed: bool, nodes: int
) -> tuple[tuple[int, ...], tuple[int, ...]]:
    """`Pattern.ranks` and `Pattern.counts` of a stack with these refractive indices."""
    ranks = tuple(cuts.index(index) for index in indices)
    counts = list(node_counts(np.array([0.0, *cuts]) ** 2, nodes))
    if filmed:
        counts[min(ranks[0] + 1, len(counts) - 1)] += round(FILM_NODES * nodes)
    return ranks, tuple(counts)


def _kinds(layer: Layer, stack: Stack) -> tuple[str, ...]:
    """What scatters in a layer; melanosomes that turn no light only absorb."""
    require_range("thickness of a layer", layer.thickness, 0.0, 1e9, "cm")
    every = stack.readings["rayleigh"] == "every_collision"
    present = {
        "melanosomes": layer.encounter > 0.0 and stack.scattering_angle > 0.0,
        "scatterers": layer.scattering > 0.0,
        "fibres": layer.rayleigh > 0.0 and every,
        "fibres once": layer.rayleigh > 0.0 and not every,
    }
    kinds = tuple(name for name in present if present[name])
    if "fibres once" in kinds and len(kinds) > 1:
        raise InputError(
            f"reading rayleigh is {stack.readings['rayleigh']!r} for a layer with other scatterers "
            "too; allowed there is 'every_collision'."
        )
    return kinds


def is_medium(kinds: tuple[str, ...]) -> bool:
    """Whether a layer with these scatterers is solved as a medium, any number of events long."""
    return bool(kinds) and "fibres once" not in kinds


@lru_cache(maxsize=KEPT)
def optics(constants: OpticalConstants, shared: Pattern, angles: tuple[float, ...]) -> Optics:
    """Optics of stacks with these constants and pattern, for angles of incidence in radians."""
    made = Directions(np.array([0.0, *constants.cuts]) ** 2, shared.counts)
    surfaces = [_surface(made, constants, shared, film, angles) for film in constants.films]
    mirrored, let_out, surface, entering = (
        np.stack(alike) for alike in zip(*surfaces, strict=True)
    )
    return Optics(
        cosines={rank: made.cosines(rank + 1) for rank in set(shared.ranks[1:-1])},
        media=_media(made, constants, shared),
        mirrored=mirrored,
        let_out=let_out,
        surface=surface,
        entering=entering,
    )


def _surface(
    made: Directions,
    constants: OpticalConstants,
    shared: Pattern,
    film: float | None,
    angles: tuple[float, ...],
):
    """`Optics.mirrored` to `Optics.entering` with one film, or with none."""
    above, top, roughness = constants.indices[0], shared.ranks[1] + 1, constants.roughness
    if film is not None:
        return through_film(made, top, film, above, roughness, np.array(angles))
    mirrored, let_out = from_inside(made, top, above, roughness)
    surface, entering = from_outside(made, top, above, roughness, np.array(angles))
    return mirrored, let_out, surface, entering


def _media(made: Directions, constants: OpticalConstants, shared: Pattern) -> dict[int, Medium]:
    """Media of the layers; layers that are alike have one in common."""
    keys = list(zip(shared.ranks[1:-1], shared.kinds, constants.anisotropies, strict=True))
    media: dict[tuple, Medium] = {}
    for rank, kinds, anisotropy in keys:
        if is_medium(kinds) and (rank, kinds, anisotropy) not in media:
            moments = [moment for kind in kinds for moment in _moments(kind, constants, anisotropy)]
            media[rank, kinds, anisotropy] = medium(integrals(made, rank + 1, ORDER), moments)
    return {number: media[key] for number, key in enumerate(keys) if key in media}


def _moments(kind: str, constants: OpticalConstants, anisotropy: float) -> list[np.ndarray]:
    """Legendre moments of a kind of scatterer; of melanosomes met once and twice."""
    if kind == "melanosomes":
        once = melanosome_moments(constants.scattering_angle, constants.exponential)
        return [once, once**2]
    return [henyey_greenstein_moments(anisotropy) if kind == "scatterers" else rayleigh_moments()]
