"""A mask for every exposure, more than a shader reads: points are as simulating them gives."""

import bpy
import numpy as np
import pytest
from masked_body import DAYS, DOSES, NAMES, body_of_masks
from masked_body import expected as simulated
from masked_body import rendered as pixels_of
from scenes import add_mask, apply, of_role, tan_group, tan_object

from blender_addon.scene import masks

SHARES = np.array(
    [
        [0, 0, 0, 0],
        [1, 0, 0, 1],
        [0, 1, 0, 0],
        [0, 0, 1, 0.6],
        [1, 1, 0, 1],
        [1, 1, 1, 1],
        [0.35, 1, 0, 0],
        [1, 0.8, 0.5, 0.2],
    ]
)
"""Of four masks, by square."""


@pytest.fixture
def body(table_path):
    return body_of_masks(table_path, SHARES)


def rendered(obj, path, output: str = "Colour") -> np.ndarray:
    """An output of the tan (squares, 3) in the middle of each square."""
    return pixels_of(obj, path, output)[1, 1::3]


def expected(obj) -> np.ndarray:
    return simulated(obj, SHARES)


def test_every_point_is_as_simulated(body, tmp_path):
    """Between two frames too."""
    apply(body)
    for frame, subframe in ((20, 0.0), (77, 0.5), (180, 0.0)):
        bpy.context.scene.frame_set(frame, subframe=subframe)
        assert rendered(body, tmp_path) == pytest.approx(expected(body), abs=0.002)
    assert np.ptp(expected(body)[:, 0]) > 0.03


def test_the_share_is_that_of_all_doses(body, tmp_path):
    apply(body)
    whole = SHARES @ DOSES / np.sum(DOSES)
    assert rendered(body, tmp_path, "Share")[:, 0] == pytest.approx(whole, abs=1e-6)


def test_a_mask_of_corners_makes_all_be_of_corners(body, tmp_path):
    shirt = body.data.attributes.new("collar", "FLOAT", "CORNER")
    shirt.data.foreach_set("value", np.repeat(SHARES[:, 1], 4))
    body.skin_tan.exposures[1].mask.source = "collar"
    apply(body)
    made = [item for item in body.data.attributes if item.name.startswith("skin_tan_basis_")]
    assert {item.domain for item in made} == {"CORNER"}
    bpy.context.scene.frame_set(90)
    assert rendered(body, tmp_path) == pytest.approx(expected(body), abs=0.002)


def test_it_renders_the_same_after_saving_without_the_add_on(body, tmp_path):
    apply(body)
    bpy.context.scene.frame_set(77)
    before = rendered(body, tmp_path)
    path = str(tmp_path / "several.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path, use_scripts=False)
    assert np.array_equal(rendered(bpy.data.objects["Body"], tmp_path), before)


def counts() -> tuple[int, ...]:
    return tuple(len(items) for items in (bpy.data.images, bpy.data.node_groups))


def own_attributes(obj) -> list[str]:
    return [item.name for item in obj.data.attributes if "skin_tan" in item.name]


def test_applied_again_nothing_is_left_over(body):
    active = body.data.attributes.active_color_name
    apply(body)
    made, before = own_attributes(body), counts()
    assert made and body.data.attributes.active_color_name == active
    for dose in (60.0, DOSES[0]):
        body.skin_tan.exposures[0].dose = dose
        apply(body)
    assert counts() == before and sorted(own_attributes(body)) == sorted(made)
    offered = masks.usable_sources(body, None)
    assert {source.name for source in offered} == {"sun", *NAMES}


def test_one_mask_again_takes_the_nodes_out(body, tmp_path):
    single = tan_object(body.skin_tan.table_file(), SHARES[:, 0])
    single.location.z = -9.0
    apply(single)
    node_count, states = len(tan_group(single).nodes), of_role(single, "states")
    apply(body)
    for exposure in body.skin_tan.exposures:
        exposure.own_mask = False
    apply(body)
    group = tan_group(body)
    assert len(group.nodes) == node_count and not own_attributes(body)
    link = of_role(body, "state").inputs[0].links[0]
    assert link.from_node["skin_tan_role"] == states["skin_tan_role"]
    assert not [key for key in (*group.keys(), *body.data.keys()) if "basis" in key]


def test_remove_tan_takes_all_away(body):
    before = {*body.data.attributes.keys()}, counts()
    apply(body)
    bpy.ops.skin_tan.remove()
    assert ({*body.data.attributes.keys()}, counts()) == before
    assert "skin_tan_basis" not in body.data


def test_objects_of_one_mesh_have_attributes_of_their_own(body, tmp_path):
    other = bpy.data.objects.new("Other", body.data)
    bpy.context.collection.objects.link(other)
    other.location.z = -9.0
    apply(body)
    bpy.context.scene.frame_set(77)
    before = rendered(body, tmp_path)
    source, settings = body.skin_tan, other.skin_tan
    settings.skin, settings.table_path = source.skin, source.table_path
    for name, day in zip(NAMES, DAYS, strict=True):
        exposure = settings.exposures.add()
        exposure.dose, exposure.day, exposure.own_mask = 50.0, day, True
        exposure.mask.source = name
    apply(other)
    assert np.array_equal(rendered(body, tmp_path), before)
    bpy.context.view_layer.objects.active = other
    bpy.ops.skin_tan.remove()
    assert np.array_equal(rendered(body, tmp_path), before)


def test_an_error_leaves_all_as_it_was(body, monkeypatch):
    from blender_addon.scene import several

    apply(body)
    before = counts(), sorted(own_attributes(body)), [len(tan_group(body).links)]
    body.skin_tan.exposures[0].dose = 55.0
    monkeypatch.setattr(several, "_replaced", lambda *_: 1 / 0)
    with pytest.raises((RuntimeError, ZeroDivisionError)):
        apply(body)
    assert (counts(), sorted(own_attributes(body)), [len(tan_group(body).links)]) == before


def test_more_than_eight_masks_are_refused(body):
    settings = body.skin_tan
    for number in range(9):
        name = f"mask {number}"
        add_mask(body, np.full(4 * len(SHARES), number / 9.0), name)
        exposure = settings.exposures.add()
        exposure.own_mask, exposure.mask.source = True, name
    with pytest.raises(RuntimeError, match="times in the sun have 13 masks; allowed are 1 to 8"):
        apply(body)


@pytest.mark.parametrize("edit", ["dose", "one mask"])
def test_a_linked_duplicate_s_apply_leaves_what_the_first_reads(body, edit):
    apply(body)
    read = {name: values_of(body, name) for name in own_attributes(body)}
    twin = body.copy()
    bpy.context.collection.objects.link(twin)
    if edit == "dose":
        twin.skin_tan.exposures[0].dose = 0.0
    else:
        for exposure in twin.skin_tan.exposures:
            exposure.own_mask = False
    apply(twin)
    assert {name: values_of(body, name) for name in read} == read
    for obj in (twin, body):
        bpy.context.view_layer.objects.active = obj
        bpy.ops.skin_tan.remove()
    assert not own_attributes(body)


def values_of(obj, name: str) -> list:
    attribute = obj.data.attributes[name]
    end = "value" if attribute.data_type == "FLOAT" else "color"
    return [tuple(np.ravel(getattr(item, end))) for item in attribute.data]
