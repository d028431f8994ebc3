"""Sliders of biology: what they show, and how a table is built with them."""

import shlex

import bpy
import numpy as np
import pytest
from scenes import apply, look, of_role, pixels, tan_group, tan_object

from blender_addon import applied, live
from blender_addon.model import biology as biologies
from blender_addon.model import catalogue
from blender_addon.model.biology import build_command, table_with
from blender_addon.model.tan import look_of
from blender_addon.scene.exr import rounded
from hylios.skin.biology import Biology
from hylios.table import skin_of
from lut_builder import cli

III = catalogue.shipped_path("III")


@pytest.fixture
def body():
    obj = tan_object(III)
    obj.skin_tan.skin = "III"
    apply(obj)
    return obj


def shown(obj) -> np.ndarray:
    return pixels(of_role(obj, "colour").image)[..., :3]


def bulge(obj) -> float:
    """That of the look whose pixels an object's images hold, as its nodes have it."""
    by_square, by_one = (
        of_role(obj, "thickness_slope").inputs[end].default_value for end in (1, 2)
    )
    low, high = look_of(obj.skin_tan.values()).thickness
    assert by_one == pytest.approx((1.0 - by_square * (high - low) ** 2) / (high - low))
    return -by_square * (high - low) ** 2


def test_sliders_show_and_defaults_give_the_skin_back(body):
    before = shown(body).copy()
    body.skin_tan.biology.blood = 2.0
    assert apply(body) == {"FINISHED"}
    np.testing.assert_array_equal(shown(body), rounded(look_of(body.skin_tan.values()).colours))
    # redder: less green beside red, wherever there is little melanin
    left = slice(0, 40)
    assert np.all(shown(body)[0, left, 1] < before[0, left, 1])
    assert bpy.ops.skin_tan.reset_biology() == {"FINISHED"}
    apply(body)
    np.testing.assert_array_equal(shown(body), before)


def test_dragging_shows_at_once_and_rests_exact(body):
    body.skin_tan.biology.oxygenation = -20.0
    scene = bpy.context.scene
    before = look(body)
    live.show_changes()
    roughly = shown(body).copy()
    assert look(body) != before and applied.is_changed(body, scene)
    live.make_exact()
    assert not applied.is_changed(body, scene)
    np.testing.assert_allclose(roughly, shown(body), atol=0.02)
    np.testing.assert_array_equal(shown(body), rounded(look_of(body.skin_tan.values()).colours))


def test_a_drag_changes_pixels_in_place(body):
    image, scene = of_role(body, "colour").image, bpy.context.scene
    for oxygenation in (-5.0, -10.0, -20.0):
        body.skin_tan.biology.oxygenation = oxygenation
        live.show_changes()
        assert of_role(body, "colour").image == image
        expected = look_of(body.skin_tan.values(), rough=True)
        np.testing.assert_array_equal(shown(body), rounded(expected.colours))
        assert bulge(body) == pytest.approx(expected.bulge, abs=1e-5)
    live.make_exact()
    assert not applied.is_changed(body, scene)


@pytest.mark.parametrize("alone", [True, False])
def test_a_drag_that_ends_where_it_began_leaves_the_look(body, alone):
    if not alone:
        other = tan_object(III)
        other.skin_tan.skin = "III"
        apply(other)
    before, bulged = look(body), bulge(body)
    for blood in (2.0, 1.0):
        body.skin_tan.biology.blood = blood
        live.show_changes()
    live.make_exact()
    assert look(body) == before and not live._stale(bpy.context.scene)
    assert bulge(body) == bulged


def test_biology_back_and_another_schedule(body):
    body.skin_tan.biology.blood = 2.0
    live.show_changes()
    body.skin_tan.biology.blood, body.skin_tan.exposures[0].dose = 1.0, 3.0
    live.make_exact()
    np.testing.assert_array_equal(shown(body), rounded(look_of(body.skin_tan.values()).colours))


def test_a_drag_leaves_other_skins(body):
    other = tan_object(III)
    other.skin_tan.skin = "III"
    apply(other)
    before = look(other)
    body.skin_tan.biology.blood = 2.0
    live.show_changes()
    body.skin_tan.biology.blood = 3.0
    live.show_changes()
    assert look(other) == before and look(body) != before
    live.make_exact()
    assert look(other) == before


@pytest.mark.parametrize("rests", [False, True])
def test_undo_brings_the_look_back(body, rests):
    bpy.ops.ed.undo_push(message="before")
    name, before, bulged = body.name, look(body), bulge(body)
    body.skin_tan.biology.blood = 2.0
    bpy.ops.ed.undo_push(message="blood")
    live.show_changes()
    if rests:
        live.make_exact()
    after = look(bpy.data.objects[name])
    assert after != before
    while bpy.data.objects[name].skin_tan.biology.blood != 1.0:
        bpy.ops.ed.undo()
        live.after_undo()
    assert look(bpy.data.objects[name]) == before
    assert bulge(bpy.data.objects[name]) == bulged
    bpy.ops.ed.redo()
    live.after_undo()
    assert bpy.data.objects[name].skin_tan.biology.blood == 2.0
    live.make_exact()
    obj = bpy.data.objects[name]
    np.testing.assert_array_equal(shown(obj), rounded(look_of(obj.skin_tan.values()).colours))


def test_skins_of_one_biology_share_their_images(body):
    other = tan_object(III)
    other.skin_tan.skin = "III"
    for obj in (body, other):
        obj.skin_tan.biology.melanin = 1.4
        apply(obj)
    assert of_role(body, "colour").image == of_role(other, "colour").image
    other.skin_tan.biology.melanin = 1.0
    apply(other)
    assert of_role(body, "colour").image != of_role(other, "colour").image


def test_a_view_shows_the_biology(body):
    body.skin_tan.biology.melanin = 0.4
    apply(body)
    assert bpy.ops.skin_tan.switch_view(view="NM365") == {"FINISHED"}
    bpy.ops.skin_tan.switch_view(view="VISIBLE")
    untanned = skin_of(catalogue.provenance(III)).untanned_state
    own, changed = (
        table_with(III, biology, bands=True).plane("band_reflectance", untanned)
        for biology in (Biology(), Biology(melanin=0.4))
    )
    assert changed[0] > 1.2 * own[0]


def test_an_error_leaves_the_tan(body, monkeypatch):
    before = look(body)
    monkeypatch.setattr(biologies, "changed_table", refuse)
    body.skin_tan.biology.thickness = 1.234
    with pytest.raises(RuntimeError, match="cannot be changed"):
        bpy.ops.skin_tan.apply()
    assert look(body) == before and tan_group(body) is not None


def refuse(*_, **__):
    from hylios.errors import InputError

    raise InputError("the table cannot be changed.")


@pytest.mark.parametrize("skin", ["III", "VI", "S2"])
def test_the_command_builds_this_skin(body, skin, monkeypatch):
    settings = body.skin_tan
    settings.skin = skin
    settings.biology.blood, settings.biology.melanin = 1.5, 1.2
    values = settings.values()
    command = shlex.split(build_command(values))
    assert command[0] == "lut-builder" and command[-2:] == ["-o", "skin.exr"]
    built = []
    monkeypatch.setattr("lut_builder.commands.build.build_table", built.append)
    cli.main(command[1:])
    from hylios.commands.skin_arguments import chosen_tanning_skin

    made, told = chosen_tanning_skin(built[0]), skin_of(catalogue.provenance(values.table))
    expected = values.biology.of(told.specimen)
    for name, value in vars(expected).items():
        if isinstance(value, float):
            assert getattr(made.specimen, name) == pytest.approx(value, rel=1e-5), name
    assert (made.mmd, made.med) == pytest.approx((told.mmd, told.med), rel=1e-5)
    assert made.dynamics == told.dynamics


def test_the_command_is_reported_and_copied(body, capfd):
    body.skin_tan.biology.blood = 2.0
    assert bpy.ops.skin_tan.copy_build_command() == {"FINISHED"}
    said = capfd.readouterr().out
    assert "lut-builder build --skin III" in said and "papillary_blood=0.49616" in said
