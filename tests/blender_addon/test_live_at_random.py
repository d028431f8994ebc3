"""Live under many changes in any order, with undo, redo, saving and loading between them."""

import time
from dataclasses import replace

import bpy
import numpy as np
import pytest
from artist_skins import mixed, wear
from scenes import add_mask, apply, of_role, pixels, tan_object

from blender_addon import applied, live, several, timers
from blender_addon.model import catalogue, day_basis, room, tan
from blender_addon.model.own_colour import offsets
from blender_addon.model.tan import history_of, look_of, peeling_of
from blender_addon.scene import exr, images, own_colour, peeling

FEW, MANY = 60, 500
SEEDS = (1, 2, 3)
MASKS = ("bikini", "shirt", "shorts", "socks", "hat")


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
        if body().data.attributes.get(MASKS[0]) and self.random.random() < 0.9:
            self.change_of_masks(settings.exposures)
        elif kind == 0:
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

    def change_of_masks(self, exposures) -> None:
        """Mostly a dose; now and then, which masks there are."""
        exposure = exposures[self.random.integers(len(exposures))]
        kind = self.random.integers(20)
        if kind == 0:
            exposure.enabled = not exposure.enabled
        elif kind == 1:
            exposure.mask.source = str(self.random.choice(MASKS))
        elif kind == 2:
            exposure.mask.strength = float(self.random.choice([0.5, 1.0]))
        elif kind == 3:
            exposure.day = float(self.random.integers(0, 20))
        else:
            exposure.dose = float(self.random.uniform(0.0, 40.0))

    def push(self) -> None:
        bpy.ops.ed.undo_push(message="change")

    def undo(self) -> None:
        if bpy.ops.ed.undo.poll():
            bpy.ops.ed.undo()

    def redo(self) -> None:
        if bpy.ops.ed.redo.poll():
            bpy.ops.ed.redo()

    def save_and_load(self) -> None:
        rest()
        bpy.ops.wm.save_as_mainfile(filepath=self.path)
        bpy.ops.wm.open_mainfile(filepath=self.path)

    def step(self) -> None:
        kinds = [self.change, self.push, self.undo, self.redo, live.show_changes, live.make_exact]
        weights = [0.4, 0.15, 0.12, 0.08, 0.2, 0.05]
        if self.random.random() < 0.03:
            self.save_and_load()
        else:
            self.random.choice(np.array(kinds, object), p=weights)()


def finish(timer) -> None:
    """Blender calls a timer until it has nothing left to do."""
    end = time.monotonic() + 60.0
    while timer() is not None:
        assert time.monotonic() < end
        time.sleep(0.001)


def rest() -> None:
    """Blender calls timers until nothing is left to do."""
    for timer in (live.show_changes, live.make_exact):
        finish(timer)


def settled() -> None:
    """After a rest the tan is that of the settings, and no image is lost."""
    rest()
    obj, scene = body(), bpy.context.scene
    if obj.skin_tan.undone == applied.text_of(obj, scene):
        apply(obj)  # an undo has led back between a setting and its Apply
        bpy.ops.ed.undo_push(message="applied")
    assert not applied.is_changed(obj, scene)
    values = obj.skin_tan.values()
    history, look = history_of(values), look_of(values)
    shown = several.shown_images(obj)
    assert bool(shown) == several.has_several(obj)
    if shown:
        made = several.computed(obj)
        for role, told in room.images_in(made, several.room_of(shown)).items():
            np.testing.assert_array_equal(pixels(shown[role])[..., :3], exr.rounded(told))
    else:
        _require_shown(obj, "states", history.coordinates)
        _require_shown(obj, "rows", history.lines)
    _require_shown(obj, "colour", look.colours)
    assert own_colour.is_shown(obj.skin_tan.group) == obj.skin_tan.own_colour
    if obj.skin_tan.own_colour:
        _require_shown(obj, "own_image", offsets(look))
    assert peeling.is_shown(obj.skin_tan.group) == obj.skin_tan.peeling
    if obj.skin_tan.peeling:
        which = several.which_masks(obj) if shown else None
        _require_shown(obj, "peel_image", peeling_of(values, which))
    for image in bpy.data.images:
        assert image.packed_file is not None and image.size[0] > 0


def _require_shown(obj, role: str, values: np.ndarray) -> None:
    shown = pixels(of_role(obj, role).image)[..., :3]
    np.testing.assert_array_equal(shown, exr.rounded(values))


def run(seed: int, folder, steps: int, rests: int = 20) -> None:
    """So many steps, and a rest after every few."""
    artist = Artist(seed, folder)
    for number in range(steps):
        artist.step()
        if number % rests == rests - 1:
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


@pytest.fixture
def masked(tanned, monkeypatch, tmp_path):
    """As above, with five exposures that have four masks, told roughly, in a file."""
    fewer = replace(tan.FULL_BASIS, points=400, steps=32, rows=96, rounds=1)
    monkeypatch.setattr(tan, "FULL_BASIS", fewer)
    monkeypatch.setattr(tan, "DRAG_BASIS", replace(fewer, points=100, ranks=(6,)))
    for name in ("DAY", "OTHERS"):
        monkeypatch.setattr(day_basis, name, replace(fewer, points=100, steps=16, rows=32))
    tan._basis.cache_clear()
    obj = body()
    exposures = obj.skin_tan.exposures
    for number, name in enumerate(MASKS):
        add_mask(obj, np.full(4, 0.2 * number), name)
        exposure = exposures[0] if number == 0 else exposures.add()
        exposure.day, exposure.dose, exposure.own_mask = 3.0 * number, 9.0, True
        exposure.mask.source = MASKS[min(number, 3)]
    apply(obj)
    Artist(0, tmp_path).save_and_load()
    yield
    tan._basis.cache_clear()


def test_a_rough_apply_is_no_tan_of_before(tanned):
    """What is turned on and off while it is dragged goes, whatever else changes meanwhile."""
    settings = body().skin_tan
    for is_on in (True, False):  # the first time sets the usual colour
        settings.own_colour = is_on
        apply(body())
    settings.biology.blood, settings.own_colour = 1.5, True
    live.show_changes()
    assert own_colour.is_shown(settings.group)
    settings.biology.blood, settings.own_colour = 1.0, False
    settings.exposures[0].dose = 9.0
    settled()


@pytest.mark.parametrize("seed", SEEDS[:2])
def test_a_few_changes(tanned, tmp_path, seed):
    run(seed, tmp_path, FEW)


def test_a_few_changes_of_masks(masked, tmp_path):
    run(4, tmp_path, FEW // 2, rests=5)


def test_what_is_refused_does_not_keep_another_object_waiting(masked, monkeypatch):
    """Whose day shows then, peeling too, where the first one stays as it was."""
    first = body()
    other = first.copy()
    bpy.context.collection.objects.link(other)
    other.skin_tan.peeling = True
    apply(other)
    before = [pixels(image) for image in live._history(first)]
    exposure = first.skin_tan.exposures[0]
    exposure.unit, exposure.month, exposure.day_of_month = "SUN", 2, 30
    other.skin_tan.exposures[1].dose = 35.0
    finish(live.show_changes)
    assert " roughly on day " in several.shown_images(other)["rows"][images.SHOWN]
    bpy.context.scene.frame_set(100)
    with monkeypatch.context() as playing:
        playing.setattr(timers, "is_playing", lambda: True)
        assert not live._waits_for_day(other, bpy.context.scene)
    finish(live.show_changes)
    assert several.shown_images(other)["rows"][images.SHOWN].endswith(f" {other['tan_day']}")
    peeling_now = pixels(of_role(other, "peel_image").image)[..., :3]
    np.testing.assert_array_equal(peeling_now, several._peeled(other)[0])
    finish(live.make_exact)
    assert not applied.is_changed(other, bpy.context.scene)
    for image, own in zip(live._history(first), before, strict=True):
        np.testing.assert_array_equal(pixels(image), own)


def test_a_day_of_other_masks_is_never_shown(masked):
    """It was computed for those that there were before an undo."""
    settings = body().skin_tan
    settings.exposures[4].dose = 20.0
    assert live.show_changes() is not None
    settings.exposures[3].enabled = settings.exposures[4].enabled = False
    apply(body())
    size = tuple(several.shown_images(body())["places"].size)
    settings.exposures[0].dose = 11.0
    several.DAYS._thread.join()
    assert live.show_changes() is not None
    assert tuple(several.shown_images(body())["places"].size) == size
    settled()


@pytest.mark.slow
@pytest.mark.parametrize("seed", SEEDS)
def test_many_changes(tanned, tmp_path, seed):
    run(seed, tmp_path, MANY)


@pytest.mark.slow
@pytest.mark.parametrize("seed", SEEDS)
def test_many_changes_of_masks(masked, tmp_path, seed):
    run(seed, tmp_path, MANY, rests=5)
