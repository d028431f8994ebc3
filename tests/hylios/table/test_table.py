"""Tables: lookup, and the way into channels and a header and back."""

import json
import os
from dataclasses import replace

import numpy as np
import pytest

from hylios.errors import InputError
from hylios.table import (
    SkinTable,
    StateAxes,
    StoredTable,
    from_stored,
    read_table,
    to_stored,
)
from hylios.table.stored import checksum

COLOURS_AND_WIDTH = ("subsurface_colour", "total_colour", "profile_width")
KNOTS = (np.array([-1.0, 0.0, 1.0, 2.0]), np.array([0.0, 1.0]), np.array([-1.0, 0.0, 0.5]))


@pytest.fixture
def table():
    """Random numbers of 32 bits in three planes; two bands, one of them no whole number."""
    random = np.random.default_rng(0)
    axes = StateAxes(
        untanned=np.array([0.5, 0.3, 0.2, 1.0]),
        basis=np.linalg.qr(random.normal(size=(4, 3)))[0],
        knots=KNOTS,
    )
    planes = {
        name: random.random((*axes.shape, 3)).astype(np.float32).astype(float)
        for name in COLOURS_AND_WIDTH
    }
    planes["band_reflectance"] = np.full((*axes.shape, 2), 0.25)
    return SkinTable(axes, planes, {"specimen": "S3", "rays": 7, "bands_nm": [365, 1083.5]})


@pytest.mark.parametrize("interpolation", ["linear", "pchip"])
def test_table_gives_its_values_at_the_knots(table, interpolation):
    states = table.axes.knot_states()
    planes = replace(table, interpolation=interpolation).lookup(states)
    assert list(planes) == list(table.planes)
    for name, values in table.planes.items():
        assert np.allclose(planes[name], values, atol=1e-12)


def test_a_plane_is_the_whole_lookup_s(table):
    states = table.axes.knot_states() * 1.1
    whole = table.lookup(states)
    for name in table.planes:
        assert np.allclose(table.plane(name, states), whole[name], rtol=1e-13)
    assert list(table.lookup(states, ("profile_width",))) == ["profile_width"]
    with pytest.raises(InputError, match="no plane profile_error; it has subsurface_colour, "):
        table.plane("profile_error", states)


def test_a_table_without_blood_is_the_same_with_any(table):
    states = table.axes.knot_states()
    told = table.lookup(states, ["total_colour"], [0.5, 1.0, 4.0])["total_colour"]
    for column in range(3):
        assert np.array_equal(told[..., column, :], table.plane("total_colour", states))


def test_table_is_linear_between_knots_and_held_beyond_them(table):
    values = table.planes["total_colour"]
    inside = table.plane("total_colour", table.axes.states(np.array([0.5, 0.0, 0.0])))
    assert np.allclose(inside, 0.5 * (values[1, 0, 1] + values[2, 0, 1]))
    beyond = table.plane("total_colour", table.axes.states(np.array([9.0, 0.0, -9.0])))
    assert np.allclose(beyond, values[3, 0, 0])


@pytest.mark.parametrize("melanin", [0.0, -1.0, np.nan, np.inf])
def test_a_state_that_is_none_is_refused(table, melanin):
    with pytest.raises(InputError, match="not above 0 and finite"):
        table.lookup(np.array([melanin, 0.3, 0.2, 1.0]))


def test_table_survives_its_channels(table):
    stored = to_stored(replace(table, interpolation="pchip"))
    again = from_stored(stored)
    for name, values in table.planes.items():
        assert np.array_equal(again.planes[name], values)
    assert again.provenance == table.provenance
    assert again.interpolation == "pchip"
    assert np.array_equal(again.axes.untanned, table.axes.untanned)
    assert np.array_equal(again.axes.basis, table.axes.basis)
    assert all(map(np.array_equal, again.axes.knots, table.axes.knots))


def test_channels_say_what_they_hold_and_rows_run_over_the_second_axis_fastest(table):
    channels = to_stored(table).channels
    assert {"total_colour.G", "profile_width.R", "band_reflectance.1083_5nm"} <= set(channels)
    values = table.planes["total_colour"]
    assert channels["total_colour.G"].shape == (6, 4)
    assert np.array_equal(channels["total_colour.G"][0], values[:, 0, 0, 1])
    assert np.array_equal(channels["total_colour.G"][1], values[:, 1, 0, 1])
    assert np.array_equal(channels["total_colour.G"][2], values[:, 0, 1, 1])


def test_half_floats_round_to_a_half_and_counts_stay_exact(table):
    count = np.full((*table.axes.shape, 3), 1e7)
    table = replace(table, planes={**table.planes, "profile_effective_samples": count})
    again = from_stored(to_stored(table, half=True))
    for name in COLOURS_AND_WIDTH:
        error = np.abs(again.planes[name] / table.planes[name] - 1.0)
        # Numbers from 0 to 1, drawn evenly: none so small that a half loses digits.
        assert 0.0 < error.max() <= 2.0**-11
    assert np.array_equal(again.planes["profile_effective_samples"], count)


def changed(stored: StoredTable, change) -> StoredTable:
    """With a header changed as if the writer had meant it: the checksum fits."""
    header = json.loads(stored.header)
    change(header)
    text = json.dumps(header)
    return StoredTable(stored.channels, text, checksum(text, stored.channels))


CHANGES = [
    (lambda header: header.update(format="other"), "not a skin tan table"),
    (lambda header: header.update(format_version=1), "format version 1; this program reads 3"),
    (lambda header: header.update(format_version=[9]), "format version .9.; this program reads 3."),
    (lambda header: header.pop("axes"), "header has no axes"),
    (lambda header: header.update(axes=5), "axes is 5; expected an object"),
    (lambda header: header.update(planes=["total_colour"]), "planes is .* expected an obj"),
    (lambda header: header["planes"].update(total_colour=None), "planes.total_colour is None"),
    (lambda header: header["planes"].clear(), "no plane that has a meaning"),
    (lambda header: header.update(planes={"glow": {}}), "planes.glow has no components"),
    (
        lambda header: header["planes"]["total_colour"]["components"].pop(),
        "the components 'R, G'; expected R",
    ),
    (lambda header: header["provenance"].pop("bands_nm"), "needs wavelengths bands_nm"),
    (lambda header: header["provenance"].update(bands_nm=[365, 365]), "bands_nm that differ"),
    (lambda header: header["provenance"].update(bands_nm=[10**400, 1]), "bands_nm is 1000.*"),
    (lambda header: header.update(provenance=[]), "provenance is ..; expected an object"),
    (lambda header: header.update(interpolation="cubic"), "interpolation is 'cubic'"),
    (lambda header: header["axes"]["list"].clear(), "axes.list is ..; expected a list of 1 to 4"),
    (lambda header: header["axes"]["list"].append(header["axes"]["list"][0]), "axes are not"),
    (
        lambda header: header["axes"]["list"][0].update(knots=[]),
        r"list.0..knots is \[\]; expected a",
    ),
    (lambda header: header["axes"]["list"][0].update(knots=0.0), "knots is 0.0; expected a list"),
    (
        lambda header: header["axes"]["list"][0].update(knots=[[0.0, 1.0]]),
        "knots.0. is .* a number",
    ),
    (
        lambda header: header["axes"]["list"][0].update(knots=[0, 1, 2, 1e5]),
        "knots.3. is 100000.0; expected a",
    ),
    (lambda header: header["axes"]["list"][0].update(knots=[0, 1, 2, 10**400]), "knots is 1000"),
    (lambda header: header["axes"]["list"][0].update(knots=[0, 1, 1, 2]), "axes are not"),
    (
        lambda header: header["axes"]["list"][0].update(knots=[0, 1, 2, None]),
        "knots.3. is None; expected a",
    ),
    (lambda header: header["axes"]["list"][0]["knots"].reverse(), "axes are not"),
    (lambda header: header["axes"]["list"][0]["knots"].pop(), "its header describes .6, 3."),
    (lambda header: header["axes"]["list"][0]["direction"].pop(), "direction is .* a list of 4"),
    (
        lambda header: header["axes"]["list"][0].update(direction=[2, 0, 0, 0]),
        "direction.0. is 2; exp",
    ),
    (lambda header: header["axes"]["untanned"].pop(), "untanned is .*; expected a list of 4"),
    (
        lambda header: header["axes"].update(untanned=[0.5, 0.3, 0.2, 0.0]),
        "untanned.3. is 0.0; exp",
    ),
    (
        lambda header: header["axes"].update(untanned=[0.5, 0.3, 0.2, 1e30]),
        "untanned.3. is 1e.30; e",
    ),
    (lambda header: header["axes"].update(untanned="many"), "untanned is 'many'; expected"),
]


@pytest.mark.parametrize(("change", "sentence"), CHANGES)
def test_a_header_that_does_not_fit_is_refused(table, change, sentence):
    with pytest.raises(InputError, match=sentence) as caught:
        from_stored(changed(to_stored(table), change))
    assert "\n" not in str(caught.value)


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("{", "not JSON"),
        ("[" * 100_000, "not JSON"),
        ('{"format": "skin tan table", "provenance": NaN}', "NaN is no finite number"),
        ('{"format": "skin tan table", "provenance": 1e999}', "1e999 is no finite number"),
        (f'{{"format": {"9" * 10_000}}}', "not JSON"),
        ("[]", "not a skin tan table"),
        ("null", "not a skin tan table"),
        (" " * 1_000_001, "has 1000001 characters"),
    ],
)
def test_a_header_that_is_none_is_refused(table, text, sentence):
    channels = to_stored(table).channels
    with pytest.raises(InputError, match=sentence):
        from_stored(StoredTable(channels, text, checksum(text, channels)))


def test_whatever_is_changed_does_not_match_the_checksum(table):
    stored = to_stored(table)
    pixels = dict(stored.channels)
    red, green = pixels["total_colour.R"], pixels["total_colour.G"]
    other_pixel = red.copy()
    other_pixel[0, 0] += 1e-6
    for channels in (
        {**pixels, "total_colour.R": other_pixel},
        {**pixels, "total_colour.R": green, "total_colour.G": red},
        {**pixels, "total_colour.R": red.reshape(4, 6)},
        {**pixels, "total_colour.R": red.view("<f2")},
        {**pixels, "other.R": red},
        {name: pixels_of for name, pixels_of in pixels.items() if name != "total_colour.R"},
    ):
        with pytest.raises(InputError, match="does not match its checksum"):
            from_stored(StoredTable(channels, stored.header, stored.checksum))
    with pytest.raises(InputError, match="does not match its checksum"):
        from_stored(StoredTable(pixels, stored.header.replace("7", "8", 1), stored.checksum))


def test_planes_of_a_later_builder_are_left_out(table):
    stored = to_stored(table)
    channels = {**stored.channels, "glow.X": stored.channels["total_colour.R"]}
    later = changed(
        StoredTable(channels, stored.header, ""),
        lambda header: header["planes"].update(glow={"components": ["X"], "unit": "", "says": ""}),
    )
    assert list(from_stored(later).planes) == list(table.planes)


@pytest.mark.parametrize("wrong", [np.nan, np.inf, 1e300])
def test_a_number_that_is_not_finite_is_not_written(table, wrong):
    table.planes["total_colour"][0, 0, 0, 0] = wrong
    with pytest.raises(InputError, match="total_colour has a number that is not finite"):
        to_stored(table)


def test_a_number_that_is_not_finite_is_not_read(table):
    stored = to_stored(table)
    stored.channels["total_colour.R"][0, 0] = np.nan
    with pytest.raises(InputError, match="channel total_colour.R has a number that is not finite"):
        from_stored(changed(stored, lambda header: None))


def test_what_is_too_large_for_a_half_is_not_written(table):
    table.planes["profile_width"][0, 0, 0, 0] = 7e4
    to_stored(table)
    with pytest.raises(InputError, match="profile_width has a number .* above 65504"):
        to_stored(table, half=True)


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        ({"planes": {}}, "no plane that has a meaning"),
        ({"provenance": {}}, "needs wavelengths bands_nm"),
        (
            {"provenance": {"bands_nm": [365, 400], "rays": np.nan}},
            "rays is nan; expected a finite",
        ),
        ({"interpolation": "cubic"}, "interpolation is 'cubic'"),
    ],
)
def test_what_could_not_be_read_is_not_written(table, change, sentence):
    with pytest.raises(InputError, match=sentence):
        to_stored(replace(table, **change))
    with pytest.raises(InputError, match="there is no plane 'glow'"):
        to_stored(replace(table, planes={**table.planes, "glow": np.zeros((4, 2, 3, 3))}))
    with pytest.raises(InputError, match="has shape .4, 2, 3, 1."):
        to_stored(replace(table, planes={**table.planes, "profile_error": np.zeros((4, 2, 3, 1))}))


def test_what_is_no_file_is_refused(tmp_path):
    os.mkfifo(tmp_path / "pipe.exr")
    for name, sentence in (("pipe.exr", "it is no regular file"), ("none.exr", "No such file")):
        with pytest.raises(InputError, match=f"cannot be read: {sentence}"):
            read_table(tmp_path / name)


def test_a_table_may_have_any_of_the_planes(table):
    for name, values in table.planes.items():
        alone = from_stored(to_stored(replace(table, planes={name: values})))
        assert list(alone.planes) == [name]
        assert np.array_equal(alone.planes[name], values)
