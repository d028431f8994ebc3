"""Peeling skin, rendered: how much of it is lighter, and by what; off, nothing is left of it."""

import bpy
import numpy as np
import pytest
from artist_skins import mixed, wear
from scenes import (
    add_camera,
    add_mask,
    apply,
    of_role,
    pixels,
    render,
    tan_group,
    tan_object,
    white_world,
)
from state import state
from synthetic import MED, colour_of
from test_own_colour import nodes_of
from test_regions import add_region, show_emission_of

from blender_addon import live
from blender_addon.model.tan import peeling_of
from blender_addon.props import settings_of
from blender_addon.scene import peeling
from blender_addon.scene.exr import rounded
from blender_addon.scene.nodes import role_of

DAY, SHARES = 12, (0.2, 0.8, 1.0)


def burnt_row(table_path, burn: float = 5.0):
    """Squares of a metre, of which the first burns too little to peel."""
    obj = tan_object(table_path, SHARES, dose=burn * MED)
    settings = obj.skin_tan
    settings.peeling, settings.first_frame, settings.last_frame = True, 0, 30
    add_camera((len(SHARES) / 2, 0.5, 5.0), len(SHARES))
    white_world()
    return obj


def shown(folder, day: int, wide: int = 100) -> np.ndarray:
    """Colours of the squares, (squares, pixels, 3)."""
    bpy.context.scene.frame_set(day)
    picture = render(folder / "row.exr", width=wide * len(SHARES), height=wide)
    return np.stack([own.reshape(-1, 3) for own in np.split(picture, len(SHARES), axis=1)])


def test_as_much_is_lighter_as_the_image_says_by_what_it_says(tmp_path, table_path):
    """Where too little burnt, all is as without; flakes are gone by then."""
    obj = burnt_row(table_path)
    apply(obj)
    show_emission_of(obj, "Colour")
    seen = shown(tmp_path, DAY)
    image = peeling_of(settings_of(obj).values())
    obj.skin_tan.peeling = False
    apply(obj)
    without = shown(tmp_path, DAY)
    assert seen[0] == pytest.approx(without[0], abs=1e-4)
    row = int((DAY + 0.5) / 30.0 * len(image))
    for square in (1, 2):
        cover, taken, _ = image[row, min(int(SHARES[square] * 64), 63)]
        lighter = seen[square, :, 2] > without[square, :, 2] + 0.004
        assert lighter.mean() == pytest.approx(cover, abs=0.07)
        (whole,) = np.unique(without[square].round(4), axis=0)
        melanin = -np.log(whole[2] / colour_of(np.array([1.0, 0, 0, 1.0, 1.0]))[2]) / 0.6
        left = whole[2] * np.exp(0.6 * taken / cover * melanin)
        assert np.quantile(seen[square, :, 2], 0.98) == pytest.approx(left, abs=0.015)


def test_off_leaves_nothing_of_it(table_path):
    """Also with regions and own colours."""
    obj = burnt_row(table_path)
    wear(obj, [mixed("skin")])
    add_region(obj, "freckles", np.ones(len(SHARES)))
    obj.skin_tan.own_colour, obj.skin_tan.peeling = True, False
    apply(obj)
    plain, images = state(), len(bpy.data.images)
    obj.skin_tan.peeling = True
    apply(obj)
    apply(obj)
    assert peeling.is_shown(tan_group(obj))
    obj.skin_tan.peeling = False
    apply(obj)
    assert nodes_of(state()) == nodes_of(plain)
    assert len(bpy.data.images) == images


def test_every_mask_peels_by_its_own_doses(tmp_path, table_path):
    """A second sun elsewhere changes nothing; where both fell the larger burn counts."""
    obj = burnt_row(table_path)
    add_mask(obj, np.repeat((1.0, 0.0, 0.3), 4), "other")
    obj.skin_tan.mask_attribute = "sun"
    more = obj.skin_tan.exposures.add()
    more.own_mask, more.dose, more.mask.source = True, 5.0 * MED, "other"
    apply(obj)
    (link,) = of_role(obj, "peel").inputs["Peeling"].links
    assert link.from_node == of_role(obj, "peel_masks")
    image = of_role(obj, "peel_image").image
    rows = image.size[1] // 2
    row = DAY * rows // 30  # the day lies between this row and the one before
    told = pixels(image)[row - 1 : row + 1, :, :3].mean(axis=0)
    tree = tan_group(obj)
    end = next(node for node in tree.nodes if node.bl_idname == "NodeGroupOutput")
    tree.links.new(link.from_socket, end.inputs["Colour"])
    show_emission_of(obj, "Colour")
    seen = shown(tmp_path, DAY, wide=4).mean(axis=1)
    columns = [63, min(int(0.8 * 64), 63), 63]  # the larger of both shares
    assert seen == pytest.approx(told[columns], abs=0.01)
    more.own_mask = False
    apply(obj)
    assert not [node for node in tree.nodes if role_of(node) == "peel_masks"]
    assert of_role(obj, "peel").inputs["Peeling"].links[0].from_node == of_role(obj, "peel_image")


def links_of(obj) -> list[tuple[str, ...]]:
    return sorted(
        (link.from_node.label, link.from_socket.name, link.to_node.label, link.to_socket.name)
        for tree in (obj.material_slots[0].material.node_tree, tan_group(obj))
        for link in tree.links
    )


def test_groups_that_were_deleted_by_hand_come_back(table_path):
    """All at once, and while the mesh turns back to one mask that does not peel."""
    obj = burnt_row(table_path)
    add_region(obj, "freckles", np.ones(len(SHARES)))
    more = obj.skin_tan.exposures.add()
    more.dose, obj.skin_tan.peeling, obj.skin_tan.last_day = 4.0 * MED, False, 9.0
    apply(obj)
    plain = links_of(obj)
    obj.skin_tan.peeling = more.own_mask = True
    apply(obj)
    whole = links_of(obj)
    inner = {group.name for group in bpy.data.node_groups} - {tan_group(obj).name}
    assert len(inner) == 5
    for is_on, expected in ((True, whole), (False, plain)):
        bpy.data.batch_remove([bpy.data.node_groups[name] for name in inner])
        obj.skin_tan.peeling = more.own_mask = is_on
        apply(obj)
        assert links_of(obj) == expected


def test_film_peeling_and_view_lead_to_one_another_in_whatever_order_they_came(table_path):
    """A film lies on flakes and follows their relief; a view shows its band in their place."""
    values = {
        "film": ("WATER", "NONE"),
        "peeling": (True, False),
        "view": ("NM365", "VISIBLE"),
    }

    def turn(obj, names: str, number: int) -> list:
        for name in names.split():
            settings = bpy.context.scene.skin_tan if name == "view" else obj.skin_tan
            setattr(settings, name, values[name][number])
            apply(obj)
        return links_of(obj)

    seen = []
    for order in ("film peeling view", "peeling view film", "view film peeling"):
        obj = tan_object(table_path, SHARES, dose=5.0 * MED)
        apply(obj)
        all_on = turn(obj, order, 0)
        again = turn(obj, order.split()[0], 1) and turn(obj, order.split()[0], 0)
        seen.append((all_on, again, turn(obj, "view", 1), turn(obj, "peeling", 1)))
        bpy.data.objects.remove(obj)
    assert all(both == seen[0] for both in seen)
    in_view, again, visible, _ = seen[0]
    assert in_view == again
    for labels in (("Flakes", "Band for colour"), ("Relief of flakes", "Normal of the skin")):
        assert labels in {(start, end) for start, _, end, _ in in_view}
    assert ("Flakes", "Change by a film") in {(start, end) for start, _, end, _ in visible}


def test_several_masks_views_and_removal_with_it(table_path):
    """In any order, and Remove Tan leaves no group and no image."""
    obj = burnt_row(table_path)
    more = obj.skin_tan.exposures.add()
    more.own_mask, more.dose = True, 4.0 * MED
    apply(obj)
    (link,) = of_role(obj, "state").inputs[0].links
    assert link.from_node == of_role(obj, "peel")
    (before,) = link.from_node.inputs["State"].links
    assert before.from_node == of_role(obj, "basis")
    bpy.context.scene.skin_tan.view = "NM365"
    more.own_mask = False
    apply(obj)
    assert of_role(obj, "peel").inputs["State"].links[0].from_node == of_role(obj, "states")
    obj.skin_tan.peeling = False
    apply(obj)
    bpy.context.scene.skin_tan.view = "VISIBLE"
    (link,) = of_role(obj, "state").inputs[0].links
    assert link.from_node == of_role(obj, "states")
    obj.skin_tan.peeling = True
    apply(obj)
    bpy.ops.skin_tan.remove()
    assert not bpy.data.images and not bpy.data.node_groups


def test_live_changes_it_and_a_saved_file_keeps_it(table_path, tmp_path):
    obj = burnt_row(table_path)
    apply(obj)
    image = of_role(obj, "peel_image").image
    obj.skin_tan.exposures[0].dose = 4.0 * MED
    live.show_changes()
    live.make_exact()
    assert of_role(obj, "peel_image").image == image
    expected = peeling_of(settings_of(obj).values())
    path = str(tmp_path / "peeling.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path)
    shown_again = pixels(of_role(bpy.data.objects["Body"], "peel_image").image)[..., :3]
    np.testing.assert_array_equal(shown_again, rounded(expected))
