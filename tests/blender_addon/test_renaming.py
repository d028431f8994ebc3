"""A mask that is an image follows the image's name."""

import bpy
import pytest
from scenes import apply, tan_object

from blender_addon import renaming


@pytest.fixture
def body(table_path):
    obj = tan_object(table_path)
    obj.data.uv_layers.new(name="UVMap")
    return obj


def masks(obj) -> list:
    settings = obj.skin_tan
    exposure = settings.exposures[0]
    exposure.own_mask = True
    region = settings.regions[0] if settings.regions else settings.regions.add()
    settings.film = "WATER"
    return [settings.mask, exposure.mask, region.mask, settings.film_mask]


def by_apply(obj) -> None:
    apply(obj)


def by_message(obj) -> None:
    """What Blender calls when a name has changed; without a window it sends no messages."""
    del obj
    renaming.name_masks()


@pytest.mark.parametrize("follow", [by_apply, by_message])
def test_masks_are_called_after_their_images(body, follow):
    image = bpy.data.images.new("Photo", 4, 4)
    for mask in masks(body):
        mask.source = "Photo"
    image.name = "Cloth"
    bpy.data.images.new("Photo", 4, 4)
    follow(body)
    assert [(mask.source, mask.image) for mask in masks(body)] == [("Cloth", image)] * 4
    assert body.skin_tan.mask_attribute == "Cloth"


def test_an_attribute_with_the_new_name_is_not_taken(body):
    image = bpy.data.images.new("Photo", 4, 4)
    body.data.attributes.new("Cloth", "FLOAT", "POINT")
    body.skin_tan.mask.source = "Photo"
    image.name = "Cloth"
    apply(body)
    assert body.skin_tan.mask.image == image


def test_other_masks_and_linked_objects_stay(body, tmp_path):
    image = bpy.data.images.new("Photo", 4, 4)
    body.skin_tan.mask.source = "Photo"
    path = str(tmp_path / "body.blend")
    image.name = "Cloth"
    bpy.ops.wm.save_as_mainfile(filepath=path)
    bpy.ops.wm.read_homefile(use_factory_startup=True, use_empty=True)
    with bpy.data.libraries.load(path, link=True) as (_, linked):
        linked.objects = ["Body"]
    renaming.name_masks()
    assert bpy.data.objects["Body"].skin_tan.mask.source == "Photo"
