"""Which of an object's materials are skin: what the artist ticked, or else a guess."""

import re
from collections.abc import Iterator
from typing import Any, cast

import bpy
import numpy as np
from numpy.typing import NDArray

from .changes import Changes
from .masks import current_depsgraph, evaluated_mesh
from .ownership import is_local, remembered
from .painted import areas_of_faces, is_like_skin, painted_colour
from .plan import DAY_PROPERTY
from .trees import chain, tan_groups, tree_of

SKIN = frozenset(
    """
    skin body face head ear lip nail fingernail toenail nipple areola aureola areolae aureolae arm
    leg torso hand foot feet neck genital limb chest belly breast finger toe eyelid scalp
    haut körper koerper gesicht kopf peau corps visage piel cuerpo cara pelle corpo viso
    """.split()
)
"""Words in names of materials of skin."""

OTHER = frozenset(
    """
    eye eyeball iris cornea sclera pupil tear tearline occlusion caruncle teeth tooth tongue gum
    mouth hair eyelash lash eyebrow brow beard mustache fur cloth clothing clothes garment shirt
    tshirt pant trouser jean short shoe boot sandal dress skirt sock stocking hat cap glass
    glasses bikini swimsuit bodysuit suit underwear bra panties panty brief belt jacket coat glove
    jewel jewelry ring earring necklace metal fabric leather denim cotton button zipper prop
    auge zahn zähne haar wimper braue kleid hose hemd schuh cheveux cheveu oeil dent ojo pelo
    """.split()
)
"""Words in names of materials that are none."""

SKIN_SIGNS = tuple("肌体顔首手足耳唇")
OTHER_SIGNS = tuple("目瞳髪眉歯服舌睫毛靴")
COMPOUND = 4
"""Letters of a word of skin that may end another word: humanbody, mainskin."""

RELINKED = "skin_tan_relinked"
"""Custom property of a material of one object: its slot was the mesh's and became the object's."""

ADDED = "skin_tan_slot"
"""Custom property of a material of ours: its slot was added for it, the mesh's only one."""


def materials_of(obj: bpy.types.Object) -> list[bpy.types.Material]:
    """Materials in an object's slots, each once."""
    return list(dict.fromkeys(slot.material for slot in obj.material_slots if slot.material))


def shown_groups(obj: bpy.types.Object) -> Iterator[bpy.types.NodeTree]:
    """Tan groups that an object's materials show, each once, at any depth."""
    shown = dict.fromkeys(materials_of(obj))
    if remembered(obj).material is not None:
        shown[remembered(obj).material] = None  # geometry nodes may show it
    yield from dict.fromkeys(group for one in shown for group in tan_groups(tree_of(one)))


def has_tan(obj: bpy.types.Object) -> bool:
    """Whether an object has been given a tan, or a material with that of another."""
    settings = remembered(obj)
    is_timed = DAY_PROPERTY in obj and bool(any(settings.keyed) or settings.applied)
    return settings.group is not None or is_timed or any(shown_groups(obj))


def is_all_tanned(obj: bpy.types.Object) -> bool:
    """Whether every material that is ticked to tan shows a tan, and there is one."""
    shown = materials_of(obj)
    entries = remembered(obj).materials
    ticked = [entry.material for entry in entries if entry.tans and entry.material in shown]
    return bool(ticked) and all(any(tan_groups(tree_of(block))) for block in ticked)


def shown_trees(obj: bpy.types.Object, group: bpy.types.NodeTree) -> Iterator[bpy.types.NodeTree]:
    """Local node trees of an object that lead to a group, from its materials on."""
    for block in chain(materials_of(obj), group):
        if block != group and is_local(block):
            yield tree_of(block)


def is_set_elsewhere(obj: bpy.types.Object) -> bool:
    """Whether geometry nodes put materials without a tan on all faces of an object."""
    if not any(modifier.type == "NODES" for modifier in obj.modifiers):
        return False
    shown = evaluated_mesh(obj, current_depsgraph())
    if shown is None:
        return False
    polygons: Any = shown.polygons
    indices = np.zeros(len(polygons), np.int32)
    polygons.foreach_get("material_index", indices)
    held = [material for material in shown.materials]
    last = len(held) - 1
    seen = [held[index] for index in np.unique(indices.clip(0, last))] if held else []
    return any(seen) and not any(
        any(tan_groups(tree_of(material.original))) for material in seen if material is not None
    )


def is_skin_by_name(name: str) -> bool | None:
    """Whether a material's name says that it is skin; None where it says nothing."""
    split = re.sub(r"(?<=[a-zäöüß])(?=[A-ZÄÖÜ])", " ", name).lower()
    words = {word for word in re.split(r"[\W\d_]+", split) if word}
    words |= {word.removesuffix("s") for word in words}
    if words & OTHER or any(sign in name for sign in OTHER_SIGNS):
        return False
    ends = tuple(word for word in SKIN if len(word) >= COMPOUND)
    if words & SKIN or any(sign in name for sign in SKIN_SIGNS):
        return True
    return True if any(word.endswith(ends) for word in words) else None


def faces_of_slots(obj: bpy.types.Object) -> list[int]:
    """How many faces show each slot of a mesh object."""
    return _of_slots(obj)


def areas(obj: bpy.types.Object) -> dict[bpy.types.Material, float]:
    """What area of a mesh object shows each material, in its own units."""
    return _of_materials(obj, _of_slots(obj, areas_of_faces(cast(Any, obj.data))))


def _of_slots(obj: bpy.types.Object, of_faces: NDArray[np.float32] | None = None) -> list[Any]:
    """Sums over the faces that show each slot, of a number of every face or of ones."""
    polygons: Any = cast(bpy.types.Mesh, obj.data).polygons
    indices = np.zeros(len(polygons), np.int32)
    polygons.foreach_get("material_index", indices)
    last = max(len(obj.material_slots) - 1, 0)
    return np.bincount(indices.clip(0, last), of_faces, minlength=last + 1).tolist()


def _of_materials(obj: bpy.types.Object, of_slots: list[Any]) -> dict[bpy.types.Material, Any]:
    """Sums over the slots that hold each material."""
    sums = dict.fromkeys(materials_of(obj), 0)
    for slot, number in zip(obj.material_slots, of_slots, strict=False):
        if slot.material is not None:
            sums[slot.material] += number
    return sums


def ticks(
    obj: bpy.types.Object, group: bpy.types.NodeTree | None
) -> dict[bpy.types.Material, bool]:
    """Of the materials in an object's slots, which are to tan.

    What the artist has said counts. Of other materials those that show the object's tan do, and
    those with faces that look like skin: by name, by colour, or, if nothing tells, the one with
    most faces.

    Parameters
    ----------
    group : ShaderNodeTree or None
        Of the object's tan.
    """
    shown = materials_of(obj)
    entries = remembered(obj).materials
    said = {entry.material: entry.tans for entry in entries if entry.material in shown}
    inside = {material: set(tan_groups(tree_of(material))) for material in shown}
    result = {material: said.get(material, group in inside[material]) for material in shown}
    if not said and any(result.values()):
        return result  # of an earlier version, which served one slot
    unsaid = [material for material in shown if material not in said and not inside[material]]
    is_first = not any(result.values())
    return {**result, **dict.fromkeys(_guess(obj, unsaid, is_first=is_first and not said), True)}


def _guess(
    obj: bpy.types.Object, materials: list[bpy.types.Material], *, is_first: bool
) -> list[bpy.types.Material]:
    """Those of some materials of an object that are skin; at first there must be one."""
    counts = _of_materials(obj, faces_of_slots(obj))
    if any(counts.values()):
        materials = [material for material in materials if counts[material]]
    names = {material: is_skin_by_name(material.name) for material in materials}
    skin = [material for material in materials if names[material]]
    unnamed = [material for material in materials if names[material] is None]
    if not skin:
        skin = [block for block in unnamed if is_like_skin(painted_colour(obj, block))]
    if not skin and is_first and materials:
        skin = [max(unnamed or materials, key=lambda material: counts[material])]
    return skin


def remember(
    obj: bpy.types.Object, ticked: dict[bpy.types.Material, bool], changes: Changes
) -> None:
    """Write into an object's settings which materials are to tan."""
    entries = remembered(obj).materials
    former = [(entry.material, entry.tans) for entry in entries]
    if former == list(ticked.items()):
        return
    changes.on_failure(_write, entries, former)
    _write(entries, list(ticked.items()))


def _write(entries: Any, values: list[tuple[bpy.types.Material, bool]]) -> None:
    entries.clear()
    for material, tans in values:
        entry = entries.add()
        entry.material, entry.tans = material, tans


def put(
    obj: bpy.types.Object,
    slot: Any,
    material: bpy.types.Material | None,
    changes: Changes,
) -> None:
    """Put a material into a slot of one object alone."""
    if obj.data.users > 1 and slot.link == "DATA":
        # Other objects have this mesh too: they keep their own skin.
        changes.set(slot, "link", "OBJECT")
        if material is not None:
            material[RELINKED] = True
    changes.set(slot, "material", material)


def remove_added(obj: bpy.types.Object) -> None:
    """Remove the only slot of an object's mesh, where it is empty on all objects with the mesh."""
    mesh: Any = obj.data
    sharing = [other for other in bpy.data.objects if other.data == mesh]
    if len(mesh.materials) == 1 and not any(materials_of(other) for other in sharing):
        # Blender sets the faces' numbers of slots to 0 then.
        numbers = np.zeros(len(mesh.polygons), np.int32)
        mesh.polygons.foreach_get("material_index", numbers)
        mesh.materials.clear()
        if numbers.any():
            mesh.polygons.foreach_set("material_index", numbers)
