"""Diffusion profiles of tables between their knots, beside finer ones, and what they take."""

from collections.abc import Sequence
from dataclasses import dataclass, replace

import numpy as np

from hylios.lab.colour import lab
from hylios.near_far import edge_spread, model_edge_spread, near_share_and_far_width
from hylios.quadrature import skin_quadrature
from hylios.skin import Skin
from hylios.transport.shared_profiles import LEAST_LIGHT, skin_profiles
from hylios.transport.simulate import DISTANCE_EDGES
from lut_builder.assemble import assembled, requested
from lut_builder.near_far_fit import DISTANCES
from lut_builder.request import ANGLE, computed, pieces
from lut_builder.settings import Settings
from lut_builder.trade.solving import timed


@dataclass(frozen=True)
class Run:
    """Profiles of a table that were walked.

    Attributes
    ----------
    error : float
        That was aimed at.
    shared, serial : float
        Seconds that cores share, and that one spends on the fit.
    spreads : (N, 3, X) array
        Edge spreads at `DISTANCES`, by what the table tells of states between its knots.
    """

    error: float
    shared: float
    serial: float
    spreads: np.ndarray


@dataclass(frozen=True)
class FineProfiles:
    """Profiles of N states against which those of tables are measured, for three channels each.

    Attributes
    ----------
    spreads : (N, 3, X) array
        Edge spreads at `DISTANCES`, by the near share and far width fitted to the walked ones.
    light : (N, 3) array
        Of the channel, linear Rec.709, that leaves after having been inside.
    misfits : (N, 3) array
        Largest difference between them and the walked ones: no table that holds near shares and
        far widths can do better.
    """

    spreads: np.ndarray
    light: np.ndarray
    misfits: np.ndarray


def fine_profiles(
    skin: Skin, states: np.ndarray, wavelengths: int, error: float, seed: int
) -> FineProfiles:
    """Profiles of states from so many wavelengths, with a standard error."""
    few = skin_quadrature(wavelengths)
    specimens = [skin.at(state) for state in states]
    # Another seed than the tables': errors are to be independent.
    profiles = skin_profiles(
        specimens, few.wavelengths, error=error, angle=ANGLE, seed=seed + 1, threads=1
    )
    channels = np.einsum(
        "cw,wsb->scb", few.weights, np.array([profile.light for profile in profiles])
    )
    light = np.maximum(channels.sum(axis=2), LEAST_LIGHT)
    spreads = model_edge_spread(DISTANCES, *near_share_and_far_width(DISTANCE_EDGES, channels))
    misfits = share_errors(spreads, edge_spread(DISTANCE_EDGES, channels, DISTANCES))
    return FineProfiles(spreads, light, misfits)


def share_errors(spreads: np.ndarray, fine: np.ndarray) -> np.ndarray:
    """Largest difference of edge spreads (..., X) and (..., X) over the distance, (...)."""
    return np.abs(spreads - fine).max(axis=-1)


def lightness_lost(light: np.ndarray, shares: np.ndarray) -> np.ndarray:
    """How much the CIE 1976 lightness of a light falls where a share of it is missing.

    So much an error of the profile's share within a distance can do at a place that light reaches
    from one side only. Elsewhere it does less, in even light nothing.

    Parameters
    ----------
    light, shares : (...) arrays
    """
    greys = np.stack([light, light * (1.0 - shares)])[..., None] * np.ones(3)
    before, after = lab(greys)[..., 0]
    return before - after


def profile_runs(
    skin: Skin,
    settings: Settings,
    errors: Sequence[float],
    states: np.ndarray,
    longest: float,
    seed: int,
) -> list[Run]:
    """Tables with profiles of ever smaller error, until one would take longer than `longest`."""
    runs: list[Run] = []
    for error in errors:
        if len(runs) > 1 and _expected(runs, error) > longest:
            break
        request = requested(skin, replace(settings, profile_error=error), seed=seed)
        shared, results = 0.0, {}
        for piece in pieces(request):
            seconds, results[piece.name] = timed(
                lambda of=request, piece=piece: computed(of, piece)
            )
            shared += seconds if piece.kind == "profile" else 0.0
        serial, table = timed(lambda of=request, by=results: assembled(of, by))
        told = table.lookup(states, ("near_share", "far_width"))
        spreads = model_edge_spread(DISTANCES, told["near_share"], told["far_width"])
        runs.append(Run(error, shared, serial, spreads))
    return runs


def _expected(runs: list[Run], error: float) -> float:
    """Seconds of the same profiles with another error, by what the last run had more than before.

    Seconds grow with the number of paths, which goes with the inverse square of the error.
    """
    before, last = runs[-2:]
    grown = max(last.shared - before.shared, 0.0)
    share = (error**-2 - last.error**-2) / (last.error**-2 - before.error**-2)
    return last.serial + last.shared + grown * share
