"""Views: tinted reflectance of a band in place of the skin's colour, and back without a trace."""

import bpy
import numpy as np
import pytest
from artist_skins import PAINTED, grouped, layered, plain, textured
from scenes import add_camera, apply, pixels, render, tan_group, tan_object, white_world
from synthetic import MED, MMD, ROUGHNESS
from test_changes import contents, inventory
from test_recolour import base_colours, body_in
from test_shader import show_emission_of

from blender_addon import views as switching
from blender_addon.model.catalogue import shipped_path
from blender_addon.model.layer import let_through
from blender_addon.model.views import VIEWS
from blender_addon.scene import changes as changes_module
from blender_addon.scene import recolour
from blender_addon.scene.nodes import role_of
from hylios.errors import InputError
from hylios.table import melanin_dynamics, minimal_doses, read_table
from hylios.tanning import Exposures, simulate

TINTS = {"NM365": (0.72, 0.60, 1.0), "NM1100": (1.0, 0.66, 0.60), "NM1650": (1.0, 0.66, 0.60)}
SHARES, DOSE, FRAME, DAY = np.array([0.0, 0.4, 1.0]), 30.0, 84, 10.0
"""The day of a frame: 30 days in frames 1 to 250."""


def switch(view: str) -> set:
    return bpy.ops.skin_tan.switch_view(view=view)


def body_of_type(name: str):
    obj = tan_object(shipped_path(name), SHARES, dose=DOSE)
    apply(obj)
    bpy.context.scene.frame_set(FRAME)
    add_camera((1.5, 0.5, 5.0), 3.0)
    return obj


def squares(tmp_path, **quality) -> np.ndarray:
    return render(tmp_path / "row.exr", width=9, height=3, **quality)[1, 1::3]


def reflectance(name: str, nm: float) -> np.ndarray:
    """The table's total reflectance at the shares on the day, simulated directly."""
    table = read_table(shipped_path(name))
    doses = minimal_doses(table.provenance)
    hour = 24.0 * 30.0 * (FRAME - 1) / 249.0
    history = simulate(
        Exposures(hours=np.array([0]), doses=SHARES[:, None] * DOSE),
        melanin_dynamics(table.provenance),
        mmd=doses.mmd,
        med=doses.med,
        hours=24 * 30,
    )
    low = int(hour)
    states = history.states[:, low] + (hour - low) * (
        history.states[:, low + 1] - history.states[:, low]
    )
    return table.plane("band_reflectance", states)[:, table.provenance["bands_nm"].index(nm)]


@pytest.mark.parametrize("name", ["I", "III", "VI"])
def test_a_view_is_tint_times_reflectance(tmp_path, name):
    """Output Colour is what has been inside the skin: the total less the surface's .047."""
    body_of_type(name)
    show_emission_of("Colour")
    visible = squares(tmp_path)
    for view, tint in TINTS.items():
        switch(view)
        inside = np.maximum(reflectance(name, VIEWS[view].nm) - 0.0467, 0.0)
        assert squares(tmp_path) == pytest.approx(np.outer(inside, tint), abs=0.001)
    switch("VISIBLE")
    assert np.array_equal(squares(tmp_path), visible)


@pytest.mark.parametrize(("name", "view"), [("I", "NM365"), ("III", "NM1100"), ("VI", "NM1650")])
def test_under_white_light_gloss_is_tinted_too(tmp_path, name, view):
    """What a camera behind a filter sees: tint times the total reflectance."""
    apply(tan_object(shipped_path(name), dose=DOSE))
    bpy.context.scene.frame_set(FRAME)
    white_world()
    bpy.context.scene.world.cycles.sampling_method = "NONE"
    add_camera((0.5, 0.5, 5.0), 0.1)
    switch(view)
    seen = render(tmp_path / "patch.exr", width=16, height=16, samples=64).mean(axis=(0, 1))
    expected = reflectance(name, VIEWS[view].nm)[-1] * np.array(TINTS[view])
    assert seen == pytest.approx(expected, rel=0.01)


@pytest.fixture
def bodies(table_path):
    """Two of a skin, one of them with another sun."""
    made = [tan_object(table_path), tan_object(table_path, dose=9.0)]
    made[1].name = "Neighbour"
    for obj in made:
        apply(obj)
    return made


def saved_size(tmp_path) -> int:
    path = tmp_path / "saved.blend"
    bpy.ops.wm.save_as_mainfile(filepath=str(path), copy=True, compress=False)
    return path.stat().st_size


def own_properties(scene) -> dict:
    """Less what Blender 4.5 makes for registered properties when they are read."""
    return {name: value for name, value in scene.items() if name != "skin_tan"}


def test_back_without_a_trace(bodies, tmp_path):
    saved_size(tmp_path)
    scene = bpy.context.scene
    before, keys, size = inventory(), own_properties(scene), saved_size(tmp_path)
    for view in VIEWS:
        assert switch(view) == {"FINISHED"}
        assert scene.skin_tan.view == view
    (image,) = (image for image in bpy.data.images if "skin_tan_view_image" in image)
    assert inventory() != before and image.packed_file
    switch("VISIBLE")
    assert inventory() == before and own_properties(scene) == keys
    assert abs(saved_size(tmp_path) - size) < 500


def test_the_property_presses_the_button(bodies):
    tan = bpy.context.scene.skin_tan
    tan.view = "NM365"
    assert tan.view == "NM365" == tan_group(bodies[1])["skin_tan_view"]
    other = bpy.data.scenes.new("Other")
    assert other.skin_tan.view == "NM365"
    other.skin_tan.view = "VISIBLE"
    assert tan.view == "VISIBLE" and "skin_tan_view" not in tan_group(bodies[0])


def test_what_an_artist_wired_meanwhile_stays(bodies):
    """The tree is as it was, but for his link."""
    group = tan_group(bodies[0])
    switch("NM365")
    dim = group.nodes.new("ShaderNodeGamma")
    band = next(node for node in group.nodes if node.label == "Band for colour")
    group.links.new(band.outputs["Result"], dim.inputs["Color"])
    switch("VISIBLE")
    assert dim.inputs["Color"].links[0].from_node.label == "By thickness"


def test_an_exception_anywhere_in_a_switch(bodies, monkeypatch):
    """Neither groups nor images nor scenes change."""
    calls = []
    for method in ("set", "set_key", "may_add_to", "may_relink", "at_the_end"):
        former = getattr(changes_module.Changes, method)
        monkeypatch.setattr(changes_module.Changes, method, _counted(former, calls))
    for former, view in (("VISIBLE", "NM365"), ("NM365", "NM1100"), ("NM1100", "VISIBLE")):
        switch(former)
        calls[:] = [10**6]
        switching.switch_view(view)
        count = 10**6 - calls[0]
        switch(former)
        assert count > 2
        before, scene = inventory(), dict(bpy.context.scene.items())
        for number in range(count):
            calls[:] = [number]
            with pytest.raises(ArithmeticError):
                switching.switch_view(view)
            calls[:] = [10**6]
            assert inventory() == before and dict(bpy.context.scene.items()) == scene
        switch("VISIBLE")


def _counted(former, calls):
    def method(self, *arguments):
        if calls and calls[0] == 0:
            raise ArithmeticError
        calls[:] = [count - 1 for count in calls]
        return former(self, *arguments)

    return method


def test_undo_and_redo(bodies):
    bpy.ops.ed.undo_push(message="before")
    before = contents(tan_group(bpy.data.objects["Body"]))[1]
    switch("NM365")
    bpy.ops.ed.undo_push(message="after")
    inside = contents(tan_group(bpy.data.objects["Body"]))[1]
    bpy.ops.ed.undo()
    assert bpy.context.scene.skin_tan.view == "VISIBLE"
    assert contents(tan_group(bpy.data.objects["Body"]))[1] == before
    bpy.ops.ed.redo()
    assert bpy.context.scene.skin_tan.view == "NM365"
    assert contents(tan_group(bpy.data.objects["Body"]))[1] == inside
    switch("VISIBLE")
    assert contents(tan_group(bpy.data.objects["Body"]))[1] == before


def test_a_view_is_saved_and_left_after_loading(bodies, tmp_path):
    before = contents(tan_group(bodies[0]))[1]
    switch("NM365")
    (image,) = (image for image in bpy.data.images if "skin_tan_view_image" in image)
    name, band = image.name, pixels(image)
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "saved.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "saved.blend"))
    assert bpy.context.scene.skin_tan.view == "NM365"
    assert np.array_equal(pixels(bpy.data.images[name]), band)
    switch("VISIBLE")
    assert contents(tan_group(bpy.data.objects["Body"]))[1] == before
    assert not any("skin_tan_view_image" in image for image in bpy.data.images)


def test_apply_in_a_view_shows_the_new_skin_in_it(tmp_path, bodies):
    switch("NM365")
    body = bodies[0]
    body.skin_tan.table_path = str(shipped_path("III"))
    apply(body)
    body.location.x = 50.0
    add_camera((50.5, 0.5, 5.0), 1.0)
    show_emission_of("Colour")
    expected = np.array(TINTS["NM365"]) * (read_bare("III") - 0.0467)
    assert squares(tmp_path)[1] == pytest.approx(expected, abs=1e-3)
    assert len({image for image in bpy.data.images if "skin_tan_view_image" in image}) == 2
    switch("VISIBLE")
    assert not any("skin_tan_view_image" in image for image in bpy.data.images)


def read_bare(name: str) -> float:
    table = read_table(shipped_path(name))
    return float(
        table.plane("band_reflectance", np.array([[*table.axes.sheet.untanned, 1.0]]))[0, 0]
    )


def test_a_new_object_is_in_the_view(bodies, table_path):
    switch("NM1650")
    obj = tan_object(table_path)
    apply(obj)
    assert tan_group(obj)["skin_tan_view"] == "NM1650"


def test_a_copy_of_a_skin_in_a_view_goes_back_too(bodies):
    before = contents(tan_group(bodies[0]))[1]
    switch("NM365")
    copy = bodies[0].copy()
    bpy.context.collection.objects.link(copy)
    copy.skin_tan.last_day = 10.0
    apply(copy)
    assert tan_group(copy) != tan_group(bodies[0])
    switch("VISIBLE")
    assert contents(tan_group(bodies[0]))[1] == before
    assert len(contents(tan_group(copy))[1]) == len(before)


@pytest.mark.parametrize("trouble", ["no bands", "missing", "removed"])
def test_skin_that_cannot_show_a_view_stays_visible(
    bodies, table_path, former_path, tmp_path, trouble
):
    """The others switch, and the sentence says which does not and why."""
    obj = tan_object(table_path)
    obj.name = "Odd"
    moved = tmp_path / "moved.exr"
    moved.write_bytes(table_path.read_bytes())
    obj.skin_tan.table_path = str(former_path if trouble == "no bands" else moved)
    apply(obj)
    if trouble == "missing":
        moved.unlink()
    if trouble == "removed":
        group = tan_group(obj)
        group.nodes.remove(next(n for n in group.nodes if role_of(n) == "mixed_colour"))
    before = contents(tan_group(obj))
    said = switching.switch_view("NM365")
    assert said.startswith("365 nm is shown on 'Body', 'Neighbour'. The visible stays on 'Odd': ")
    assert contents(tan_group(obj)) == before
    assert "skin_tan_view" in tan_group(bodies[0])
    for body in bodies:
        bpy.data.objects.remove(body)
    with pytest.raises(RuntimeError, match="'Odd'"):
        switch("NM1100")
    assert bpy.context.scene.skin_tan.view == "NM365"


def test_settings_that_are_not_applied_yet_do_not_count(bodies, table_path):
    """The view is of the skin that shows, whatever has been chosen since."""
    switch("NM365")
    shown = {image.name: pixels(image).tobytes() for image in bpy.data.images}
    switch("VISIBLE")
    for obj in bodies:
        obj.skin_tan.skin, obj.skin_tan.mmd, obj.skin_tan.own_minimal_doses = "IV", MMD + MED, True
    switch("NM365")
    assert {image.name: pixels(image).tobytes() for image in bpy.data.images} == shown


def test_linked_skin_stays_as_it_is(bodies, tmp_path):
    path = str(tmp_path / "library.blend")
    bpy.data.libraries.write(path, {bodies[0].material_slots[0].material})
    with bpy.data.libraries.load(path, link=True) as (_, wanted):
        wanted.materials = ["Skin Tan Body"]
    obj = bpy.data.objects.new("Linked", bodies[0].data.copy())
    obj.data.materials[0] = wanted.materials[0]
    said = switching.switch_view("NM365")
    assert "Linked skin stays as it is: 'Linked'." in said


def test_a_view_that_is_not_there(bodies):
    with pytest.raises(TypeError):
        switch("NM700")
    with pytest.raises(InputError, match="allowed is one of VISIBLE, NM365"):
        switching.switch_view("NM700")
    bpy.context.scene["skin_tan_view"] = "NM700"  # of a later version
    assert bpy.context.scene.skin_tan.view == "VISIBLE"
    assert apply(bodies[0]) == {"FINISHED"}
    assert "skin_tan_view" not in tan_group(bodies[0])


@pytest.fixture
def dressed(table_path):
    """A body in materials of an artist's."""
    materials = [make(f"skin {make.__name__}") for make in (plain, textured, grouped, layered)]
    obj = body_in(table_path, materials)
    trees = [material.node_tree for material in materials]
    trees += [group for group in bpy.data.node_groups]
    before = [contents(tree) for tree in trees]
    apply(obj)
    return obj, trees, before


def test_recoloured_materials_show_the_view_in_place_of_paint(tmp_path, table, dressed):
    obj, trees, _ = dressed
    count = len(obj.material_slots)
    recoloured = [contents(tree) for tree in trees]
    add_camera((count / 2, 0.5, 5.0), count)
    let_out = base_colours(tmp_path, count)[:3] / PAINTED
    switch("NM1650")
    states = np.array([[*table.axes.sheet.untanned, 1.0, 1.0]])
    total = table.plane("band_reflectance", states)[0, 2]
    surface = 1.0 - float(let_through(ROUGHNESS, 8.0))
    expected = (total - surface) * np.array(TINTS["NM1650"])
    assert base_colours(tmp_path, count)[:3] == pytest.approx(let_out * expected, abs=1e-3)
    switch("NM365")
    switch("VISIBLE")
    assert [contents(tree) for tree in trees] == recoloured


def test_paint_comes_back_where_the_tan_is_removed_in_a_view(dressed):
    obj, trees, before = dressed
    switch("NM365")
    for tree in trees:
        recolour.take_out(tree)
    assert [contents(tree) for tree in trees] == before


def test_a_material_that_is_recoloured_in_a_view_shows_it(table_path, bodies):
    switch("NM365")
    obj = body_in(table_path, [plain("skin")])
    apply(obj)
    tree = bpy.data.materials["skin"].node_tree
    (node,) = recolour.inserted(tree, recolour.INSTEAD)
    assert node.outputs["Result"].is_linked or node.outputs[2].is_linked
    apply(obj)
    assert recolour.inserted(tree, recolour.INSTEAD) == [node]
    switch("VISIBLE")
    assert recolour.inserted(tree, recolour.INSTEAD) == []


def test_a_first_apply_in_a_view_shows_it_in_groups_too(table_path):
    switch("NM1650")
    obj = body_in(table_path, [grouped("skin"), layered("ears")])
    apply(obj)
    trees = [*(slot.material.node_tree for slot in obj.material_slots), *bpy.data.node_groups]
    shown = [contents(tree) for tree in trees if recolour.inserted(tree)]
    switch("NM365")
    switch("NM1650")
    assert [contents(tree) for tree in trees if recolour.inserted(tree)] == shown
    assert len(shown) > 2 and all(
        recolour.inserted(t, "instead") for t in trees if recolour.inserted(t)
    )
