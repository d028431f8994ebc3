"""Points of time against error: the front among them, choosing one, its file."""

from dataclasses import replace

import numpy as np
import pytest

from hylios.errors import InputError
from lut_builder.cli import main
from lut_builder.settings import PRESETS, Settings
from lut_builder.trade.pareto import best, cheapest, front, nondominated, worst
from lut_builder.trade.points import Point, named, read_points, shipped_points, write_points


def point(seconds, error, **made):
    return Point(Settings((3,), **made), 0.0, seconds, 0.5, error / 2.0, error, 0.0)


def test_the_front_is_what_nothing_beats():
    random = np.random.default_rng(1)
    seconds, errors = random.uniform(0.0, 1.0, (2, 500))
    kept = set(nondominated(seconds, errors, 0.0))
    for one in range(500):
        beaten = np.any((seconds < seconds[one]) & (errors <= errors[one]))
        assert (one in kept) != beaten


def test_each_point_of_the_front_gains_enough():
    seconds, errors = np.array([3.0, 1.0, 2.0, 4.0, 2.0]), np.array([0.5, 1.0, 0.99, 0.485, 2.0])
    assert nondominated(seconds, errors, 0.02).tolist() == [1, 0, 3]
    assert nondominated(seconds, errors, 0.05).tolist() == [1, 0]


def test_tables_with_and_without_a_profile_have_fronts_of_their_own():
    slow = point(9.0, 0.5, profile_error=0.01)
    quick = point(1.0, 0.5, profile_error=0.0)
    assert front([quick, slow]) == [slow, quick]


def test_the_profile_counts_as_colour_does():
    one = replace(point(1.0, 0.3), profile_lightness=0.4)
    assert one.error == pytest.approx(0.5)
    assert replace(one, profile_lightness=0.0).error == 0.3


def test_tables_for_several_skins_are_as_slow_and_wrong_as_the_worst():
    light = [replace(point(1.0, 0.4), shared_seconds=3.0), point(5.0, 0.1)]
    dark = [replace(point(2.0, 0.3), shared_seconds=1.0), point(4.0, 0.2)]
    one, other = worst([light, dark])
    assert (one.shared_seconds, one.serial_seconds, one.delta_e_largest) == (3.0, 2.0, 0.4)
    assert (other.serial_seconds, other.delta_e_mean, other.delta_e_largest) == (5.0, 0.1, 0.2)
    assert worst([light]) == light


def test_choosing_by_error_and_by_time():
    points = [point(1.0, 1.0), point(10.0, 0.2), point(100.0, 0.1)]
    choose = {"cores": 2, "profile": True}
    assert cheapest(points, 0.2, **choose) is points[1]
    assert cheapest(points, 5.0, **choose) is points[0]
    assert best(points, 99.0, **choose) is points[1]
    assert best(points, 1e6, **choose) is points[2]
    with pytest.raises(InputError, match=r"0.05 CIEDE2000; the best table measured has 0.1"):
        cheapest(points, 0.05, **choose)
    with pytest.raises(InputError, match=r"time is 0.1 s; the fastest table measured takes 1.5 s"):
        best(points, 0.1, **choose)
    with pytest.raises(InputError, match="without a profile"):
        best(points, 10.0, cores=2, profile=False)


def test_more_cores_share_what_can_be_shared():
    one = replace(point(3.0, 1.0), shared_seconds=12.0)
    assert [one.seconds(cores) for cores in (1, 2, 4)] == [15.5, 9.5, 6.5]


def test_points_are_read_as_they_were_written(tmp_path):
    path = tmp_path / "front.csv"
    made = Settings((4, 3), 6, profile_error=0.02, profile_wavelengths=4, nodes=14)
    points = [
        Point(made, 1.25, 0.5, 2.0, 0.125, 0.25, 0.001, 0.01, 0.03, 0.75),
        Point(replace(made, interpolation="linear", profile_error=0.0), 1.0, 0.0, 1.0, 0.2, 0.3, 0),
    ]
    write_points(path, points, ["a note", "another, with a comma"])
    assert read_points(path) == points
    assert path.read_text().startswith("# a note\n# another, with a comma\nknots,")


@pytest.mark.parametrize("spoilt", ["", "knots,nodes\n3,22\n", "\0", "x" * 1000])
def test_another_file_is_refused_as_a_front(tmp_path, spoilt, capsys):
    path = tmp_path / "front.csv"
    path.write_text(spoilt)
    out = str(tmp_path / "t.exr")
    assert main(["build", "--max-seconds", "9", "--front", str(path), "-o", out]) == 2
    assert "front" in capsys.readouterr().err


def test_presets_are_points_of_the_shipped_front():
    """Besides them it holds no table that another beats."""
    points = shipped_points()
    assert front(points) == points
    ours = {named(point): point for point in points if named(point)}
    assert {name: point.settings for name, point in ours.items()} == PRESETS
    errors = [ours[name].delta_e_mean for name in ("preview", "standard", "reference")]
    assert errors == sorted(errors, reverse=True)
    for name in ("standard", "reference"):
        assert ours[name].delta_e_mean < 0.08 and ours[name].delta_e_largest < 0.25
        assert ours[name].band_rmse < 0.003
