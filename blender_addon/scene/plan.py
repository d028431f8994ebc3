"""The plan of a tan's node group: which nodes it has, what they are called, how they are linked.

From the left: the share of the dose and the day lead to a place in the image of states; the state,
with what the group's inputs change of it, to a place in the images of the skin's look; these, by
the angle of view, to the base colours of two shaders.
"""

from dataclasses import dataclass, field
from typing import Any

LAYOUT_KEY, LAYOUT = "skin_tan_layout", 4
"""Custom property of a group that says that this add-on made it, and by which plan."""

PROFILE_KEY = "skin_tan_profile"
"""Custom property of a group: whether its table has a profile, so that light scatters below."""

ROLE_PREFIX = "skin_tan:"
"""What the names of our nodes begin with; their role follows. Their labels are for artists."""

ROLE_KEY = "skin_tan_role"
"""Custom property of a node of earlier versions: its role. It took 400 bytes of a file."""

DAY_PROPERTY = "tan_day"

INDEX = 1.5526
"""Index of refraction of the surface of the skin in the model."""

SEEN = 0.00973
"""1 less the cosine of the 8 degrees at which Colour is seen."""

SHARPEST = 0.3
"""Roughness of fully oiled skin's sharper gloss over that of the skin, by eye."""

TINT = "Specular Tint"
"""Input of a shader that is a factor on its gloss, and may be above 1."""

Link = tuple[str, str | int, str, str | int]
"""From a role and its output to a role and its input."""


@dataclass(frozen=True)
class Role:
    """A kind of node in the group.

    Attributes
    ----------
    kind : str
        Its type, as Blender calls it.
    label : str
        What an artist reads; it tells the node in files without roles.
    location : tuple
    values : mapping
        Attributes that a new node is given.
    inputs : mapping
        Values of its inputs, by number or identifier.
    """

    kind: str
    label: str
    location: tuple[int, int]
    values: dict[str, Any] = field(default_factory=dict)
    inputs: dict[Any, Any] = field(default_factory=dict)


def _image(label: str, location: tuple[int, int]) -> Role:
    values = {"interpolation": "Linear", "extension": "EXTEND"}
    return Role("ShaderNodeTexImage", label, location, values)


def math_role(operation: str, label: str, location: tuple[int, int], **inputs: float) -> Role:
    """A node of arithmetic; `at_1` is the value of its input 1."""
    numbered = {int(name.removeprefix("at_")): value for name, value in inputs.items()}
    return Role("ShaderNodeMath", label, location, {"operation": operation}, numbered)


def vector_role(operation: str, label: str, location: tuple[int, int], **inputs: Any) -> Role:
    """A node of arithmetic with vectors; `at_1` is the value of its input 1."""
    numbered = {int(name.removeprefix("at_")): value for name, value in inputs.items()}
    return Role("ShaderNodeVectorMath", label, location, {"operation": operation}, numbered)


def _principled(label: str, location: tuple[int, int]) -> Role:
    values = {"subsurface_method": "BURLEY", "distribution": "MULTI_GGX"}
    return Role(
        "ShaderNodeBsdfPrincipled",
        label,
        location,
        values,
        {"Subsurface Weight": 0.0, "IOR": INDEX},
    )


LOOK = {"colours": "Colours", "light": "Light"}
"""The images of a look by the names of the numbers, and how they are called."""

LIGHT = ("bend", "bow", "near", "width")
"""Roles of the nodes that show the image of light, by its rows from the bottom; its last row is for
`let_through`, with the tint of the gloss as its alpha. `bend` and `bow` tell how colour changes
with the angle of view."""

CHANNEL_ROLES = {
    "mask_channel": vector_role("DOT_PRODUCT", "Channel of the mask", (-2300, 400)),
    "mask_alpha": math_role("MULTIPLY_ADD", "Alpha of the mask", (-2100, 350)),
}
"""Nodes of a mask of which one channel counts, or which is an image. A group gets them and those of
`IMAGE_ROLES` with the first such mask: others need none of them, and a node is 3 kB of a file."""

IMAGE_ROLES = {
    "mask_uv": Role("ShaderNodeUVMap", "UV map of the mask", (-2700, 50)),
    "mask_image": _image("Mask image", (-2500, 100)),
    "image_channel": vector_role("DOT_PRODUCT", "Channel of the image", (-2200, 100)),
    "image_alpha": math_role("MULTIPLY_ADD", "Alpha of the image", (-2000, 50)),
}
"""Nodes of a mask that is an image."""

ROLES = {
    "mask": Role("ShaderNodeAttribute", "Share", (-2500, 350), {"attribute_type": "GEOMETRY"}),
    "mask_value": Role(
        "ShaderNodeMath",
        "Mask, cut to 0 to 1",
        (-1800, 250),
        {"operation": "ADD", "use_clamp": True},
        {1: 0.0},
    ),
    "share": math_role("MULTIPLY_ADD", "Invert and strength", (-1600, 250)),
    "day": Role(
        "ShaderNodeAttribute",
        "Day",
        (-1400, 0),
        {"attribute_type": "OBJECT", "attribute_name": DAY_PROPERTY},
    ),
    "columns": _image("Columns of shares", (-1000, 250)),
    "rows": _image("Rows of days", (-1000, -50)),
    "state_place": vector_role("ADD", "Place of the state", (-500, 150)),
    "states": _image("States", (-300, 150)),
    "state": Role("ShaderNodeSeparateXYZ", "Melanin, thickness, blood", (0, 150)),
    "input": Role("NodeGroupInput", "", (-200, 500)),
    "melanin": math_role("EXPONENT", "Melanin", (200, 300)),
    "more_melanin": math_role("MULTIPLY", "More or less melanin", (350, 300)),
    "root": math_role("SQRT", "Root of melanin", (500, 300)),
    "least_blood": math_role("MAXIMUM", "Some blood", (0, -100), at_1=0.001),
    "more_blood": math_role("LOGARITHM", "Logarithm of blood", (200, -100), at_1=2.718281828),
    "blood": math_role("ADD", "More or less blood", (350, -100)),
    "look_row": Role("ShaderNodeClamp", "Blood of which the look tells", (500, -100)),
    "thickness_slope": math_role("MULTIPLY_ADD", "Thin to thick, slope", (350, -350)),
    "thickness": Role(
        "ShaderNodeMath",
        "Thin to thick",
        (500, -350),
        {"operation": "MULTIPLY_ADD", "use_clamp": True},
    ),
    "look_place": Role("ShaderNodeCombineXYZ", "Root of melanin, blood", (700, 150)),
    # The first version called this one and that of the width so.
    "colour": _image("Colour", (900, 500)),
    "thick_colour": _image("Colour of thick skin, less that", (900, 200)),
    "mixed_colour": vector_role("MULTIPLY_ADD", "By thickness", (1200, 500)),
    "bend": _image("Bend", (900, -100)),
    "bow": _image("Bow", (900, -400)),
    "near": _image("Near share", (900, -700)),
    "width": _image("Profile width (mm)", (900, -1000)),
    "untanned": _image("Untanned colour", (900, 800)),
    "ratio": vector_role("DIVIDE", "Ratio to untanned", (1500, 800)),
    "facing": Role("ShaderNodeLayerWeight", "Angle of view", (1000, 1050), {}, {"Blend": 0.5}),
    "turned": math_role("SUBTRACT", "Angle of view from that of Colour", (1200, 750), at_1=SEEN),
    "slope": vector_role("MULTIPLY_ADD", "Bow and bend", (1400, 200)),
    "gain": vector_role("MULTIPLY_ADD", "Change with the angle", (1550, 200)),
    "base": vector_role("MULTIPLY", "Base colour", (1700, 400)),
    "near_part": vector_role("MULTIPLY", "Near part", (1850, 200)),
    "far_part": vector_role("SUBTRACT", "Far part", (1850, 400)),
    "near_scaled": vector_role("SCALE", "Base of near light", (2000, 200)),
    "far_base": vector_role("DIVIDE", "Base of far light", (2000, 400)),
    "radius": Role("ShaderNodeValue", "Width to radius", (2000, -100)),
    "dryness": math_role(
        "MULTIPLY_ADD", "Roughness by oil", (1900, 0), at_1=SHARPEST - 1.0, at_2=1.0
    ),
    "sharper": math_role("MULTIPLY", "Roughness of oiled skin", (2050, 0)),
    # A bump without a height is for Cycles what is linked to it, or else the mesh's own normal. Any
    # other node would have it evaluate the shader again where light leaves the skin: 1.15 times.
    "normal": Role("ShaderNodeBump", "Normal, or that of the mesh", (2200, -400)),
    # A second shader takes a fourth more time, so that where both would have one gloss the near
    # light is that of a diffuse shader, whose colour takes account of the gloss.
    "two_lobes": math_role("GREATER_THAN", "Whether one gloss is sharper", (1250, 900), at_1=0.0),
    "far_weight": math_role("MULTIPLY_ADD", "Weight of far light", (1900, 700), at_2=1.0),
    "let_through": _image("What the gloss lets through", (1400, 1100)),
    "beneath": Role(
        "ShaderNodeMath",
        "What one gloss lets through, or two nothing",
        (1700, 1000),
        {"operation": "SUBTRACT", "use_clamp": True},
    ),
    "near_shown": vector_role("SCALE", "Near light", (2150, 800)),
    "near_light": Role("ShaderNodeBsdfDiffuse", "Near light beneath one gloss", (2350, 800)),
    "near_skin": _principled("Skin, near light", (2350, 0)),
    "skin": _principled("Skin", (2350, 500)),
    "lobes": Role("ShaderNodeMixShader", "Near and far light", (2700, 400)),
    "light": Role("ShaderNodeAddShader", "All light", (2900, 500)),
    "output": Role("NodeGroupOutput", "", (3100, 300)),
}

SHADERS = frozenset(
    "dryness sharper normal two_lobes far_weight "
    "let_through beneath near_shown near_light light "
    "near_skin lobes far_base near_scaled near_part far_part base gain slope "
    "facing turned".split()
)
"""Roles that nobody needs where an artist has put another shader in place of ours."""

CHANNEL_LINKS: tuple[Link, ...] = (
    ("mask", "Color", "mask_channel", 0),
    ("mask", "Alpha", "mask_alpha", 0),
    ("mask_channel", "Value", "mask_alpha", 2),
)
"""Links of the nodes of a mask's channel; the last one leads to what the mask's number led to."""

IMAGE_LINKS: tuple[Link, ...] = (
    ("mask_uv", "UV", "mask_image", "Vector"),
    ("mask_image", "Color", "image_channel", 0),
    ("mask_image", "Alpha", "image_alpha", 0),
    ("image_channel", "Value", "image_alpha", 2),
    ("image_alpha", "Value", "mask_value", 1),
)
"""Links of the nodes of a mask that is an image."""

LINKS: tuple[Link, ...] = (
    ("mask", "Fac", "mask_value", 0),
    ("mask_value", "Value", "share", 0),
    ("share", "Value", "columns", "Vector"),
    ("day", "Fac", "rows", "Vector"),
    ("columns", "Color", "state_place", 0),
    ("rows", "Color", "state_place", 1),
    ("state_place", "Vector", "states", "Vector"),
    ("states", "Color", "state", "Vector"),
    ("state", "X", "melanin", 0),
    ("melanin", "Value", "more_melanin", 0),
    ("input", "Melanin", "more_melanin", 1),
    ("more_melanin", "Value", "root", 0),
    ("root", "Value", "look_place", "X"),
    ("input", "Blood", "least_blood", 0),
    ("least_blood", "Value", "more_blood", 0),
    ("state", "Z", "blood", 0),
    ("more_blood", "Value", "blood", 1),
    ("blood", "Value", "look_row", "Value"),
    ("state", "Y", "thickness_slope", 0),
    ("thickness_slope", "Value", "thickness", 1),
    ("look_row", "Result", "look_place", "Y"),
    ("state", "Y", "thickness", 0),
    *(("look_place", "Vector", role, "Vector") for role in ("colour", "thick_colour", *LIGHT)),
    ("thick_colour", "Color", "mixed_colour", 0),
    ("thickness", "Value", "mixed_colour", 1),
    ("colour", "Color", "mixed_colour", 2),
    ("look_place", "Vector", "untanned", "Vector"),
    ("mixed_colour", "Vector", "ratio", 0),
    ("untanned", "Color", "ratio", 1),
    ("bow", "Color", "slope", 0),
    ("facing", "Facing", "turned", 0),
    ("turned", "Value", "slope", 1),
    ("bend", "Color", "slope", 2),
    ("slope", "Vector", "gain", 0),
    ("turned", "Value", "gain", 1),
    ("mixed_colour", "Vector", "base", 0),
    ("gain", "Vector", "base", 1),
    ("base", "Vector", "near_part", 0),
    ("near", "Color", "near_part", 1),
    ("base", "Vector", "far_part", 0),
    ("near_part", "Vector", "far_part", 1),
    ("near_part", "Vector", "near_scaled", 0),
    ("far_part", "Vector", "far_base", 0),
    ("far_weight", "Value", "far_base", 1),
    ("near_scaled", "Vector", "near_skin", "Base Color"),
    ("far_base", "Vector", "skin", "Base Color"),
    ("width", "Color", "skin", "Subsurface Radius"),
    ("radius", "Value", "skin", "Subsurface Scale"),
    ("input", "Roughness", "skin", "Roughness"),
    ("input", "Oil", "dryness", 0),
    ("dryness", "Value", "sharper", 0),
    ("input", "Roughness", "sharper", 1),
    ("sharper", "Value", "near_skin", "Roughness"),
    ("input", "Normal", "normal", "Normal"),
    *(("normal", "Normal", role, "Normal") for role in ("skin", "near_skin")),
    *(("input", "Specular", role, "Specular IOR Level") for role in ("skin", "near_skin")),
    ("near_skin", "BSDF", "lobes", 1),
    ("skin", "BSDF", "lobes", 2),
    ("input", "Oil", "two_lobes", 0),
    ("two_lobes", "Value", "far_weight", 0),
    ("far_weight", "Value", "lobes", 0),
    ("facing", "Facing", "let_through", "Vector"),
    ("let_through", "Color", "beneath", 0),
    *(("let_through", "Alpha", role, TINT) for role in ("skin", "near_skin")),
    ("two_lobes", "Value", "beneath", 1),
    ("near_part", "Vector", "near_shown", 0),
    ("beneath", "Value", "near_shown", "Scale"),
    ("near_shown", "Vector", "near_light", "Color"),
    ("normal", "Normal", "near_light", "Normal"),
    ("lobes", "Shader", "light", 0),
    ("near_light", "BSDF", "light", 1),
    ("light", "Shader", "output", "Surface"),
    ("mixed_colour", "Vector", "output", "Colour"),
    ("width", "Color", "output", "Far Width"),
    ("ratio", "Vector", "output", "Ratio"),
    ("near", "Color", "output", "Near Share"),
    ("share", "Value", "output", "Share"),
)
"""From a role and its output to a role and its input; by name or identifier, or by number where
names are alike or a node of earlier plans has others."""
