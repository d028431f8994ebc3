"""What a table holds, against the solver and the random walk; and what is left out of it."""

import json
from dataclasses import asdict, replace

import numpy as np
import pytest

from hylios.adding.absorptance import tabulated
from hylios.adding.spectrum import spectrum as solved
from hylios.burley import burley_width
from hylios.history import read_schedule
from hylios.quadrature import skin_quadrature
from hylios.skin import Skin
from hylios.skin.phototypes import phototype
from hylios.skin.specimen import SPECIMENS
from hylios.table import from_stored, read_table, require_provenance, skin_of, to_stored
from hylios.transport.simulate import DISTANCE_EDGES
from hylios.transport.simulate import spectrum as walked
from lut_builder.assemble import build
from lut_builder.check import check
from lut_builder.cli import main
from lut_builder.request import ANGLE
from lut_builder.settings import PRESETS, Settings

SKIN = Skin.of(SPECIMENS["S3"], "intermediate", 2.89, 1.7)
SMALL = Settings(knots=(3, 2), colour_wavelengths=5, profile_error=0.02, profile_wavelengths=4)
COLOURS = Settings(knots=(2,), colour_wavelengths=4, bands=(365.0,), profile_error=0.0)


@pytest.fixture(scope="module")
def small():
    return build(SKIN, SMALL)


@pytest.mark.parametrize("place", [(0, 0), (2, 1)])
def test_an_entry_is_the_solution_of_its_state(small, place):
    """The same solver's, alone: colours, bands and what the surface reflects."""
    state = small.axes.knot_states()[place]
    few = skin_quadrature(SMALL.colour_wavelengths)
    wavelengths = [*few.wavelengths, *SMALL.bands]
    direct = solved(SKIN.at(state), wavelengths, angle=ANGLE)
    expected = {
        "subsurface_colour": few.weights @ direct.subsurface[:-3],
        "total_colour": few.weights @ direct.total[:-3],
        "band_reflectance": direct.total[-3:],
    }
    for name, values in expected.items():
        assert small.planes[name][place] == pytest.approx(values, rel=1e-12)


def test_widths_are_those_of_a_random_walk(small):
    """Of the walk's own rays, a million: its light within the width is known to 1e-3. The table's
    is within four standard errors of the cumulative profile: a false alarm in 5000 runs."""
    place = (2, 1)
    state = small.axes.knot_states()[place]
    few = skin_quadrature(SMALL.profile_wavelengths)
    alone = walked(SKIN.at(state), few.wavelengths, angle=ANGLE, rays=250_000, seed=77)
    for channel, weights in enumerate(few.weights):
        light = weights @ (alone.exit_counts / alone.rays)
        within = np.cumsum(light) / light.sum()
        width = small.planes["profile_width"][place][channel]
        own = burley_width(DISTANCE_EDGES, np.maximum(light, 0.0))
        apart = np.ptp(np.interp([width, own], DISTANCE_EDGES[1:], within[:-1]))
        error = small.planes["profile_error"][place][channel]
        assert 0.0 < error < 0.1
        assert apart < 4.0 * np.hypot(error, 1e-3)


def test_profiles_are_as_sure_as_was_asked(small):
    """Of single wavelengths; a channel is made of some, some negative."""
    assert small.planes["profile_effective_samples"].min() > 50.0
    assert small.planes["profile_error"].max() < 0.08
    finer = build(SKIN, replace(SMALL, colour_wavelengths=4, bands=(), profile_error=0.005))
    ratio = small.planes["profile_error"] / finer.planes["profile_error"]
    assert 2.5 < np.median(ratio) < 6.0


def test_the_header_holds_what_the_untanned_skin_absorbs(small):
    told, expected = small.provenance["absorptance"], tabulated(SKIN.specimen)
    assert told["wavelengths_nm"] == expected.wavelengths.tolist()
    assert told["values"] == pytest.approx(expected.values, abs=1e-5)


@pytest.mark.parametrize(
    ("change", "planes"),
    [
        (
            {"bands": ()},
            {"subsurface_colour", "total_colour", "colour_error"},
        ),
        ({"colour_wavelengths": 0, "profile_error": 0.05}, {"band_reflectance"}),
        (
            {"profile_error": 0.05},
            {
                "subsurface_colour",
                "total_colour",
                "colour_error",
                "band_reflectance",
                "profile_width",
                "profile_error",
                "profile_effective_samples",
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


def test_a_schedule_through_the_shell(tmp_path, capsys):
    path, sun = tmp_path / "t.exr", tmp_path / "sun.csv"
    sun.write_text("# a day at the beach\nhour,melanogenesis_sed,thickening_sed\n0,6,5\n30,4,3\n")
    read = read_schedule(sun)
    assert read.hours.tolist() == [0, 30]
    assert (read.doses.tolist(), read.thickening_doses.tolist()) == ([6.0, 4.0], [5.0, 3.0])
    quick = "--knots 9,3,3,2 --wavelengths 4 --bands visible --no-profile"
    command = f"build --specimen S3 --schedule {sun} --days 10 {quick} -o {path}"
    assert main(["build", "--days", "10", "-o", str(path)]) == 2
    assert "--days is 10 without a --schedule" in capsys.readouterr().err
    assert main(command.split()) == 0
    said = capsys.readouterr().out
    told = read_table(path).provenance
    count = told["states_computed"]
    assert f"for the scene: {count}, for any sun: 162; {1 - count / 162:.0%} saved" in said
    assert count < 90 and told["states_for_any_sun"] == 162


def test_a_scene_that_reaches_farther_than_other_suns_saves_nothing(tmp_path, capsys):
    """Sun every day of 60, where the table for any sun takes up to 11 exposures for its limits."""
    sun = tmp_path / "sun.csv"
    days = [f"{24 * day + 12},13.7,13.7" for day in range(60)]
    sun.write_text("\n".join(["hour,melanogenesis_sed,thickening_sed", *days]))
    quick = "--knots 3,3,3 --wavelengths 4 --bands visible --no-profile"
    command = f"build --skin VI --schedule {sun} {quick} -o {tmp_path / 't.exr'}"
    assert main(command.split()) == 0
    assert "states for the scene: 36, for any sun: 27; none saved" in capsys.readouterr().out


def test_a_schedule_without_a_dose_is_one_state(tmp_path, capsys):
    path, sun = tmp_path / "t.exr", tmp_path / "sun.csv"
    sun.write_text("hour,melanogenesis_sed,thickening_sed\n")
    quick = "--knots 5,2 --wavelengths 4 --bands visible --no-profile"
    command = f"build --skin III --schedule {sun} {quick} -o {path}"
    assert main(command.split()) == 0
    assert "states for the scene: 1, for any sun: 10; 90% saved" in capsys.readouterr().out
    assert read_table(path).axes.shape == (1,)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("", "it is empty"),
        ("hour,melanogenesis_sed\n0,1\n", "has no column thickening_sed"),
        (
            "hour,melanogenesis_sed,thickening_sed\n0,x,1\n",
            "melanogenesis_sed in line 2 is 'x'; expected",
        ),
        ("hour,melanogenesis_sed,thickening_sed\n0,1\n", "line 2 has 2 cells and the header has 3"),
        (
            "hour,melanogenesis_sed,thickening_sed\n-1,1,1\n",
            "hour of -1 in line 2; allowed is 0 to",
        ),
        ("hour,melanogenesis_sed,thickening_sed\n0,nan,1\n", "melanogenesis_sed in line 2 is nan"),
        ("\x00\n", "cannot be read: it is empty"),
    ],
)
def test_a_schedule_that_is_none_is_one_sentence(tmp_path, capsys, text, sentence):
    sun = tmp_path / "sun.csv"
    sun.write_text(text)
    assert main(["build", "--schedule", str(sun), "-o", str(tmp_path / "t.exr")]) == 2
    error = capsys.readouterr().err
    assert sentence in error and error.count("\n") == 1


def test_a_schedule_s_days_are_limited(tmp_path, capsys):
    sun = tmp_path / "sun.csv"
    sun.write_text("hour,melanogenesis_sed,thickening_sed\n")
    command = f"build --schedule {sun} --days 367 -o {tmp_path}/t.exr"
    assert main(command.split()) == 2
    assert "days of the scene is 367; allowed is 0 to 366." in capsys.readouterr().err


def test_the_preview_is_good_enough_to_look_at():
    table = build(phototype("III").skin, PRESETS["preview"])
    found = check(table, count=40, seed=9).differences
    assert found.mean() < 0.5 and found.max() < 1.5


@pytest.mark.slow
@pytest.mark.parametrize("name", ["I", "III", "VI"])
def test_the_standard_cannot_be_told_from_the_model(name):
    table = build(phototype(name).skin, PRESETS["standard"])
    assert skin_of(table.provenance) == phototype(name).skin
    found = check(table, count=200, seed=9).differences
    assert found.mean() < 0.1 and found.max() < 0.3
