"""Each rule of the walk alone, against a closed form or an independent simulation in numpy.

Comparisons allow 4 standard errors: one in about 16,000 seeds fails by chance; seeds are fixed.
"""

import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from numba import njit

from hylios.skin.specimen import SPECIMENS, with_values
from hylios.tissue import Layer, Model, Stack, complete_readings
from hylios.transport.events import SURFACE, TRANSMITTED
from hylios.transport.generator import stream
from hylios.transport.interfaces import fresnel, meet_surface
from hylios.transport.simulate import spectrum, trace

RAYS = 200_000


def assert_share(share, expected, rays=RAYS):
    assert abs(share - expected) < 4.0 * np.sqrt(expected * (1.0 - expected) / rays)


def transmitted(traced):
    return (traced.outcome == TRANSMITTED).mean()


def clear(index, thickness=0.1, absorption=0.0):
    return Layer(thickness=thickness, refractive_index=index, absorption=absorption)


def combined(first, second):
    """Reflectance of two parallel interfaces, all reflections between them added up."""
    return first + (1.0 - first) ** 2 * second / (1.0 - first * second)


def test_interfaces_of_unlike_layers_reflect_as_their_series_does():
    """Air, 1.5, 1.2, 1.9, air, at 40 degrees, without absorption."""
    indices = [1.0, 1.5, 1.2, 1.9, 1.0]
    cosines = [np.sqrt(1.0 - (np.sin(np.radians(40.0)) / index) ** 2) for index in indices]
    faces = [fresnel(cosines[i], indices[i], indices[i + 1])[0] for i in range(4)]
    expected = faces[3]
    for face in reversed(faces[:3]):
        expected = combined(face, expected)
    layers = Stack(tuple(clear(index) for index in indices[1:-1]))
    traced = trace(layers, rays=RAYS, angle=40.0)
    assert_share(transmitted(traced), 1.0 - expected)
    assert_share((traced.outcome == SURFACE).mean(), faces[0])


def test_absorption_along_the_internally_reflected_path():
    """A slab of index 1.5 at 60 degrees: T = (1 - r)^2 a / (1 - r^2 a^2)."""
    cosine = np.sqrt(1.0 - (np.sin(np.radians(60.0)) / 1.5) ** 2)
    face = fresnel(np.cos(np.radians(60.0)), 1.0, 1.5)[0]
    passed = np.exp(-4.0 * 0.1 / cosine)
    expected = (1.0 - face) ** 2 * passed / (1.0 - (face * passed) ** 2)
    traced = trace(Stack((clear(1.5, absorption=4.0),)), rays=RAYS, angle=60.0)
    assert_share(transmitted(traced), expected)


def test_fibres_scatter_once_in_each_traversal():
    """So dense that each traversal has its one event, after which half go on and half go back;
    each of two layers is left at random, anew on every return: of two, 1 in 3 gets through."""
    fibres = Layer(thickness=0.1, refractive_index=1.0, absorption=0.0, rayleigh=1e6)
    assert_share(transmitted(trace(Stack((fibres,)), rays=RAYS)), 0.5)
    assert_share(transmitted(trace(Stack((fibres, fibres)), rays=RAYS)), 1.0 / 3.0)


def melanosomes(**values):
    """A layer of 1 mm with index 1 in air: nothing but melanosomes of 1 um."""
    usual = Layer(
        thickness=0.1,
        refractive_index=1.0,
        absorption=0.0,
        semi_minor=0.5e-4,
        semi_major=0.5e-4,
        encounter=1.0,
    )
    return replace(usual, **values)


@pytest.mark.parametrize("as_printed", [False, True])
def test_single_melanosomes_absorb_at_their_rate(as_printed):
    """Spheres without an index step, seldom met, so never drawn again: exp(-mu L (1 - survival)).

    A chord 2 r h, h = sqrt(1 - u), is survived with 2 (1 - (1 + t) exp(-t)) / t^2, t = 2 r mu.
    """
    layer = melanosomes(encounter=8.0, melanin_absorption=2.5e4)
    survival = 2.0 * (1.0 - 3.5 * np.exp(-2.5)) / 2.5**2
    traced = trace(Stack((layer,)), rays=RAYS, as_printed=as_printed)
    assert_share(transmitted(traced), np.exp(-8.0 * 0.1 * (1.0 - survival)))


@pytest.mark.parametrize("counting", ["chord", "diameter"])
def test_a_complex_holds_the_melanosomes_of_its_chord(counting):
    """Sphere of 4.1 melanosomes across: int(4.1 h) along a chord, h = sqrt(1 - u) evenly hit."""
    layer = melanosomes(encounter=8.0, survival=0.3, complex_radius=4.1 * 0.5e-4, semi_minor=0.5e-4)
    height = np.sqrt(1.0 - (np.arange(100_000) + 0.5) / 100_000)
    count = np.floor(4.1 * (height if counting == "chord" else np.ones(1)))
    absorbed = 1.0 - np.mean(0.3**count)
    readings = complete_readings({"complex_melanosomes": counting})
    traced = trace(Stack((layer,), readings=readings), rays=RAYS)
    assert_share(transmitted(traced), np.exp(-8.0 * 0.1 * absorbed))


CROWDED = melanosomes(thickness=20e-4, encounter=5000.0, melanin_absorption=3000.0)


@pytest.fixture(scope="module")
def passed_the_crowd():
    """Share of each of 20,000 rays that gets through the melanosomes of `CROWDED`, in numpy."""
    radius, depth, rate, rays = CROWDED.semi_minor, CROWDED.thickness, CROWDED.encounter, 20_000
    random = np.random.default_rng(21)
    passed = np.ones(rays)
    for ray in range(rays):
        place, before = 0.0, None
        while True:
            ahead = place + random.exponential(1.0 / rate)
            if ahead >= depth:
                break
            across = radius * np.sqrt(random.random())
            turn = 2.0 * np.pi * random.random()
            centre = np.array(
                [
                    -across * np.cos(turn),
                    -across * np.sin(turn),
                    ahead + np.sqrt(radius**2 - across**2),
                ]
            )
            inside = radius <= centre[2] <= depth - radius
            apart = before is None or np.linalg.norm(centre - before) >= 2.0 * radius
            if inside and apart:
                place, before = ahead, centre
                chord = 2.0 * np.sqrt(radius**2 - across**2)
                passed[ray] *= np.exp(-CROWDED.melanin_absorption * chord)
    return passed


@pytest.mark.parametrize("as_printed", [False, True])
def test_melanosomes_do_not_overlap_or_leave_their_layer(as_printed, passed_the_crowd):
    """Spheres of 1 um in 20 um, met every 2 um: the same rules in numpy, ray by ray."""
    passed = passed_the_crowd
    share = transmitted(trace(Stack((CROWDED,)), rays=RAYS, as_printed=as_printed))
    error = np.hypot(passed.std() / np.sqrt(passed.size), np.sqrt(share * (1.0 - share) / RAYS))
    assert abs(share - passed.mean()) < 4.0 * error
    clear = 2.0 * (1.0 - 1.3 * np.exp(-0.3)) / 0.3**2  # survival of one
    unhindered = np.exp(-CROWDED.encounter * CROWDED.thickness * (1.0 - clear))
    assert share - unhindered > 20.0 * error


def test_melanosomes_turn_light_by_algorithm_1():
    """Mean angle of light that met one melanosome, seldom two: that of the density's own mean."""
    scale = np.radians(5.0)
    layer = melanosomes(encounter=0.2, survival=1.0)
    traced = trace(Stack((layer,), scattering_angle=scale), rays=4 * RAYS)
    angles = np.arccos(np.clip(traced.direction[:, 2], -1.0, 1.0))
    turned = angles[(traced.outcome == TRANSMITTED) & (angles > 1e-6)]
    grid = np.linspace(0.0, np.pi, 200_001)
    density = np.exp(-grid / scale) * np.sin(grid)
    expected = (density * grid).sum() / density.sum()
    # two events in one ray, 1 in 100 of those, and light turned back push the mean by < 1 %
    assert turned.mean() == pytest.approx(expected, rel=0.03)
    assert turned.size / traced.outcome.size == pytest.approx(1.0 - np.exp(-0.02), rel=0.03)


@njit
def _meet(state, ray, index_from, index_to, roughness, crossed, upward):
    for draw in range(crossed.size):
        crossed[draw], direction = meet_surface(state, ray, index_from, index_to, roughness)
        upward[draw] = -direction[2]


def meetings(cosine, index, roughness):
    """The same as `meet_surface` from inside, for a ray with the given cosine, in numpy: normals
    of 4.8 from a tabulated inverse, and drawing again what does not fit. z points outwards."""
    random = np.random.default_rng(7)
    tilts = np.linspace(0.0, np.pi / 2, 200_001)
    density = np.sin(tilts) / (roughness**2 * np.cos(tilts) ** 2 + np.sin(tilts) ** 2) ** 2
    cumulative = np.cumsum(density) / density.sum()
    tilt = np.interp(random.random(4 * RAYS), cumulative, tilts)
    turn = 2.0 * np.pi * random.random(tilt.size)
    normal = np.stack(
        [np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn), np.cos(tilt)], axis=1
    )
    ray = np.array([np.sqrt(1.0 - cosine**2), 0.0, cosine])
    facing = normal @ ray
    total = index**2 * (1.0 - facing**2) >= 1.0
    beyond = np.sqrt(np.where(total, 0.0, 1.0 - index**2 * (1.0 - facing**2)))
    across = (index * facing - beyond) / (index * facing + beyond)
    along = (index * beyond - facing) / (index * beyond + facing)
    reflectance = np.where(total, 1.0, 0.5 * (across**2 + along**2))
    reflected = random.random(tilt.size) < reflectance
    mirrored = ray - 2.0 * facing[:, None] * normal
    passed = index * ray + (beyond - index * facing)[:, None] * normal
    upward = np.where(reflected, mirrored[:, 2], passed[:, 2])
    fits = (facing > 0.0) & (np.where(reflected, -upward, upward) > 0.0)
    return ~reflected[fits][:RAYS], upward[fits][:RAYS]


@pytest.mark.parametrize("cosine", [0.95, 0.6])
@pytest.mark.parametrize("roughness", [0.1, 0.45])
def test_a_rough_surface_lets_light_out_as_an_independent_draw_says(cosine, roughness):
    crossed, upward = np.empty(RAYS, bool), np.empty(RAYS)
    ray = (np.sqrt(1.0 - cosine**2), 0.0, -cosine)
    _meet(stream(3, 1), ray, 1.4, 1.0, roughness, crossed, upward)
    expected_crossed, expected_upward = meetings(cosine, 1.4, roughness)
    share = expected_crossed.mean()
    error = np.sqrt(2.0 * share * (1.0 - share) / RAYS)
    assert abs(crossed.mean() - share) < 4.0 * error
    for side in (True, False):
        sample, expected = upward[crossed == side], expected_upward[expected_crossed == side]
        error = np.hypot(
            sample.std() / np.sqrt(sample.size), expected.std() / np.sqrt(expected.size)
        )
        assert abs(sample.mean() - expected.mean()) < 4.0 * error


BROAD = np.concatenate(
    [np.arange(250.0, 400.0, 30.0), np.arange(400.0, 700.0, 40.0), np.arange(700, 1401, 100.0)]
)


def total(**arguments):
    return spectrum(SPECIMENS["S3"], BROAD, rays=30_000, **arguments).total


@pytest.fixture(scope="module")
def usual_total():
    return total()


@pytest.mark.parametrize(
    ("name", "choice", "expected"),
    [
        ("colloidal_melanin", "solid", (0.07, 0.33, 0.37)),
        ("melanosome_entry", "refracted", (0.01, 0.02, 0.01)),
        ("melanosome_scattering", "exponential", (0.00, 0.02, 0.02)),
        ("rayleigh", "every_collision", (0.09, 0.15, 0.09)),
        ("rayleigh_denominator", "plus_two", (0.00, 0.00, 0.02)),
        ("inner_fresnel", "off", (0.01, 0.05, 0.07)),
        ("floor", "mirrored", (0.00, 0.02, 0.04)),
    ],
)
def test_other_readings_move_s3_as_an_independent_implementation_found(
    name, choice, expected, usual_total
):
    """RMSE in the UV, the visible and 700 to 1400 nm, printed there to two places: within .012 or
    8 %, for its rounding, another choice of wavelengths and the noise of both."""
    moved = total(model=Model(readings={name: choice})) - usual_total
    regions = (BROAD < 400, (BROAD >= 400) & (BROAD < 700), BROAD >= 700)
    moves = [np.sqrt(np.mean(moved[region] ** 2)) for region in regions]
    assert np.allclose(moves, expected, atol=0.012, rtol=0.08)


@pytest.mark.parametrize(
    ("name", "choice", "most"),
    [("complex_content", "packed", -0.05), ("complex_melanosomes", "diameter", -0.015)],
)
def test_more_melanosomes_met_is_darker(name, choice, most):
    usual = spectrum(SPECIMENS["S3"], [500.0, 550.0], rays=50_000).total
    model = Model(readings={name: choice})
    other = spectrum(SPECIMENS["S3"], [500.0, 550.0], rays=50_000, model=model).total
    assert np.all(other - usual < most)


def test_compact_complexes_are_as_wide_as_a_melanosome_is_long():
    compact = with_values(SPECIMENS["S3"], {"melanosome_arrangement": "compact_complexes"})
    layer = Stack.of(compact, 550.0).layers[3]
    assert layer.complex_radius == pytest.approx(0.205e-4)
    assert layer.encounter == pytest.approx(0.75 * 0.03 / 0.205e-4)


@pytest.mark.slow
def test_a_change_in_any_source_is_compiled_anew(tmp_path):
    """numba's own cache would keep running the old physics."""
    package = Path(__file__).parents[3] / "hylios"
    shutil.copytree(package, tmp_path / "hylios", ignore=shutil.ignore_patterns("__pycache__"))
    command = [sys.executable, "-m", "hylios.commands.cli", "reflectance", "--wavelengths", "550"]

    def total():
        ended = subprocess.run(
            [*command, "--rays", "2000"], cwd=tmp_path, capture_output=True, text=True, check=True
        )
        return ended.stdout.splitlines()[1].split(",")[1]

    before = total()
    source = tmp_path / "hylios" / "transport" / "interfaces.py"
    formula = "return 0.5 * (across * across + along * along) / (both * both), beyond"
    assert formula in source.read_text()
    source.write_text(source.read_text().replace(formula, "return 0.5, beyond"))
    assert float(total()) > float(before) + 0.2
