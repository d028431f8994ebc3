"""What is measured of time and error, and what follows from it."""

import numpy as np
import pytest

from hylios.errors import InputError
from hylios.lab.colour import difference, rec709_weights
from hylios.skin import Skin
from hylios.skin.specimen import SPECIMENS
from lut_builder.assemble import build
from lut_builder.check import FINE
from lut_builder.settings import Settings
from lut_builder.trade.components import component_errors, regions
from lut_builder.trade.extent import BROAD, QUICK, between_knots
from lut_builder.trade.measurement import measure
from lut_builder.trade.points import Point, read_points, write_points
from lut_builder.trade.profiles import (
    FineProfiles,
    Run,
    lightness_lost,
    profile_runs,
    share_errors,
)
from lut_builder.trade.solving import reflectances
from lut_builder.trade.table_errors import completed, noise_share

S3 = Skin.of(SPECIMENS["S3"])


@pytest.fixture(scope="module")
def quick():
    return measure(S3, QUICK)


def test_lightness_lost_is_that_of_cie_1976():
    """116 (Y^(1/3) - (Y - Y s)^(1/3)) in light, 24389 / 27 Y s in the dark."""
    light, shares = np.array([0.3, 0.05, 0.005]), np.array([0.01, 0.1, 0.2])
    lost = lightness_lost(light, shares)
    cube = 116.0 * (np.cbrt(light) - np.cbrt(light * (1.0 - shares)))
    assert lost[:2] == pytest.approx(cube[:2], rel=1e-3)
    assert lost[2] == pytest.approx(24389 / 27 * 0.001, rel=1e-3)
    assert lightness_lost(np.array(1.0), np.array(1.0)) == pytest.approx(100.0, rel=1e-3)


@pytest.mark.parametrize(
    ("old", "new", "sentence"),
    [
        (",0.75", "", "cannot be read: line 3 has 14 cells and the header has 18"),
        ("4 3,", "4 x,", "front.csv is no front of lut-builder trade; in line 3 invalid literal"),
        ("4 3,", "4 0,", "in line 3 number of knots is 0; allowed is 1 to"),
        (",0.125,", ",-1,", "front.csv has a delta_e_mean of -1 in line 3; allowed is 0 to 1e+09."),
        (",0.125,", ",nan,", "delta_e_mean in line 3 is nan; allowed are finite numbers"),
    ],
)
def test_a_spoilt_row_of_a_front_is_refused_with_its_line(tmp_path, old, new, sentence):
    path = tmp_path / "front.csv"
    made = Settings((4, 3), 6, profile_error=0.02, profile_wavelengths=4, nodes=14)
    write_points(path, [Point(made, 1.25, 0.5, 2.0, 0.125, 0.25, 0.001, 0.01, 0.03, 0.75)], ["a"])
    text = path.read_text()
    spoilt = text.replace(old, new)
    if not new:
        spoilt = text.rstrip("\n").rsplit(",", 4)[0] + "\n"
    path.write_text(spoilt)
    with pytest.raises(InputError) as caught:
        read_points(path)
    assert sentence in str(caught.value)


def test_errors_of_light_beyond_an_edge():
    fine = np.array([[[0.4, 0.2, 0.1], [0.3, 0.1, 0.0]]])
    assert share_errors(fine, fine).tolist() == [[0.0, 0.0]]
    off = share_errors(fine + np.array([0.0, -0.02, 0.01]), fine)
    assert off == pytest.approx(np.full((1, 2), 0.02))


def test_profiles_that_were_not_walked_follow_from_those_that_were():
    """Noise halves with the error asked for; what does not, stays."""
    fine = np.full((50, 3, 1), 0.3)
    noise = np.random.default_rng(1).normal(0.0, 1.0, fine.shape)
    errors = (0.02, 0.01, 0.005, 0.0025)

    def runs(offset):
        return [Run(e, 3.0, 1.0, fine * (1.0 + offset + e * noise)) for e in errors[:2]]

    share = noise_share([runs(0.0), runs(0.1), runs(0.0)], fine)
    truth = FineProfiles(fine, fine[..., 0], 0.0 * fine[..., 0])
    noisy = completed(runs(0.0), truth, errors, share)
    assert [error.walked for error in noisy] == [True, True, False, False]
    assert noisy[3].rms == pytest.approx(noisy[1].rms / 4.0, rel=0.02)
    assert noisy[3].largest == pytest.approx(noisy[1].largest / 4.0, rel=0.02)
    assert noisy[3].lightness == pytest.approx(noisy[1].lightness / 4.0, rel=0.02)
    assert noisy[2].shared == 12.0 and noisy[3].shared == 48.0 and noisy[3].serial == 1.0
    off = completed(runs(0.1), truth, (*errors, 5e-4), share)
    assert off[-1].rms == pytest.approx(0.03, rel=0.05)


def test_noise_cannot_fall_by_more_than_there_is():
    """However much noise others have, a good run's error only scales."""
    fine = np.full((9, 3, 1), 0.3)
    truth = FineProfiles(fine, fine[..., 0], 0.0 * fine[..., 0])
    (_, last) = completed([Run(0.02, 3.0, 1.0, 1.01 * fine)], truth, (0.02, 0.01), 100.0)
    assert last.rms == pytest.approx(0.003 / 2.0)


def test_components_keep_what_they_span():
    """As many components as there are shapes keep all; regions need their own."""
    random = np.random.default_rng(1)
    shapes = random.uniform(0.0, 1.0, (3, BROAD.size))
    spectra = random.uniform(0.0, 1.0, (40, 3)) @ shapes
    whole = [np.full(BROAD.size, True)]
    for parts in (whole, regions(BROAD)):
        assert component_errors(spectra[:20], spectra[20:], parts, 3).max() < 1e-12
    two = component_errors(spectra[:20], spectra[20:], whole, 2)
    kept = np.linalg.svd(spectra[:20], full_matrices=False)[2][2]
    assert two == pytest.approx(np.abs(spectra[20:] @ kept) / np.sqrt(BROAD.size))
    assert component_errors(spectra[:20], spectra[20:], regions(BROAD), 2).max() < two.max()


def test_regions_share_all_wavelengths():
    parts = regions(BROAD)
    assert np.sum(parts, axis=0).tolist() == [1] * BROAD.size
    assert [BROAD[part][-1] for part in parts] == [700.0, 1400.0, 2500.0]


@pytest.mark.slow
def test_points_put_together_are_what_tables_are(quick):
    """Colours of tables that are built, at the same states.

    With 14 nodes and so few knots, adding the shift misses the largest error by 2 %; with 22
    there is none to add.
    """
    states = between_knots(S3, QUICK.states, 1)
    direct = reflectances(S3, states, FINE, QUICK.fine_nodes) @ rec709_weights(FINE).T
    wanted = {(9, 2, 2, 3): ("pchip", 14), (4, 2, 2, 2): ("linear", 22)}
    for one in quick.points:
        made = one.settings
        kind = wanted.get(made.knots)
        if made.has_profile or kind != (made.interpolation, made.nodes):
            continue
        apart = difference(build(S3, made).plane("total_colour", states), direct)
        shifted = 0.03 if made.nodes == 14 else 1e-6
        assert one.delta_e_mean == pytest.approx(apart.mean(), rel=shifted)
        assert one.delta_e_largest == pytest.approx(apart.max(), rel=shifted)
        wanted[made.knots] = None
    assert set(wanted.values()) == {None}


@pytest.mark.slow
def test_what_was_measured_is_in_order(quick):
    """More knots, wavelengths, nodes, rays, paths, components: less error."""
    mean = {(row["traded"], row["setting"]): float(row["mean"]) for row in quick.parts}
    assert mean["wavelengths", 8] < mean["wavelengths", 4]
    assert mean["nodes, spectrum", 22] < mean["nodes, spectrum", 14]
    assert mean["rays, spectrum", 1000] > mean["nodes, spectrum", 22]
    assert mean["knots, pchip", "9 2 2 3"] < mean["knots, pchip", "4 2 2 2"]
    for name in ("PCA", "PPCA"):
        errors = [mean[f"components, {name}", count] for count in (1, 2, 3)]
        assert errors == sorted(errors, reverse=True)
    assert all(mean["components, PPCA", n] < mean["components, PCA", n] for n in (1, 2, 3))
    assert mean["number", "float"] == 0.0 < mean["number", "half"] < 0.03
    assert all(point.shared_seconds > 0.0 and point.start_seconds > 0.0 for point in quick.points)


@pytest.mark.slow
def test_profiles_stop_where_they_would_take_too_long():
    """Two are always walked, or nothing would be known of how the error falls."""
    states = between_knots(S3, 2, 1)
    table = Settings((2,), 4, (), 0.1, 4, 8, nodes=10)
    runs = profile_runs(S3, table, (0.1, 0.05, 0.001), states, 0.0, 1)
    assert [run.error for run in runs] == [0.1, 0.05]
    assert all(run.spreads.shape == (2, 3, 40) and run.shared > 0.0 for run in runs)
