"""Views of tanned skin in bands outside the visible: nodes put into a tan's group, taken out."""

from collections.abc import Iterable
from dataclasses import dataclass
from functools import partial
from typing import Any

import bpy
from mathutils import Color

from hylios.errors import InputError

from . import nodes, recolour, slots, stand_ins
from .changes import Changes
from .ownership import is_local
from .places import copy_place
from .plan import Link, Role
from .stand_ins import StandIn

VIEW_KEY = "skin_tan_view"
"""Custom property of scenes and of groups: the view that they show, if it is not the visible."""

IMAGE_KEY = "skin_tan_view_image"
"""Custom property of an image that was made for a view."""

_IMAGE = {"interpolation": "Linear", "extension": "EXTEND"}
ROLES = {
    "view_thin": Role("ShaderNodeTexImage", "Band", (900, 1700), _IMAGE),
    "view_thick": Role("ShaderNodeTexImage", "Band, thick skin", (900, 1400), _IMAGE),
    "view_mixed": Role(
        "ShaderNodeMix",
        "By thickness",
        (1200, 1600),
        {"data_type": "RGBA", "clamp_factor": True},
    ),
    "view_colour": Role(
        "ShaderNodeMix",
        "Band for colour",
        (1400, 1600),
        {"data_type": "RGBA"},
        {"Factor_Float": 1.0},
    ),
    "view_near": Role(
        "ShaderNodeVectorMath", "One near share", (1400, 1400), {"operation": "DOT_PRODUCT"}
    ),
    "view_width": Role(
        "ShaderNodeVectorMath", "One far width", (1400, 1250), {"operation": "DOT_PRODUCT"}
    ),
    "view_angle": Role(
        "ShaderNodeVectorMath",
        "Alike at all angles",
        (1400, 1100),
        {"operation": "MULTIPLY"},
        {1: (0.0, 0.0, 0.0)},
    ),
    "view_film": Role(
        "ShaderNodeVectorMath", "Light through a film", (1400, 800), {"operation": "MULTIPLY_ADD"}
    ),
    "view_tint": Role(
        "ShaderNodeVectorMath", "Tint of the gloss", (1650, 1150), {"operation": "MULTIPLY"}
    ),
}
LINKS: tuple[Link, ...] = (
    ("thickness", "Value", "view_mixed", "Factor_Float"),
    ("view_thin", "Color", "view_mixed", "A_Color"),
    ("view_thick", "Color", "view_mixed", "B_Color"),
    ("view_mixed", "Result_Color", "view_colour", "B_Color"),
)


SAMPLED_AS = {"view_thin": "colour", "view_thick": "thick_colour"}
"""Roles of images of a band, and those whose place in the look is theirs."""

STAND_INS = {
    "view_colour": stand_ins.COLOUR["view_colour"],
    "view_near": StandIn("near", "Color", 0, "Value"),
    "view_width": StandIn("width", "Color", 0, "Value"),
    "view_angle": StandIn("slope", "Vector", 0, "Vector"),
    "view_film": StandIn("film_colour", "Vector", 0, "Vector"),
    "view_tint": StandIn("let_through", "Alpha", 0, "Vector"),
}


@dataclass(frozen=True)
class Band:
    """A skin in a view.

    Attributes
    ----------
    view : str
        Identifier of the view.
    image : Image
        Tinted reflectance over the coordinates of the skin's look.
    tint : tuple of float
        Linear Rec.709.
    nearest : int
        Channel of the visible whose near share and far width count.
    film : float
        Share of light that is left after the way through the film on the skin, to it and back.
    """

    view: str
    image: bpy.types.Image
    tint: tuple[float, float, float]
    nearest: int
    film: float = 1.0


def shown_view(group: Any) -> str | None:
    """The view that a tan's group shows, if it is not the visible."""
    return group.get(VIEW_KEY)


def view_of_file() -> str | None:
    """The view that the file is in, if it is not the visible: all scenes share one."""
    return next((scene[VIEW_KEY] for scene in bpy.data.scenes if VIEW_KEY in scene), None)


def set_view_of_file(view: str | None, changes: Changes) -> None:
    """Note the view in all scenes of the file."""
    for scene in filter(is_local, bpy.data.scenes):
        if view is not None:
            changes.set_key(scene, VIEW_KEY, view)
        elif VIEW_KEY in scene:
            changes.at_the_end(partial(scene.pop, VIEW_KEY, None))


def groups_of_file() -> dict[Any, list[bpy.types.Object]]:
    """Tan groups that this file's objects show, and these objects; linked groups too."""
    shown: dict[Any, list[bpy.types.Object]] = {}
    for obj in filter(is_local, bpy.data.objects):
        for group in slots.shown_groups(obj):
            shown.setdefault(group, []).append(obj)
    return shown


def trees_of(group: Any, objects: Iterable[bpy.types.Object]) -> list[Any]:
    """Local trees that lead to a group from the materials of objects."""
    return list(dict.fromkeys(tree for obj in objects for tree in slots.shown_trees(obj, group)))


def show(group: Any, trees: Iterable[Any], band: Band, changes: Changes) -> None:
    """Have a tan's group show a band in place of the visible, or another band.

    So do recoloured materials, of which the trees are, in place of their painted colours.

    Raises
    ------
    InputError
        If it lacks nodes without which it cannot show a tan.
    """
    removed = nodes.missing_roles(group)
    if removed:
        raise InputError(f"nodes were removed from {group.name!r}: {', '.join(removed)}.")
    wanted = ROLES.keys() - (set() if any(nodes.of_role(group, "film_colour")) else {"view_film"})
    lacking = [role for role in ROLES if role in wanted and not any(nodes.of_role(group, role))]
    changes.may_relink(group)
    if lacking:
        changes.may_add_to(group.nodes)
        nodes.complete(group, lacking, ROLES, LINKS)
    for role, sampled in SAMPLED_AS.items():
        _sample_as(group, role, sampled, changes)
    for role, plan in STAND_INS.items():
        stand_ins.put_in(group, stand_ins.COLOUR if role == "view_colour" else {role: plan})
    for role, socket, value in (
        ("view_near", 1, _unit_vector(band.nearest)),
        ("view_width", 1, _unit_vector(band.nearest)),
    ):
        for node in nodes.of_role(group, role):
            changes.set(nodes.find_input(node, socket), "default_value", value)
    for node in nodes.of_role(group, "view_film"):
        changes.set(node.inputs[1], "default_value", (band.film,) * 3)
        # The film's share of a base colour, for which `film_level` has what it is without one.
        level = next(nodes.of_role(group, "film_level")).inputs[2].default_value
        less = tuple((band.film - 1.0) * value for value in level)
        changes.set(node.inputs[2], "default_value", less)
    for node in nodes.of_role(group, "view_tint"):
        tint: Any = Color(band.tint).from_rec709_linear_to_scene_linear()
        changes.set(node.inputs[1], "default_value", tuple(tint))
    for role in ("view_thin", "view_thick"):
        for node in nodes.of_role(group, role):
            changes.set(node, "image", band.image)
    changes.set_key(group, VIEW_KEY, band.view)
    for tree in trees:
        recolour.show_instead(tree, "Colour", changes)


def hide(group: Any, trees: Iterable[Any], changes: Changes) -> None:
    """Have a tan's group show the visible again, when all else is done."""
    changes.at_the_end(partial(_take_out, group))
    for tree in trees:
        changes.at_the_end(partial(recolour.show_painted, tree))


def remove_unused_images(changes: Changes) -> None:
    """Remove images of views that nothing shows any more, when all else is done."""
    changes.at_the_end(remove_unused)


def _unit_vector(channel: int) -> tuple[float, ...]:
    return tuple(float(channel == other) for other in range(3))


def _sample_as(group: Any, role: str, sampled: str, changes: Changes) -> None:
    """Have a node sample its image as one of the visible samples its own."""
    for source in nodes.of_role(group, sampled):
        for node in nodes.of_role(group, role):
            copy_place(source, node, changes)
            for former in source.inputs["Vector"].links:
                group.links.new(former.from_socket, node.inputs["Vector"])


def _take_out(group: Any) -> None:
    stand_ins.take_out(group, STAND_INS, ROLES)
    group.pop(VIEW_KEY, None)


def remove_unused() -> None:
    """Remove images of views that nothing shows any more."""
    unused: Iterable[bpy.types.Image] = [
        image
        for image in bpy.data.images
        if IMAGE_KEY in image and image.users == 0 and image.library is None
    ]
    for image in list(unused):
        bpy.data.images.remove(image)
