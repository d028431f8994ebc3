"""Live under many changes in any order, with undo, redo, saving and loading between them."""

import bpy
import numpy as np
import pytest
from artist_skins import mixed, wear
from scenes import apply, of_role, pixels, tan_object

from blender_addon import applied, live, timers
from blender_addon.model import catalogue
from blender_addon.model.own_colour import offsets
from blender_addon.model.tan import history_of, look_of, peeling_of
from blender_addon.scene import exr, own_colour, peeling

FEW, MANY = 60, 500
SEEDS = (1, 2, 3)


def body():
    return bpy.data.objects["Body"]


class Artist:
    """Does one thing after another to an object with a tan."""

    def __init__(self, seed: int, folder):
        self.random = np.random.default_rng(seed)
        self.path = str(folder / "body.blend")

    def change(self) -> None:
        settings = body().skin_tan
        kind = self.random.integers(13)
        if kind == 0:
            settings.last_day = float(self.random.uniform(8.0, 40.0))
        elif kind == 1 and len(settings.exposures) < 5:
            bpy.ops.skin_tan.add_exposure()
        elif kind == 2 and len(settings.exposures) > 1:
            bpy.ops.skin_tan.remove_exposure(index=0)
        elif kind == 3:
            exposure = settings.exposures[0]
            exposure.enabled = not exposure.enabled
        elif kind == 4:
            settings.biology.blood = float(self.random.choice([1.0, 1.5, 2.0]))
        elif kind == 5:
            settings.own_colour = not settings.own_colour
        elif kind == 6:
            settings.redness = not settings.redness
        elif kind == 7:
            settings.kinetics = str(self.random.choice(["MEASURED", "THESIS"]))
        elif kind == 8:
            settings.peeling = not settings.peeling
        elif kind == 9:
            settings.darkening = not settings.darkening
            settings.exposures[0].unit = str(self.random.choice(["SUN", "SED"]))
        elif kind == 10:
            settings.own_minimal_doses = True
            settings.mmd = float(self.random.choice([6.0, 15.0]))
        else:
            settings.exposures[0].dose = float(self.random.uniform(0.0, 40.0))

    def push(self) -> None:
        bpy.ops.ed.undo_push(message="change")

    def undo(self) -> None:
        if bpy.ops.ed.undo.poll():
            bpy.ops.ed.undo()

    def redo(self) -> None:
        if bpy.ops.ed.redo.poll():
            bpy.ops.ed.redo()

    def save_and_load(self) -> None:
        live.make_exact()
        bpy.ops.wm.save_as_mainfile(filepath=self.path)
        bpy.ops.wm.open_mainfile(filepath=self.path)

    def step(self) -> None:
        kinds = [self.change, self.push, self.undo, self.redo, live.show_changes, live.make_exact]
        weights = [0.4, 0.15, 0.12, 0.08, 0.2, 0.05]
        if self.random.random() < 0.03:
            self.save_and_load()
        else:
            self.random.choice(np.array(kinds, object), p=weights)()


def settled() -> None:
    """After a rest the tan is that of the settings, and no image is lost."""
    live.show_changes()
    live.make_exact()
    obj, scene = body(), bpy.context.scene
    if obj.skin_tan.undone == applied.text_of(obj, scene):
        apply(obj)  # an undo has led back between a setting and its Apply
        bpy.ops.ed.undo_push(message="applied")
    assert not applied.is_changed(obj, scene)
    values = obj.skin_tan.values()
    history, look = history_of(values), look_of(values)
    _require_shown(obj, "states", history.coordinates)
    _require_shown(obj, "rows", history.lines)
    _require_shown(obj, "colour", look.colours)
    assert own_colour.is_shown(obj.skin_tan.group) == obj.skin_tan.own_colour
    if obj.skin_tan.own_colour:
        _require_shown(obj, "own_image", offsets(look))
    assert peeling.is_shown(obj.skin_tan.group) == obj.skin_tan.peeling
    if obj.skin_tan.peeling:
        _require_shown(obj, "peel_image", peeling_of(values))
    for image in bpy.data.images:
        assert image.packed_file is not None and image.size[0] > 0


def _require_shown(obj, role: str, values: np.ndarray) -> None:
    shown = pixels(of_role(obj, role).image)[..., :3]
    np.testing.assert_array_equal(shown, exr.rounded(values))


def run(seed: int, folder, steps: int) -> None:
    artist = Artist(seed, folder)
    for number in range(steps):
        artist.step()
        if number % 20 == 19:
            settled()
    settled()


@pytest.fixture
def tanned(monkeypatch):
    """A body with a tan, as in a window, where undo finds what Live had shown."""
    monkeypatch.setattr(timers, "are_called", lambda: True)
    obj = tan_object(catalogue.shipped_path("III"))
    wear(obj, [mixed("skin")])
    apply(obj)
    bpy.ops.ed.undo_push(message="applied")


@pytest.mark.parametrize("seed", SEEDS)
def test_a_few_changes(tanned, tmp_path, seed):
    run(seed, tmp_path, FEW)


@pytest.mark.slow
@pytest.mark.parametrize("seed", SEEDS)
def test_many_changes(tanned, tmp_path, seed):
    run(seed, tmp_path, MANY)
