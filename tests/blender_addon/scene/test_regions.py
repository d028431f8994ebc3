"""Regions of the skin, rendered: the state they shift to, spots in mm, and nothing without them."""

import bpy
import numpy as np
import pytest
from artist_skins import plain, wear
from scenes import add_camera, apply, of_role, render, tan_group, tan_object, white_world
from state import state
from synthetic import MED, MMD, UNTANNED_COLOUR, colour_of, provenance
from test_recolour import base_colours

import hylios
from blender_addon.model.regions import shown, spots
from blender_addon.props import settings_of
from blender_addon.scene.nodes import find_input, role_of
from blender_addon.scene.region_nodes import PLACE
from blender_addon.scene.regions import LATER, OF_LATER, ROLES
from hylios.errors import InputError
from hylios.skin import whole_thickening
from hylios.skin.regions import REGIONS
from hylios.table import skin_of
from hylios.tanning import PIGMENTATIONS, Exposures, states_at

DOSE, DAY, STRENGTH = 7.0, 8, 0.9
PLACES = [(share, mask) for share in (0.0, 1.0) for mask in (0.5, 1.0)]
"""Share of the sun and mask of the squares of a kind."""


def add_region(obj, kind: str, values=None, **settings):
    """Values are the mask at each square."""
    region = obj.skin_tan.regions.add()
    region.kind, region.painted = kind.upper(), values is not None
    for name, value in settings.items():
        setattr(region, name, value)
    if values is not None:
        name = f"of {len(obj.skin_tan.regions)} {kind}"
        attribute = obj.data.attributes.new(name, "FLOAT", "POINT")
        attribute.data.foreach_set("value", np.repeat(values, 4).astype(np.float32))
        region.mask.source = name
    return region


def row_of_kinds(table_path):
    """Four squares of every kind, in the sun and not, where half and all of it lies."""
    names = list(REGIONS)
    squares = [(*place, name) for name in names for place in PLACES]
    obj = tan_object(table_path, [share for share, _, _ in squares], dose=DOSE)
    for name in names:
        masks = [mask if name == own else 0.0 for _, mask, own in squares]
        add_region(obj, name, masks, strength=STRENGTH)
    add_camera((len(squares) / 2, 0.5, 5.0), len(squares))
    white_world()
    settings = obj.skin_tan
    settings.first_day, settings.last_day = 0.0, 30.0
    settings.first_frame, settings.last_frame = 0, 30
    return obj, squares


def expected(obj, squares, day: int) -> tuple[np.ndarray, np.ndarray]:
    """Colours, and ratios to those without sun, of the synthetic table at the shifted states."""
    shares = np.array([share for share, _, _ in squares])
    exposures = Exposures(hours=np.array([0]), doses=shares[:, None] * DOSE)
    own = PIGMENTATIONS["intermediate"]
    erythema = None
    if settings_of(obj).redness:
        erythema = hylios.erythema(skin_of(provenance("intermediate")))
    states = states_at(exposures, own, times=[24 * day], mmd=MMD, med=MED, erythema=erythema)[:, 0]
    if erythema is None:
        states = np.insert(states, 4, 1.0, axis=1)
    else:
        states = whole_thickening(states)
    colours, before = [], []
    for (_, mask, name), lit in zip(squares, states, strict=True):
        start = [*own.steady_state() / np.sum(own.steady_state()), 1.0, 1.0]
        for given, kept in ((lit, colours), (np.array(start), before)):
            u = np.log(given[:3].sum())
            told = shown(settings_of(obj).values(), name, STRENGTH)
            b = np.log(given[4])
            melanin, blood = told.region.of_state(u, b, STRENGTH * mask)
            full = np.array(
                [min(melanin, np.exp(1.8)), 0.0, 0.0, given[3], min(np.exp(blood), 12.0)]
            )
            kept.append(colour_of(full) * np.power(told.colour, STRENGTH * mask))
    return np.array(colours), np.array(colours) / np.array(before)


def show_emission_of(obj, output: str) -> None:
    """Have the skin emit an output of its group."""
    tree = obj.material_slots[0].material.node_tree
    skin = next(n for n in tree.nodes if getattr(n, "node_tree", None) == tan_group(obj))
    emission = tree.nodes.new("ShaderNodeEmission")
    tree.links.new(skin.outputs[output], emission.inputs["Color"])
    end = next(node for node in tree.nodes if node.bl_idname == "ShaderNodeOutputMaterial")
    tree.links.new(emission.outputs[0], end.inputs["Surface"])


@pytest.mark.parametrize(("day", "redness"), [(DAY, False), (2, True)])
def test_colour_and_ratio_are_those_of_the_shifted_state(tmp_path, table_path, day, redness):
    """Of every kind, in the sun and not; Ratio is over the same region before the sun."""
    obj, squares = row_of_kinds(table_path)
    obj.skin_tan.redness = redness
    assert apply(obj) == {"FINISHED"}
    bpy.context.scene.frame_set(day)
    colours, ratios = expected(obj, squares, day)
    for output, wanted in (("Colour", colours), ("Ratio", ratios)):
        show_emission_of(obj, output)
        seen = render(tmp_path / "row.exr", width=3 * len(squares), height=3)[1, 1::3]
        assert seen == pytest.approx(wanted, abs=0.005)
    unlike = np.abs(colours - UNTANNED_COLOUR).max(axis=1)
    assert unlike.min() > 0.01


def test_a_painted_material_is_as_painted_before_the_sun_and_tans_as_its_regions(
    tmp_path, table_path
):
    obj, squares = row_of_kinds(table_path)
    wear(obj, [plain("painted")])
    for face in obj.data.polygons:
        face.material_index = 0
    assert apply(obj) == {"FINISHED"}
    bpy.context.scene.frame_set(0)
    painted = base_colours(tmp_path, len(squares))
    assert np.ptp(painted, axis=0) == pytest.approx(np.zeros(3), abs=1e-5)
    bpy.context.scene.frame_set(DAY)
    _, ratios = expected(obj, squares, DAY)
    assert base_colours(tmp_path, len(squares)) / painted == pytest.approx(ratios, abs=0.005)


def spots_shown(obj, folder, pixels: int) -> np.ndarray:
    """Where freckles are, as a picture: 1 without, less where there is a spot."""
    show_emission_of(obj, "Colour")
    picture = render(folder / "spots.exr", width=pixels, height=pixels)[..., 2]
    return picture / picture.max()


@pytest.mark.parametrize("strength", [0.5, 1.0])
def test_freckles_cover_the_share_of_the_skin_that_the_table_says(tmp_path, table_path, strength):
    """On 24 cm of skin; those that would overlap cut each other, so it is 4 to 7 % less."""
    obj = tan_object(table_path, dose=0.0)
    obj.scale = (0.24, 0.24, 0.24)
    bpy.context.view_layer.update()
    add_region(obj, "freckles", strength=strength)
    assert apply(obj) == {"FINISHED"}
    add_camera((0.12, 0.12, 1.0), 0.24)
    covered = (spots_shown(obj, tmp_path, 480) < 1.0 - 1e-4).mean()
    told = spots()["freckles"].share_of_area(strength)
    assert covered == pytest.approx(told, rel=0.15)


@pytest.mark.parametrize("scale", [0.02, 0.5, 30.0])
def test_moles_are_as_many_mm_wide_as_the_table_says_at_any_scale_of_the_object(
    tmp_path, table_path, scale
):
    """The largest of many is about that; the model scale makes up for a giant."""
    obj = tan_object(table_path, dose=0.0)
    obj.scale = (scale, scale, scale)
    obj.skin_tan.model_scale = scale / 0.4
    bpy.context.view_layer.update()
    add_region(obj, "moles", strength=2.0)
    assert apply(obj) == {"FINISHED"}
    add_camera((scale / 2, scale / 2, 1.0), scale)
    dark = spots_shown(obj, tmp_path, 800) < 1.0 - 1e-4
    assert dark.any()
    widest = longest_run(dark) * 400.0 / 800
    largest = spots()["moles"].largest
    assert 0.5 * largest < widest < largest + 0.6


def longest_run(rows: np.ndarray) -> int:
    """Most true values in a row of a picture that follow each other."""
    longest = 0
    for row in rows:
        edges = np.flatnonzero(np.diff(np.concatenate([[0], row.astype(int), [0]])))
        longest = max([longest, *(edges[1::2] - edges[::2])])
    return longest


def test_without_regions_nothing_is_left_of_them(table_path):
    obj = tan_object(table_path)
    add_region(obj, "lips")  # without a mask it is nowhere
    assert apply(obj) == {"FINISHED"}
    before = state()
    assert not any(role_of(node) in ROLES for node in tan_group(obj).nodes)
    region = add_region(obj, "freckles")
    assert apply(obj) == {"FINISHED"}
    assert of_role(obj, "regions")
    region.enabled = False
    assert apply(obj) == {"FINISHED"}
    assert told(state()) == told(before)


def told(everything: dict) -> dict:
    """A state of a file, whatever the order of the links."""
    groups = {
        name: (nodes, sorted(links), *rest)
        for name, (nodes, links, *rest) in everything["groups"].items()
    }
    return {**everything, "groups": groups}


def test_remove_tan_takes_regions_too(table_path):
    obj = tan_object(table_path)
    before = state()
    add_region(obj, "freckles")
    group = obj.vertex_groups.new(name="mouth")
    group.add([0], 1.0, "REPLACE")
    add_region(obj, "lips").mask.source = "mouth"
    assert apply(obj) == {"FINISHED"}
    assert bpy.ops.skin_tan.remove() == {"FINISHED"}
    assert state() == before


def test_a_second_apply_keeps_what_was_edited_and_another_strength_does_not(table_path):
    obj = tan_object(table_path)
    region = add_region(obj, "freckles")
    apply(obj)
    tree = of_role(obj, "regions").node_tree
    (cells,) = (node for node in tree.nodes if node.bl_idname == "ShaderNodeTexVoronoi")
    cells.inputs["Randomness"].default_value = 0.5
    apply(obj)
    assert of_role(obj, "regions").node_tree == tree
    region.strength = 1.5
    apply(obj)
    shown = of_role(obj, "regions").node_tree
    assert shown.name.startswith("Skin Tan Regions Body")
    trees = [group for group in bpy.data.node_groups if "skin_tan_regions" in group]
    assert trees == [shown]
    assert len(of_role(obj, "region_melanin").inputs[1].links) == 1


def test_regions_of_an_earlier_version_get_light_and_redness(tmp_path, table_path):
    """On the day after a burn: palms and moles have not reddened."""
    obj, squares = row_of_kinds(table_path)
    obj.skin_tan.redness = True
    apply(obj)
    group = tan_group(obj)
    tree = of_role(obj, "regions").node_tree
    tree.interface.remove(tree.interface.items_tree["Light"])
    tree["skin_tan_regions"] = "earlier"
    for role in LATER:
        group.nodes.remove(of_role(obj, role))
    for image, output, target, socket in OF_LATER:
        end = find_input(of_role(obj, target), socket)
        group.links.new(of_role(obj, image).outputs[output], end)
    apply(obj)
    bpy.context.scene.frame_set(1)
    show_emission_of(obj, "Colour")
    seen = render(tmp_path / "row.exr", width=3 * len(squares), height=3)[1, 1::3]
    assert seen == pytest.approx(expected(obj, squares, 1)[0], abs=0.005)


def test_a_copy_of_the_object_gets_regions_of_its_own(table_path):
    obj = tan_object(table_path)
    add_region(obj, "freckles")
    apply(obj)
    other = obj.copy()
    bpy.context.collection.objects.link(other)
    other.scale = (2.0, 2.0, 2.0)
    bpy.context.view_layer.update()
    apply(other)
    trees = [of_role(item, "regions").node_tree for item in (obj, other)]
    assert trees[0] != trees[1]
    sizes = [next(n for n in tree.nodes if role_of(n) == PLACE) for tree in trees]
    first, second = (np.array(node.inputs[1].default_value) for node in sizes)
    assert second == pytest.approx(2.0 * first)


def test_an_error_leaves_all_as_it_was(table_path, monkeypatch):
    from blender_addon.scene import images

    obj = tan_object(table_path)
    apply(obj)
    before = state()

    def fail(*_):
        raise InputError("no.")

    monkeypatch.setattr(images, "replace", fail)
    add_region(obj, "freckles")
    with pytest.raises(RuntimeError):
        apply(obj)
    assert told(state()) == told(before)


def test_a_mask_that_is_gone_is_told(table_path):
    obj = tan_object(table_path)
    add_region(obj, "lips").mask.source = "mouth"
    with pytest.raises(RuntimeError, match="no 'mouth', which is set as a mask"):
        apply(obj)


def test_regions_come_and_go_by_buttons(table_path):
    obj = tan_object(table_path)
    bpy.ops.skin_tan.add_region()
    bpy.ops.skin_tan.add_region(kind="LIPS", strength=0.5, mask="mouth")
    regions = obj.skin_tan.regions
    assert [(item.kind, item.mask.source) for item in regions] == [
        ("FRECKLES", ""),
        ("LIPS", "mouth"),
    ]
    bpy.ops.skin_tan.remove_region(index=0)
    assert [item.kind for item in regions] == ["LIPS"]
    bpy.ops.skin_tan.remove_region()
    assert not bpy.ops.skin_tan.remove_region.poll()


def test_paint_mask_makes_a_black_one_for_a_region(table_path, capfd):
    obj = tan_object(table_path)
    with pytest.raises(RuntimeError, match="has no region"):
        bpy.ops.skin_tan.paint_mask(target="REGION")
    bpy.ops.skin_tan.add_region(kind="LIPS")
    assert bpy.ops.skin_tan.paint_mask(target="REGION") == {"FINISHED"}
    assert "Black is outside the region, white is in it" in capfd.readouterr().out
    assert obj.skin_tan.regions[0].mask.source == "Lips Mask"
    assert obj.skin_tan.mask.source == ""
    painted = obj.data.attributes["Lips Mask"].data
    assert {tuple(point.color) for point in painted} == {(0.0, 0.0, 0.0, 1.0)}
    assert apply(obj) == {"FINISHED"}
    assert of_role(obj, "regions")
