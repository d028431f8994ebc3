"""The buttons that make masks, from scripts: for a brush, and from clothes."""

from types import SimpleNamespace

import bpy
import numpy as np
import pytest
from scenes import apply

from blender_addon import masking
from blender_addon.ops import masks as ops_masks
from blender_addon.ops.masks import SKIN_TAN_OT_mask_from_clothes
from blender_addon.props import settings_of
from blender_addon.scene import clothes
from blender_addon.scene.mask_values import mask_values
from blender_addon.scene.masks import Mask
from blender_addon.scene.nodes import role_of

RADIUS, BAND_RADIUS, HALF_BAND = 0.1, 0.105, 0.03
"""Of a sphere and of a band around it, in metres."""


def sphere(fineness: int = 4):
    bpy.ops.mesh.primitive_ico_sphere_add(subdivisions=fineness, radius=RADIUS)
    return bpy.context.object


def band(radius: float = BAND_RADIUS, name: str = "Band"):
    bpy.ops.mesh.primitive_cylinder_add(
        vertices=128, radius=radius, depth=2 * HALF_BAND, end_fill_type="NOTHING"
    )
    bpy.context.object.name = name
    return bpy.context.object


def select(body, *garments) -> None:
    bpy.ops.object.select_all(action="DESELECT")
    for obj in (*garments, body):
        obj.select_set(True)
    bpy.context.view_layer.objects.active = body


def shares(obj, mask=None) -> np.ndarray:
    values = mask_values(obj, mask or settings_of(obj).shown_mask())
    assert values.domain == "POINT"
    return values.shares


def to_hem(obj) -> np.ndarray:
    """Millimetres (points,) along the sphere to the hem of the band; less than 0 is covered."""
    points = np.array([vertex.co for vertex in obj.data.vertices])
    latitude = np.abs(np.arcsin(points[:, 2] / np.linalg.norm(points, axis=1)))
    return 1000.0 * RADIUS * (latitude - np.arctan(HALF_BAND / BAND_RADIUS))


@pytest.mark.parametrize(("softness", "most"), [(20.0, 0.005), (40.0, 0.003)])
def test_a_band_covers_what_lies_under_it_with_an_edge_of_its_softness(softness, most):
    """At all points: the share is that of the distance from the hem."""
    body, garment = sphere(5), band()
    select(body, garment)
    assert bpy.ops.skin_tan.mask_from_clothes(softness=softness) == {"FINISHED"}
    expected = np.clip(0.5 + to_hem(body) / softness, 0.0, 1.0)
    assert shares(body) == pytest.approx(expected, abs=most)


def test_on_a_coarse_mesh_the_edge_is_wide_enough_to_be_a_clean_line():
    """Where the share falls to half between two points is near the hem, to .1 of an edge."""
    body = sphere()
    select(body, band())
    bpy.ops.skin_tan.mask_from_clothes(softness=0.0)
    edges = np.array([edge.vertices for edge in body.data.edges])
    points = 1000 * np.array([vertex.co for vertex in body.data.vertices])
    long = np.linalg.norm(points[edges[:, 0]] - points[edges[:, 1]], axis=1).mean()
    values, places = shares(body), to_hem(body)
    assert set(np.unique(values[np.abs(places) > 1.1 * long])) == {0.0, 1.0}
    low, high = values[edges].T
    crossed = (low < 0.5) != (high < 0.5)
    part = (0.5 - low[crossed]) / (high[crossed] - low[crossed])
    at = places[edges[crossed, 0]] * (1 - part) + places[edges[crossed, 1]] * part
    assert np.sqrt((at**2).mean()) < 0.02 * long
    assert np.abs(at).max() < 0.1 * long


@pytest.mark.parametrize(("radius", "is_covered"), [(0.098, True), (0.092, False), (0.14, False)])
def test_cloth_that_dips_into_the_skin_or_is_far_from_it(radius, is_covered):
    """5 mm inwards and 30 mm outwards if not told otherwise."""
    body = sphere()
    select(body, band(radius))
    bpy.ops.skin_tan.mask_from_clothes()
    at_the_equator = shares(body)[np.abs(to_hem(body)) > 15]
    assert (at_the_equator.min() == 0.0) == is_covered
    bpy.ops.skin_tan.mask_from_clothes(reach=60.0, inside=12.0)
    assert shares(body).min() == 0.0


def test_pose_modifiers_and_units_count():
    """The body is twice as large, turned and moved, and shown with its covered part masked out."""
    body, garment = sphere(), band()
    select(body, garment)
    bpy.ops.skin_tan.mask_from_clothes(softness=20.0)
    expected = shares(body)
    body.vertex_groups.new(name="Hidden").add(range(100), 1.0, "REPLACE")
    hiding = body.modifiers.new("Hide", "MASK")
    hiding.vertex_group, hiding.invert_vertex_group = "Hidden", True
    body.modifiers.new("Finer", "SUBSURF")
    holder = bpy.data.objects.new("Holder", None)
    bpy.context.collection.objects.link(holder)
    holder.location, holder.rotation_euler, holder.scale = (1, 2, 3), (0.4, 1.0, 2.0), (200,) * 3
    bpy.context.scene.unit_settings.scale_length = 0.01
    for obj in (body, garment):
        obj.parent = holder
    count = len(bpy.data.objects)
    bpy.ops.skin_tan.mask_from_clothes(softness=40.0, reach=60.0)
    assert settings_of(body).mask.source == "Clothes Mask"
    assert shares(body) == pytest.approx(expected, abs=0.002)
    assert len(bpy.data.objects) == count and len(body.modifiers) == 2


def test_a_garment_with_the_body_s_own_points_has_no_holes():
    """Where rays go through its points and edges, as through garments that are fitted."""
    body, garment = sphere(), sphere()
    garment.scale = (1.05,) * 3
    select(body, garment)
    bpy.ops.skin_tan.mask_from_clothes()
    assert shares(body).max() == 0.0


def test_what_mpfb_deletes_under_a_garment_is_covered():
    body, garment = sphere(), band(0.2, "Anna.fancy shirt.001")
    body.vertex_groups.new(name="Delete.fancy_shirt").add(range(50), 1.0, "REPLACE")
    body.vertex_groups.new(name="Delete.shirt").add(range(100, 150), 1.0, "REPLACE")
    assert clothes.delete_groups(body, garment) == ["Delete.fancy_shirt"]
    select(body, garment)
    bpy.ops.skin_tan.mask_from_clothes(softness=0.0)
    assert (shares(body)[:50] < 0.5).all() and (shares(body)[50:] > 0.5).all()
    garment.name = "Coat"
    assert clothes.delete_groups(body, garment) == []
    garment["MPFB_MC_delete_group"] = "Delete.shirt"
    assert clothes.delete_groups(body, garment) == ["Delete.shirt"]


def test_what_was_painted_and_what_other_masks_read_stays():
    body, garment = sphere(3), band()
    select(body, garment)
    settings = settings_of(body)

    def make(**keywords) -> str:
        bpy.ops.skin_tan.mask_from_clothes(**keywords)
        return settings.mask.source

    first = make(softness=20.0)
    before = shares(body)
    assert make(softness=60.0) == first and (shares(body) != before).any()
    body.data.attributes[first].data[0].color = (0.25, 0.25, 0.25, 1.0)
    before = shares(body, Mask(first))
    second = make()
    assert second == "Clothes Mask.001" and (shares(body, Mask(first)) == before).all()
    exposure = settings.exposures.add()
    bpy.ops.skin_tan.mask_from_clothes(target="EXPOSURE", garments=[{"name": "Band"}])
    assert exposure.own_mask and exposure.mask.source == "Clothes Mask.002"
    assert settings.mask.source == second
    exposure.mask.source = second
    before = shares(body, Mask(second))
    bpy.ops.skin_tan.mask_from_clothes(target="OBJECT", softness=90.0)
    assert settings.mask.source == "Clothes Mask.003"
    assert (shares(body, Mask(second)) == before).all()


def test_without_clothes_and_with_hidden_ones():
    body, garment = sphere(2), band()
    select(body)
    refused("No clothes are selected; select garments, and last the body.")
    refused("There is no object 'Shirt'", garments=[{"name": "Shirt"}])
    select(body, garment)
    garment.hide_viewport = True
    refused("'Band' is hidden in this view layer", garments=[{"name": "Band"}])
    garment.hide_viewport = False
    select(body, garment)
    garment.data.clear_geometry()
    refused("'Band' has no faces, so it covers nothing.")
    body.data.clear_geometry()
    refused("'Icosphere' has no faces")
    assert not body.data.attributes.get("Clothes Mask")


def refused(sentence: str, **keywords) -> None:
    with pytest.raises(RuntimeError, match=sentence):
        bpy.ops.skin_tan.mask_from_clothes(**keywords)


def test_far_clothes_say_so(capfd):
    body = sphere(2)
    select(body, band(0.5))
    bpy.ops.skin_tan.mask_from_clothes()
    assert "No skin lies within 30 mm under 'Band'" in capfd.readouterr().out
    assert (shares(body) == 1.0).all()


def test_nothing_changes_before_the_end():
    """So that Esc has nothing to take back."""
    body, garment = sphere(), band()
    request = masking.ClothesRequest((garment,))
    settings = settings_of(body).mask
    before = set(body.data.attributes.keys())
    work = masking.from_clothes(body, settings, request, bpy.context, bpy.context.scene)
    done = [next(work) for _ in range(3)]
    assert done == sorted(done) and 0.0 <= done[0] and done[-1] <= 1.0
    work.close()
    assert set(body.data.attributes.keys()) == before and not settings.source
    assert hasattr(SKIN_TAN_OT_mask_from_clothes, "modal")


class Operator:
    """From Clothes with a window: a stand-in for what Blender makes of its class."""

    reach, inside, softness, name, target, garments = 30.0, 5.0, 20.0, "Clothes Mask", "OBJECT", ()

    def __init__(self):
        self.reports = []

    def report(self, kind, text):
        self.reports.append(text)


for name in ("invoke", "modal", "execute", "_started", "_end"):
    setattr(Operator, name, vars(SKIN_TAN_OT_mask_from_clothes)[name])


class Manager:
    """A window manager that counts timers and keeps progress."""

    def __init__(self):
        self.timers, self.progress = 0, []

    def event_timer_add(self, seconds, window):
        self.timers += 1

    def event_timer_remove(self, timer):
        self.timers -= 1

    def progress_begin(self, low, high):
        self.progress.append(low)

    def progress_update(self, value):
        self.progress.append(value)

    def progress_end(self):
        self.progress.append(None)

    def modal_handler_add(self, operator):
        pass


@pytest.mark.parametrize("is_cancelled", [False, True])
def test_with_a_window_there_is_progress_and_esc(monkeypatch, is_cancelled):
    body, garment = sphere(), band()
    select(body, garment)
    monkeypatch.setattr(ops_masks, "has_window", lambda context: True)
    monkeypatch.setattr(ops_masks, "STEP_SECONDS", 0.0001)
    manager, operator = Manager(), Operator()
    layer = bpy.context.view_layer
    context = SimpleNamespace(
        window=None,
        window_manager=manager,
        view_layer=layer,
        scene=bpy.context.scene,
        selected_objects=[body, garment],
        evaluated_depsgraph_get=bpy.context.evaluated_depsgraph_get,
    )
    assert operator.invoke(context, None) == {"RUNNING_MODAL"}
    timer, esc = SimpleNamespace(type="TIMER"), SimpleNamespace(type="ESC")
    assert operator.modal(context, timer) == {"RUNNING_MODAL"}
    assert operator.modal(context, SimpleNamespace(type="MOUSEMOVE")) == {"RUNNING_MODAL"}
    if is_cancelled:
        assert operator.modal(context, esc) == {"CANCELLED"}
        assert operator.reports == ["Cancelled; nothing has changed."]
        assert "Clothes Mask" not in body.data.attributes
    else:
        results = {"RUNNING_MODAL"}
        while results == {"RUNNING_MODAL"}:
            results = operator.modal(context, timer)
        assert results == {"FINISHED"} and shares(body).min() == 0.0
        assert sorted(manager.progress[:-1]) == manager.progress[:-1]
    assert manager.timers == 0 and manager.progress[-1] is None


@pytest.mark.parametrize("domain", ["POINT", "CORNER"])
def test_a_mask_for_the_brush_is_bare_and_set(domain):
    body = sphere(2)
    settings = settings_of(body)
    settings.mask.invert, settings.mask.strength = True, 0.5
    assert bpy.ops.skin_tan.paint_mask(domain=domain) == {"FINISHED"}
    attribute = body.data.attributes["Sun Mask"]
    assert (attribute.data_type, attribute.domain) == ("FLOAT_COLOR", domain)
    assert body.data.color_attributes.active_color.name == settings.mask.source == "Sun Mask"
    assert mask_values(body, settings.shown_mask()).shares.min() == 1.0
    assert body.mode == "OBJECT"
    body.data.color_attributes.new("Other", "BYTE_COLOR", "POINT")
    body.data.attributes["Sun Mask"].data[0].color = (0.0, 0.0, 0.0, 1.0)
    body.data.color_attributes.active_color_name = "Other"
    bpy.ops.skin_tan.paint_mask()
    assert body.data.color_attributes.active_color.name == "Sun Mask"
    assert body.data.attributes["Sun Mask"].data[0].color[0] == 0.0
    assert len(body.data.color_attributes) == 2


def test_numbers_without_a_brush_are_copied(capfd):
    body = sphere(1)
    body.data.attributes.new("shade", "FLOAT", "POINT")
    values = np.linspace(0.0, 1.0, len(body.data.vertices), dtype=np.float32)
    body.data.attributes["shade"].data.foreach_set("value", values)
    mask = settings_of(body).mask
    mask.source, mask.strength, mask.invert = "shade", 0.5, True
    before = shares(body)
    bpy.ops.skin_tan.paint_mask(name="Mine")
    said = "'shade' was copied, for Blender has no brush for it. Black is bare, white is covered"
    assert said in capfd.readouterr().out
    assert mask.source == "Mine" and mask.strength == 0.5
    assert shares(body) == pytest.approx(before)
    assert "shade" in body.data.attributes


def test_weights_and_images_are_painted_as_such():
    body = sphere(1)
    group = body.vertex_groups.new(name="Skirt")
    body.vertex_groups.new(name="Other")
    mask = settings_of(body).mask
    mask.source = "Skirt"
    bpy.ops.skin_tan.paint_mask()
    assert mask.source == "Skirt" and body.vertex_groups.active == group
    mask.image = bpy.data.images.new("Photo", 4, 4)
    bpy.ops.skin_tan.paint_mask()
    assert bpy.context.scene.tool_settings.image_paint.canvas.name == "Photo"
    assert "Sun Mask" not in body.data.attributes


def test_painting_has_something_to_paint_on():
    body = sphere(1)
    bpy.ops.object.mode_set(mode="EDIT")
    with pytest.raises(RuntimeError, match="'Icosphere' is in Edit Mode; leave Edit Mode"):
        bpy.ops.skin_tan.paint_mask()
    bpy.ops.object.mode_set(mode="OBJECT")
    body.data.clear_geometry()
    with pytest.raises(RuntimeError, match="'Icosphere' has no faces, so there is nothing to"):
        bpy.ops.skin_tan.paint_mask()
    with pytest.raises(RuntimeError, match="has no time in the sun that could have a mask"):
        bpy.ops.skin_tan.paint_mask(target="EXPOSURE")


def test_a_new_mask_shows_on_a_tan_that_is_there(table_path):
    body = sphere(2)
    settings = settings_of(body)
    settings.skin, settings.table_path = "FILE", str(table_path)
    settings.exposures.add()
    apply(body)
    bpy.ops.skin_tan.paint_mask()
    (node,) = (node for node in settings.group.nodes if role_of(node) == "mask")
    assert node.attribute_name == "Sun Mask"
