"""Four masks and more, images among them: every texel is as simulating its shares gives."""

import bpy
import numpy as np
import pytest
from masked_body import body_of_masks, expected, rendered
from scenes import apply, tan_group

from blender_addon.scene.unwrapped import covered
from hylios.colour_difference import ciede2000, lab

SHARES = np.array([[0, 0, 0.3, 1], [0, 0, 1, 0.6], [0, 0, 0, 1]])
"""Of four masks, by square; the first two are images."""

SIDE, FRAME = 12, 150
"""Texels and pixels of a square."""


def squares_apart(count: int) -> np.ndarray:
    """UV coordinates (corners, 2) that put squares side by side."""
    corners = np.array([(0, 0), (1, 0), (1, 1), (0, 1)], float)
    places = corners + np.arange(count)[:, None, None] * [1, 0]
    return (places / [count, 1]).reshape(-1, 2).astype(np.float32)


def add_uv(obj, places: np.ndarray, name: str) -> None:
    obj.data.uv_layers.new(name=name).uv.foreach_set("vector", places.ravel())


def add_image(name: str, texels: np.ndarray, *, is_float: bool = False) -> bpy.types.Image:
    rows, columns = texels.shape
    made = bpy.data.images.new(name, columns, rows, float_buffer=is_float)
    made.colorspace_settings.name = "Non-Color"
    made.pixels.foreach_set(np.repeat(texels, 4).astype(np.float32))
    made.pack()
    return made


@pytest.fixture
def texels() -> np.ndarray:
    """Two hard-edged masks (2, rows, columns)."""
    return np.random.default_rng(6).random((2, SIDE, SIDE * len(SHARES))).round()


@pytest.fixture
def body(table_path, texels):
    obj = body_of_masks(table_path, SHARES)
    add_uv(obj, squares_apart(len(SHARES)), "Skin")
    for exposure, own, name in zip(obj.skin_tan.exposures, texels, "ab", strict=False):
        exposure.mask.image = add_image(name, own)
    return obj


def errors(obj, pixels: np.ndarray, shares: np.ndarray) -> np.ndarray:
    """CIEDE2000 of pixels (..., 3) from what simulating shares (..., masks) gives."""
    exact = expected(obj, shares.reshape(-1, shares.shape[-1]))
    return ciede2000(lab(pixels.reshape(-1, 3)), lab(exact))


def shares_at(texels: np.ndarray) -> np.ndarray:
    """Shares (rows, columns, 4) of images and attributes, the top row first."""
    of_squares = np.repeat(SHARES[:, 2:], SIDE, axis=0)
    flat = np.broadcast_to(of_squares, (SIDE, *of_squares.shape))
    return np.concatenate([np.moveaxis(texels, 0, -1)[::-1], flat], axis=-1)


def seen(obj, path, output: str = "Colour") -> np.ndarray:
    bpy.context.scene.frame_set(FRAME)
    return rendered(obj, path, output, columns=SIDE, rows=SIDE)


def require_right(obj, path, shares: np.ndarray) -> None:
    error = errors(obj, seen(obj, path), shares)
    assert error.mean() < 0.05 and np.quantile(error, 0.99) < 0.3


def test_every_texel_is_as_simulated(body, texels, tmp_path):
    apply(body)
    shares = shares_at(texels)
    require_right(body, tmp_path, shares)
    whole = shares @ np.array([20.0, 30.0, 15.0, 12.0]) / 77.0
    assert seen(body, tmp_path, "Share")[..., 0] == pytest.approx(whole, abs=0.003)
    assert not [item for item in body.data.attributes if "skin_tan" in item.name]


def test_between_texels_tans_are_mixed(body, tmp_path):
    """Three pixels to a texel: those beside the middle lie between it and the next one."""
    apply(body)
    bpy.context.scene.frame_set(FRAME)
    points = rendered(body, tmp_path, "Share", columns=3 * SIDE, rows=3 * SIDE)[..., 0]
    middle = points[1::3, 1::3]
    third = middle[:, :-1] * (2.0 / 3.0) + middle[:, 1:] / 3.0
    assert points[1::3, 2:-1:3] == pytest.approx(third, abs=0.002)


def test_a_soft_attribute_and_an_image_on_another_map(body, texels, tmp_path):
    """Another map turns the second image over; an attribute runs across every face."""
    turned = squares_apart(len(SHARES)) * [1.0, -1.0] + [0.0, 1.0]
    add_uv(body, turned.astype(np.float32), "Other")
    body.skin_tan.exposures[1].mask.uv_map = "Other"
    ramp = np.tile(np.array([0.0, 1.0, 1.0, 0.0], np.float32), len(SHARES))
    body.data.attributes["shorts"].data.foreach_set("value", ramp)
    apply(body)
    shares = shares_at(np.stack([texels[0], texels[1, ::-1]]))
    shares[..., 2] = np.tile((np.arange(SIDE) + 0.5) / SIDE, len(SHARES))
    require_right(body, tmp_path, shares)


def test_a_coarser_image_is_interpolated(body, texels, tmp_path):
    coarse = np.array([[0.0, 1.0]])
    body.skin_tan.exposures[1].mask.image = add_image("coarse", coarse, is_float=True)
    apply(body)
    places = (np.arange(SIDE * len(SHARES)) + 0.5) / (SIDE * len(SHARES))
    shares = shares_at(np.stack([texels[0], texels[1]]))
    shares[..., 1] = np.clip(2.0 * places - 0.5, 0.0, 1.0)
    require_right(body, tmp_path, shares)


def test_it_renders_the_same_after_saving_without_the_add_on(body, tmp_path):
    apply(body)
    before = seen(body, tmp_path)
    path = str(tmp_path / "texels.blend")
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.open_mainfile(filepath=path, use_scripts=False)
    assert np.array_equal(seen(bpy.data.objects["Body"], tmp_path), before)


def counts() -> tuple[int, ...]:
    return len(bpy.data.images), len(bpy.data.node_groups)


def test_nothing_is_left_over(body):
    apply(body)
    made = counts()
    body.skin_tan.exposures[0].dose = 40.0
    apply(body)
    assert counts() == made
    own = body.skin_tan.exposures[1].mask
    own.source = "shirt"
    body.skin_tan.exposures[0].mask.source = "bikini"
    apply(body)
    assert not [key for key in tan_group(body).keys() if "index" in key]
    bpy.ops.skin_tan.remove()
    assert {image.name for image in bpy.data.images} == {"a", "b"}


@pytest.mark.parametrize("moved", [(0.0, 0.0), (0.0, 1.2)])
def test_faces_over_each_other_are_told(body, capfd, moved):
    """Or outside the image."""
    apply(body)
    assert "lie over each other" not in capfd.readouterr().out
    corners = squares_apart(1)
    body.data.uv_layers["Skin"].uv.foreach_set("vector", np.tile(corners + moved, (3, 1)).ravel())
    apply(body)
    assert (
        "Faces of 'Body' lie over each other or outside the image in the UV map; with more than "
        "three masks those that are no images are wrong there."
    ) in capfd.readouterr().out


def test_tiles_are_refused_with_four_masks(body):
    body.skin_tan.exposures[0].mask.image.source = "TILED"
    with pytest.raises(RuntimeError, match="has tiles .UDIM., which cannot be read for more than"):
        apply(body)


def test_points_at_texels():
    """A function that is linear over the UV map; a face without area covers nothing."""
    places = np.array([(0.1, 0.2), (0.9, 0.1), (0.7, 0.8), (0.5, 0.5), (0.5, 0.5), (0.5, 0.5)])
    mesh = bpy.data.meshes.new("Triangles")
    mesh.from_pydata([(*place, 0.0) for place in places], [], [(0, 1, 2), (3, 4, 5)])
    points = covered(mesh, places.astype(np.float32), 40, 30)
    x, y = (points.texels % 30 + 0.5) / 30, (points.texels // 30 + 0.5) / 40
    values = points.values((places @ [2.0, 3.0]).astype(np.float32))
    inside = points.weights.min(axis=1) >= 0.0
    exact = 2.0 * x + 3.0 * y
    beside = np.abs(values - exact) > 1e-5
    assert beside.any() and np.abs(values - exact).max() < 2 * (2.0 / 30 + 3.0 / 40) + 1e-5
    area = 0.5 * abs(np.linalg.det(places[1:3] - places[0]))
    assert np.count_nonzero(~beside) == pytest.approx(area * 1200, rel=0.06)
    assert inside.all()
