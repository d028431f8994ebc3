"""Images of a look belong to a skin: objects share them as long as nobody has changed them."""

import bpy
import numpy as np
import pytest
from scenes import LOOK_IMAGES, OWN_IMAGES, apply, look, of_role, pixels, tan_object

from blender_addon.scene.plan import LOOK


@pytest.fixture
def body(table_path):
    obj = tan_object(table_path)
    apply(obj)
    return obj


def look_images(obj) -> list:
    return [of_role(obj, role).image for role in ("colour", "bend")]


@pytest.fixture
def neighbour(body, table_path):
    """Of the same skin, with another sun."""
    obj = tan_object(table_path, dose=9.0)
    obj.name = "Neighbour"
    apply(obj)
    return obj


def test_objects_of_a_skin_share_its_look(body, neighbour):
    assert look_images(body) == look_images(neighbour)
    assert of_role(body, "states").image != of_role(neighbour, "states").image
    assert len(bpy.data.images) == 2 * OWN_IMAGES + LOOK_IMAGES


def test_another_skin_has_another_look_and_the_last_one_removes_it(body, neighbour, former_path):
    former, before = look_images(body), look(neighbour)
    body.skin_tan.table_path = str(former_path)
    apply(body)
    assert not set(former) & set(look_images(body))
    assert look_images(neighbour) == former and look(neighbour) == before
    neighbour.skin_tan.table_path = str(former_path)
    apply(neighbour)
    assert look_images(body) == look_images(neighbour)
    assert len(bpy.data.images) == 2 * OWN_IMAGES + LOOK_IMAGES


def test_a_look_is_shared_after_saving(body, table_path, tmp_path):
    bpy.ops.wm.save_as_mainfile(filepath=str(tmp_path / "saved.blend"))
    bpy.ops.wm.open_mainfile(filepath=str(tmp_path / "saved.blend"))
    obj = tan_object(table_path)
    apply(obj)
    assert look_images(obj) == look_images(bpy.data.objects["Body"])


def painted(image) -> None:
    image.pixels[0] = 0.123
    image.update()


def packed(image) -> None:
    painted(image)
    image.pack()


def renamed(image) -> None:
    image.name = "My skin"


@pytest.mark.parametrize("change", [painted, packed, renamed])
def test_what_an_artist_changed_is_his(body, table_path, change):
    image = of_role(body, "colour").image
    change(image)
    obj = tan_object(table_path)
    apply(obj)
    assert of_role(obj, "colour").image != image == of_role(body, "colour").image
    assert look_images(obj)[1:] == look_images(body)[1:]


def test_a_name_alone_makes_no_look(table_path, former_path):
    """Nor does an image without the numbers."""
    for name in LOOK.values():
        bpy.data.images.new(f"Skin Tan Look {name}", 4, 4)
    obj = tan_object(table_path)
    apply(obj)
    assert all(image.size[0] > 4 for image in look_images(obj))


def artists_image(obj, role: str, how: str):
    """An image that an artist has made his own, in a node of the tan."""
    image = of_role(obj, role).image
    if how == "copied":
        image = of_role(obj, role).image = image.copy()
    elif how == "renamed":
        image.name = "My tan"
    elif how == "kept":
        image.use_fake_user = True
    else:
        image = of_role(obj, role).image = bpy.data.images.new("Photo", 4, 4)
    return image


@pytest.mark.parametrize(
    ("role", "how"),
    [
        *(("states", how) for how in ("copied", "renamed", "kept", "of another")),
        *(("colour", how) for how in ("copied", "renamed", "of another")),
    ],
)
def test_an_artist_s_image_is_set_aside(body, capfd, role, how):
    image = artists_image(body, role, how)
    name, before = image.name, pixels(image)
    for _ in range(2):
        assert apply(body) == {"FINISHED"}
    assert bpy.data.images[name] == image and image.use_fake_user
    assert np.array_equal(pixels(image), before)
    assert of_role(body, role).image != image
    assert f"No longer shown but kept in the file: {name!r}." in capfd.readouterr().out
    # One that no node showed before is left to Blender.
    assert len(bpy.data.images) - OWN_IMAGES - LOOK_IMAGES in (1, 2)
