"""Tables compared with the model between their knots."""

from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from hylios.errors import InputError
from hylios.skin.phototypes import phototype
from hylios.table import read_table, skin_of
from lut_builder.assemble import build
from lut_builder.check import check
from lut_builder.settings import PRESETS


def test_the_preview_is_good_enough_to_look_at():
    table = build(phototype("III").skin, PRESETS["preview"])
    checked = check(table, count=20, seed=9)
    for differences in (checked.differences, checked.slanting):
        assert differences.mean() < 0.5 and differences.max() < 1.5


@pytest.mark.slow
@pytest.mark.parametrize("name", ["I", "III", "VI"])
def test_the_standard_cannot_be_told_from_the_model(name):
    table = build(phototype(name).skin, PRESETS["standard"])
    assert skin_of(table.provenance) == phototype(name).skin
    checked = check(table, count=200, seed=9)
    assert 6.0 < checked.states[:, 4].max() < 12.0
    for differences in (checked.differences, checked.slanting):
        assert differences.mean() < 0.08 and differences.max() < 0.25
    assert np.sqrt(np.mean(checked.bands**2)) < 0.003


@pytest.mark.slow
def test_the_reference_is_at_least_twice_as_near_as_the_standard():
    """Five times in the mean (.0051 of .0249), three in the largest (.0173 of .0515) of III."""
    off = {}
    for name in ("standard", "reference"):
        settings = replace(PRESETS[name], profile_error=0.0)
        off[name] = check(build(phototype("III").skin, settings), count=100, seed=9)
    for part in ("differences", "slanting"):
        near, usual = (getattr(off[name], part) for name in ("reference", "standard"))
        assert near.mean() < usual.mean() / 2.0 and near.max() < usual.max() / 2.0


def test_check_finds_a_table_right_and_a_wrong_one_wrong(small):
    honest = check(small, count=6, seed=5)
    assert honest.differences.shape == (6,)
    assert honest.noise is None and honest.noise_share == 0.0
    assert len(set(np.round(honest.differences, 6))) == 6
    darker = {name: 0.6 * values for name, values in small.planes.items()}
    differences = check(replace(small, planes=darker), count=6, seed=5)
    assert differences.differences.min() > honest.differences.mean()


def test_a_table_of_bands_alone_is_checked_by_them(small):
    bands = replace(small, planes={"band_reflectance": small.planes["band_reflectance"]})
    checked, whole = (check(table, count=4, seed=5) for table in (bands, small))
    assert checked.differences.size == 0 and checked.slanting is None
    assert checked.bands == pytest.approx(whole.bands, abs=1e-12)
    with pytest.raises(InputError, match="no plane total_colour"):
        check(bands, count=4, seed=5, rays=100)


def test_both_ways_of_checking_say_the_same(small):
    """The solver and the random walk at the same states; the difference is the walk's noise. The
    mean of so few squares exceeds nine times what noise alone explains in less than one of 1000."""
    solved, walked = (check(small, count=4, seed=5, rays=rays) for rays in (0, 4000))
    assert np.array_equal(solved.states, walked.states)
    apart = np.mean((walked.differences - solved.differences) ** 2)
    assert 0.0 < apart < 9.0 * np.mean(walked.noise**2)
    assert walked.noise_share > 0.0


def test_checked_states_are_no_knots(small):
    states = check(small, count=10, seed=2).states
    knots = np.log(small.axes.knot_states().reshape(-1, 5))
    apart = np.abs(np.log(states)[:, None] - knots).max(axis=2).min(axis=1)
    assert apart.min() > 1e-6


def test_a_table_of_format_3_is_checked_at_its_one_angle_and_blood():
    old = read_table(Path(__file__).parents[1] / "data" / "III_format_3.exr")
    checked = check(old, count=10, seed=2)
    assert checked.differences.max() < 0.2 and checked.slanting is None
    assert np.all(checked.states[:, 4] == 1.0) and np.abs(checked.bands).max() < 0.01
