"""The images and the mask of a tan are those of its settings."""

import numpy as np
import pytest
from scenes import add_mask, apply, of_role, pixels, tan_object


@pytest.fixture
def body(table_path):
    obj = tan_object(table_path)
    apply(obj)
    return obj


def test_without_and_with_a_mask(body):
    """Adding one and taking it away again, in the nodes that are there."""
    count = len(body.skin_tan.group.nodes)
    share = of_role(body, "share").inputs
    assert [end.default_value for end in share[1:]] == [0.0, 1.0]
    add_mask(body, np.zeros(4))
    apply(body)
    assert of_role(body, "mask").attribute_name == "sun"
    assert [end.default_value for end in share[1:]] == [1.0, 0.0]
    body.skin_tan.mask_attribute = ""
    apply(body)
    assert of_role(body, "mask").attribute_name == ""
    assert [end.default_value for end in share[1:]] == [0.0, 1.0]
    assert len(body.skin_tan.group.nodes) == count


def test_images_are_those_of_the_model(body, table_path):
    """Float for float of the 24 bits that are kept, after reading the packed file."""
    from blender_addon.model.tan import tan_of
    from blender_addon.scene.exr import rounded

    expected = tan_of(body.skin_tan.values())
    history, look = expected.history, expected.look
    for role, values in (
        ("states", history.coordinates),
        ("columns", history.lines),
        ("rows", history.lines),
        ("colour", look.colours),
        ("thick_colour", look.colours),
        ("bend", look.light),
        ("let_through", look.light),
    ):
        assert np.array_equal(
            pixels(of_role(body, role).image)[..., : values.shape[-1]], rounded(values)
        )
