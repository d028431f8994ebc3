"""Building a table: the light model at every knot of a skin's tanning states."""

from collections.abc import Mapping
from dataclasses import asdict, dataclass

import numpy as np

import hylios
from hylios.adding.ultraviolet import tabulated
from hylios.colour import rec709_weights
from hylios.phototypes import PHOTOTYPES, phototype, specimens
from hylios.profile import burley_width
from hylios.skin import UNTANNED, Skin
from hylios.specimen import Specimen
from hylios.spectra import Figures, estimates_within, figures
from hylios.table import PLANES, SkinTable, described_dynamics
from hylios.tissue import FIGURES, readings
from hylios.transport.simulate import DISTANCE_EDGES, Progress, Spectrum, spectrum
from lut_builder.states import choose_axes

BANDS_NM = (365.0, 1100.0, 1650.0)
"""The thesis's wavelengths in the ultraviolet and the infrared (figures 6.8 to 6.11)."""

ANGLE = 8.0
"""Of incidence, in degrees, as reflectance is measured."""


@dataclass(frozen=True)
class Settings:
    """How accurately a table is built.

    Attributes
    ----------
    knots : tuple of int
        Numbers of knots on the principal axes of the tanning states.
    visible : tuple of float
        Ascending wavelengths in nm that make the colour.
    rays : int
        Per wavelength and state.
    """

    knots: tuple[int, ...]
    visible: tuple[float, ...]
    rays: int

    @property
    def wavelengths(self) -> np.ndarray:
        """The visible ones, then `BANDS_NM`."""
        return np.array([*self.visible, *BANDS_NM])

    @property
    def states(self) -> int:
        """Number of knots in all."""
        return int(np.prod(self.knots))

    @property
    def total_rays(self) -> int:
        """Rays of a whole table."""
        return self.states * self.wavelengths.size * self.rays


def visible_wavelengths(step: float) -> tuple[float, ...]:
    """Wavelengths from 400 to 700 nm at a spacing in nm."""
    return tuple(np.arange(400.0, 700.0 + 1e-6 * step, step).tolist())


PRESETS = {
    "small": Settings(knots=(9, 2, 1), visible=visible_wavelengths(25.0), rays=50_000),
    "standard": Settings(knots=(11, 3, 2), visible=visible_wavelengths(20.0), rays=60_000),
}


@dataclass(frozen=True)
class Appearance:
    """What a spectrum looks like, and its noise.

    Attributes
    ----------
    values : (4, 3) array
        The first four of `hylios.table.PLANES`.
    colour_covariance : (3, 3) array
        Of the total colour's Monte Carlo error, linear Rec.709.
    """

    values: np.ndarray
    colour_covariance: np.ndarray


def appearance(result: Spectrum) -> Appearance:
    """Colour, band reflectance and profile width of a spectrum at `Settings.wavelengths`.

    The profile of a colour channel adds those of the wavelengths that lift the channel, weighted
    as they do; wavelengths that lower it (the colour space's negative lobes) are left out.
    """
    visible = slice(0, result.wavelengths.size - len(BANDS_NM))
    weights = rec709_weights(result.wavelengths[visible])
    exits = np.maximum(weights, 0.0) @ result.exit_counts[visible]
    planes = (
        weights @ result.subsurface[visible],
        weights @ result.total[visible],
        result.total[visible.stop :],
        [_width(row) for row in exits],
    )
    error = result.standard_error[visible]
    return Appearance(np.array(planes), (weights * error**2) @ weights.T)


def _width(exits: np.ndarray) -> float:
    """Burley's d in mm; where no light comes out of the skin any width will do."""
    return burley_width(DISTANCE_EDGES, exits) if exits.sum() > 0 else DISTANCE_EDGES[1]


def tanned_appearance(
    made_for: Skin,
    state: np.ndarray,
    settings: Settings,
    seed: int,
    threads: int | None = None,
    known: Figures | None = None,
    chosen: Mapping[str, str] | None = None,
    progress: Progress | None = None,
) -> Appearance:
    """Appearance of a skin in a tanning state (4,) by direct simulation."""
    result = spectrum(
        made_for.tanned(state[:3], state[3]),
        settings.wavelengths,
        angle=ANGLE,
        rays=settings.rays,
        seed=seed,
        threads=threads,
        known=known,
        chosen=chosen,
        progress=progress,
    )
    return appearance(result)


def build(
    made_for: Skin,
    settings: Settings,
    *,
    seed: int = 1,
    threads: int | None = None,
    known: Figures | None = None,
    chosen: Mapping[str, str] | None = None,
    progress: Progress | None = None,
) -> SkinTable:
    """Build a skin's table.

    All states use the same random numbers, so that their noise is alike and a tan over time is
    smooth. `known` and `chosen` are the spectral figures and readings, the project's own by
    default; `progress` is told the rays of each piece of work as it ends.
    """
    known = known or figures()
    axes = choose_axes(made_for, settings.knots)
    states = axes.knot_states().reshape(-1, 4)
    entries = [
        tanned_appearance(
            made_for,
            state,
            settings,
            seed,
            threads=threads,
            known=known,
            chosen=chosen,
            progress=progress,
        )
        for state in states
    ]
    values = np.array([entry.values for entry in entries])
    variance = np.array([np.diag(entry.colour_covariance) for entry in entries])
    planes = dict(zip(PLANES[:4], np.moveaxis(values, 1, 0), strict=True))
    planes["colour_error"] = np.sqrt(variance)
    cut = sum(made_for.overfull(state[:3], state[3]) for state in states)
    return SkinTable(
        axes=axes,
        planes={name: plane.reshape(*axes.shape, -1) for name, plane in planes.items()},
        provenance={
            **_provenance(made_for, settings, seed, known, readings(chosen)),
            "colour_standard_error": np.sqrt(variance.mean(axis=0)).tolist(),
            "states_with_melanin_cut": int(cut),
        },
    )


def _provenance(
    made_for: Skin,
    settings: Settings,
    seed: int,
    known: Figures,
    decided: Mapping[str, str],
) -> dict:
    own = figures()
    return {
        "software": f"skin-tan {hylios.__version__}",
        "skin": _phototype(made_for),
        "specimen": _described(made_for.specimen),
        "specimen_parameters": asdict(made_for.specimen),
        "untanned_state": UNTANNED[made_for.untanned],
        "pigmentation": made_for.pigmentation,
        "melanin_dynamics": described_dynamics(made_for.dynamics),
        "mmd_sed": made_for.mmd,
        "med_sed": made_for.med,
        "solver": "random walk",
        "readings": dict(decided),
        "absorptance": _absorptance(made_for.specimen, known, decided),
        "own_figures": {
            name: known[name].source for name in FIGURES if known[name] is not own[name]
        },
        "wavelengths_nm": list(settings.visible),
        "bands_nm": list(BANDS_NM),
        "angle_deg": ANGLE,
        "rays": settings.rays,
        "seed": seed,
        "colour": "linear Rec.709, D65, CIE 1931 2 degree",
        "profile_width_unit": "mm",
        "estimated_figures": estimates_within(known, FIGURES, settings.wavelengths),
    }


def _absorptance(specimen: Specimen, known: Figures, decided: Mapping[str, str]) -> dict:
    """What the untanned skin absorbs of ultraviolet, for doses of the sun."""
    found = tabulated(specimen, known=known, chosen=decided)
    return {
        "wavelengths_nm": found.wavelengths.tolist(),
        "values": np.round(found.values, 5).tolist(),
    }


def _phototype(made_for: Skin) -> str | None:
    """Name of the Fitzpatrick type that a skin is, unless something in it was set otherwise."""
    return next((name for name in PHOTOTYPES if phototype(name).skin == made_for), None)


def _described(specimen: Specimen) -> str:
    """The specimen's name, with what was set in it."""
    usual = specimens().get(specimen.name)
    changes = [
        f"{name}={value}"
        for name, value in asdict(specimen).items()
        if usual is not None and value != getattr(usual, name)
    ]
    return f"{specimen.name} with {', '.join(changes)}" if changes else specimen.name
