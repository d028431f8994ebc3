"""Renders after figures 6.9 to 6.12, 6.19 and 6.20: skins, what is said of readings, the path."""

import numpy as np
import pytest

from examples.figures import picture_page, spectral_claims, spectral_looks, spectral_renders
from examples.figures.light import Effort
from examples.figures.report import Row, claim
from examples.figures.spectral_claims import Seen
from examples.figures.spectral_shots import IR, LIGHT, UV, of_figures, said_of, shots
from hylios.skin.specimen import SPECIMENS


def look(nm, spotted=True, melanin=LIGHT, **named):
    skin = spectral_looks.with_melanin(melanin, **named)
    return spectral_looks.look(skin, nm, spotted=spotted, seed=1)


def test_every_shot_has_a_figure_and_a_name_of_its_own():
    every = shots()
    assert len({shot.name for shot in every}) == len(every)
    assert {shot.name.split()[0] for shot in every} == set(spectral_renders.FIGURES)
    assert [said_of(shot.nm) for shot in of_figures(("6.12",))] == ["1200 nm", "1400 nm"]
    assert Effort(figures=("6.12", "C.1")).wanted(spectral_renders.FIGURES) == ("6.12",)
    assert Effort().wanted(("6.9",)) == ("6.9",)


def test_a_skin_has_the_melanin_and_water_that_is_given():
    skin = spectral_looks.with_melanin(0.07, water=0.6)
    assert skin.pigmentation == pytest.approx(0.07)
    assert skin.reticular_water == pytest.approx(0.6 * SPECIMENS["S3"].reticular_water)


@pytest.mark.slow
def test_looks_are_darker_in_spots_and_films_take_what_they_absorb():
    ultraviolet, infrared = look(UV), look(IR)
    assert np.all(np.diff(ultraviolet.colours[:, 0]) < 0.0)
    contrast = [one.colours[-1, 0] / one.colours[0, 0] for one in (ultraviolet, infrared)]
    assert contrast[0] < 0.3 and contrast[1] > 0.8
    assert np.all(ultraviolet.near > infrared.near)
    assert ultraviolet.sunscreen == pytest.approx(1.0 / 30.0)  # SPF 30, half the amount, twice
    assert infrared.sunscreen == 1.0
    # 5.93 /cm at 1650 nm, half a millimetre, twice
    assert look(1650.0).water == pytest.approx(np.exp(-0.593), rel=1e-3)


def seen(shot, light, spots=0.0, gloss=0.1):
    """A grey face of which half is darker by a share."""
    albedo = np.ones((4, 4, 3))
    albedo[:, ::2] -= 2.0 * spots / (1.0 + spots)
    everywhere = np.ones((4, 4), bool)
    scattered = light * albedo
    return Seen(shot, albedo, scattered, albedo, gloss, everywhere, everywhere, albedo, "Face")


def mets(figure, *lights):
    drawn = [seen(shot, *light) for shot, light in zip(of_figures((figure,)), lights, strict=True)]
    return [row.met for row in spectral_claims.CLAIMS[figure](drawn)]


def test_what_is_said_of_domains_follows_the_readings():
    as_said = [(0.1, 0.2, 0.3), (0.3, 0.1, 0.2), (0.5, 0.02, 0.1)]
    brdf = [(0.11, 0.2, 0.3), (0.4, 0.1, 0.2), (0.8, 0.02, 0.1)]
    assert mets("6.9", *as_said, *brdf) == [True, True, True]
    assert mets("6.9", *as_said[::-1], *brdf[::-1]) == [False, False, False]


def test_what_is_said_of_the_infrared_follows_the_readings():
    assert mets("6.11", (0.1,), (0.15,), (0.2,)) == [True]
    assert mets("6.11", (0.1,), (0.15,), (0.12,)) == [False]
    assert mets("6.12", (0.4, 0.01, 0.2), (0.1, 0.01, 0.6)) == [True, True]
    assert mets("6.12", (0.4, 0.05, 0.6), (0.1, 0.01, 0.2)) == [False, False]


@pytest.mark.slow
@pytest.mark.parametrize("figure", ["6.12", "6.20"])
def test_a_small_render_goes_the_whole_path(tmp_path, monkeypatch, figure):
    monkeypatch.setattr(spectral_looks, "RAYS", 1000)
    options = ("--stand-in", "--scale", "0.3", "--samples", "8")
    drawn = spectral_renders.rendered(
        of_figures((figure,)), tmp_path, Effort(), lambda _: None, options
    )
    rows = spectral_renders.draw({"renders": drawn}, tmp_path)
    assert (tmp_path / f"{figure}.png").exists()
    claims = [row for row in rows if row.aim]
    assert all(row.met for row in claims) and len(rows) == len(claims) + 1  # Suzanne


def test_the_page_has_a_picture_and_what_is_said(tmp_path):
    from PIL import Image

    Image.new("RGB", (8, 8)).save(tmp_path / "6.9.png")
    rows = [claim("6.9", "glossier", "so it is", "34 %", True), Row("6.10", "without", "", "")]
    picture_page.write(tmp_path / "page.md", rows, tmp_path)
    page = (tmp_path / "page.md").read_text()
    assert "| glossier | 34 % | yes |" in page and "page/6.9.jpg" in page
    assert "6.10" not in page.split("## ", 1)[1]
    assert (tmp_path / "page" / "6.9.jpg").exists()
