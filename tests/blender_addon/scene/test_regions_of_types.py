"""Regions on the skin of a shipped type, rendered, against the light model solved by itself."""

import bpy
import numpy as np
from scenes import add_camera, apply, render, tan_object, white_world
from test_regions import add_region, show_emission_of

from blender_addon.model import catalogue
from hylios.colour_difference import ciede2000, lab
from hylios.region_colour import subsurface_colours
from hylios.skin.regions import region
from hylios.table import skin_of
from hylios.tanning import Exposures

KINDS = ("fingers", "cheeks", "palms", "moles")
DOSE, DAY = 15.0, 8


def test_regions_look_as_the_light_model_has_them_with_a_tan_and_without(tmp_path):
    """Fingers without their brighter tissue were off by 2.7."""
    path = catalogue.shipped_path("III")
    skin = skin_of(catalogue.provenance(path))
    squares = [(name, share) for name in KINDS for share in (0.0, 1.0)]
    obj = tan_object(path, [share for _, share in squares], dose=DOSE)
    for name in KINDS:
        add_region(obj, name, [float(name == own) for own, _ in squares])
    add_camera((len(squares) / 2, 0.5, 5.0), len(squares))
    white_world()
    settings = obj.skin_tan
    settings.first_day, settings.last_day = 0.0, 30.0
    settings.first_frame, settings.last_frame = 0, 30
    assert apply(obj) == {"FINISHED"}
    bpy.context.scene.frame_set(DAY)
    show_emission_of(obj, "Colour")
    seen = render(tmp_path / "row.exr", width=3 * len(squares), height=3)[1, 1::3]
    doses = np.array([[share * DOSE] for _, share in squares])
    states = skin.states(Exposures(np.array([0]), doses), [24 * DAY])[:, 0]
    told = [region(name, skin.specimen.pigmentation) for name, _ in squares]
    # What does not tan keeps its melanin and gets as thick as the skin around it.
    states[:, :3] = np.where(
        [[own.tan == 0.0] for own in told], skin.untanned_melanin, states[:, :3]
    )
    own = [kind.of(skin.at(state)) for kind, state in zip(told, states, strict=True)]
    off = ciede2000(lab(seen), lab(subsurface_colours(own)))
    assert off.mean() < 0.25
    assert off.max() < 0.5
