"""A skin's material at one wavelength: a near share, Burley's profile for the rest, and a surface.

Freckles and moles are spots of more melanin; sunscreen and water are films that take light twice.
"""

from collections.abc import Mapping

import bpy
import numpy as np

from examples.demo import scene
from examples.figures.spectral_shots import WET_FROM, SpectralShot

INDEX = 1.5526
"""Of the stratum corneum in the visible."""

LET_IN = 0.954
"""Share of light that Cycles' surface of that index lets in, straight on."""

RADIUS_PER_MILLIMETRE = 4.0 * np.pi * 1.04 * 0.001
"""Cycles' radius of a profile, in metres, for a width in mm."""

FRECKLES, MOLES = (130.0, 0.30, 0.12, 0.75), (28.0, 0.075, 0.05, 1.0)
"""Cells to a metre, radii in cells at which spots end and are full, and how dark they become."""

WATER_ROUGHNESS, SUNSCREEN_ROUGHNESS = 0.06, 0.18
DROPS = (60.0, 0.33, 0.27, 1.0)
"""Of water, as of `FRECKLES`."""


def skin_material(
    look: Mapping[str, np.ndarray], spots: np.ndarray, shot: SpectralShot
) -> bpy.types.Material:
    """The material of a look, by the names of `examples.figures.spectral_looks.Look`."""
    material = bpy.data.materials.new("Skin at a wavelength")
    if material.node_tree is None:
        material.use_nodes = True  # Blender 4.5
    tree = material.node_tree
    tree.nodes.clear()
    colour = _colour(tree, look["colours"], spots, shot.spots)
    roughness = None
    if shot.films:
        colour, roughness = _under_films(tree, colour, look)
    near = np.clip(look["near"], 0.01, 0.99) if shot.scattering else np.ones(3)
    part = float(near.mean())
    surfaces = []
    for share, scatters in ((near / part, False), ((1.0 - near) / max(1.0 - part, 1e-6), True)):
        if not shot.scattering and scatters:
            continue
        surface = _surface(tree, float(look["roughness"]))
        if roughness is not None:
            tree.links.new(roughness, surface.inputs["Roughness"])
        if scatters:
            surface.subsurface_method = "BURLEY"
            surface.inputs["Subsurface Weight"].default_value = 1.0
            surface.inputs["Subsurface Radius"].default_value = look["width"].tolist()
            surface.inputs["Subsurface Scale"].default_value = RADIUS_PER_MILLIMETRE
        tree.links.new(_times(tree, colour, share / LET_IN), surface.inputs["Base Color"])
        surfaces.append(surface.outputs["BSDF"])
    output = tree.nodes.new("ShaderNodeOutputMaterial")
    shown = surfaces[0] if len(surfaces) == 1 else _mixed(tree, surfaces, 1.0 - part)
    tree.links.new(shown, output.inputs["Surface"])
    return material


def _surface(tree, roughness: float):
    surface = tree.nodes.new("ShaderNodeBsdfPrincipled")
    surface.inputs["IOR"].default_value = INDEX
    surface.inputs["Roughness"].default_value = roughness
    return surface


def _mixed(tree, surfaces, factor: float):
    mix = tree.nodes.new("ShaderNodeMixShader")
    mix.inputs[0].default_value = factor
    for number, surface in enumerate(surfaces, 1):
        tree.links.new(surface, mix.inputs[number])
    return mix.outputs[0]


def _colour(tree, colours: np.ndarray, spots: np.ndarray, spotted: bool):
    """Socket of the colour: of the skin, or by how much melanin a spot has."""
    ramp = tree.nodes.new("ShaderNodeValToRGB")
    elements = ramp.color_ramp.elements
    elements[0].position, elements[1].position = 0.0, 1.0
    places = spots / spots[-1]
    for place in places[1:-1]:
        elements.new(float(place))
    for element, colour in zip(elements, colours, strict=True):
        element.color = (*np.clip(colour, 0.0, 1.0), 1.0)
    ramp.inputs[0].default_value = 0.0
    if spotted:
        both = _math(tree, "MAXIMUM", _spots(tree, *FRECKLES), _spots(tree, *MOLES))
        tree.links.new(both, ramp.inputs[0])
    return ramp.outputs["Color"]


def _spots(tree, cells: float, outer: float, inner: float, most: float):
    """Socket of round spots, some in each cell of space, 0 beside them."""
    place = tree.nodes.new("ShaderNodeTexCoord")
    spots = tree.nodes.new("ShaderNodeTexVoronoi")
    spots.inputs["Scale"].default_value = cells
    shape = tree.nodes.new("ShaderNodeMapRange")
    shape.interpolation_type = "SMOOTHSTEP"
    for name, value in (("From Min", outer), ("From Max", inner), ("To Max", most)):
        shape.inputs[name].default_value = value
    tree.links.new(place.outputs["Object"], spots.inputs["Vector"])
    tree.links.new(spots.outputs["Distance"], shape.inputs["Value"])
    return shape.outputs["Result"]


def _under_films(tree, colour, look: Mapping[str, np.ndarray]):
    """Sockets of a colour under sunscreen and drops of water, and of the roughness there."""
    share = tree.nodes.new("ShaderNodeAttribute")
    share.attribute_name = scene.MASK
    bare = share.outputs["Fac"]
    screen = _math(tree, "SUBTRACT", 1.0, bare)
    water = _math(tree, "MULTIPLY", _spots(tree, *DROPS), _wet(tree))
    water = _math(tree, "MULTIPLY", water, bare)
    roughness = _value(tree, float(look["roughness"]))
    for film, kept, smooth in (
        (screen, float(look["sunscreen"]), SUNSCREEN_ROUGHNESS),
        (water, float(look["water"]), WATER_ROUGHNESS),
    ):
        colour = _scaled(tree, colour, _between(tree, film, _value(tree, 1.0), kept))
        roughness = _between(tree, film, roughness, smooth)
    return colour, roughness


def _wet(tree):
    """Socket of where drops lie: the left side of the back."""
    place = tree.nodes.new("ShaderNodeTexCoord")
    parts = tree.nodes.new("ShaderNodeSeparateXYZ")
    tree.links.new(place.outputs["Object"], parts.inputs["Vector"])
    return _math(tree, "LESS_THAN", parts.outputs["X"], WET_FROM)


def _between(tree, factor, first, second: float):
    """Socket of first + factor (second - first)."""
    mix = tree.nodes.new("ShaderNodeMix")
    tree.links.new(factor, mix.inputs["Factor"])
    tree.links.new(first, mix.inputs["A"])
    mix.inputs["B"].default_value = second
    return mix.outputs["Result"]


def _value(tree, number: float):
    node = tree.nodes.new("ShaderNodeValue")
    node.outputs[0].default_value = number
    return node.outputs[0]


def _math(tree, operation: str, *inputs):
    node = tree.nodes.new("ShaderNodeMath")
    node.operation = operation
    for number, value in enumerate(inputs):
        if isinstance(value, float):
            node.inputs[number].default_value = value
        else:
            tree.links.new(value, node.inputs[number])
    return node.outputs[0]


def _times(tree, colour, factors: np.ndarray):
    """Socket of a colour times three numbers."""
    node = tree.nodes.new("ShaderNodeVectorMath")
    node.operation = "MULTIPLY"
    node.inputs[1].default_value = factors.tolist()
    tree.links.new(colour, node.inputs[0])
    return node.outputs[0]


def _scaled(tree, colour, factor):
    """Socket of a colour times one number."""
    node = tree.nodes.new("ShaderNodeVectorMath")
    node.operation = "SCALE"
    tree.links.new(colour, node.inputs[0])
    tree.links.new(factor, node.inputs["Scale"])
    return node.outputs[0]
