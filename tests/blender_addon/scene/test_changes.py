"""An exception in the midst of Apply leaves the file as it was."""

import inspect
import sys
from collections import Counter
from functools import cache, partial
from pathlib import Path

import bpy
import pytest
from artist_skins import layered, mixed, wear
from bpy_extras.anim_utils import action_get_channelbag_for_slot
from scenes import add_mask, apply, look, tan_object
from state import state

import blender_addon.apply as module
from blender_addon.removal import remove_tan
from blender_addon.scene import changes
from blender_addon.scene.links import link_at

FILE = Path(__file__).parents[1] / "data" / "first_version.blend"
ROOMS = (
    "blender_addon/scene/",
    "blender_addon/removal.py",
    "blender_addon/apply.py",
    "blender_addon/own_colour.py",
    "blender_addon/views.py",
)
COLLECTIONS = ("images", "materials", "node_groups", "actions", "meshes", "objects")


class StoppedError(Exception):
    """What a test raises."""


@cache
def is_of_rooms(filename: str) -> bool:
    return any(room in filename.replace("\\", "/") for room in ROOMS)


def is_left_alone(frame) -> bool:
    """Whether changes are undone or ended here, or Blender would swallow an exception."""
    while frame is not None and frame.f_code.co_name not in LEFT_ALONE:
        frame = frame.f_back
    return frame is not None


LEFT_ALONE = ("__exit__", "kinetics_of", "redness_of")
"""Names of functions: the last two get properties for Blender."""


def stopped_at(number: int, obj, function=None) -> bool:
    """Apply with an exception at the n-th stop; whether it came so far.

    Stops are lines of the add-on, before they run for the first, second, fourth, eighth ... time:
    most of the time loops run that look for nodes, and change nothing.
    """
    count, function = 0, function or partial(module.apply_tan, scene=bpy.context.scene)
    times = Counter()
    code = getattr(function, "func", function).__code__
    source, first_line = inspect.getsourcelines(code)
    with_line = first_line + source.index("    with Changes() as changes:\n")

    def called(frame, event, argument):
        return line if is_of_rooms(frame.f_code.co_filename) and not is_left_alone(frame) else None

    def line(frame, event, argument):
        nonlocal count
        # Python comes back to the line of the `with` on its way to `__exit__`.
        if event == "line" and not (frame.f_code is code and frame.f_lineno == with_line):
            place = frame.f_code, frame.f_lineno
            times[place] += 1
            if times[place].bit_count() == 1:
                count += 1
                if count == number:
                    sys.settrace(None)
                    raise StoppedError
        return line

    former = sys.gettrace()
    sys.settrace(called)
    try:
        function(obj)
    except StoppedError:
        return True
    finally:
        sys.settrace(former)
    assert count < number, "the exception was swallowed"
    return False


def inventory() -> dict:
    """All that Apply might change."""
    blocks = [block for name in COLLECTIONS for block in getattr(bpy.data, name)]
    records = {block: (block.name, block.users, block.use_fake_user) for block in blocks}
    return {
        "blocks": records,
        "trees": {group: contents(group) for group in bpy.data.node_groups},
        "materials": {block: contents(block.node_tree) for block in bpy.data.materials},
        "objects": {obj: of_object(obj) for obj in bpy.data.objects},
        "actions": {action: of_action(action) for action in bpy.data.actions},
    }


def contents(tree) -> tuple:
    if tree is None:  # a new material's in Blender 4.5
        return ()
    nodes = [
        (
            node.name,
            dict(node.items()),
            getattr(node, "image", None),
            getattr(node, "node_tree", None),
            getattr(node, "attribute_name", None),
            [plain(getattr(end, "default_value", None)) for end in (*node.inputs, *node.outputs)],
        )
        for node in tree.nodes
    ]
    return nodes, sorted(links(tree)), dict(tree.items())


def links(tree) -> list:
    return [
        (
            link.from_socket.path_from_id(),
            link.to_socket.path_from_id(),
            link.is_muted,
            link.multi_input_sort_id,
        )
        for link in tree.links
    ]


def plain(value):
    return tuple(value) if hasattr(value, "__len__") else value


def of_object(obj) -> tuple:
    animation, settings = obj.animation_data, obj.skin_tan
    slots = [(slot.link, slot.material) for slot in obj.material_slots]
    animated = animation and (animation.action, animation.action_slot)
    shown = obj.id_properties_ui("tan_day").as_dict() if "tan_day" in obj else None
    return slots, animated, settings.group, settings.material, obj.get("tan_day"), shown


def of_action(action) -> list:
    slots = [slot.identifier for slot in action.slots]
    bags = [action_get_channelbag_for_slot(action, slot) for slot in action.slots if action.layers]
    curves = [
        (curve.data_path, curve.extrapolation, [key_values(key) for key in curve.keyframe_points])
        for bag in bags
        if bag is not None
        for curve in bag.fcurves
    ]
    return [slots, len(action.layers), curves]


def key_values(key) -> tuple:
    return (*key.co, key.handle_left_type, key.handle_right_type, key.interpolation, key.easing)


def new(table_path):
    """An object with a material and an animation of the artist's own."""
    obj = tan_object(table_path)
    material = bpy.data.materials.new("Mine")
    if material.node_tree is None:  # Blender 4.5 makes it without nodes
        material.use_nodes = True
    obj.data.materials.append(material)
    obj.keyframe_insert("location", frame=3)
    return obj


def again(table_path):
    """After an Apply, with keys that the artist retimed."""
    obj = tan_object(table_path)
    apply(obj)
    animation = obj.animation_data
    bag = action_get_channelbag_for_slot(animation.action, animation.action_slot)
    key = bag.fcurves.find('["tan_day"]').keyframe_points[0]
    key.interpolation, key.easing = "BACK", "EASE_OUT"
    obj.skin_tan.last_frame, obj.skin_tan.last_day = 99, 10.0
    add_mask(obj, [1.0] * 4)
    return obj


def shared(table_path):
    """A linked duplicate of an object with a tan."""
    obj = tan_object(table_path)
    apply(obj)
    copy = obj.copy()
    bpy.context.collection.objects.link(copy)
    copy.skin_tan.last_day = 10.0
    return copy


def without_slots(table_path):
    """Of two objects with a mesh that has no material slot."""
    obj = tan_object(table_path)
    bpy.context.collection.objects.link(bpy.data.objects.new("Twin", obj.data))
    return obj


def of_first_version(table_path):
    bpy.ops.wm.open_mainfile(filepath=str(FILE))
    twin = bpy.data.objects["Twin"]
    twin.skin_tan.exposures[0].dose = 5.0
    return twin


def of_layout_1(table_path):
    """With a material and a group that an artist changed."""
    bpy.ops.wm.open_mainfile(filepath=str(FILE.with_name("layout_1.blend")))
    body = bpy.data.objects["Body"]
    body.skin_tan.exposures[0].dose = 5.0
    return body


def turned(table_path, name: str, material, *, on: bool):
    """With a setting that Apply has not met yet."""
    obj = tan_object(table_path)
    wear(obj, [material("skin")] if material else [])
    apply(obj)
    setattr(obj.skin_tan, name, True)
    if not on:
        apply(obj)
        setattr(obj.skin_tan, name, False)
    return obj


SCENES = {
    scene.__name__: scene
    for scene in (new, again, shared, without_slots, of_first_version, of_layout_1)
}
TURNED = {
    f"{name}_{'on' if on else 'off'}": partial(turned, name=name, material=material, on=on)
    for name, material in (("own_colour", mixed), ("peeling", None))
    for on in (True, False)
}
STEP, APART = 83, 14
"""Every so many stops are tried; the first is so many later from scene to scene. With a step of 1
the tests take minutes."""


@pytest.mark.parametrize(
    "name", [*SCENES, *(pytest.param(name, marks=pytest.mark.slow) for name in TURNED)]
)
def test_an_exception_anywhere(table_path, monkeypatch, name):
    scenes = SCENES | TURNED
    obj = scenes[name](table_path)
    tan = module.tan_of(obj.skin_tan.values())
    monkeypatch.setattr(module, "tan_of", lambda values, **more: tan)
    bpy.context.view_layer.update()
    before, number = inventory(), 1 + APART * list(scenes).index(name)
    seen = look(obj) if bpy.data.images else b""
    while stopped_at(number, obj):
        assert inventory() == before, f"at stop {number}"
        number += STEP
    assert number > 1500
    assert inventory() != before
    assert look(obj) != seen


def test_an_exception_anywhere_in_remove(table_path):
    """With copies of shared materials and groups, and an action of the artist's."""
    obj = tan_object(table_path)
    wear(obj, [layered("skin")])
    hands = bpy.data.objects.new("Hands", bpy.data.meshes.new("Hands"))
    hands.data.materials.append(obj.data.materials[0])
    obj.keyframe_insert("location", frame=3)
    apply(obj)
    bpy.context.view_layer.update()
    before, kept, number = inventory(), state(), 1
    while stopped_at(number, obj, remove_tan):
        assert inventory() == before and state() == kept, f"at stop {number}"
        number += 149
    assert number > 1000
    assert obj.skin_tan.group is None


def test_what_cannot_be_undone_waits_for_the_end():
    image = bpy.data.images.new("Former", 4, 4)
    with pytest.raises(StoppedError), changes.Changes() as undone:
        undone.at_the_end(lambda: bpy.data.images.remove(image))
        undone.set(image, "name", "Changed")
        bpy.data.images.new("Made", 4, 4)
        raise StoppedError
    assert [image.name for image in bpy.data.images] == ["Former"]
    with changes.Changes() as done:
        done.at_the_end(lambda: bpy.data.images.remove(image))
    assert not bpy.data.images


def test_links_that_are_muted_or_of_several_into_one_input_return_in_their_order():
    tree = bpy.data.node_groups.new("Tree", "GeometryNodeTree")
    cubes = [tree.nodes.new("GeometryNodeMeshCube") for _ in range(4)]
    joined, moved = (
        tree.nodes.new(f"GeometryNode{kind}") for kind in ("JoinGeometry", "Transform")
    )
    made = [tree.links.new(cube.outputs[0], joined.inputs[0]) for cube in cubes]
    tree.links.new(cubes[1].outputs[0], moved.inputs[0]).is_muted = True
    made[0].swap_multi_input_sort_id(made[2])
    before = links(tree)
    with pytest.raises(StoppedError), changes.Changes() as undone:
        undone.may_relink(tree)
        for link in list(tree.links)[1::3]:
            tree.links.remove(link)
        tree.links.new(cubes[3].outputs[0], moved.inputs[0])
        tree.links[-2].is_muted = True
        assert links(tree) != before
        raise StoppedError
    assert links(tree) == before


def test_a_link_that_comes_again_has_its_place():
    """As Remove Tan gives a tree its links."""
    tree = bpy.data.node_groups.new("Tree", "GeometryNodeTree")
    cubes = [tree.nodes.new("GeometryNodeMeshCube") for _ in range(3)]
    joined, moved = (
        tree.nodes.new(f"GeometryNode{kind}") for kind in ("JoinGeometry", "Transform")
    )
    tree.links.new(cubes[0].outputs[0], moved.inputs[0]).is_muted = True
    made = [tree.links.new(cube.outputs[0], joined.inputs[0]) for cube in cubes]
    made[0].swap_multi_input_sort_id(made[2])
    before = links(tree)
    tree.links.remove(tree.links[0])
    link_at(tree, 0, (cubes[0].outputs[0], moved.inputs[0], True))
    assert links(tree) == before
