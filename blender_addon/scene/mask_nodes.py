"""What the mask's nodes in a tan's group read, and setting it."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass, replace
from typing import Any, cast

import bpy

from hylios.errors import InputError

from .changes import Changes
from .masks import COLOURS, Mask, require_usable
from .nodes import complete, find_input, of_role
from .ownership import Users, is_local, remembered
from .plan import (
    CHANNEL_LINKS,
    CHANNEL_ROLES,
    IMAGE_LINKS,
    IMAGE_ROLES,
    LAYOUT,
    LAYOUT_KEY,
    LINKS,
    ROLES,
    Link,
    Role,
)
from .vertex_groups import copied

WEIGHTS = {
    "MEAN": (1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0),
    "RED": (1.0, 0.0, 0.0),
    "GREEN": (0.0, 1.0, 0.0),
    "BLUE": (0.0, 0.0, 1.0),
    "ALPHA": (0.0, 0.0, 0.0),
}
"""Of red, green and blue in the number that a channel gives."""

SHARE_ROLES = ("mask", "mask_value", "share")
"""Roles of the nodes that read a mask which is no image."""

NUMBER, NOTHING = (1.0, 0.0, 0.0), (0.0, 0.0, 0.0)


@dataclass(frozen=True)
class ShownMask:
    """What the nodes read: an attribute or an image, or neither where the whole body is bare.

    Attributes
    ----------
    attribute : str
    image : Image or None
    uv_map : str
    weights : 3 floats
        Of red, green and blue.
    alpha : float
        Weight of alpha.
    slope, offset : float
        From the number to the share of the dose.
    by_channel : bool
        Whether the number is not the mean of an attribute's red, green and blue.
    """

    attribute: str = ""
    image: bpy.types.Image | None = None
    uv_map: str = ""
    weights: tuple[float, float, float] = NOTHING
    alpha: float = 0.0
    slope: float = 1.0
    offset: float = 0.0
    by_channel: bool = False

    def values(self) -> Mapping[str, Mapping[int, Any]]:
        """By roles and numbers of inputs."""
        of_image, bare = self.image is not None, self.image is None and not self.attribute
        line = {1: 0.0, 2: 1.0} if bare else {1: self.slope, 2: self.offset}
        return {
            "mask_channel": {1: NOTHING if of_image else self.weights},
            "mask_alpha": {1: 0.0 if of_image else self.alpha},
            "image_channel": {1: self.weights if of_image else NOTHING},
            "image_alpha": {1: self.alpha if of_image else 0.0},
            "share": line,
            # Groups of earlier versions have both: their share is at least what its input 1 says.
            "mask_share": line,
        }


def slope_and_offset(mask: Mask) -> tuple[float, float]:
    """How the share of the dose follows from a mask's number: a factor, and what is added."""
    return (-mask.strength, 1.0) if mask.invert else (mask.strength, 1.0 - mask.strength)


def shown_mask(obj: bpy.types.Object, mask: Mask, changes: Changes) -> ShownMask:
    """What the nodes read for a mask; a vertex group is copied for them.

    Raises
    ------
    InputError
        If the mask cannot be used.
    """
    source = require_usable(obj, mask)
    if source is None:
        return ShownMask()
    slope, offset = slope_and_offset(mask)
    weights = WEIGHTS.get(mask.channel, WEIGHTS["MEAN"])
    alpha = 1.0 if mask.channel == "ALPHA" else 0.0
    if source.kind == "IMAGE":
        return ShownMask("", mask.image, mask.uv_map, weights, alpha, slope, offset)
    by_channel = mask.channel in WEIGHTS and mask.channel != "MEAN"
    if source.data_type not in COLOURS:
        weights, alpha, by_channel = NUMBER, 0.0, False
    name = source.name
    if source.kind == "GROUP":
        name = copied(obj, name, changes)
    return ShownMask(name, None, "", weights, alpha, slope, offset, by_channel)


def where_it_lies(obj: bpy.types.Object, mask: Mask, changes: Changes) -> ShownMask:
    """What nodes read of a mask of what lies on the skin: its number times its strength.

    Raises
    ------
    InputError
        If the mask cannot be used.
    """
    slope, offset = (-mask.strength, mask.strength) if mask.invert else (mask.strength, 0.0)
    return replace(shown_mask(obj, mask, changes), slope=slope, offset=offset)


def show(group: bpy.types.NodeTree, shown: ShownMask, changes: Changes, prefix: str = "") -> None:
    """Have the nodes of a mask read something else; those of another mask by their prefix."""
    if any(of_role(group, prefix + "mask_value")):
        if shown.by_channel or shown.image is not None:
            _add_channel(group, changes, prefix)
        if shown.image is not None:
            _add_lacking(group, IMAGE_ROLES, IMAGE_LINKS, changes, prefix)
    for role, values in shown.values().items():
        for node in of_role(group, prefix + role):
            at_least = node.operation == "MAXIMUM"
            for socket, value in ({1: 0.0} if at_least else values).items():
                changes.set(find_input(node, socket), "default_value", value)
    for role, name, value in (
        ("mask", "attribute_name", shown.attribute),
        ("mask_uv", "uv_map", shown.uv_map),
        ("mask_image", "image", shown.image),
    ):
        for node in of_role(group, prefix + role):
            changes.set(node, name, value)


def _add_channel(group: Any, changes: Changes, prefix: str) -> None:
    """Have the channel of a mask's attribute lead to all that its number led to."""
    masks = list(of_role(group, prefix + "mask"))
    ends = [link.to_socket for node in masks for link in node.outputs["Fac"].links]
    if _add_lacking(group, CHANNEL_ROLES, CHANNEL_LINKS, changes, prefix):
        for alpha in of_role(group, prefix + "mask_alpha"):
            for end in ends:
                group.links.new(alpha.outputs[0], end)


def _add_lacking(
    group: Any, roles: Mapping[str, Role], links: Iterable[Link], changes: Changes, prefix: str
) -> list[str]:
    """Make those nodes of a mask that a group lacks; their roles."""
    own_roles, own_links = prefixed(roles, links, prefix)
    made = [role for role in own_roles if not any(of_role(group, role))]
    if made:
        changes.may_add_to(group.nodes)
        changes.may_relink(group)
        complete(group, made, own_roles, own_links)
    return made


def added(tree: bpy.types.NodeTree, shown: ShownMask, changes: Changes, prefix: str) -> Any:
    """Add the nodes of another mask to a tree; the last of them, which gives the share."""
    roles, links = prefixed(
        {role: ROLES[role] for role in SHARE_ROLES},
        [link for link in LINKS if {link[0], link[2]} <= set(SHARE_ROLES)],
        prefix,
    )
    complete(tree, roles, roles, links)
    show(tree, shown, changes, prefix)
    return next(of_role(tree, prefix + "share"))


def prefixed(
    roles: Mapping[str, Role], links: Iterable[Link], prefix: str
) -> tuple[dict[str, Role], list[Link]]:
    """Roles and the links between them for another mask, higher up in the tree."""
    height = 1500 if prefix else 0
    moved = {
        prefix + name: replace(role, location=(role.location[0], role.location[1] + height))
        for name, role in roles.items()
    }
    inner = [
        (prefix + source, output, prefix + target, socket)
        for source, output, target, socket in links
    ]
    return moved, inner


def show_at_once(obj: bpy.types.Object, mask: Mask) -> bool:
    """Have a tan that is there show another mask, without Apply; whether it does.

    It does not where other objects show the tan's nodes too, where the mask cannot be used, where
    the tan shows several, or while Blender renders.
    """
    group = remembered(obj).group
    if group is None or group.get(LAYOUT_KEY) != LAYOUT or bpy.app.is_job_running("RENDER"):
        return False
    if not (is_local(group) and is_local(cast(bpy.types.ID, obj.data))):
        return False
    if Users().others(group, obj) or any(of_role(group, "basis")):
        return False
    try:
        with Changes() as changes:
            show(group, shown_mask(obj, mask, changes), changes)
    except InputError:
        return False
    return True
