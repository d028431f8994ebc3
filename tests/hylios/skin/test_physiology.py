"""Physiological ranges: who lies within them, what they refuse, what they let through."""

import re
from dataclasses import MISSING, asdict, fields, replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from hylios.errors import InputError
from hylios.skin.physiology import MOST_EPIDERMAL_MELANIN, PHYSIOLOGY
from hylios.skin.specimen import (
    ARRANGEMENTS,
    EPIDERMIS,
    SPECIMENS,
    Specimen,
    parameters,
    specimen_of,
    with_values,
)
from hylios.tissue import Stack
from hylios.tissue.melanosome_survival import is_tabulated
from hylios.transport.simulate import spectrum

S3 = SPECIMENS["S3"]
FORMS = ("melanosomes", "colloidal_melanin")
MELANIN = [f"{layer}_{form}" for layer in EPIDERMIS for form in FORMS]
LAYERS = ("corneum", "epidermis", "papillary", "reticular")
WATER_AND_LIPIDS = [f"{layer}_{what}" for layer in LAYERS for what in ("water", "lipids")]


def test_every_parameter_has_a_range_with_a_source_within_what_is_possible():
    assert list(PHYSIOLOGY) == [parameter.name for parameter in parameters()]
    for parameter in parameters():
        usual = PHYSIOLOGY[parameter.name]
        assert parameter.metadata["low"] <= usual.low < usual.high <= parameter.metadata["high"], (
            parameter.name
        )
        assert re.search(r"thesis|ESTIMATE|\b(19|20)\d\d\b|\.edu|\.com", usual.source), (
            parameter.name
        )
        assert usual.cited.startswith("[")


@pytest.mark.parametrize("name", list(SPECIMENS))
def test_the_thesis_s_specimens_are_physiological(name):
    assert specimen_of(asdict(SPECIMENS[name])) == SPECIMENS[name]


THESIS = [
    ("S3", dict.fromkeys(MELANIN, 0.0)),
    ("S4", {"granulosum_melanosomes": 0, "spinosum_melanosomes": 0, "basale_melanosomes": 30}),
    ("S4", {"basale_melanosomes": 0, "basale_colloidal_melanin": 45}),
    ("S1", {"surface_fold_aspect_ratio": 0.3}),
    ("S3", {"eumelanin_concentration": 24, "pheomelanin_concentration": 1.5}),
    ("S3", {"eumelanin_concentration": 62.5, "pheomelanin_concentration": 5}),
    ("S3", {"papillary_blood": 0.225, "reticular_blood": 3.12}),
    ("S3", {name: 0.75 * getattr(S3, name) for name in WATER_AND_LIPIDS}),
    ("S3", {name: 1.25 * getattr(S3, name) for name in WATER_AND_LIPIDS}),
    ("S3", {"corneum_water": 26.25, "papillary_water": 93.75, "papillary_lipids": 0.25}),
    ("S3", {"corneum_water": 21.0, "epidermis_water": 36.0, "papillary_water": 45.0}),
    ("S3", {"corneum_thickness": 36e-4, "corneum_urocanic_acid": 0.0029}),
]
"""What the thesis calls physiologically valid: section 6.1, appendices A, C and D.1."""


@pytest.mark.parametrize(("name", "values"), THESIS)
def test_what_the_thesis_varies_is_physiological(name, values):
    assert with_values(SPECIMENS[name], values) == replace(SPECIMENS[name], **values)


def test_a_palm_is_physiological_and_thin_skin_keeps_its_range():
    palm = with_values(S3, {"corneum_thickness": 0.0173})
    assert palm.corneum_thickness == 0.0173
    assert (PHYSIOLOGY["corneum_thickness"].high, PHYSIOLOGY["corneum_thickness"].most) == (
        0.0036,
        0.0173,
    )


@pytest.mark.parametrize("name", list(PHYSIOLOGY))
@pytest.mark.parametrize("side", [-1.0, 1.0])
def test_a_value_outside_is_refused_with_both_ranges_and_taken_where_allowed(name, side):
    usual = PHYSIOLOGY[name]
    possible = next(parameter.metadata for parameter in parameters() if parameter.name == name)
    end = usual.low if side < 0 else usual.most
    value = float(np.nextafter(end, side * np.inf))
    with pytest.raises(InputError, match=f"{name} is .*; physiological is {usual.low:g} to "):
        with_values(S3, {name: value})
    if not possible["low"] <= value <= possible["high"]:
        with pytest.raises(InputError, match=f"{name} is "):
            with_values(S3, {name: value}, allow_unphysical=True)
    elif name not in ("melanosome_major_axis", "melanosome_minor_axis"):
        assert getattr(with_values(S3, {name: value}, allow_unphysical=True), name) == value


def test_more_melanin_than_the_darkest_epidermis_is_refused():
    layers = {f"{layer}_melanosomes": 43.0 for layer in EPIDERMIS}
    with pytest.raises(InputError, match="melanin is 44.35 % of the epidermis; .* 0 to 43 %"):
        with_values(S3, layers)
    dark = with_values(S3, layers, allow_unphysical=True)
    assert dark.pigmentation > MOST_EPIDERMAL_MELANIN


@pytest.mark.parametrize(
    "value",
    ["0.3", None, True, [0.3], {"a": 1}, pytest.param(10**5000, id="huge"), 1j, np.nan, np.inf],
)
@pytest.mark.parametrize("allow", [False, True])
def test_what_is_no_number_is_refused(value, allow):
    with pytest.raises(InputError, match="papillary_blood is "):
        with_values(S3, {"papillary_blood": value}, allow_unphysical=allow)


def test_fields_that_are_missing_unknown_or_unprintable_are_refused():
    with pytest.raises(InputError, match="the specimen lacks name, melanosome_arrangement, surf"):
        specimen_of({})
    with pytest.raises(InputError, match="there is no parameter 'blood'; there are name, "):
        specimen_of({**asdict(S3), "blood": 1.0})
    for name in ("", "a\nb", "\ud800", 3, None):
        with pytest.raises(InputError, match="name is .*; allowed is printable text"):
            replace(S3, name=name)
    table_6_1 = {
        field.name: getattr(S3, field.name)
        for field in fields(Specimen)
        if field.default is MISSING
    }
    assert specimen_of(table_6_1) == S3


def box(limits):
    """Fields of specimens with every number from its range (low, high) by name, ends often."""
    numbers = {
        name: st.one_of(st.sampled_from(ends), st.floats(*ends)) for name, ends in limits.items()
    }
    texts = {"name": st.just("drawn"), "melanosome_arrangement": st.sampled_from(ARRANGEMENTS)}
    return st.fixed_dictionaries({**texts, **numbers})


def consistent(values, most_melanin):
    """The values, with what several of them must meet together put right."""
    axes = [values[f"melanosome_{axis}_axis"] for axis in ("major", "minor")]
    fullest = max(
        values[f"{layer}_melanosomes"] + values[f"{layer}_colloidal_melanin"] for layer in EPIDERMIS
    )
    share = min(1.0, most_melanin / max(fullest, 1e-9))
    return {
        **values,
        **{name: share * values[name] for name in MELANIN},
        "melanosome_major_axis": max(axes),
        "melanosome_minor_axis": min(axes),
    }


def layer_numbers(specimen, wavelength):
    layers = Stack.of(specimen, wavelength).layers
    given = [{**asdict(layer), "longest_path": 0.0} for layer in layers]  # infinite until tabulated
    return np.array([list(layer.values()) for layer in given])


PHYSIOLOGICAL = box({name: (usual.low, usual.most) for name, usual in PHYSIOLOGY.items()})
POSSIBLE = box(
    {
        parameter.name: (parameter.metadata["low"], parameter.metadata["high"])
        for parameter in parameters()
    }
)


@settings(max_examples=150)
@given(values=PHYSIOLOGICAL, wavelength=st.floats(250.0, 2500.0))
def test_all_of_physiology_gives_finite_optical_layers(values, wavelength):
    numbers = layer_numbers(specimen_of(consistent(values, 43.0)), wavelength)
    assert np.all(np.isfinite(numbers))
    thickness, index, absorption = numbers[:, :3].T
    assert np.all((thickness > 0) & (index > 1.2) & (index < 1.8) & (absorption > 0))


REFUSAL = re.compile(r"(granulosum|spinosum|basale)_thickness is .* cm[;,] .*\.")


@settings(max_examples=150)
@given(values=PHYSIOLOGICAL, wavelength=st.floats(250.0, 2500.0))
def test_all_of_physiology_can_be_solved(values, wavelength):
    """The table of survival reaches as far as the physiological shapes and indices do."""
    stack = Stack.of(specimen_of(consistent(values, 43.0)), wavelength)
    assert all(is_tabulated(layer, stack.melanin_index) for layer in stack.layers[1:4])


@settings(max_examples=300)
@given(values=POSSIBLE, wavelength=st.floats(250.0, 2500.0))
def test_past_physiology_layers_are_finite_or_refused_for_their_thickness(values, wavelength):
    specimen = specimen_of(consistent(values, 100.0), allow_unphysical=True)
    try:
        numbers = layer_numbers(specimen, wavelength)
    except InputError as error:
        assert REFUSAL.fullmatch(str(error)), error
    else:
        assert np.all(np.isfinite(numbers))
        assert np.all(numbers[:, :8] >= 0.0)


@pytest.mark.slow
@settings(max_examples=40)
@given(values=POSSIBLE, wavelength=st.floats(250.0, 2500.0))
def test_past_physiology_every_ray_ends(values, wavelength):
    specimen = specimen_of(consistent(values, 100.0), allow_unphysical=True)
    try:
        result = spectrum(specimen, [wavelength], rays=50, threads=1)
    except InputError as error:
        assert REFUSAL.fullmatch(str(error)), error
    else:
        assert result.total[0] + result.absorptance[0] == pytest.approx(1.0)


def test_melanosomes_that_would_keep_a_ray_for_ever_are_refused():
    clear = {
        "eumelanin_concentration": 0.0,
        "pheomelanin_concentration": 0.0,
        "epidermis_water": 0.0,
        "epidermis_lipids": 0.0,
        "basale_melanosomes": 60.0,
        "basale_thickness": 1.0,
    }
    with pytest.raises(InputError, match="basale_thickness is 1 cm, where a ray would meet"):
        Stack.of(with_values(S3, clear, allow_unphysical=True), 1000.0)
    usual = {"basale_melanosomes": 60.0, "basale_thickness": 0.33}
    assert Stack.of(with_values(S3, usual, allow_unphysical=True), 1000.0)
