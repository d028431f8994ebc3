"""Tables over melanin, thickness, spread and blood; and those of format 3 beside them."""

import json
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

import blender_addon
from hylios.adding import colours
from hylios.errors import InputError
from hylios.lab.colour import difference
from hylios.skin.phototypes import phototype, skin_type
from hylios.table import (
    LookAxes,
    SkinTable,
    StateAxes,
    StoredTable,
    from_stored,
    read_table,
    to_stored,
)
from hylios.table.stored import checksum
from hylios.tanning import KINETICS, Exposures, spread_of

TABLES = Path(blender_addon.__file__).parent / "tables"
FORMAT_3 = Path(__file__).parents[2] / "data" / "III_format_3.exr"
KNOTS = (
    np.array([-6.0, 0.0, 0.8, 1.6]),
    np.array([0.0, 0.2]),
    np.array([-0.4, 0.0, 1.0]),
    np.log([1.0, 3.0, 12.0]),
)


@pytest.fixture(scope="module")
def axes():
    sheets = [
        spread_of(skin.melanin_kinetics, mmd=skin.mmd, med=skin.med)
        for skin in (skin_type("V", kinetics=name) for name in KINETICS)
    ]
    return LookAxes(*sheets, sheets[0].directions[:, 1], KNOTS)


@pytest.fixture(scope="module")
def table(axes):
    """Colours that are straight in every coordinate."""
    places = np.stack(np.meshgrid(*axes.knots, indexing="ij"), axis=-1)
    slopes = [[-0.05, 0.0, 0.02], [0.3, 0.1, 0.0], [0.0, 0.04, 0.0], [0.01, -0.04, -0.05]]
    colour = 0.5 + places @ np.array(slopes)
    planes = {"subsurface_colour": np.clip(colour, 0.0, 1.5)}
    return SkinTable(axes, planes, {"specimen": "V"})


def states(count):
    random = np.random.default_rng(3)
    melanin = random.dirichlet([3.0, 2.0, 1.0], count) * random.uniform(0.1, 4.0, (count, 1))
    return np.column_stack(
        [melanin, random.uniform(1.0, 1.2, count), random.uniform(1.0, 12.0, count)]
    )


def test_coordinates_are_logarithms_of_melanin_thickness_and_blood(axes):
    some = states(50)
    places = axes.coordinates(some)
    assert places[:, 0] == pytest.approx(np.log(some[:, :3].sum(axis=1)))
    assert places[:, [1, 3]] == pytest.approx(np.log(some[:, 3:]))
    flushed = axes.coordinates(some * np.array([1.0, 1.0, 1.0, 1.0, 2.5]))
    assert flushed - places == pytest.approx(
        np.tile([0.0, 0.0, 0.0, np.log(2.5)], (50, 1)), abs=1e-12
    )
    assert axes.coordinates(np.append(axes.sheet.untanned, 1.0)) == pytest.approx(
        np.zeros(4), abs=1e-12
    )
    assert np.array_equal(axes.coordinates(some[:, :4])[:, 3], np.zeros(50))


def test_the_spread_tells_whose_kinetics_a_state_is_of(axes):
    """0 on the sheet of the thesis's, 1 on that of the measured; what lies off is between them."""
    melanin, thickness = np.meshgrid(np.linspace(-2.0, 1.5, 6), np.linspace(0.0, 0.2, 4))
    thesis, measured = (one.states(melanin, thickness) for one in (axes.sheet, axes.measured))
    assert axes.coordinates(thesis)[..., 2] == pytest.approx(np.zeros((4, 6)), abs=1e-12)
    tanned = melanin > 0.1
    assert axes.coordinates(measured)[tanned, 2] == pytest.approx(np.ones(tanned.sum()), abs=1e-9)
    assert axes.states(axes.coordinates(measured)) == pytest.approx(measured, rel=0.01)
    half = np.stack([melanin, thickness, np.full((4, 6), 0.5), np.zeros((4, 6))], axis=-1)[tanned]
    assert axes.coordinates(axes.states(half)) == pytest.approx(half, abs=1e-9)
    back = half - [0.0, 0.0, 0.8, 0.0]
    assert axes.coordinates(axes.states(back)) == pytest.approx(back, abs=1e-9)
    moved = np.log(axes.states(back) / thesis[tanned])[:, :3]
    moved -= moved.mean(axis=1, keepdims=True)
    assert moved == pytest.approx(np.tile(-0.3 * axes.aside, (len(back), 1)), abs=1e-9)


def test_what_both_kinetics_tell_counts_as_of_the_sheets(axes):
    """Though the side below 0 tells it as well: as in light skin, where both go one way."""
    place = np.array([0.3, 0.1, 1.0, 0.0])
    across = np.log(axes.states(place)[:3] / axes.states(place * [1, 1, 0, 1])[:3])
    across -= across.mean()
    alike = replace(axes, aside=-across / np.linalg.norm(across))
    assert alike.coordinates(alike.states(place)) == pytest.approx(place, abs=1e-6)
    beyond = np.array([0.3, 0.1, -1.2 * np.linalg.norm(across), 0.0])
    assert alike.coordinates(alike.states(beyond)) == pytest.approx(beyond, abs=1e-6)


def test_states_at_the_knots_have_the_knots_coordinates(axes):
    knots = axes.knot_states()
    assert knots.shape == (4, 2, 3, 3, 5)
    places = np.stack(np.meshgrid(*axes.knots, indexing="ij"), axis=-1)
    told = axes.coordinates(knots)
    assert told[..., [0, 1, 3]] == pytest.approx(places[..., [0, 1, 3]], abs=1e-9)
    assert told[2:] == pytest.approx(places[2:], abs=1e-9)
    assert axes.states(told) == pytest.approx(knots, rel=1e-9)


@pytest.mark.parametrize("interpolation", ["linear", "pchip"])
def test_four_numbers_are_looked_up_as_five_with_the_untanned_blood(table, interpolation):
    some, used = states(40), replace(table, interpolation=interpolation)
    whole = used.plane("subsurface_colour", np.column_stack([some[:, :4], np.ones(40)]))
    assert np.array_equal(used.plane("subsurface_colour", some[:, :4]), whole)
    flushed = used.plane("subsurface_colour", some)
    assert not np.allclose(flushed, whole, atol=1e-3)


@pytest.mark.parametrize("interpolation", ["linear", "pchip"])
def test_states_with_several_amounts_of_blood_are_as_one_by_one(table, interpolation):
    some, used = states(12).reshape(3, 4, 5), replace(table, interpolation=interpolation)
    amounts = np.exp([-0.3, 0.0, 0.7, 1.1, 9.0])
    together = used.lookup(some, blood=amounts)
    for column, amount in enumerate(amounts):
        alone = used.lookup(np.concatenate([some[..., :4], np.full((3, 4, 1), amount)], axis=-1))
        for name, plane in alone.items():
            np.testing.assert_allclose(together[name][..., column, :], plane, rtol=1e-12)
    for wrong in ([[1.0]], [0.0], [np.nan]):
        with pytest.raises(InputError, match="blood is"):
            used.lookup(some, blood=wrong)


def test_a_table_over_melanin_survives_its_channels_and_says_its_axes(table):
    stored = to_stored(table)
    header = json.loads(stored.header)
    assert header["format_version"] == 4
    assert [axis["name"] for axis in header["axes"]["list"]] == [
        "melanin",
        "thickness",
        "spread",
        "blood",
    ]
    again = from_stored(stored)
    assert isinstance(again.axes, LookAxes) and not again.axes.bounded
    for own, other in (
        (again.axes.sheet, table.axes.sheet),
        (again.axes.measured, table.axes.measured),
    ):
        for name in ("untanned", "directions", "thicknesses", "least", "most", "coefficients"):
            assert np.array_equal(getattr(own, name), getattr(other, name))
    assert all(map(np.array_equal, again.axes.knots, table.axes.knots))
    some = states(20)
    assert again.plane("subsurface_colour", some) == pytest.approx(
        table.plane("subsurface_colour", some), abs=1e-6
    )
    assert np.array_equal(again.axes.knot_states(), table.axes.knot_states())


def test_bounded_axes_hold_what_lies_within_their_knots(table):
    inside = table.axes.states(np.array([[0.5, 0.1, 0.3, 1.0], [1.605, 0.2, 1.0, 0.0]]))
    outside = table.axes.states(
        np.array([[1.7, 0.1, 0.3, 1.0], [0.5, 0.1, 0.3, 2.6], [0.5, 0.3, 0.3, 1.0]])
    )
    everything = np.concatenate([inside, outside])
    assert table.holds(everything).all()
    bounded = replace(table, axes=replace(table.axes, bounded=True))
    assert bounded.holds(everything).tolist() == [True, True, False, False, False]
    again = from_stored(to_stored(bounded))
    assert again.holds(everything).tolist() == bounded.holds(everything).tolist()


def test_states_of_another_shape_are_refused(table):
    for wrong in (np.ones(3), np.ones((2, 6)), 1.0):
        with pytest.raises(InputError, match=r"expected \(\.\.\., 4\) or \(\.\.\., 5\)"):
            table.lookup(wrong)
    with pytest.raises(InputError, match="not above 0 and finite"):
        table.lookup([0.5, 0.3, 0.2, 1.0, 0.0])


@pytest.mark.parametrize(
    ("change", "sentence"),
    [
        (lambda axes: axes.update(bounded=1), "axes.bounded is 1; expected true or false"),
        (lambda axes: axes.pop("bounded"), "axes has no bounded"),
        (lambda axes: axes["list"].pop(), r"axes.list is .*; expected a list of 4"),
        (lambda axes: axes["list"].reverse(), "axes are blood, spread, thickness, melanin"),
        (lambda axes: axes["sheets"].pop("measured"), "axes.sheets has no measured"),
        (
            lambda axes: axes["sheets"]["thesis"].pop("direction"),
            "axes.sheets.thesis has no direction",
        ),
        (
            lambda axes: axes["sheets"]["thesis"]["coefficients"].pop(),
            "coefficients is .*; expected a list of 20",
        ),
        (lambda axes: axes["sheets"]["thesis"]["most_melanin"].pop(), "axes are not two sheets"),
        (lambda axes: axes["sheets"]["thesis"]["thicknesses"].reverse(), "axes are not two sheets"),
        (
            lambda axes: axes["sheets"]["thesis"].update(direction=[1, 0, 0]),
            "axes are not two sheets",
        ),
        (
            lambda axes: axes["sheets"]["thesis"].update(untanned_melanin=[1, 1, 1]),
            "axes are not two sheets",
        ),
        (lambda axes: axes["list"][0].update(knots=[1.0, 0.0]), "axes are not two sheets"),
    ],
)
def test_axes_that_do_not_fit_are_refused(table, change, sentence):
    stored = to_stored(table)
    header = json.loads(stored.header)
    change(header["axes"])
    text = json.dumps(header)
    with pytest.raises(InputError, match=sentence):
        from_stored(StoredTable(stored.channels, text, checksum(text, stored.channels)))


@pytest.mark.parametrize("kinetics", KINETICS)
@pytest.mark.parametrize("name", ["III", "V", "VI"])
def test_a_shipped_table_is_near_the_model_by_either_kinetics(name, kinetics):
    table, skin = read_table(TABLES / f"{name}.exr"), skin_type(name, kinetics=kinetics)
    assert table.kinetics == tuple(KINETICS)
    doses = skin.mmd * np.array([[1.0, 0.0, 0.0], [2.5, 0.0, 0.0], [1.0, 2.0, 1.5]])
    reached = skin.states(Exposures([0, 48, 120], doses), [60.0, 170.0, 400.0, 900.0])
    some = np.column_stack([reached.reshape(-1, 4), np.tile([1.0, 1.0, 4.0], 4)])
    seen = table.plane("total_colour", some)
    off = difference(colours(skin, some, count=10).total, seen)
    assert off.mean() < 0.08 and off.max() < 0.25


def test_a_table_of_format_3_is_read_and_knows_no_blood():
    """The one shipped with the earlier add-on, against the model."""
    old = read_table(FORMAT_3)
    assert isinstance(old.axes, StateAxes) and old.kinetics == ("thesis",)
    assert {"profile_width", "profile_error", "profile_effective_samples"} <= set(old.planes)
    skin = phototype("III").skin
    melanin = spread_of(skin.dynamics, mmd=skin.mmd, med=skin.med)
    some = melanin.states([0.0, 0.3, 0.6], [0.0, 0.1, 0.05])
    seen = old.plane("total_colour", some)
    assert difference(colours(skin, some[:, :4]).total, seen).max() < 0.15
    flushed = some * np.array([1.0, 1.0, 1.0, 1.0, 8.0])
    assert np.array_equal(old.plane("total_colour", flushed), seen)
    assert old.holds(flushed).all()
    assert json.loads(to_stored(old).header)["format_version"] == 3
