"""A row of squares whose exposures have a mask each, and what the model says of them."""

from contextlib import contextmanager
from dataclasses import replace

import bpy
import numpy as np
import pytest
from sampled import looked_up
from scenes import add_camera, add_mask, render, tan_object

from blender_addon.model import catalogue
from blender_addon.model import tan as tans
from blender_addon.model.tan import look_of
from hylios.table import melanin_dynamics
from hylios.tanning import Exposures, states_at

DOSES, DAYS = (20.0, 30.0, 15.0, 12.0), (0.0, 3.0, 6.0, 7.0)
NAMES = ("bikini", "shirt", "shorts", "socks")


@contextmanager
def few_points():
    """Fewer points over the shares, with which all is computed faster, and once for all tests."""
    fewer = replace(tans.FULL_BASIS, points=8000, steps=128, rows=96)
    with pytest.MonkeyPatch.context() as patched:
        patched.setattr(tans, "FULL_BASIS", fewer)
        tans._basis.cache_clear()
        yield
    tans._basis.cache_clear()


def body_of_masks(table_path, shares: np.ndarray):
    """Squares with shares (squares, masks), an attribute to every mask, without a tan yet."""
    obj = tan_object(table_path, np.ones(len(shares)))
    settings = obj.skin_tan
    settings.exposures.clear()
    for name, own, dose, day in zip(NAMES, shares.T, DOSES, DAYS, strict=False):
        add_mask(obj, np.repeat(own, 4), name)
        exposure = settings.exposures.add()
        exposure.dose, exposure.day, exposure.own_mask = dose, day, True
        exposure.mask.source = name
    settings.mask_attribute = ""
    return obj


def rendered(obj, path, output: str = "Colour", *, columns: int = 3, rows: int = 3) -> np.ndarray:
    """An output of the tan (rows, pixels, 3): so many pixels to a square."""
    squares = len(obj.data.polygons)
    tree = obj.material_slots[0].material.node_tree
    (skin,) = (node for node in tree.nodes if "Surface" in node.outputs)
    emission = tree.nodes.new("ShaderNodeEmission")
    tree.links.new(skin.outputs[output], emission.inputs["Color"])
    surface = tree.nodes["Material Output"].inputs["Surface"]
    former = surface.links[0].from_socket
    tree.links.new(emission.outputs["Emission"], surface)
    if bpy.context.scene.camera is None:
        add_camera((squares / 2, 0.5, 5.0), squares)
    pixels = render(path / "row.exr", width=columns * squares, height=rows)
    tree.links.new(former, surface)
    tree.nodes.remove(emission)
    return pixels


def expected(obj, shares: np.ndarray) -> np.ndarray:
    """The colour (N, 3) of simulating shares (N, masks) on the day that shows."""
    values = obj.skin_tan.values()
    header = catalogue.provenance(values.table)
    minimal = values.minimal_doses(header)
    masks = shares.shape[1]
    states = states_at(
        Exposures([int(24 * day) for day in DAYS[:masks]], shares * DOSES[:masks]),
        melanin_dynamics(header),
        times=[24.0 * obj["tan_day"]],
        mmd=minimal.mmd,
        med=minimal.med,
    )[:, 0]
    places = np.zeros((len(shares), 3))
    places[:, 0], places[:, 1] = np.log(states[:, :3].sum(axis=1)), np.log(states[:, 3])
    look = look_of(values)
    return looked_up(look, look.colour, places)
