"""Materials as artists and character generators build them."""

import bpy
import numpy as np

PAINTED = (0.42, 0.23, 0.16)


def empty_material(name: str):
    material = bpy.data.materials.new(name)
    if material.node_tree is None:
        material.use_nodes = True
    material.node_tree.nodes.clear()
    return material


def add(tree, kind: str, location=(0, 0), **values):
    """A new node; `values` are its attributes."""
    node = tree.nodes.new(kind)
    node.location = location
    for name, value in values.items():
        setattr(node, name, value)
    return node


def output_of(tree, shader) -> None:
    surface = add(tree, "ShaderNodeOutputMaterial", (600, 0))
    tree.links.new(shader, surface.inputs["Surface"])


def principled(tree, colour=PAINTED, **inputs):
    node = add(tree, "ShaderNodeBsdfPrincipled", (200, 0))
    node.inputs["Base Color"].default_value = (*colour, 1.0)
    node.inputs["Roughness"].default_value = 0.37
    for name, value in inputs.items():
        node.inputs[name.replace("_", " ")].default_value = value
    return node


def image(name: str, colours, *, tiled: bool = False):
    """A float image of (rows, columns, 3) linear colours."""
    values = np.asarray(colours, dtype=np.float32)
    rows, columns, _ = values.shape
    made = bpy.data.images.new(name, columns, rows, float_buffer=True, tiled=tiled)
    pixels = np.ones((rows, columns, 4), np.float32)
    pixels[..., :3] = values
    made.pixels.foreach_set(pixels.ravel())
    made.update()
    if not tiled:
        made.pack()
    return made


def texture(tree, colours=((PAINTED,),), **options):
    return add(tree, "ShaderNodeTexImage", (-400, 0), image=image("Painted", colours, **options))


def plain(name: str):
    material = empty_material(name)
    output_of(material.node_tree, principled(material.node_tree).outputs[0])
    return material


def textured(name: str, **options):
    """With a normal map and a roughness map besides."""
    material = empty_material(name)
    tree = material.node_tree
    skin = principled(tree)
    bump, rough = add(tree, "ShaderNodeBump"), texture(tree, [[[0.5] * 3]])
    tree.links.new(texture(tree, **options).outputs["Color"], skin.inputs["Base Color"])
    tree.links.new(rough.outputs["Color"], skin.inputs["Roughness"])
    tree.links.new(rough.outputs["Color"], bump.inputs["Height"])
    tree.links.new(bump.outputs["Normal"], skin.inputs["Normal"])
    output_of(tree, skin.outputs[0])
    return material


def tiled(name: str):
    return textured(name, tiled=True)


def mixed(name: str):
    """Two shaders, one from a mix of colours and one of a plain colour, in a frame, rerouted."""
    material = empty_material(name)
    tree = material.node_tree
    frame = add(tree, "NodeFrame", (100, 50))
    first, second = principled(tree), principled(tree, (0.3, 0.1, 0.08), Subsurface_Weight=0.3)
    first.parent = frame
    colours = add(tree, "ShaderNodeMix", data_type="RGBA")
    colours.inputs["Factor"].default_value = 0.25
    ends = {end.identifier: end for end in (*colours.inputs, *colours.outputs)}
    ends["B_Color"].default_value = (0.2, 0.1, 0.3, 1.0)
    tree.links.new(texture(tree).outputs["Color"], ends["A_Color"])
    knot = add(tree, "NodeReroute")
    tree.links.new(ends["Result_Color"], knot.inputs[0])
    tree.links.new(knot.outputs[0], first.inputs["Base Color"])
    lobes = add(tree, "ShaderNodeMixShader")
    tree.links.new(first.outputs[0], lobes.inputs[1])
    tree.links.new(second.outputs[0], lobes.inputs[2])
    output_of(tree, lobes.outputs[0])
    return material


def other_shaders(name: str):
    """Diffuse and subsurface light added, gloss over it."""
    material = empty_material(name)
    tree = material.node_tree
    diffuse = add(tree, "ShaderNodeBsdfDiffuse")
    under = add(tree, "ShaderNodeSubsurfaceScattering")
    gloss, lobes = add(tree, "ShaderNodeBsdfAnisotropic"), add(tree, "ShaderNodeMixShader")
    both = add(tree, "ShaderNodeMixShader")
    lobes.inputs[0].default_value = 0.2
    for node in (diffuse, under):
        node.inputs["Color"].default_value = (*PAINTED, 1.0)
    tree.links.new(diffuse.outputs[0], both.inputs[1])
    tree.links.new(under.outputs[0], both.inputs[2])
    tree.links.new(both.outputs[0], lobes.inputs[1])
    tree.links.new(gloss.outputs[0], lobes.inputs[2])
    output_of(tree, lobes.outputs[0])
    return material


def emission(name: str):
    material = empty_material(name)
    tree = material.node_tree
    light = add(tree, "ShaderNodeEmission")
    light.inputs["Color"].default_value = (*PAINTED, 1.0)
    output_of(tree, light.outputs[0])
    return material


def vertex_colours(name: str):
    material = empty_material(name)
    tree = material.node_tree
    skin = principled(tree)
    colours = add(tree, "ShaderNodeVertexColor", layer_name="Paint")
    tree.links.new(colours.outputs["Color"], skin.inputs["Base Color"])
    output_of(tree, skin.outputs[0])
    return material


def shader_group(name: str, *, colour_input: bool = True):
    """A group with a Principled BSDF, its colour from an input or else from a texture."""
    group = bpy.data.node_groups.new(name, "ShaderNodeTree")
    group.interface.new_socket("Shader", in_out="OUTPUT", socket_type="NodeSocketShader")
    entry = group.interface.new_socket("Colour", in_out="INPUT", socket_type="NodeSocketColor")
    entry.default_value = (*PAINTED, 1.0)
    start, skin = add(group, "NodeGroupInput"), principled(group)
    exit_ = add(group, "NodeGroupOutput")
    bright = add(group, "ShaderNodeBrightContrast")
    source = start.outputs["Colour"] if colour_input else texture(group).outputs["Color"]
    group.links.new(source, bright.inputs["Color"])
    group.links.new(bright.outputs[0], skin.inputs["Base Color"])
    group.links.new(skin.outputs[0], exit_.inputs["Shader"])
    return group


def show(tree, group, colour=PAINTED):
    node = add(tree, "ShaderNodeGroup", node_tree=group)
    node.inputs["Colour"].default_value = (*colour, 1.0)
    return node


def grouped(name: str):
    """As MPFB's ENHANCED SSS: all of it in one group with textures."""
    material = empty_material(name)
    node = show(material.node_tree, shader_group(f"{name} all", colour_input=False))
    output_of(material.node_tree, node.outputs[0])
    return material


def layered(name: str):
    """As MPFB's LAYERED: parts in groups, one of them used twice, mixed in another group."""
    material = empty_material(name)
    tree = material.node_tree
    router = bpy.data.node_groups.new(f"{name} router", "ShaderNodeTree")
    for part in ("Body", "Fingers", "Toes"):
        router.interface.new_socket(part, in_out="INPUT", socket_type="NodeSocketShader")
    router.interface.new_socket("Shader", in_out="OUTPUT", socket_type="NodeSocketShader")
    start, exit_ = add(router, "NodeGroupInput"), add(router, "NodeGroupOutput")
    lobes = [add(router, "ShaderNodeMixShader") for _ in range(2)]
    router.links.new(start.outputs["Body"], lobes[0].inputs[1])
    router.links.new(start.outputs["Fingers"], lobes[0].inputs[2])
    router.links.new(lobes[0].outputs[0], lobes[1].inputs[1])
    router.links.new(start.outputs["Toes"], lobes[1].inputs[2])
    router.links.new(lobes[1].outputs[0], exit_.inputs["Shader"])
    nails = shader_group(f"{name} nails")
    outer = bpy.data.node_groups.new(f"{name} body", "ShaderNodeTree")
    outer.interface.new_socket("Shader", in_out="OUTPUT", socket_type="NodeSocketShader")
    outer.interface.new_socket("Colour", in_out="INPUT", socket_type="NodeSocketColor")
    inner = show(outer, shader_group(f"{name} inner"))
    outer.links.new(add(outer, "NodeGroupInput").outputs["Colour"], inner.inputs["Colour"])
    outer.links.new(inner.outputs[0], add(outer, "NodeGroupOutput").inputs["Shader"])
    parts = {"Body": show(tree, outer), "Fingers": show(tree, nails, (0.6, 0.4, 0.3))}
    parts["Toes"] = show(tree, nails, (0.5, 0.3, 0.3))
    whole = add(tree, "ShaderNodeGroup", node_tree=router)
    for part, node in parts.items():
        tree.links.new(node.outputs[0], whole.inputs[part])
    output_of(tree, whole.outputs[0])
    return material


def makeskin(name: str):
    """As MPFB's MAKESKIN: texture times intensity times occlusion, mixed with transparency."""
    material = empty_material(name)
    tree = material.node_tree
    skin = principled(tree, Subsurface_Weight=0.2)
    intensity, occlusion = (add(tree, "ShaderNodeMixRGB", blend_type="MULTIPLY") for _ in range(2))
    for node, share in ((intensity, 0.0), (occlusion, 1.0)):
        node.inputs["Fac"].default_value = share
        node.inputs["Color2"].default_value = (0.9, 0.8, 0.7, 1.0)
    paint = texture(tree)
    tree.links.new(paint.outputs["Color"], intensity.inputs["Color1"])
    tree.links.new(intensity.outputs["Color"], occlusion.inputs["Color1"])
    tree.links.new(occlusion.outputs["Color"], skin.inputs["Base Color"])
    clear, opacity = add(tree, "ShaderNodeBsdfTransparent"), add(tree, "ShaderNodeMixShader")
    tree.links.new(paint.outputs["Alpha"], opacity.inputs[0])
    tree.links.new(clear.outputs[0], opacity.inputs[1])
    tree.links.new(skin.outputs[0], opacity.inputs[2])
    output_of(tree, opacity.outputs[0])
    return material


KINDS = (
    plain,
    textured,
    tiled,
    mixed,
    other_shaders,
    emission,
    vertex_colours,
    grouped,
    layered,
    makeskin,
)


def wear(obj, materials) -> None:
    """A slot and a face for each of some materials."""
    for number, material in enumerate(materials):  # None is an empty slot
        obj.data.materials.append(material)
        obj.data.polygons[number].material_index = number
