"""Putting a table together from its pieces."""

from collections.abc import Mapping
from dataclasses import asdict
from os import cpu_count

import numpy as np

import hylios
from hylios.skin import UNTANNED, Skin
from hylios.skin.phototypes import PHOTOTYPES, phototype, specimens
from hylios.skin.specimen import Specimen
from hylios.spectra import estimates_within
from hylios.table import SkinTable, described_dynamics
from hylios.threads import one_thread
from hylios.tissue import SPECTRA, Model
from lut_builder.jobs.local import in_threads
from lut_builder.jobs.run import run_units
from lut_builder.jobs.units import Unit
from lut_builder.lighting import Lighting
from lut_builder.near_far_fit import degree_of, fitted, terms
from lut_builder.own_spectra import described_spectra
from lut_builder.reachable import choose_axes, within
from lut_builder.request import ANGLE, ANGLES, WATER, Piece, Request, computed, pieces, wavelengths
from lut_builder.settings import Settings

SOLVER_ERROR = 3e-4
"""Error of a reflectance by `hylios.adding`, rms against the random walk."""

Results = Mapping[str, Mapping[str, np.ndarray]]
"""Arrays of each piece by name."""


def requested(
    skin: Skin,
    settings: Settings,
    *,
    seed: int = 1,
    model: Model | None = None,
    reached: np.ndarray | None = None,
    lighting: Lighting | None = None,
) -> Request:
    """What has to be computed for a skin's table.

    Parameters
    ----------
    model
        Spectra and readings, the project's own by default.
    reached : (N, 4) array, optional
        Tanning states that a scene leads through, for a table of these alone.
    lighting : Lighting, optional
        Of the colours, D65 and CIE 1931 2 degree by default.

    Raises
    ------
    InputError
        If the skin has a layer without melanin (`lut_builder.reachable.untanned_state`).
    """
    with one_thread():
        whole = choose_axes(skin, settings.knots)
        axes = whole if reached is None else within(whole, reached)
    return Request(
        skin,
        settings,
        axes,
        whole=int(np.prod(whole.shape)),
        seed=seed,
        model=model or Model(),
        lighting=lighting or Lighting(),
    )


def units(request: Request) -> list[Unit]:
    """The work of a request."""
    return [Unit(piece.name, computed, (request, piece), piece.size) for piece in pieces(request)]


def build(
    skin: Skin,
    settings: Settings,
    *,
    seed: int = 1,
    threads: int | None = None,
    model: Model | None = None,
    reached: np.ndarray | None = None,
    lighting: Lighting | None = None,
) -> SkinTable:
    """Build a skin's table in this process; the same whatever the number of threads.

    Parameters as in `requested`, errors as there and in `lut_builder.request.computed`.
    """
    request = requested(skin, settings, seed=seed, model=model, reached=reached, lighting=lighting)
    runner = in_threads(threads or cpu_count() or 1)
    return assembled(request, run_units(units(request), None, "", runner))


def assembled(request: Request, results: Results) -> SkinTable:
    """The table of a request from the results of its pieces."""
    settings, parts = request.settings, pieces(request)
    planes = _reflectance_planes(request, parts, results)
    if settings.has_profile:
        planes.update(_near_far_planes(request, parts, results))
    cut = sum(request.skin.overfull(state) for state in request.states)
    return SkinTable(
        axes=request.axes,
        planes={name: plane.reshape(*request.axes.shape, -1) for name, plane in planes.items()},
        provenance={
            **provenance(request),
            "absorptance": _absorptance(results["absorptance"]),
            "states_with_melanin_cut": int(cut),
        },
        interpolation=settings.interpolation,
    )


def _reflectance_planes(
    request: Request, parts: list[Piece], results: Results
) -> dict[str, np.ndarray]:
    """Colours and bands, (states, components)."""
    settings = request.settings
    colours = sorted((piece for piece in parts if piece.kind == "colours"), key=lambda p: p.first)
    piece_results = [results[piece.name] for piece in colours]

    def joined(name: str, axis: int) -> np.ndarray:
        return np.concatenate([piece[name] for piece in piece_results], axis=axis)

    subsurface = joined("subsurface", 1)
    total = subsurface + joined("surface", 1)
    planes = {}
    count = settings.colour_wavelengths
    if count:
        weights = request.lighting.weights(count)
        planes = {
            "subsurface_colour": _colour(subsurface[0], weights),
            "total_colour": _colour(total[0], weights),
            **{
                f"subsurface_colour_{angle:g}": _colour(light, weights)
                for angle, light in zip(ANGLES[1:], subsurface[1:], strict=True)
            },
            "total_colour_45": _colour(total[ANGLES.index(45.0)], weights),
            "wet_subsurface_colour": _colour(joined("wet_subsurface", 0), weights),
            "colour_error": np.tile(
                SOLVER_ERROR * np.abs(weights).sum(axis=1), (total.shape[1], 1)
            ),
        }
    if settings.bands:
        planes["band_reflectance"] = total[0, :, count:]
    return planes


def _colour(reflectance: np.ndarray, weights: np.ndarray) -> np.ndarray:
    """Colours (N, 3) of reflectances, of which those of the first wavelengths (N, W or more) count.

    A colour beyond what Rec.709 can show, as of skin full of carotene, has 0 in the channel that
    would be negative.
    """
    return np.maximum(reflectance[:, : weights.shape[1]] @ weights.T, 0.0)


def _near_far_planes(
    request: Request, parts: list[Piece], results: Results
) -> dict[str, np.ndarray]:
    """Near share and far width of each colour channel with their errors, (states, 3).

    A channel's profile is the sum of those of the wavelengths, weighted as they make the channel's
    colour, be it negatively.
    """
    walks = sorted(
        (piece for piece in parts if piece.kind == "profile"), key=lambda p: p.wavelength
    )
    light = np.stack([results[piece.name]["light"] for piece in walks], axis=1)
    degree = degree_of(request.axes, len(request.walked_states))
    walked, wanted = (
        terms(request.skin, request.axes, states, degree)
        for states in (request.walked_states, request.states)
    )
    error = request.settings.profile_error
    channels = [
        fitted(walked, np.einsum("w,swb->sb", weights, light), wanted, error, degree)
        for weights in request.lighting.weights(request.settings.profile_wavelengths)
    ]
    return {
        name: np.stack([getattr(channel, name) for channel in channels], axis=-1)
        for name in ("near_share", "far_width", "near_share_error", "far_width_error")
    }


def provenance(request: Request) -> dict:
    """What a table's header says about how it was made."""
    skin, settings = request.skin, request.settings
    model = request.model
    return {
        "software": f"skin-tan {hylios.__version__}",
        "skin": _phototype(skin),
        "specimen": _described(skin.specimen),
        "specimen_parameters": asdict(skin.specimen),
        "untanned_state": UNTANNED[skin.untanned],
        "pigmentation": skin.pigmentation,
        "melanin_dynamics": described_dynamics(skin.dynamics),
        "mmd_sed": skin.mmd,
        "med_sed": skin.med,
        "solver": f"adding, {settings.nodes} directions; profiles by random walk on shared paths",
        "settings": {
            name: list(value) if isinstance(value, tuple) else value
            for name, value in asdict(settings).items()
        },
        "readings": dict(model.readings),
        **described_spectra(model),
        "bands_nm": list(settings.bands),
        "angle_deg": ANGLE,
        "seed": request.seed,
        "film_index": WATER,
        "states_computed": len(request.states),
        "states_for_any_sun": request.whole,
        **request.lighting.described(),
        "estimated_figures": estimates_within(model.spectra, SPECTRA, wavelengths(settings)),
    }


def _absorptance(tabulated: Mapping[str, np.ndarray]) -> dict:
    """What the untanned skin absorbs of ultraviolet, for doses of the sun."""
    return {
        "wavelengths_nm": tabulated["wavelengths"].tolist(),
        "values": np.round(tabulated["values"], 5).tolist(),
    }


def _phototype(skin: Skin) -> str | None:
    """Name of the Fitzpatrick type that a skin is, unless something in it was set otherwise."""
    return next((name for name in PHOTOTYPES if phototype(name).skin == skin), None)


def _described(specimen: Specimen) -> str:
    """The specimen's name, with what was set in it."""
    usual = specimens().get(specimen.name)
    changes = [
        f"{name}={value}"
        for name, value in asdict(specimen).items()
        if usual is not None and value != getattr(usual, name)
    ]
    return f"{specimen.name} with {', '.join(changes)}" if changes else specimen.name
