"""Several masks, which the shader reads: every place is as simulating its shares gives."""

import bpy
import numpy as np
import pytest
from masked_body import NAMES, body_of_masks, expected, few_points, rendered
from scenes import apply, tan_group

from blender_addon.scene import exr
from hylios.colour_difference import ciede2000, lab

SHARES = np.array([[0, 0], [1, 0], [0, 1], [1, 1], [0.35, 1], [1, 0.8]])
"""Of two masks, by square."""

FOUR = np.array([[0, 0, 0.3, 1], [1, 0, 1, 0.6], [0, 1, 0, 1]])
"""Of four masks."""

FRAME = 120


@pytest.fixture(autouse=True, scope="module")
def coarse():
    with few_points():
        yield


@pytest.fixture
def body(table_path):
    return body_of_masks(table_path, SHARES)


def errors(obj, pixels: np.ndarray, shares: np.ndarray) -> np.ndarray:
    """CIEDE2000 of pixels (..., 3) from what simulating shares (..., masks) gives."""
    exact = expected(obj, shares.reshape(-1, shares.shape[-1]))
    return ciede2000(lab(pixels.reshape(-1, 3)), lab(exact))


def across_a_square(columns: int) -> np.ndarray:
    """Where pixels of a square lie along x, from 0 to 1."""
    return (np.arange(columns) + 0.5) / columns


def test_every_square_is_as_simulated(body, tmp_path):
    """Between two frames too, and the share is that of all doses."""
    apply(body)
    for frame, subframe in ((20, 0.0), (77, 0.5)):
        bpy.context.scene.frame_set(frame, subframe=subframe)
        seen = rendered(body, tmp_path)[1, 1::3]
        assert errors(body, seen, SHARES).max() < 0.15
    assert np.ptp(seen[:, 0]) > 0.03
    share = rendered(body, tmp_path, "Share")[1, 1::3, 0]
    assert share == pytest.approx(SHARES @ exr.rounded(np.array([0.4, 0.6])), abs=1e-6)
    assert not [item for item in body.data.attributes if "skin_tan" in item.name]


def test_a_jump_within_a_face(body, tmp_path):
    """Shares are interpolated across it; a tan is no straight line between its ends."""
    for name, corners in zip(NAMES, ([0, 1, 1, 0], [0, 0.2, 1, 0.8]), strict=False):
        values = np.tile(np.array(corners, np.float32), len(SHARES))
        body.data.attributes[name].data.foreach_set("value", values)
    apply(body)
    bpy.context.scene.frame_set(FRAME)
    seen = rendered(body, tmp_path, columns=24, rows=24)[:, :24]
    x, y = np.meshgrid(across_a_square(24), 1.0 - across_a_square(24))
    error = errors(body, seen, np.stack([x, 0.2 * x + 0.8 * y], axis=-1))
    assert error.mean() < 0.05 and np.quantile(error, 0.99) < 0.3 and error.max() < 0.7


def add_uv(obj, *, tiles: bool = False) -> None:
    """A UV map in which every square is the whole image, or the first two are tiles."""
    corners = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], np.float32)
    places = np.tile(corners, (len(obj.data.polygons), 1, 1))
    if tiles:
        places[1, :, 0] += 1.0
    obj.data.uv_layers.new().uv.foreach_set("vector", places.ravel())


def hard_image(name: str, texels: np.ndarray) -> bpy.types.Image:
    rows, columns = texels.shape
    made = bpy.data.images.new(name, columns, rows, float_buffer=True)
    made.colorspace_settings.name = "Non-Color"
    made.pixels.foreach_set(np.repeat(texels, 4).astype(np.float32))
    made.pack()
    return made


@pytest.mark.parametrize("shares", [SHARES, FOUR], ids=["two", "four"])
def test_an_image_is_right_at_every_texel(table_path, shares, tmp_path):
    """One mask a hard-edged image, the others attributes."""
    body = body_of_masks(table_path, shares)
    texels = np.random.default_rng(2).random((12, 12)).round()
    add_uv(body)
    body.skin_tan.exposures[0].mask.image = hard_image("Straps", texels)
    apply(body)
    bpy.context.scene.frame_set(FRAME)
    seen = rendered(body, tmp_path, columns=12, rows=12)
    own = np.tile(np.repeat(shares, 12, axis=0), (12, 1, 1))
    own[..., 0] = np.tile(texels[::-1], (1, len(shares)))
    error = errors(body, seen, own)
    assert error.mean() < 0.05 and error.max() < 0.3
    assert np.ptp(seen[..., 0]) > 0.02


def test_tiles(table_path, tmp_path):
    """With four masks."""
    body = body_of_masks(table_path, FOUR)
    folder = tmp_path / "tiles"
    for tile, value in ((1001, 1.0), (1002, 0.0)):
        image = hard_image("tile", np.full((4, 4), value))
        image.filepath_raw, image.file_format = f"{folder}/sun.{tile}.exr", "OPEN_EXR"
        image.save()
    tiled = bpy.data.images.load(f"{folder}/sun.1001.exr")
    tiled.source, tiled.filepath = "TILED", f"{folder}/sun.<UDIM>.exr"
    tiled.colorspace_settings.name = "Non-Color"
    if len(tiled.tiles) < 2:
        tiled.tiles.new(1002)
    add_uv(body, tiles=True)
    body.skin_tan.exposures[0].mask.image = tiled
    apply(body)
    bpy.context.scene.frame_set(FRAME)
    seen = rendered(body, tmp_path)[1, 1:6:3]
    shares = np.concatenate([[[1.0], [0.0]], FOUR[:2, 1:]], axis=1)
    assert errors(body, seen, shares).max() < 0.3


def test_painting_shows_without_apply(body, tmp_path):
    apply(body)
    bpy.context.scene.frame_set(FRAME)
    body.data.attributes["shirt"].data.foreach_set("value", np.full(4 * len(SHARES), 0.5))
    body.data.update_tag()
    seen = rendered(body, tmp_path)[1, 1::3]
    painted = np.stack([SHARES[:, 0], np.full(len(SHARES), 0.5)], axis=1)
    assert errors(body, seen, painted).max() < 0.15


@pytest.mark.parametrize("masks", [3, 4])
def test_more_masks(table_path, masks, tmp_path):
    """Bare or covered by any mask, and in the soft edge of one."""
    random = np.random.default_rng(3)
    shares = random.integers(0, 2, (6, masks)).astype(float)
    shares[np.arange(6), random.integers(0, masks, 6)] = random.random(6)
    body = body_of_masks(table_path, shares)
    apply(body)
    bpy.context.scene.frame_set(FRAME)
    assert errors(body, rendered(body, tmp_path)[1, 1::3], shares).max() < 0.3


def test_it_renders_the_same_after_saving_without_the_add_on(body, tmp_path):
    apply(body)
    bpy.context.scene.frame_set(FRAME)
    before = rendered(body, tmp_path)
    path = str(tmp_path / "read.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path, use_scripts=False)
    assert np.array_equal(rendered(bpy.data.objects["Body"], tmp_path), before)


def counts() -> tuple[int, ...]:
    made = [image for image in bpy.data.images if image.packed_file]
    return len(made), len(bpy.data.node_groups)


def test_masks_come_and_go(table_path, tmp_path):
    """From two to four, and back, and to one: nothing is left over."""
    shares = np.random.default_rng(4).random((3, 4)).round(1)
    body = body_of_masks(table_path, shares)
    own = body.skin_tan.exposures
    for exposure in own:
        exposure.own_mask = False
    apply(body)
    none = counts(), len(tan_group(body).links)
    for exposure in own[:2]:
        exposure.own_mask = True
    own[2].enabled = own[3].enabled = False
    apply(body)
    few = counts(), [len(tan_group(body).links)]
    bpy.context.scene.frame_set(FRAME)
    before = rendered(body, tmp_path)
    for exposure in own:
        exposure.enabled = exposure.own_mask = True
    apply(body)
    bpy.context.scene.frame_set(FRAME)
    assert errors(body, rendered(body, tmp_path)[1, 1::3], shares).max() < 0.3
    own[2].enabled = own[3].enabled = False
    apply(body)
    bpy.context.scene.frame_set(FRAME)
    assert (counts(), [len(tan_group(body).links)]) == few
    assert np.array_equal(rendered(body, tmp_path), before)
    for exposure in own:
        exposure.own_mask = False
    apply(body)
    assert (counts(), len(tan_group(body).links)) == none
    assert not [key for key in (*tan_group(body).keys(), *body.data.keys()) if "basis" in key]
