"""The reader of tables, and the writer of images, against Blender's own image loader."""

import bpy
import numpy as np
import OpenImageIO as oiio  # noqa: N813
import pytest

from blender_addon.scene import exr, images
from hylios.table import exr_reader


@pytest.mark.parametrize("compression", ["zip", "zips", "none"])
@pytest.mark.parametrize("pixel_type", [oiio.HALF, oiio.FLOAT])
def test_pixels_are_those_that_blender_loads(tmp_path, compression, pixel_type):
    """Bit for bit. Blender shows the layers of a table but gives no script their pixels, so the
    picture here has R, G and B."""
    path = tmp_path / "picture.exr"
    values = np.random.default_rng(3).normal(size=(37, 11, 3)).astype(np.float32)
    specification = oiio.ImageSpec(11, 37, 3, pixel_type)
    specification.attribute("compression", compression)
    output = oiio.ImageOutput.create(str(path))
    assert output.open(str(path), specification) and output.write_image(values) and output.close()
    image = bpy.data.images.load(str(path))
    image.colorspace_settings.name = "Non-Color"
    loaded = np.empty(37 * 11 * image.channels, dtype=np.float32)
    image.pixels.foreach_get(loaded)
    # Blender's first row is the bottom one.
    loaded = loaded.reshape(37, 11, -1)[::-1]
    read = exr_reader.parse(path.read_bytes()).channels
    assert list(read) == ["B", "G", "R"]
    for number, name in enumerate("RGB"):
        assert read[name].dtype == (np.float16 if pixel_type == oiio.HALF else np.float32)
        assert np.array_equal(read[name], loaded[..., number])


def test_blender_shows_a_table_s_planes_as_layers(table_path, table):
    image = bpy.data.images.load(str(table_path))
    group = bpy.data.node_groups.new("Layers", "CompositorNodeTree")
    node = group.nodes.new("CompositorNodeImage")
    node.image = image
    assert {output.name for output in node.outputs} >= set(table.planes)


@pytest.mark.parametrize("shape", [(1, 1), (1, 1025), (17, 2), (33, 20)])
@pytest.mark.parametrize("noise", [0.0, 1.0])
def test_blender_loads_what_is_packed(shape, noise):
    """Blocks that deflate makes smaller, and others; 24 bits of a float are kept."""
    random = np.random.default_rng(3)
    smooth = np.linspace(-1.0, 2.0, 3 * np.prod(shape)).reshape(*shape, 3)
    values = (smooth + noise * random.normal(size=smooth.shape)).astype(np.float32)
    image = images.packed_image("Table", values, is_colour=False)
    loaded = np.empty((*shape, 4), dtype=np.float32)
    image.pixels.foreach_get(loaded.ravel())
    assert image.source == "FILE" and image.is_float and not image.is_dirty
    assert np.array_equal(loaded[..., :3], exr.rounded(values))
    assert loaded[..., :3] == pytest.approx(values, rel=2.0**-16, abs=0.0)
