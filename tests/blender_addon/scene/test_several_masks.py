"""A mask for every exposure: what Apply makes of four, and takes away again."""

import json
import time

import bpy
import numpy as np
import pytest
from masked_body import DOSES, NAMES, body_of_masks, few_points
from masked_body import expected as simulated
from masked_body import rendered as pixels_of
from scenes import add_mask, apply, of_role, tan_group, tan_object

from blender_addon import applied, live, several, timers
from blender_addon.model.ahead import Ahead
from blender_addon.scene import exr, masks
from blender_addon.scene import several as scene_several
from blender_addon.scene.nodes import role_of

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


@pytest.fixture(autouse=True, scope="module")
def coarse():
    with few_points():
        yield


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
    """To the 16 binary digits of an image."""
    apply(body)
    whole = SHARES @ exr.rounded(np.array(DOSES) / np.sum(DOSES))
    assert rendered(body, tmp_path, "Share")[:, 0] == pytest.approx(whole, abs=1e-6)


def counts() -> tuple[int, ...]:
    return tuple(len(items) for items in (bpy.data.images, bpy.data.node_groups))


def own_attributes(obj) -> list[str]:
    return [item.name for item in obj.data.attributes if "skin_tan" in item.name]


def test_applied_again_nothing_is_left_over(body):
    apply(body)
    before = counts()
    for dose in (60.0, DOSES[0]):
        body.skin_tan.exposures[0].dose = dose
        apply(body)
    assert counts() == before and not own_attributes(body)
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
    assert len(group.nodes) == node_count
    link = of_role(body, "state").inputs[0].links[0]
    assert role_of(link.from_node) == role_of(states)
    assert not [key for key in (*group.keys(), *body.data.keys()) if "basis" in key]


def test_remove_tan_takes_all_away(body):
    before = {*body.data.attributes.keys()}, counts()
    apply(body)
    bpy.ops.skin_tan.remove()
    assert ({*body.data.attributes.keys()}, counts()) == before
    assert "skin_tan_basis" not in body.data


@pytest.mark.provokes
def test_an_error_leaves_all_as_it_was(body, monkeypatch):
    apply(body)
    before = counts(), len(tan_group(body).links)
    body.skin_tan.exposures[0].dose = 55.0
    monkeypatch.setattr(scene_several, "_replaced", lambda *_: 1 / 0)
    with pytest.raises((RuntimeError, ZeroDivisionError)):
        apply(body)
    assert (counts(), len(tan_group(body).links)) == before


def test_more_than_eight_masks_are_refused(body):
    settings = body.skin_tan
    for number in range(9):
        name = f"mask {number}"
        add_mask(body, np.full(4 * len(SHARES), number / 9.0), name)
        exposure = settings.exposures.add()
        exposure.own_mask, exposure.mask.source = True, name
    with pytest.raises(RuntimeError, match="times in the sun have 13 masks; allowed are 1 to 8"):
        apply(body)


def test_what_an_earlier_version_wrote_onto_the_mesh_goes(body):
    """Once no object shows it any more."""
    name = "skin_tan_basis_0"
    apply(body)
    body.data.attributes.new(name, "FLOAT_COLOR", "POINT")
    node = next(node for node in tan_group(body).nodes if role_of(node) == "basis")
    node.node_tree["skin_tan_basis"] = body.data["skin_tan_basis"] = json.dumps([name])
    twin = body.copy()
    bpy.context.collection.objects.link(twin)
    twin.skin_tan.exposures[0].dose = 0.0
    apply(twin)
    assert own_attributes(body) == [name]
    apply(body)
    assert not own_attributes(body) and "skin_tan_basis" not in body.data


def test_another_dose_is_other_pixels(body, tmp_path, monkeypatch):
    """No node or image is made: the day of this frame shows rightly at once, then all do."""
    for name in ("AHEAD", "DAYS"):  # no other test was here
        monkeypatch.setattr(several, name, Ahead(getattr(several, name).function))
    monkeypatch.setattr(timers, "are_called", lambda: True)
    monkeypatch.setattr(timers, "wait", lambda *_: None)
    apply(body)
    bpy.context.scene.frame_set(77)
    before = {*bpy.data.node_groups}, several.shown_images(body)
    monkeypatch.setattr("masked_body.DOSES", (45.0, *DOSES[1:]))
    body.skin_tan.exposures[0].dose = 45.0
    for timer, frame in ((live.show_changes, 77), (live.make_exact, 180)):
        end = time.monotonic() + 120.0
        while timer() is not None:
            assert time.monotonic() < end
            time.sleep(0.001)
        bpy.context.scene.frame_set(frame)
        assert rendered(body, tmp_path) == pytest.approx(expected(body), abs=0.002)
    assert ({*bpy.data.node_groups}, several.shown_images(body)) == before and before[1]
    assert not applied.is_changed(body, bpy.context.scene)
