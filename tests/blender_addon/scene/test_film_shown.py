"""A film on the skin, rendered, and what it leaves alone."""

from pathlib import Path

import bpy
import numpy as np
import pytest
from scenes import add_camera, apply, of_role, render, tan_group, tan_object, white_world
from synthetic import UNTANNED_COLOUR

from blender_addon.apply import apply_tan
from blender_addon.model.film import film_of
from blender_addon.model.layer import let_through
from blender_addon.model.look import NORMAL_ANGLE
from blender_addon.scene import images
from blender_addon.scene.film import ROLES
from blender_addon.scene.nodes import role_of
from blender_addon.scene.plan import INDEX
from hylios.errors import InputError
from hylios.tissue.liquids import LIQUIDS

LAYOUT_1 = Path(__file__).parents[1] / "data" / "layout_1.blend"


@pytest.fixture
def body(table_path):
    """A square that has not been in the sun, seen straight on under white light."""
    obj = tan_object(table_path, dose=0.0)
    add_camera((0.5, 0.5, 5.0), 0.5)
    white_world()
    return obj


def worn(obj, film: str) -> None:
    obj.skin_tan.film = film
    assert apply(obj) == {"FINISHED"}


def shown(folder, samples: int = 32) -> np.ndarray:
    """Mean colour of the picture."""
    return render(folder / "film.exr", width=12, height=12, samples=samples).mean(axis=(0, 1))


def film_nodes(obj) -> list:
    return [node for node in tan_group(obj).nodes if role_of(node) in ROLES]


def group_node(obj):
    tree = obj.material_slots[0].material.node_tree
    return next(node for node in tree.nodes if getattr(node, "node_tree", None) == tan_group(obj))


def reflected(one: float, other: float) -> float:
    return ((one - other) / (one + other)) ** 2


@pytest.mark.parametrize("liquid", LIQUIDS)
def test_film_and_skin_show_what_the_light_model_says(body, tmp_path, liquid):
    """What they reflect by Fresnel, and the light from inside beside that of dry skin by a fit."""
    worn(body, "NONE")
    roughness = group_node(body).inputs["Roughness"].default_value
    dry_through = float(let_through(roughness, NORMAL_ANGLE))
    dry = shown(tmp_path, 256) - (1.0 - dry_through)
    worn(body, liquid.upper())
    index = LIQUIDS[liquid].index
    through = (1.0 - reflected(1.0, index)) * (1.0 - reflected(index, INDEX))
    wet = shown(tmp_path, 256) - (1.0 - through)
    numbers = film_of(liquid, roughness)
    change = 1.0 + np.array(numbers.start) + np.array(numbers.slope) * UNTANNED_COLOUR
    assert wet / dry == pytest.approx(change * through / dry_through, abs=0.002)


def test_oil_beneath_a_film_changes_nothing(body, tmp_path):
    worn(body, "WATER")
    plain = shown(tmp_path)
    group_node(body).inputs["Oil"].default_value = 1.0
    assert shown(tmp_path) == pytest.approx(plain, abs=1e-6)


def test_skin_without_a_film_has_no_nodes_for_one(body):
    worn(body, "NONE")
    assert not film_nodes(body)
    assert "Film" not in group_node(body).inputs


def test_where_no_film_lies_skin_is_dry(body, tmp_path):
    worn(body, "NONE")
    dry = shown(tmp_path)
    worn(body, "WATER")
    wet = shown(tmp_path)
    assert np.abs(wet - dry).max() > 0.005
    group_node(body).inputs["Film"].default_value = 0.0
    assert shown(tmp_path) == pytest.approx(dry, abs=1e-4)
    group_node(body).inputs["Film"].default_value = 1.0
    assert shown(tmp_path) == pytest.approx(wet, abs=1e-6)
    worn(body, "NONE")
    assert shown(tmp_path) == pytest.approx(dry, abs=1e-4)
    assert len(film_nodes(body)) == len(ROLES)


def test_a_mask_in_the_material_stays(body):
    worn(body, "WATER")
    tree = body.material_slots[0].material.node_tree
    mask = tree.nodes.new("ShaderNodeAttribute")
    tree.links.new(mask.outputs["Fac"], group_node(body).inputs["Film"])
    worn(body, "OIL")
    assert group_node(body).inputs["Film"].links[0].from_node == mask
    assert of_role(body, "skin").inputs["Coat IOR"].default_value == pytest.approx(1.47)


def test_an_artist_s_coat_stays_and_the_film_says_so(body, tmp_path):
    worn(body, "NONE")
    for role in ("skin", "near_skin"):
        inputs = of_role(body, role).inputs
        inputs["Coat Weight"].default_value, inputs["Coat IOR"].default_value = 0.5, 1.6
    before = shown(tmp_path)
    body.skin_tan.film = "WATER"
    assert "The film does not show" in apply_tan(body, bpy.context.scene)
    inputs = of_role(body, "skin").inputs
    assert not inputs["Coat Weight"].is_linked
    assert inputs["Coat IOR"].default_value == pytest.approx(1.6)
    assert shown(tmp_path).shape == before.shape


def test_an_error_takes_the_film_s_nodes_back(body, monkeypatch):
    worn(body, "NONE")
    names = {node.name for node in tan_group(body).nodes}
    links, sockets = len(tan_group(body).links), len(tan_group(body).interface.items_tree)

    def fail(*_):
        raise InputError("no.")

    monkeypatch.setattr(images, "replace", fail)
    body.skin_tan.film = "WATER"
    with pytest.raises(RuntimeError):
        apply(body)
    assert {node.name for node in tan_group(body).nodes} == names
    assert len(tan_group(body).links) == links
    assert len(tan_group(body).interface.items_tree) == sockets


def test_a_mask_says_where_the_film_lies(table_path, tmp_path):
    """As much as its number says, of an attribute or a vertex group, inverted, half as strong."""
    obj = tan_object(table_path, np.array([0.0, 0.25, 1.0]), dose=0.0)
    obj.skin_tan.mask.source = ""
    white_world()
    add_camera((1.5, 0.5, 5.0), 3.0)
    group = obj.vertex_groups.new(name="wet")
    for point, weight in enumerate(np.repeat([0.0, 0.25, 1.0], 4)):
        group.add([point], float(weight), "REPLACE")
    obj.skin_tan.film_mask.source = "sun"
    worn(obj, "WATER")
    covered = film_shares(obj)
    assert covered(tmp_path) == pytest.approx([0.0, 0.25, 1.0], abs=1e-3)
    mask = obj.skin_tan.film_mask
    mask.source, mask.invert, mask.strength = "wet", True, 0.5
    assert apply(obj) == {"FINISHED"}
    assert covered(tmp_path) == pytest.approx([0.5, 0.375, 0.0], abs=1e-3)
    mask.source, mask.invert, mask.strength = "", False, 1.0
    assert apply(obj) == {"FINISHED"}
    assert covered(tmp_path) == pytest.approx([1.0, 1.0, 1.0], abs=1e-3)
    mask.source = "sun"
    worn(obj, "NONE")
    assert covered(tmp_path) == pytest.approx([0.0, 0.0, 0.0], abs=1e-3)


def film_shares(obj):
    """A function that renders how much of each of three squares the film covers."""
    tree = tan_group(obj)
    emission = tree.nodes.new("ShaderNodeEmission")
    tree.links.new(of_role(obj, "film").outputs[0], emission.inputs["Color"])
    tree.links.new(emission.outputs[0], of_role(obj, "output").inputs["Surface"])
    return lambda folder: render(folder / "film.exr", width=9, height=3)[1, 1::3, 0]


def test_a_copy_made_for_one_of_two_objects_is_covered(body):
    """The other one stays dry."""
    worn(body, "NONE")
    other = body.copy()
    bpy.context.collection.objects.link(other)
    worn(other, "OIL")
    assert tan_group(other) != tan_group(body)
    assert group_node(other).inputs["Film"].default_value == 1.0
    assert not film_nodes(body)


def test_a_recoloured_material_shows_no_film_and_apply_says_so(body):
    material = bpy.data.materials.new("Painted")
    if material.node_tree is None:
        material.use_nodes = True  # Blender 4.5
    body.data.materials.append(material)
    body.skin_tan.film = "OIL"
    assert "No film shows on 'Painted'" in apply_tan(body, bpy.context.scene)


def test_a_file_of_the_plan_before_shows_a_film_where_no_coat_is_in_its_way(tmp_path):
    """On Body an artist has given the skin a coat."""
    bpy.ops.wm.open_mainfile(filepath=str(LAYOUT_1))
    twin, body = bpy.data.objects["Twin"], bpy.data.objects["Body"]
    for obj in (twin, body):
        obj.skin_tan.film = "WATER"
    assert "film" not in apply_tan(twin, bpy.context.scene)
    assert of_role(twin, "skin").inputs["Coat Weight"].is_linked
    assert group_node(twin).inputs["Film"].default_value == 1.0
    assert "The film does not show" in apply_tan(body, bpy.context.scene)
