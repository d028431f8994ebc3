"""What simplifications cost and buy: the simplified layers, noise, tan lines and the page."""

import datetime
import os
import signal
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from examples.simplifications import __main__ as simplifications
from examples.simplifications import edge, light, measures, report, skins, variants
from hylios.lab import colour
from hylios.quadrature import Quadrature
from hylios.skin.specimen import EPIDERMIS, SPECIMENS
from hylios.transport.simulate import DISTANCE_EDGES, Spectrum

ROOT = Path(__file__).parent.parent.parent
WAVELENGTH = 500.0


def absorbing_depth(stack):
    """Optical depth of all absorbers, melanosomes' taken by their content (4.3 for a complex)."""
    return sum(layer.thickness * layer.absorption for layer in stack.layers)


@pytest.mark.parametrize("name", list(SPECIMENS))
def test_dissolved_melanosomes_keep_their_melanin(name):
    specimen = SPECIMENS[name]
    usual = variants.whole(specimen, WAVELENGTH)
    plain = variants.plain_absorber(specimen, WAVELENGTH)
    assert all(layer.encounter == 0.0 for layer in plain.layers)
    melanin = sum(
        0.01 * getattr(specimen, f"{part}_melanosomes") * layer.thickness * layer.melanin_absorption
        for part, layer in zip(EPIDERMIS, usual.layers[1:4], strict=True)
    )
    assert absorbing_depth(plain) == pytest.approx(absorbing_depth(usual) + melanin, rel=1e-12)


@pytest.mark.parametrize("name", list(SPECIMENS))
@pytest.mark.parametrize("variant", [variants.one_epidermis, variants.spread_evenly])
def test_melanin_moved_is_still_all_there(name, variant):
    def amounts(stack):
        epidermis = stack.layers[1:-2]
        held = sum(layer.thickness * layer.encounter * layer.semi_minor for layer in epidermis)
        return [held, absorbing_depth(stack), sum(layer.thickness for layer in stack.layers)]

    specimen = SPECIMENS[name]
    moved = variant(specimen, WAVELENGTH)
    assert amounts(moved) == pytest.approx(amounts(variants.whole(specimen, WAVELENGTH)), rel=1e-12)


def test_one_epidermis_of_like_layers_is_the_three():
    """Where nothing is there to be averaged but particles of one size: none at all."""
    bare = replace(SPECIMENS["S3"], basale_melanosomes=0.0)
    three = light.reflectances([bare], np.array([450.0, 600.0]), variants.whole)
    one = light.reflectances([bare], np.array([450.0, 600.0]), variants.one_epidermis)
    assert one == pytest.approx(three, abs=1e-9)
    assert len(variants.one_epidermis(bare, WAVELENGTH).layers) == 4


def test_what_is_left_out_is_gone():
    specimen = SPECIMENS["S4"]
    clear = variants.all_of_it(specimen, WAVELENGTH)
    assert all(
        layer.rayleigh == layer.encounter == layer.scattering == 0.0 for layer in clear.layers
    )
    usual = variants.whole(specimen, WAVELENGTH)
    assert sum(layer.rayleigh > 0.0 for layer in usual.layers) == 1
    assert all(layer.rayleigh == 0.0 for layer in variants.no_rayleigh(specimen, WAVELENGTH).layers)
    rarer = variants.no_rare_pigments(specimen, WAVELENGTH)
    assert absorbing_depth(rarer) < absorbing_depth(usual)


def test_tans_darken_and_fade():
    lightness = [
        colour.lab(colour.linear_rec709(measures.COARSE, reflectance))[0]
        for reflectance in light.reflectances(
            skins.tan(SPECIMENS["S3"]), measures.COARSE, variants.whole
        )
    ]
    assert int(np.argmin(lightness)) == skins.DAYS.index(10)


def test_random_skins_are_the_same_each_time_and_go_past_s4():
    drawn = skins.random_skins(100, 1)
    assert drawn == skins.random_skins(100, 1)
    pigmentation = [skin.pigmentation for skin in drawn]
    assert min(pigmentation) < 0.01 and max(pigmentation) > SPECIMENS["S4"].pigmentation


def test_noise_is_that_of_binomial_draws():
    """4000 draws: their root mean square is known to 1 %, 4 standard errors are allowed."""
    wavelengths = measures.EVEN[::10]
    weights = colour.rec709_weights(wavelengths)
    reflectance = np.linspace(0.2, 0.6, wavelengths.size)[None]
    colours = reflectance @ weights.T
    rays, draws = 1_000_000, 4000
    expected = light.noise(weights, reflectance, colours, rays)
    drawn = np.random.default_rng(5).binomial(rays, reflectance, (draws, wavelengths.size)) / rays
    squared = colour.difference(np.broadcast_to(colours, (draws, 3)), drawn @ weights.T) ** 2
    error = squared.std() / np.sqrt(draws)
    assert abs(squared.mean() - expected**2) < 4.0 * error + 0.01 * expected**2


def ring(distance: float, share: float) -> Spectrum:
    """Light at one wavelength of which a share comes out, all of it at one distance in mm."""
    exits = np.zeros((1, DISTANCE_EDGES.size), int)
    exits[0, np.searchsorted(DISTANCE_EDGES, distance, side="right") - 1] = round(share * 1000)
    none = np.zeros((1, 6))
    return Spectrum(
        wavelengths=np.array([550.0]),
        rays=1000,
        surface=np.array([0.04]),
        subsurface=np.array([share]),
        **{name: none for name in light_fields()},
        exit_counts=exits,
    )


def light_fields():
    """Fields of a spectrum that a tan line does not look at."""
    used = {"wavelengths", "rays", "surface", "subsurface", "exit_counts"}
    return [name for name in Spectrum.__dataclass_fields__ if name not in used]


def test_half_of_a_ring_lies_beyond_a_line_through_it_and_none_beyond_its_reach():
    crossed = edge.crossing(ring(2.0, 0.5), np.array([0.0, 1.0, 2.2, 50.0]))[:, 0]
    assert crossed[0] == pytest.approx(0.25)
    assert crossed[1] == pytest.approx(0.5 * np.arccos(0.5) / np.pi, rel=0.05)
    assert crossed[2] == crossed[3] == 0.0


def test_a_line_between_like_skins_is_no_line():
    one = ring(2.0, 0.5)
    line = edge.edge(one, one, np.ones((3, 1)))
    assert line.cost == pytest.approx(np.zeros(line.places.size), abs=1e-9)
    assert line.visible_to == 0.0


def test_light_crosses_a_line_as_far_as_the_ring_reaches():
    line = edge.edge(ring(2.0, 0.5), ring(2.0, 0.25), np.ones((3, 1)))
    assert 1.9 < line.visible_to < 2.1
    assert line.mean_within(1.0) > line.mean_within(3.0) > 0.0
    middle = line.places.size // 2
    assert line.true[middle - 1 : middle + 1].mean() == pytest.approx(0.04 + 0.375, rel=1e-3)


def row(what: str) -> measures.Row:
    return measures.Row(what, np.array([0.1, 0.3]), np.array([1.0, 3.0]), 0.02, 0.5, None, 1.0)


def findings(render: float | None) -> report.Findings:
    full = Quadrature(np.array([550.0]), np.ones((3, 1)))
    choices = [("all", full), ("few", full)]
    return report.Findings(
        wavelengths=[row("all"), row("few")],
        gauss=[row("gauss")],
        rays=[row("rays")],
        model=[row("model")],
        choices=choices,
        lines=[edge.edge(ring(2.0, 0.5), ring(2.0, 0.3), np.ones((3, 1)))] * 4,
        profiles=[ring(2.0, 0.5)] * 4,
        walked=0.3,
        chance=0.25,
        solver=0.01,
        bands=np.array([0.5, 2.0, 0.5]),
        render=render,
    )


@pytest.mark.parametrize(("render", "sentence"), [(1.3, "in 1.3 times"), (None, "not measured")])
def test_the_page_has_every_row_and_no_number_missing(render, sentence):
    page = report.markdown(findings(render), datetime.date(2026, 1, 2), 60.0)
    assert sentence in page and "2026-01-02" in page and "1/100 of the time" in page
    for row in ("all", "few", "gauss", "rays", "model"):
        assert f"| {row} | 0.20, 0.30 | 2.0, 3.0 | 0.020 | 0.50 |  | 1.0 |" in page
    assert "{" not in page and "nan" not in page
    tables = [part.split("\n") for part in page.split("\n\n") if part.startswith("|")]
    for lines in tables:
        assert len({line.count("|") for line in lines}) == 1


def test_the_page_shipped_has_the_rows_of_today():
    page = (ROOT / simplifications.DOCUMENT).read_text(encoding="utf-8")
    names = [what for what, _ in [*simplifications.CHOICES, *simplifications.GAUSS]]
    for name in [*names, *(case.what for case in simplifications.CASES)]:
        assert f"| {name} |" in page


@pytest.mark.slow
def test_ctrl_c_leaves_the_page_alone(tmp_path):
    environment = {**os.environ, "PYTHONPATH": str(ROOT)}
    command = [sys.executable, "-m", "examples.simplifications"]
    running = subprocess.Popen(
        command, cwd=tmp_path, env=environment, stderr=subprocess.PIPE, text=True
    )
    shown = ""
    while "| 1/" not in shown:  # the kernels are compiled, and it measures
        shown += running.stderr.read(1)
        assert running.poll() is None
    running.send_signal(signal.SIGINT)
    _, said = running.communicate(timeout=60.0)
    assert running.returncode == 130
    assert said.rstrip().endswith("cancelled")
    assert not list(tmp_path.iterdir())
