"""A film in views outside the visible: sunscreen is dark in the ultraviolet, water at 1650 nm."""

import bpy
import numpy as np
import pytest
from scenes import add_camera, apply, render, tan_group, tan_object, white_world
from test_changes import inventory

from blender_addon.model.catalogue import shipped_path
from blender_addon.model.film import film_of
from blender_addon.model.views import VIEWS
from blender_addon.scene.nodes import role_of
from hylios.tissue.liquids import LIQUIDS


@pytest.fixture
def body():
    obj = tan_object(shipped_path("III"), dose=0.0)
    white_world()
    bpy.context.scene.world.cycles.sampling_method = "NONE"
    add_camera((0.5, 0.5, 5.0), 0.1)
    return obj


def wear(obj, film: str) -> None:
    obj.skin_tan.film = film
    assert apply(obj) == {"FINISHED"}


def seen(folder) -> np.ndarray:
    return render(folder / "film.exr", width=16, height=16, samples=64).mean(axis=(0, 1))


@pytest.mark.parametrize(
    ("film", "view"), [("SUNSCREEN", "NM365"), ("WATER", "NM1650"), ("OIL", "NM1100")]
)
@pytest.mark.parametrize("first", ["film", "view"])
def test_a_film_holds_back_light_of_the_band(body, tmp_path, film, view, first):
    """Of light from inside twice the way through it is left, in whichever order both came.

    The film's own gloss is white: Blender has no tint for that of a coat.
    """
    wear(body, "NONE" if first == "view" else film)
    bpy.ops.skin_tan.switch_view(view=view)
    wear(body, "NONE")
    tint, liquid = np.array(VIEWS[view].tint), LIQUIDS[film.lower()]
    dry = seen(tmp_path) - 0.0467 * tint
    wear(body, film)
    gloss = ((liquid.index - 1.0) / (liquid.index + 1.0)) ** 2
    beneath = ((1.5526 - liquid.index) / (1.5526 + liquid.index)) ** 2
    inside = seen(tmp_path) - gloss - beneath * tint
    numbers = film_of(film.lower(), np.sqrt(0.1))
    wet = dry * (1.0 + np.array(numbers.start) + np.array(numbers.slope) * dry)
    through = (1.0 - gloss) * (1.0 - beneath) / (1.0 - 0.0467)
    left = liquid.twice_through([VIEWS[view].nm])[0]
    assert inside == pytest.approx(left * wet * through, rel=0.015, abs=5e-4)


def test_back_without_a_trace(body):
    wear(body, "WATER")
    before = inventory()
    for view in VIEWS:
        bpy.ops.skin_tan.switch_view(view=view)
    assert any(role_of(node) == "view_film" for node in tan_group(body).nodes)
    bpy.ops.skin_tan.switch_view(view="VISIBLE")
    assert inventory() == before
