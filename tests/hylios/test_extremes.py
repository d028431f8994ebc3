"""The walk over the whole parameter box and past it: every ray is counted, nothing is no number.

More melanin never brightens beyond noise: each of the 24 comparisons allows 5 standard errors, so
correct code fails for about one seed in 150,000.
"""

from dataclasses import replace
from functools import cache, lru_cache

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from hylios.errors import InputError
from hylios.skin.specimen import ARRANGEMENTS, EPIDERMIS, SPECIMENS, parameters
from hylios.tissue import READINGS, Layer, Model, Stack, complete_readings
from hylios.transport import melanosome_paths
from hylios.transport.events import LOST, SUBSURFACE
from hylios.transport.simulate import DISTANCE_EDGES, count, spectrum, trace

RAYS = 60


@pytest.fixture(scope="module", autouse=True)
def few_paths():
    """Coarse tables of survival: here every example has refractive indices of its own."""
    with pytest.MonkeyPatch.context() as changed:
        changed.setattr(melanosome_paths, "PATHS", 1 << 12)
        # The tables made before stay as they are, for the tests of other modules.
        changed.setattr(
            melanosome_paths, "path_lengths", lru_cache(melanosome_paths.path_lengths.__wrapped__)
        )
        yield


def assert_counted(layers, rays=RAYS, angle=8.0):
    """Both ways and both entries end every ray, in numbers, the same each time."""
    for as_printed in (False, True):
        work = {"rays": rays, "angle": angle, "key": (1, 2), "as_printed": as_printed}
        counted, traced = count(layers, **work), trace(layers, **work)
        assert counted.rays == rays
        assert counted.left[SUBSURFACE] == counted.exits.sum()
        assert np.array_equal(counted.left, np.bincount(traced.outcome, minlength=LOST)[:3])
        assert np.all(np.isfinite(traced.place))
        assert np.allclose(np.linalg.norm(traced.direction, axis=1), 1.0, atol=1e-6)


def numbers(*limits):
    """Any number between the limits, and often a limit itself."""
    low, high = limits
    return st.one_of(st.just(float(low)), st.just(float(high)), st.floats(low, high))


def parameter_values():
    """Values of some parameters anywhere in their ranges; thicknesses from x0.01 to x100."""
    fields = {
        parameter.name: numbers(parameter.metadata["low"], parameter.metadata["high"])
        for parameter in parameters()
        if not parameter.name.endswith(
            ("_thickness", "_melanosomes", "_colloidal_melanin", "_axis")
        )
    }
    contents = {f"{layer}_melanosomes": numbers(0.0, 60.0) for layer in EPIDERMIS}
    colloidal = {f"{layer}_colloidal_melanin": numbers(0.0, 40.0) for layer in EPIDERMIS}
    arrangement = {"melanosome_arrangement": st.sampled_from(ARRANGEMENTS)}
    return st.fixed_dictionaries({}, optional=fields | contents | colloidal | arrangement)


@settings(max_examples=50)
@given(
    name=st.sampled_from(list(SPECIMENS)),
    values=parameter_values(),
    scale=st.dictionaries(
        st.sampled_from(("corneum", *EPIDERMIS, "papillary", "reticular")),
        st.sampled_from((0.01, 0.1, 10.0, 100.0)),
    ),
    wavelength=numbers(250.0, 2500.0),
    angle=numbers(0.0, 89.99),
    reading=st.sampled_from(
        [(name, choice) for name, of in READINGS.items() for choice in of.choices]
    ),
)
def test_every_skin_gives_numbers(name, values, scale, wavelength, angle, reading):
    usual = SPECIMENS[name]
    most = {parameter.name: parameter.metadata["high"] for parameter in parameters()}
    thick = {
        name: min(getattr(usual, name) * factor, most[name])
        for name, factor in ((f"{part}_thickness", factor) for part, factor in scale.items())
    }
    specimen = replace(usual, **values, **thick)
    model = Model(readings=dict([reading]))
    try:
        layers = Stack.of(specimen, wavelength, model)
    except InputError as error:
        assert "thickness is" in str(error)  # of a layer, for the melanosomes in it
        assume(False)
    assume(sum(layer.thickness * layer.encounter for layer in layers.layers) < 300)
    assert_counted(layers, angle=angle)
    reflected = spectrum(specimen, [wavelength], angle=angle, rays=RAYS, seed=7, model=model)
    again = spectrum(specimen, [wavelength], angle=angle, rays=RAYS, seed=7, model=model)
    assert abs(reflected.total[0] + reflected.absorptance[0] - 1.0) < 1e-12
    assert np.allclose(reflected.absorbed_by.sum(axis=2), reflected.absorbed, rtol=1e-12, atol=0.0)
    for part in ("surface", "subsurface", "absorbed", "absorbed_in_melanosomes", "exit_counts"):
        values = getattr(reflected, part)
        assert np.all(np.isfinite(values))
        assert np.array_equal(values, getattr(again, part))


def any_layer():
    minor = st.sampled_from((1e-6, 1e-5))
    return st.builds(
        lambda minor, longer, wider, **values: Layer(
            semi_minor=minor,
            semi_major=minor * longer,
            complex_radius=minor * longer * wider,
            **values,
        ),
        minor=minor,
        longer=st.sampled_from((1.0, 2.5, 30.0)),
        wider=st.sampled_from((0.0, 0.0, 1.0, 2.0)),
        thickness=st.sampled_from((1e-8, 3e-5, 1e-3, 0.1)),
        refractive_index=st.sampled_from((1.0, 1.0 + 1e-12, 1.4, 4.0)),
        absorption=st.sampled_from((0.0, 0.0, 1e-6, 10.0, 1e6)),
        encounter=st.sampled_from((0.0, 1.0, 1e4)),
        melanin_absorption=st.sampled_from((0.0, 1e-3, 1e3, 1e6, 1e12)),
        rayleigh=st.sampled_from((0.0, 100.0, 1e6)),
        scattering=st.sampled_from((0.0, 100.0, 1e4)),
        anisotropy=st.sampled_from((-0.99, 0.0, 0.9, 0.999)),
    )


MOST_EVENTS_WALKED = 3000.0
"""Of a ray in all layers, before what is reflected back into them: more take minutes, or have more
than `hylios.transport.events.MOST_EVENTS` and no end."""


def events(layer):
    """About how often a ray is scattered in a layer before it gets out or is absorbed."""
    scattered = layer.rayleigh + layer.scattering + layer.encounter
    out = (scattered * layer.thickness) ** 2
    return min(out, scattered / layer.absorption) if layer.absorption else out


@settings(max_examples=150)
@given(
    layers=st.lists(any_layer(), min_size=1, max_size=4),
    roughness=st.sampled_from((0.0, 1e-7, 1e-5, 0.1, 10.0)),
    floor=st.booleans(),
    around=st.tuples(*[st.sampled_from((1.0, 1.4, 4.0))] * 2),
    melanin_index=st.sampled_from((1.0, 1.4, 1.7, 4.0)),
    scale=st.sampled_from((0.0, 1e-9, 1e-3, 0.1, 3.0)),
    angle=numbers(0.0, 89.99),
    every=st.sampled_from(READINGS["rayleigh"].choices),
)
def test_every_stack_gives_numbers(
    layers, roughness, floor, around, melanin_index, scale, angle, every
):
    assume(sum(map(events, layers)) < MOST_EVENTS_WALKED)
    whole = Stack(
        tuple(layers),
        roughness=roughness,
        lambertian_floor=floor,
        index_above=around[0],
        index_below=around[1],
        melanin_index=melanin_index,
        scattering_angle=scale,
        readings=complete_readings({"rayleigh": every}),
    )
    assert_counted(whole, rays=30, angle=angle)


def brightest_case(name, melanin, factor):
    """A specimen with its melanin in one form or as a whole multiplied."""
    usual = SPECIMENS[name]
    names = {
        "concentration": ("eumelanin_concentration", "pheomelanin_concentration"),
        "colloidal": tuple(f"{layer}_colloidal_melanin" for layer in EPIDERMIS),
        "melanosomes": tuple(f"{layer}_melanosomes" for layer in EPIDERMIS),
    }[melanin]
    return replace(usual, **{name: factor * getattr(usual, name) for name in names})


@cache  # a specimen as it is comes with each form of melanin
def visible(specimen, seed):
    """Reflectances of 400 to 700 nm added up, and their standard error."""
    reflected = spectrum(specimen, np.arange(400.0, 701.0, 50.0), rays=8_000, seed=seed)
    return reflected.total.sum(), np.sqrt((reflected.standard_error**2).sum())


@pytest.mark.parametrize("melanin", ["concentration", "colloidal", "melanosomes"])
@pytest.mark.parametrize("name", ["S3", "S4"])
def test_more_melanin_never_brightens(name, melanin):
    """At every step from none of it to four times as much, summed over 400 to 700 nm."""
    sums = [
        visible(brightest_case(name, melanin, factor), seed)
        for seed, factor in enumerate((0.0, 0.3, 1.0, 2.0, 4.0))
    ]
    totals, errors = zip(*sums, strict=True)
    for step in range(4):
        assert totals[step + 1] - totals[step] < 5.0 * np.hypot(errors[step], errors[step + 1])
    assert totals[0] - totals[4] > 10.0 * np.hypot(errors[0], errors[4])


@pytest.mark.parametrize("as_printed", [False, True])
def test_light_that_finds_no_end_is_said_at_the_first_ray(as_printed):
    """However many are asked for: a clear half-space, and one that only scatters."""
    endless = Layer(thickness=np.inf, refractive_index=1.3, absorption=0.0)
    for layer in (endless, replace(endless, rayleigh=1e-3), replace(endless, scattering=1e-9)):
        with pytest.raises(RuntimeError, match="neither absorbs light nor lets it out"):
            count(Stack((layer,)), rays=10**9, as_printed=as_printed)


def test_a_layer_that_no_melanosome_fits_lets_light_pass():
    """As if it had none: of 2 um in 1 um, met every 0.1 um."""
    thin = Layer(
        thickness=1e-4,
        refractive_index=1.0,
        absorption=0.0,
        encounter=1e5,
        semi_minor=1e-4,
        semi_major=1e-4,
        complex_radius=1e-4,
        melanin_absorption=1e6,
    )
    for as_printed in (False, True):
        counted = count(Stack((thin,)), rays=200, angle=60.0, as_printed=as_printed)
        assert counted.left.tolist() == [0, 0, 200]


@pytest.mark.parametrize("absorption", [0.0, 1e6])
def test_absorption_of_the_whole_skin_at_its_limits(absorption):
    usual = Stack.of(SPECIMENS["S3"], 500.0)
    layers = replace(
        usual,
        layers=tuple(
            replace(layer, absorption=absorption, melanin_absorption=absorption)
            for layer in usual.layers
        ),
    )
    counted = count(layers, rays=3_000)
    assert counted.rays == 3_000
    if absorption:
        assert counted.left[SUBSURFACE] == 0
        assert counted.absorbed[0, 0] == counted.absorbed.sum()
    else:
        assert counted.absorbed.sum() == 0


def test_counts_do_not_overflow():
    """Counts past 2^32 are whole numbers still."""
    layers = Stack((Layer(thickness=0.1, refractive_index=1.0, absorption=1e6),))
    counted = count(layers, rays=1)
    for _ in range(40):
        counted = counted + counted
    assert counted.rays == 2**40
    assert counted.absorbed[0, 0] == 2**40


@pytest.mark.slow
def test_a_hundred_million_rays_in_one_call():
    """Beer and Lambert to 4 standard errors of 1e8 rays: one seed in 16,000 fails."""
    layers = Stack((Layer(thickness=0.1, refractive_index=1.0, absorption=10.0),))
    counted = count(layers, rays=10**8)
    assert counted.rays == 10**8
    expected = np.exp(-1.0)
    error = np.sqrt(expected * (1.0 - expected) / 1e8)
    assert abs(counted.left[2] / 1e8 - expected) < 4.0 * error


@pytest.mark.parametrize("rays", [1, 2, 16_384, 16_385])
def test_any_number_of_rays_is_counted_whole(rays):
    reflected = spectrum(SPECIMENS["S4"], [430.0], rays=rays)
    ended = rays * (reflected.total + reflected.absorptance)
    assert np.allclose(ended, rays, rtol=0.0, atol=1e-9)
    assert reflected.exit_counts.shape == (1, DISTANCE_EDGES.size)
