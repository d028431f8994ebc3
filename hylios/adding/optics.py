"""The parts of a stack's optics that stay the same however much its layers absorb and scatter.

These are directions, the rough surface and the densities of scattering. They take several times
as long as adding the layers up, so they are kept: stacks that differ only in their pigments share
them.
"""

from collections.abc import Sequence
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
    stacked,
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


def groups(
    stacks: Stack, nodes: int, films: tuple[float | None, ...] = (None,)
) -> dict[Pattern, tuple[np.ndarray, list[OpticalConstants], np.ndarray]]:
    """Which stacks, of one whose numbers are arrays, can be solved together.

    Returns
    -------
    dict
        For each pattern, numbers of the stacks (M,), the optical constants that occur among them,
        with films of these refractive indices in turn, and which of these each stack has (M,).

    Raises
    ------
    InputError
        If a film's refractive index lies outside that above the stack to 2, a layer's thickness is
        not finite, or fibres that scatter once per traversal share a layer with other scatterers.
    """
    for layer in stacks.layers:
        require_range("least thickness of a layer", float(np.min(layer.thickness)), 0.0, 1e9, "cm")
        require_range("thickness of a layer", float(np.max(layer.thickness)), 0.0, 1e9, "cm")
    scatter = [_scatterers(layer, stacks) for layer in stacks.layers]
    rows = np.stack(
        [
            stacks.index_above,
            *(layer.refractive_index for layer in stacks.layers),
            stacks.index_below,
            stacks.roughness,
            stacks.scattering_angle,
            *(layer.anisotropy for layer in stacks.layers),
            *(own for kinds in scatter for own in kinds.values()),
        ],
        axis=1,
    )
    _, some, which = np.unique(rows, axis=0, return_index=True, return_inverse=True)
    which = which.reshape(-1)
    constants = [_constants(stacks, int(one), films) for one in some]
    patterns = [
        _pattern(stacks, [_kinds(kinds, int(one), stacks) for kinds in scatter], own, nodes)
        for one, own in zip(some, constants, strict=True)
    ]
    result = {}
    for shared in dict.fromkeys(patterns):
        numbers = np.array([number for number, own in enumerate(patterns) if own == shared])
        members = np.flatnonzero(np.isin(which, numbers))
        place = np.searchsorted(numbers, which[members])
        result[shared] = members, [constants[number] for number in numbers], place
    return result


def _constants(stacks: Stack, one: int, films: tuple[float | None, ...]) -> OpticalConstants:
    """The optical constants of one of the stacks."""
    inner = tuple(float(layer.refractive_index[one]) for layer in stacks.layers)  # type: ignore
    if stacks.readings["inner_fresnel"] == "off":
        inner = inner[:1] * len(inner)
    above, below, roughness, angle = (
        float(getattr(stacks, name)[one])
        for name in ("index_above", "index_below", "roughness", "scattering_angle")
    )
    for film in films:
        if film is not None:
            require_range("refractive index of the film", film, above, 2.0)
    return OpticalConstants(
        roughness=roughness,
        scattering_angle=angle,
        exponential=stacks.readings["melanosome_scattering"] == "exponential",
        indices=(above, *inner, inner[-1] if stacks.lambertian_floor else below),
        anisotropies=tuple(float(layer.anisotropy[one]) for layer in stacks.layers),  # type: ignore
        films=tuple(None if film == above else film for film in films),
    )


def _pattern(
    stacks: Stack, kinds: list[tuple[str, ...]], constants: OpticalConstants, nodes: int
) -> Pattern:
    """The pattern of stacks with the given optical constants."""
    cuts, filmed = constants.cuts, any(constants.films)
    ranks, counts = _ranks_and_counts(constants.indices, cuts, filmed, nodes)
    return Pattern(
        ranks=ranks,
        counts=counts,
        kinds=tuple(kinds),
        floor=stacks.readings["floor"] if stacks.lambertian_floor else "open",
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


def _scatterers(layer: Layer, stacks: Stack) -> dict[str, np.ndarray]:
    """Whether each kind of scatterer is in a layer; melanosomes that turn no light only absorb."""
    every = stacks.readings["rayleigh"] == "every_collision"
    fibres = np.asarray(layer.rayleigh) > 0.0
    return {
        "melanosomes": (np.asarray(layer.encounter) > 0.0) & (stacks.scattering_angle > 0.0),
        "scatterers": np.asarray(layer.scattering) > 0.0,
        "fibres": fibres & every,
        "fibres once": fibres & (not every),
    }


def _kinds(present: dict[str, np.ndarray], one: int, stacks: Stack) -> tuple[str, ...]:
    """What scatters in a layer of one of the stacks."""
    kinds = tuple(name for name in present if present[name][one])
    if "fibres once" in kinds and len(kinds) > 1:
        raise InputError(
            f"reading rayleigh is {stacks.readings['rayleigh']!r} for a layer with other "
            "scatterers too; allowed there is 'every_collision'."
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


def joined_optics(parts: Sequence[Optics], which: np.ndarray) -> Optics:
    """Optics of S stacks as one, with a leading dimension; `which` (S,) of the parts each has."""

    def gathered(arrays: Sequence[np.ndarray]) -> np.ndarray:
        return np.stack(arrays)[which]

    first = parts[0]
    return Optics(
        cosines={
            rank: (
                gathered([part.cosines[rank][0] for part in parts]),
                gathered([part.cosines[rank][1] for part in parts]),
            )
            for rank in first.cosines
        },
        media={
            number: stacked([part.media[number] for part in parts], which) for number in first.media
        },
        **{
            name: gathered([getattr(part, name) for part in parts])
            for name in ("mirrored", "let_out", "surface", "entering")
        },
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
