"""Putting a table together from its pieces."""

from collections.abc import Mapping
from dataclasses import asdict
from os import cpu_count

import numpy as np

import hylios
from hylios.burley import burley_width
from hylios.quadrature import skin_quadrature
from hylios.skin import UNTANNED, Skin
from hylios.skin.phototypes import PHOTOTYPES, phototype, specimens
from hylios.skin.specimen import Specimen
from hylios.spectra import estimates_within
from hylios.table import SkinTable, described_dynamics
from hylios.tissue import SPECTRA, Model
from lut_builder.jobs.local import in_threads
from lut_builder.jobs.run import run_units
from lut_builder.jobs.units import Unit
from lut_builder.own_spectra import described_spectra
from lut_builder.reachable import choose_axes, needed_knots
from lut_builder.request import ANGLE, Piece, Request, computed, pieces, wavelengths
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
) -> Request:
    """What has to be computed for a skin's table.

    Parameters
    ----------
    model
        Spectra and readings, the project's own by default.
    reached : (N, 4) array, optional
        Tanning states that a scene leads through, for a table of these alone.

    Raises
    ------
    InputError
        If the skin has a layer without melanin (`lut_builder.reachable.untanned_state`).
    """
    whole = axes = choose_axes(skin, settings.knots)
    states, needed, within = axes.knot_states(), np.ones(axes.shape, bool), None
    if reached is not None:
        from lut_builder.scene_axes import farthest, laid_over  # scipy

        axes, states = laid_over(whole, reached)
        needed = needed_knots(axes, reached, settings.interpolation)
        within = farthest(axes, states, reached, settings.interpolation)
    return Request(
        skin,
        settings,
        axes,
        states,
        needed,
        whole=int(np.prod(whole.shape)),
        within=within,
        seed=seed,
        model=model or Model(),
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
) -> SkinTable:
    """Build a skin's table in this process; the same whatever the number of threads.

    Parameters as in `requested`, errors as there and in `lut_builder.request.computed`.
    """
    request = requested(skin, settings, seed=seed, model=model, reached=reached)
    runner = in_threads(threads or cpu_count() or 1)
    return assembled(request, run_units(units(request), None, "", runner))


def assembled(request: Request, results: Results) -> SkinTable:
    """The table of a request from the results of its pieces."""
    settings, parts = request.settings, pieces(request)
    planes = _reflectance_planes(settings, parts, results)
    if settings.has_profile:
        planes.update(_profile_planes(settings, parts, results))
    if request.within is not None:
        planes["state"] = _state_plane(request, request.within)
        nearest = _nearest_computed(request.needed)
        planes = {name: plane[nearest] for name, plane in planes.items()}
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


def _state_plane(request: Request, within: float) -> np.ndarray:
    """The states that were computed, and how near to them a table for one scene holds, (N, 5)."""
    ratios = np.log(request.states / request.axes.untanned)
    return np.concatenate([ratios, np.full((len(ratios), 1), within)], axis=1)


def _nearest_computed(needed: np.ndarray) -> np.ndarray:
    """Number of the computed state that stands for a knot: its own, or the nearest."""
    computed_knots = np.argwhere(needed)
    return np.array(
        [((computed_knots - place) ** 2).sum(axis=1).argmin() for place in np.ndindex(needed.shape)]
    )


def _reflectance_planes(
    settings: Settings, parts: list[Piece], results: Results
) -> dict[str, np.ndarray]:
    """Colours and bands, (states, components).

    A colour beyond what Rec.709 can show, as of skin full of carotene, has 0 in the channel that
    would be negative.
    """
    colours = sorted((piece for piece in parts if piece.kind == "colours"), key=lambda p: p.first)
    piece_results = [results[piece.name] for piece in colours]
    subsurface = np.concatenate([piece["subsurface"] for piece in piece_results])
    total = subsurface + np.concatenate([piece["surface"] for piece in piece_results])
    planes = {}
    count = settings.colour_wavelengths
    if count:
        weights = skin_quadrature(count).weights
        error = SOLVER_ERROR * np.abs(weights).sum(axis=1)
        planes["subsurface_colour"] = np.maximum(subsurface[:, :count] @ weights.T, 0.0)
        planes["total_colour"] = np.maximum(total[:, :count] @ weights.T, 0.0)
        planes["colour_error"] = np.tile(error, (len(total), 1))
    if settings.bands:
        planes["band_reflectance"] = total[:, count:]
    return planes


def channel_widths(light: np.ndarray) -> np.ndarray:
    """Widths (...) in mm of the profiles of colour channels, from their light (..., bins)."""
    from hylios.transport.simulate import DISTANCE_EDGES  # numba

    seen = np.maximum(light, 0.0)
    seen[~seen.any(axis=-1), 0] = 1.0  # where no light comes out any width will do
    return np.asarray(burley_width(DISTANCE_EDGES, seen))


def _profile_planes(
    settings: Settings, parts: list[Piece], results: Results
) -> dict[str, np.ndarray]:
    """Width of each colour channel's profile, its error and effective sample size, (states, 3).

    A channel's profile is the sum of those of the wavelengths, weighted as they make the channel's
    colour, be it negatively.
    """
    from hylios.transport.shared_profiles import Profiles  # numba

    walked = sorted(
        (piece for piece in parts if piece.kind == "profile"), key=lambda p: p.wavelength
    )
    walks = [results[piece.name] for piece in walked]
    light = np.stack([piece["light"] for piece in walks], axis=1)
    squares = np.stack([piece["squares"] for piece in walks], axis=1)
    widths, errors, samples = [], [], []
    for weights in skin_quadrature(settings.profile_wavelengths).weights:
        channel = Profiles(
            light=np.einsum("w,swb->sb", weights, light),
            squares=np.einsum("w,swb->sb", weights**2, squares),
            rays=walks[0]["rays"],
            anew=walks[0]["anew"],
        )
        widths.append(channel_widths(channel.light))
        errors.append(channel.standard_error.max(axis=1))
        samples.append(channel.effective_sample_size)
    return {
        "profile_width": np.transpose(widths),
        "profile_error": np.transpose(errors),
        "profile_effective_samples": np.transpose(samples),
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
        "states_computed": int(request.needed.sum()),
        "states_for_any_sun": request.whole,
        "colour": "linear Rec.709, D65, CIE 1931 2 degree",
        "profile_width_unit": "mm",
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
