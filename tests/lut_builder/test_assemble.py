"""What a table holds, against the solver and the random walk; and what is left out of it."""

import json
from dataclasses import asdict, replace

import numpy as np
import pytest
from small_table import SKIN, SMALL

from hylios.adding.absorptance import tabulated
from hylios.adding.spectrum import spectrum as solved
from hylios.near_far import edge_spread, model_edge_spread
from hylios.quadrature import skin_quadrature
from hylios.skin import Skin
from hylios.skin.specimen import SPECIMENS
from hylios.table import from_stored, melanin_dynamics, require_provenance, skin_of, to_stored
from hylios.tanning import PIGMENTATIONS, Exposures, simulate
from hylios.transport.simulate import DISTANCE_EDGES
from hylios.transport.simulate import spectrum as walked
from lut_builder.assemble import build
from lut_builder.near_far_fit import DISTANCES
from lut_builder.request import ANGLE, ANGLES, WATER
from lut_builder.settings import PRESETS, Settings

COLOURS = Settings(knots=(2,), colour_wavelengths=4, bands=(365.0,), profile_error=0.0)
COLOUR_PLANES = {
    "subsurface_colour",
    "total_colour",
    "subsurface_colour_45",
    "subsurface_colour_60",
    "subsurface_colour_70",
    "total_colour_45",
    "wet_subsurface_colour",
    "colour_error",
}


@pytest.mark.parametrize("place", [(0, 0, 0, 0), (2, 1, 1, 1)])
def test_an_entry_is_the_solution_of_its_state(small, place):
    """The same solver's, alone: colours at all angles and wet, bands, what the surface reflects."""
    specimen = SKIN.at(small.axes.knot_states()[place])
    few = skin_quadrature(SMALL.colour_wavelengths)
    seen = solved(specimen, few.wavelengths, angle=ANGLES, film=(None, WATER))
    bands = solved(specimen, SMALL.bands, angle=ANGLE)
    expected = {
        "subsurface_colour": few.weights @ seen.subsurface[0, 0],
        "subsurface_colour_45": few.weights @ seen.subsurface[0, 1],
        "subsurface_colour_60": few.weights @ seen.subsurface[0, 2],
        "subsurface_colour_70": few.weights @ seen.subsurface[0, 3],
        "total_colour": few.weights @ seen.total[0, 0],
        "total_colour_45": few.weights @ seen.total[0, 1],
        "wet_subsurface_colour": few.weights @ seen.subsurface[1, 0],
        "band_reflectance": bands.total,
    }
    for name, values in expected.items():
        assert small.planes[name][place] == pytest.approx(values, rel=1e-12)


@pytest.mark.parametrize("state", [SKIN.untanned_state, [0.5, 0.6, 0.3, 1.1, 4.0]])
def test_light_beyond_an_edge_is_that_of_a_random_walk(small, state):
    """The walk's own edge spread, from 60,000 rays a wavelength, beyond .1 mm."""
    few = skin_quadrature(SMALL.profile_wavelengths)
    alone = walked(SKIN.at(state), few.wavelengths, angle=ANGLE, rays=60_000, seed=77)
    light = few.weights @ (alone.exit_counts / alone.rays)
    expected = edge_spread(DISTANCE_EDGES, light, DISTANCES)
    told = small.lookup(state, ("near_share", "far_width"))
    seen = model_edge_spread(DISTANCES, told["near_share"], told["far_width"])
    assert np.abs(seen - expected).max() < 0.07


def test_near_share_and_far_width_have_errors(small):
    """Whether these are right, `test_near_far_fit` asks."""
    share, width = small.planes["near_share_error"], small.planes["far_width_error"]
    assert np.all((share > 0.0) & (share <= 1.0)) and np.all(width > 0.0)
    assert np.median(share) < 0.2
    assert np.median(width / small.planes["far_width"]) < 1.0


def test_the_header_holds_what_the_untanned_skin_absorbs(small):
    told, expected = small.provenance["absorptance"], tabulated(SKIN.specimen)
    assert told["wavelengths_nm"] == expected.wavelengths.tolist()
    assert told["values"] == pytest.approx(expected.values, abs=1e-5)


def test_a_preview_tabulates_it_in_coarser_steps():
    assert PRESETS["preview"].absorptance_step == 6.0
    assert PRESETS["standard"].absorptance_step == PRESETS["reference"].absorptance_step == 2.0


@pytest.mark.parametrize(
    ("change", "planes"),
    [
        ({"bands": ()}, COLOUR_PLANES),
        ({"colour_wavelengths": 0, "profile_error": 0.05}, {"band_reflectance"}),
        (
            {"profile_error": 0.1, "profile_wavelengths": 4},
            {
                *COLOUR_PLANES,
                "band_reflectance",
                "near_share",
                "far_width",
                "near_share_error",
                "far_width_error",
            },
        ),
    ],
)
def test_a_table_holds_what_is_asked_for(change, planes):
    table = build(SKIN, replace(COLOURS, **change))
    assert set(table.planes) == planes
    assert set(from_stored(to_stored(table)).planes) == planes


def test_what_is_left_out_does_not_change_the_rest(small):
    """Colours without profile and bands, and a single band, are the same numbers."""
    alone = build(SKIN, replace(SMALL, bands=(), profile_error=0.0))
    for name, values in alone.planes.items():
        assert np.array_equal(values, small.planes[name])
    band = build(SKIN, replace(SMALL, colour_wavelengths=0, bands=(1100.0,)))
    assert np.array_equal(
        band.planes["band_reflectance"][..., 0], small.planes["band_reflectance"][..., 1]
    )


def test_the_header_says_how_the_table_was_built(small):
    told = from_stored(to_stored(small)).provenance["settings"]
    assert told == json.loads(json.dumps(asdict(SMALL)))


@pytest.mark.parametrize("settings", PRESETS.values(), ids=list(PRESETS))
def test_settings_of_presets_are_of_the_schema(settings):
    require_provenance({"settings": asdict(settings)})


def test_a_tan_is_darker_in_every_colour_and_in_the_ultraviolet(small):
    history = simulate(
        Exposures([0], [30.0]), PIGMENTATIONS["intermediate"], mmd=2.89, med=1.7, hours=240
    )
    before, after = (small.lookup(history.states[hour]) for hour in (0, 240))
    for plane in ("subsurface_colour", "total_colour"):
        assert np.all(after[plane] < before[plane])
    assert after["band_reflectance"][0] < before["band_reflectance"][0]


def test_surface_light_is_what_total_has_more_than_subsurface(small):
    surface = small.planes["total_colour"] - small.planes["subsurface_colour"]
    assert np.all((surface > 0.03) & (surface < 0.06))
    wet = small.planes["wet_subsurface_colour"] / small.planes["subsurface_colour"]
    assert np.all((wet > 1.0) & (wet < 1.2))


def test_blood_makes_skin_redder(small):
    usual, flushed = (
        small.plane("total_colour", [*SKIN.untanned_state, blood]) for blood in (1.0, 6.0)
    )
    assert flushed[1] / flushed[0] < 0.85 * usual[1] / usual[0]


def test_same_seed_same_table_whatever_the_threads(small):
    for threads in (1, 2):
        again = build(skin_of(small.provenance), SMALL, seed=1, threads=threads)
        assert to_stored(again).checksum == to_stored(small).checksum
    other = build(skin_of(small.provenance), SMALL, seed=2)
    assert not np.array_equal(other.planes["near_share"], small.planes["near_share"])
    assert np.array_equal(other.planes["total_colour"], small.planes["total_colour"])


def test_a_header_spells_out_how_its_skin_tans(small):
    """The numbers count, not the set's name; without them, as in the first tables, the name."""
    skin = Skin.of(
        SPECIMENS["S3"], "low", tanning={"basale_extra_production": 0.05}, untanned="own"
    )
    table = build(skin, COLOURS, seed=1)
    again = from_stored(to_stored(table))
    assert skin_of(again.provenance) == skin
    assert again.provenance["skin"] is None
    assert "scaled by m_i(t)/m_i(0)" in again.provenance["untanned_state"]
    named = {key: value for key, value in small.provenance.items() if key != "melanin_dynamics"}
    assert skin_of(named) == skin_of(small.provenance)
    assert melanin_dynamics({"pigmentation": "high"}) == PIGMENTATIONS["high"]


def test_a_colour_beyond_rec709_has_no_negative_channel():
    """Skin full of carotene absorbs so much blue that the blue of its inner light would be -.01."""
    yellow = replace(SPECIMENS["S1"], epidermis_beta_carotene=10.0)
    table = from_stored(to_stored(build(Skin.of(yellow), replace(COLOURS, colour_wavelengths=8))))
    assert table.planes["subsurface_colour"][..., 2].min() == 0.0
    assert table.planes["subsurface_colour"][..., :2].min() > 0.0
