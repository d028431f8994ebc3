"""Colours read back from renders and predicted from a table."""

import csv

import numpy as np
import pytest

from examples.demo import colours, swimsuit
from examples.demo.render import Light
from hylios.lab import colour
from hylios.skin import Skin
from hylios.skin.specimen import SPECIMENS

SKIN = np.array([[0.50, 0.27, 0.17], [0.30, 0.14, 0.08]])  # untanned, tanned
WHITE = np.ones((2, 3))


def plate(albedos: np.ndarray, unevenness: float = 0.0) -> Light:
    """A plate of 20 by 20 cm seen from y = 1, its lower and its upper half of the two albedos."""
    x, z = np.meshgrid(np.linspace(-0.1, 0.1, 81), np.linspace(0.1, -0.1, 81))
    position = np.stack([x, np.zeros_like(x), z], axis=-1)
    position[0] = 0.0  # a row of background
    normal = np.zeros_like(position) + [0.0, 1.0, 0.0]
    normal[0] = 0.0
    albedo = albedos[(z > 0.0).astype(int)]
    lamp = 0.8 + unevenness * np.abs(x - 0.04)[..., None]
    return Light(scattered=lamp * albedo, albedo=albedo, position=position, normal=normal)


def patches_of(white: Light) -> list[colours.Patch]:
    return colours.patches(white, lambda at: at[:, 2], np.array([0.0, 1.0, 0.0]))


def test_patches_lie_clear_of_the_edge_where_light_is_even():
    untanned, tanned = patches_of(plate(WHITE, unevenness=3.0))
    assert (untanned.skin, tanned.skin) == colours.SKINS
    assert untanned.centre[2] < -colours.CLEAR_OF_EDGE < colours.CLEAR_OF_EDGE < tanned.centre[2]
    assert colours.CLEAR_OF_EDGE > colours.PATCH_RADIUS + 2 * swimsuit.EDGE_WIDTH / 2


def test_a_patch_is_seen_whole_and_its_window_holds_it():
    for patch in patches_of(plate(WHITE)):
        left, right, bottom, top = patch.window
        x, z = patch.centre[0] / 0.2 + 0.5, patch.centre[2] / 0.2 + 0.5
        assert 0.0 <= left < x < right <= 1.0 and 0.0 <= bottom < z < top <= 1.0
        assert right - left == pytest.approx(2 * colours.PATCH_RADIUS / 0.2, rel=0.3)


def test_a_patch_knows_at_which_angle_it_is_seen():
    """By a camera a metre before the plate's middle."""
    for patch in patches_of(plate(WHITE)):
        aside = np.hypot(patch.centre[0], patch.centre[2])
        assert patch.angle == pytest.approx(np.degrees(np.arctan(aside)), abs=0.5)


def test_a_colour_seen_aslant_is_another_than_straight_on():
    """The model's own reflectance at the angle, at more wavelengths than the add-on's tables."""
    skin = Skin.of(SPECIMENS["S3"])
    straight, aslant = colours.predictions(skin, 0.0, [0.0], (8.0, 60.0))[0]
    assert colour.difference(straight, aslant) > 1.0


def test_a_reading_is_the_albedo_whatever_the_lamp():
    white = plate(WHITE, unevenness=3.0)
    skin = plate(SKIN, unevenness=3.0)
    for patch, expected in zip(patches_of(white), SKIN, strict=True):
        reading = colours.reading(10.0, patch, skin, white, expected)
        # Light is divided by light over the same patch: uneven light leaves the ratio alone.
        assert reading.rendered == pytest.approx(expected, rel=1e-6)
        assert reading.difference == pytest.approx(0.0, abs=1e-5)


def test_the_model_darkens_tanned_skin_alone_and_most_on_day_ten():
    days = (0, 1, 4, 10, 20, 30)
    predicted = colours.predictions(Skin.of(SPECIMENS["S3"]), 30.0, days, (20.0, 20.0))
    assert predicted.shape == (6, 2, 3)
    assert np.ptp(predicted[:, 0], axis=0) == pytest.approx([0.0, 0.0, 0.0])
    assert predicted[0, 1] == pytest.approx(predicted[0, 0], rel=1e-6)
    lightness = colour.lab(predicted[:, 1])[:, 0]
    assert days[int(np.argmin(lightness))] == 10


def test_srgb_bytes_go_back_to_the_colour():
    for linear in SKIN:
        byte = np.array(colours.srgb_bytes(linear)) / 255.0
        assert ((byte + 0.055) / 1.055) ** 2.4 == pytest.approx(linear, rel=0.02)
    assert colours.srgb_bytes(np.ones(3)) == [255, 255, 255]
    assert colour.lab(np.ones(3)) == pytest.approx([100.0, 0.0, 0.0], abs=0.02)


def test_the_file_holds_what_is_printed(tmp_path):
    readings = [
        colours.Reading(day, skin, 0.97 * linear, linear)
        for day in (0, 10)
        for skin, linear in zip(colours.SKINS, SKIN, strict=True)
    ]
    colours.write_csv(readings, tmp_path / "colours.csv")
    with (tmp_path / "colours.csv").open() as file:
        rows = list(csv.DictReader(file))
    assert [(row["day"], row["skin"]) for row in rows] == [
        ("0", "untanned"),
        ("0", "tanned"),
        ("10", "untanned"),
        ("10", "tanned"),
    ]
    assert float(rows[1]["predicted_L"]) == pytest.approx(colour.lab(SKIN[1])[0], abs=1e-3)
    report = colours.report(readings)
    assert f"{readings[0].difference:.2f}" in report
    apart = [reading.difference for reading in readings]
    assert f"mean {np.mean(apart):.2f} (allowed 0.3), largest {max(apart):.2f}" in report
    assert np.mean(apart) > colours.ALLOWED  # 3 % off is told from right
    assert all(row["rendered_red"] in report for row in rows)
