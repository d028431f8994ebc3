"""Errors of tables between their knots, from single measurements."""

from collections.abc import Sequence
from dataclasses import dataclass
from itertools import product
from typing import Any

import numpy as np

from hylios.adding.solver import NODES
from hylios.lab.colour import difference
from hylios.quadrature import skin_quadrature
from hylios.skin import Skin
from hylios.table import INTERPOLATIONS
from hylios.table.interpolation import interpolate
from lut_builder.check import FINE
from lut_builder.reachable import choose_axes
from lut_builder.settings import BANDS_NM
from lut_builder.trade.extent import Extent, fine_wavelengths, table_wavelengths
from lut_builder.trade.profiles import FineProfiles, Run, lightness_lost, share_errors
from lut_builder.trade.solving import colours


@dataclass(frozen=True)
class ColourError:
    """Errors of a table's colours and bands at states between its knots, as in `Point`."""

    mean: float
    largest: float
    bands: float


@dataclass(frozen=True)
class ProfileError:
    """Errors of a table's profiles at states between its knots, and their time, as in `Point`."""

    error: float
    shared: float
    serial: float
    rms: float
    largest: float
    lightness: float
    walked: bool = True


def colour_errors(
    skin: Skin, extent: Extent, states: np.ndarray, measured: dict[Any, Any]
) -> dict[Any, ColourError]:
    """Errors of colours by (knots, interpolation, wavelengths, nodes)."""
    few, grid = table_wavelengths(extent), fine_wavelengths()
    fine = measured["fine"]
    direct = colours(fine[:, np.isin(grid, FINE)], FINE)
    bands = np.isin(few, BANDS_NM)
    direct_bands = fine[:, np.isin(grid, BANDS_NM)]
    errors = {}
    for knots, kind in product(extent.knots, INTERPOLATIONS):
        axes = choose_axes(skin, knots)
        positions = axes.coordinates(states)

        def seen(values: np.ndarray, axes=axes, positions=positions, kind=kind) -> np.ndarray:
            return interpolate(kind, axes.knots, values.reshape(*axes.shape, -1), positions)

        at_knots = measured["knots", knots]
        seen_bands = seen(at_knots[:, bands])
        for count in extent.wavelengths:
            rule = skin_quadrature(count)
            own = np.isin(few, rule.wavelengths)
            seen_colours = seen(at_knots[:, own] @ rule.weights.T)
            for nodes in extent.nodes:
                shift = measured["nodes", nodes] - measured["nodes", NODES]
                apart = difference(seen_colours + shift[:, own] @ rule.weights.T, direct)
                errors[knots, kind, count, nodes] = ColourError(
                    mean=float(apart.mean()),
                    largest=float(apart.max()),
                    bands=root_mean_square(seen_bands + shift[:, bands] - direct_bands),
                )
    return errors


def noise_share(runs: Sequence[Sequence[Run]], fine: np.ndarray) -> float:
    """Mean squared error of tables' profiles over that of a wavelength's, of noise alone.

    The median over tables, of what a table's squared error falls by with the error aimed at.
    """
    falls = []
    for some in runs:
        squares = [root_mean_square(share_errors(run.spreads, fine)) ** 2 for run in some]
        aimed_at = [run.error**2 for run in some]
        falls.append((squares[0] - squares[-1]) / (aimed_at[0] - aimed_at[-1]))
    return max(float(np.median(falls)), 0.0)


def completed(
    runs: Sequence[Run], fine: FineProfiles, errors: Sequence[float], noise: float
) -> list[ProfileError]:
    """Error and time of a table's profiles for all errors aimed at.

    Those that were not walked follow from the most accurate run: its mean squared error falls by
    what `noise_share` says, though no further than to that of noise alone, and its largest errors
    by as much; seconds are its own, times the number of paths. All are too large rather than too
    small.

    Parameters
    ----------
    fine : FineProfiles
        Of the states at which the runs' spreads are.
    errors : sequence of float
        Descending; those of the runs come first.
    """
    completed_errors = [_profile_error(run, fine) for run in runs]
    last = completed_errors[-1]
    for error in errors[len(runs) :]:
        fallen = last.rms**2 - noise * (last.error**2 - error**2)
        rms = max(np.sqrt(max(fallen, 0.0)), last.rms * error / last.error)
        completed_errors.append(
            ProfileError(
                error,
                last.shared * (last.error / error) ** 2,
                last.serial,
                float(rms),
                float(last.largest * rms / last.rms),
                float(last.lightness * rms / last.rms),
                walked=False,
            )
        )
    return completed_errors


def _profile_error(run: Run, fine: FineProfiles) -> ProfileError:
    shares = share_errors(run.spreads, fine.spreads)
    seen = lightness_lost(fine.light, shares)
    return ProfileError(
        run.error,
        run.shared,
        run.serial,
        root_mean_square(shares),
        float(shares.max()),
        float(seen.max()),
    )


def root_mean_square(values: np.ndarray) -> float:
    """Root mean square of all values together."""
    return float(np.sqrt(np.mean(np.square(values))))
