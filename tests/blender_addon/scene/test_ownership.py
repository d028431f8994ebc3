"""Apply changes the object that it is told to, whatever is shared and however things are called."""

import bpy
import pytest
from scenes import (
    LOOK_IMAGES,
    OWN_IMAGES,
    apply,
    look,
    modifier_input,
    of_role,
    set_modifier_input,
    tan_groups,
    tan_object,
)

from blender_addon.scene import images, materials, plan, timeline

LONG = ("x" * 62, "x" * 254, "ж" * 40, "肌" * 30, "😀" * 20)


@pytest.fixture
def body(table_path):
    obj = tan_object(table_path)
    apply(obj)
    return obj


def other(table_path, name: str, dose: float = 8.0):
    obj = tan_object(table_path, dose=dose)
    obj.name = name
    return obj


def group_node(obj):
    tree = obj.material_slots[0].material.node_tree
    return next(node for node in tree.nodes if node.bl_idname == "ShaderNodeGroup")


@pytest.mark.parametrize("prefix", LONG)
def test_names_that_meet_when_they_are_cut(table_path, prefix):
    first = other(table_path, prefix + "1", 30.0)
    apply(first)
    before = look(first)
    second = other(table_path, prefix + "2")
    apply(second)
    assert look(first) == before != look(second)
    apply(first)
    assert look(first) == before
    assert len(bpy.data.materials) == len(tan_groups()) == 2
    assert len(bpy.data.images) == 2 * OWN_IMAGES + LOOK_IMAGES


def test_a_name_given_on(body, table_path):
    before = look(body)
    body.name = "Anna"
    second = other(table_path, "Body")
    apply(second)
    assert look(body) == before != look(second)


@pytest.mark.parametrize("collection", ["materials", "node_groups", "actions", "objects"])
def test_what_is_renamed_is_found_again(body, collection):
    """And keeps the name that it was given."""
    for number, block in enumerate(getattr(bpy.data, collection)):
        block.name = f"Renamed {number}"
    names = {block.name for block in getattr(bpy.data, collection)}
    body.skin_tan.exposures[0].dose = 8.0
    apply(body)
    assert {block.name for block in getattr(bpy.data, collection)} == names
    assert len(bpy.data.materials) == len(tan_groups()) == 1
    assert len(bpy.data.images) == OWN_IMAGES + LOOK_IMAGES


def test_what_bears_the_names_is_not_the_add_on_s(table_path):
    obj = tan_object(table_path)
    material = bpy.data.materials.new("Skin Tan Body")
    groups = [
        bpy.data.node_groups.new("Skin Tan Body", kind)
        for kind in ("GeometryNodeTree", "ShaderNodeTree")
    ]
    groups[1].nodes.new("ShaderNodeRGB")
    picture = bpy.data.images.new("Skin Tan States Body", 4, 4)
    bpy.data.actions.new("BodyAction")
    for _ in range(2):
        assert apply(obj) == {"FINISHED"}
    assert obj.material_slots[0].material not in (None, material)
    assert [node.bl_idname for node in groups[1].nodes] == ["ShaderNodeRGB"]
    assert not groups[0].nodes and tuple(picture.size) == (4, 4)
    assert picture.name == "Skin Tan States Body"


def linked_duplicate(obj):
    copy = obj.copy()
    bpy.context.collection.objects.link(copy)
    return copy


def full_duplicate(obj):
    copy = linked_duplicate(obj)
    copy.data = obj.data.copy()
    return copy


@pytest.mark.parametrize("duplicate", [linked_duplicate, full_duplicate])
@pytest.mark.parametrize("which", ["copy", "original"])
def test_a_copy_and_its_original_tan_on_their_own(body, duplicate, which):
    group_node(body).inputs["Roughness"].default_value = 0.3
    copy = duplicate(body)
    before = look(body)
    assert look(copy) == before
    changed, kept = (copy, body) if which == "copy" else (body, copy)
    changed.skin_tan.exposures[0].dose, changed.skin_tan.last_day = 8.0, 10.0
    apply(changed)
    assert look(kept) == before != look(changed)
    bpy.context.scene.frame_set(250)
    assert (kept["tan_day"], changed["tan_day"]) == pytest.approx((30.0, 10.0))
    assert group_node(changed).inputs["Roughness"].default_value == pytest.approx(0.3)
    # From now on each has its own: nothing is copied any more.
    counts = len(bpy.data.materials), len(bpy.data.images), len(bpy.data.actions)
    assert counts == (2, 2 * OWN_IMAGES + LOOK_IMAGES, 2)
    apply(kept)
    apply(changed)
    assert (len(bpy.data.materials), len(bpy.data.images), len(bpy.data.actions)) == counts


@pytest.mark.parametrize("linked", [True, False])
def test_blender_s_own_duplicates(body, linked):
    body.select_set(True)
    bpy.ops.object.duplicate(linked=linked)
    copy, before = bpy.context.object, look(body)
    copy.skin_tan.exposures[0].dose, copy.skin_tan.last_day = 8.0, 10.0
    apply(copy)
    bpy.context.scene.frame_set(250)
    assert look(body) == before != look(copy)
    assert (body["tan_day"], copy["tan_day"]) == pytest.approx((30.0, 10.0))


def test_a_material_given_to_another_object_stays_as_it_was(body, capfd):
    """That object has no settings of its own; it is told who keeps what."""
    hands = bpy.data.objects.new("Hands", bpy.data.meshes.new("Hands"))
    hands.data.materials.append(body.material_slots[0].material)
    before = look(body)
    body.skin_tan.exposures[0].dose = 8.0
    apply(body)
    assert look(hands) == before != look(body)
    assert "The skin on 'Hands' stays as it was." in capfd.readouterr().out


def test_a_world_that_shows_the_group_stays_as_it_was(body):
    world = bpy.data.worlds.new("World")
    if world.node_tree is None:
        world.use_nodes = True
    node = world.node_tree.nodes.new("ShaderNodeGroup")
    group = node.node_tree = body.skin_tan.group
    former = of_role(body, "states").image
    apply(body)
    assert node.node_tree == group != body.skin_tan.group
    assert former in {inner.image for inner in group.nodes if hasattr(inner, "image")}


def test_an_appended_object_beside_its_source(body, tmp_path):
    before, path = look(body), str(tmp_path / "source.blend")
    bpy.data.libraries.write(path, {body})
    with bpy.data.libraries.load(path, link=False) as (_, wanted):
        wanted.objects = ["Body"]
    (appended,) = wanted.objects
    bpy.context.collection.objects.link(appended)
    assert appended.name == "Body.001" and look(appended) == before
    appended.skin_tan.exposures[0].dose = 8.0
    apply(appended)
    assert look(body) == before != look(appended)


def test_a_linked_material_is_copied(body, table_path, tmp_path):
    path = str(tmp_path / "library.blend")
    bpy.data.libraries.write(path, {body.material_slots[0].material})
    with bpy.data.libraries.load(path, link=True) as (_, wanted):
        wanted.materials = ["Skin Tan Body"]
    (linked,) = wanted.materials
    second = other(table_path, "Second")
    second.data.materials.append(linked)
    before = look(second)
    apply(second)
    assert look(second) != before and second.material_slots[0].material.library is None
    assert linked.library is not None and second.skin_tan.group.library is None


def test_an_action_with_other_slots_is_shared_on(body):
    """A slot of another object in the same action: nothing has to be copied."""
    action = body.animation_data.action
    camera = bpy.data.objects.new("Camera", None)
    camera.animation_data_create().action = action
    camera.animation_data.action_slot = action.slots.new("OBJECT", "Camera")
    camera.keyframe_insert("location", frame=5)
    body.skin_tan.last_day = 10.0
    apply(body)
    assert body.animation_data.action == camera.animation_data.action == action


def test_after_a_push_down_to_the_nla_the_day_is_right_at_once(body):
    animation = body.animation_data
    animation.nla_tracks.new().strips.new("days", 1, animation.action)
    animation.action = None
    bpy.context.scene.frame_set(250)
    body.skin_tan.last_day = 10.0
    apply(body)
    bpy.context.scene.frame_set(250)
    assert body["tan_day"] == pytest.approx(10.0)
    evaluated = body.evaluated_get(bpy.context.evaluated_depsgraph_get())
    assert evaluated["tan_day"] == pytest.approx(10.0)


def test_the_artist_s_group_around_the_tan_is_kept(body):
    tree = body.material_slots[0].material.node_tree
    outer = bpy.data.node_groups.new("My skin", "ShaderNodeTree")
    outer.nodes.new("ShaderNodeGroup").node_tree = body.skin_tan.group
    outer.nodes.new("ShaderNodeBump")
    tree.nodes.clear()
    tree.nodes.new("ShaderNodeGroup").node_tree = outer
    material, former = body.material_slots[0].material, of_role(body, "states").image.size[1]
    body.skin_tan.last_day = 10.0
    apply(body)
    assert body.material_slots[0].material == material
    assert [node.bl_idname for node in outer.nodes] == ["ShaderNodeGroup", "ShaderNodeBump"]
    assert len(tree.nodes) == 1 and len(tan_groups()) == 1
    assert of_role(body, "states").image.size[1] < former


def test_a_group_nested_in_a_shared_one_is_copied_with_it(body):
    tree = body.material_slots[0].material.node_tree
    outer = bpy.data.node_groups.new("My skin", "ShaderNodeTree")
    outer.nodes.new("ShaderNodeGroup").node_tree = body.skin_tan.group
    next(node for node in tree.nodes if node.bl_idname == "ShaderNodeGroup").node_tree = outer
    hands = bpy.data.objects.new("Hands", bpy.data.meshes.new("Hands"))
    material = bpy.data.materials.new("Hands")
    if material.node_tree is None:
        material.use_nodes = True
    material.node_tree.nodes.new("ShaderNodeGroup").node_tree = outer
    hands.data.materials.append(material)
    before = look(hands)
    body.skin_tan.exposures[0].dose = 8.0
    apply(body)
    assert look(hands) == before != look(body)


def test_what_an_artist_did_inside_the_group_is_kept(body):
    group = body.skin_tan.group
    skin, colour = of_role(body, "skin"), of_role(body, "colour")
    freckles = group.nodes.new("ShaderNodeMix")
    freckles.data_type = "RGBA"
    group.links.new(colour.outputs["Color"], freckles.inputs["A"])
    group.links.new(freckles.outputs["Result"], skin.inputs["Base Color"])
    skin.inputs["Coat Weight"].default_value = 0.2
    of_role(body, "radius").label = "Renamed"
    apply(body)
    assert skin.inputs["Base Color"].links[0].from_node == freckles
    assert skin.inputs["Coat Weight"].default_value == pytest.approx(0.2)
    assert len(group.nodes) == len(plan.ROLES) + 1


def test_a_texture_of_one_s_own_with_the_tan_s_image_follows(body):
    """It is the object's; the same image in another object's material stays."""
    tree = body.material_slots[0].material.node_tree
    mine = tree.nodes.new("ShaderNodeTexImage")
    mine.image = of_role(body, "states").image
    apply(body)
    assert mine.image == of_role(body, "states").image
    assert len(bpy.data.images) == OWN_IMAGES + LOOK_IMAGES
    hands = bpy.data.objects.new("Hands", bpy.data.meshes.new("Hands"))
    material = bpy.data.materials.new("Hands")
    if material.node_tree is None:
        material.use_nodes = True
    hands.data.materials.append(material)
    theirs = material.node_tree.nodes.new("ShaderNodeTexImage")
    former = theirs.image = of_role(body, "states").image
    apply(body)
    assert theirs.image == former != of_role(body, "states").image


def test_a_node_that_was_removed_is_told_and_stays_away(body, capfd):
    group = body.skin_tan.group
    group.nodes.remove(of_role(body, "colour"))
    assert apply(body) == {"FINISHED"}
    assert "The tan does not show: nodes were removed" in capfd.readouterr().out
    assert len(group.nodes) == len(plan.ROLES) - 1


def test_what_was_deleted_is_made_anew(body):
    for group in list(bpy.data.node_groups):
        bpy.data.node_groups.remove(group)
    assert apply(body) == {"FINISHED"}
    assert body.skin_tan.group is not None
    for image in list(bpy.data.images):
        bpy.data.images.remove(image)
    assert apply(body) == {"FINISHED"}
    assert look(body)
    bpy.data.materials.remove(body.material_slots[0].material)
    assert apply(body) == {"FINISHED"}
    assert look(body)


def test_a_skin_put_aside_comes_back(body):
    """The slot was emptied: Apply puts the object's own material into it again."""
    material = body.material_slots[0].material
    group_node(body).inputs["Roughness"].default_value = 0.3
    body.material_slots[0].material = None
    apply(body)
    assert body.material_slots[0].material == material
    assert group_node(body).inputs["Roughness"].default_value == pytest.approx(0.3)


def test_a_neighbour_s_skin_in_a_slot_of_its_own_is_left_alone(body, table_path):
    second = other(table_path, "Second")
    apply(second)
    second.data.materials.append(body.material_slots[0].material)
    second.active_material_index, before = 1, look(body)
    second.skin_tan.exposures[0].dose = 20.0
    apply(second)
    assert look(body) == before and second.material_slots[1].material == (
        body.material_slots[0].material
    )
    assert len(bpy.data.materials) == 2


def test_a_group_of_a_newer_version_is_refused(body):
    body.skin_tan.group[plan.LAYOUT_KEY] = 99
    before = look(body)
    with pytest.raises(RuntimeError, match="A newer version of this add-on made the node group"):
        apply(body)
    assert look(body) == before and len(bpy.data.images) == OWN_IMAGES + LOOK_IMAGES


def test_a_material_in_an_input_of_geometry_nodes_stays_as_it_was(body):
    """A duplicate has another material in its slot, and the tan's through a modifier."""
    copy, before = full_duplicate(body), look(body)
    copy.material_slots[0].material = bpy.data.materials.new("Plain")
    tree = bpy.data.node_groups.new("Coat", "GeometryNodeTree")
    tree.interface.new_socket("Geometry", in_out="INPUT", socket_type="NodeSocketGeometry")
    entry = tree.interface.new_socket("Skin", in_out="INPUT", socket_type="NodeSocketMaterial")
    modifier = copy.modifiers.new("Coat", "NODES")
    modifier.node_group = tree
    shown = body.material_slots[0].material
    set_modifier_input(modifier, entry.identifier, shown)
    body.skin_tan.exposures[0].dose = 8.0
    apply(body)
    assert modifier_input(modifier, entry.identifier) == shown != body.material_slots[0].material
    body.material_slots[0].material, own = shown, body.material_slots[0].material
    assert look(body) == before
    body.material_slots[0].material = own
    assert look(body) != before


@pytest.mark.parametrize(
    ("module", "name"),
    [(images, "set_colour_space"), (materials, "new_material"), (timeline, "_curve")],
)
@pytest.mark.parametrize("applied", [False, True])
@pytest.mark.provokes
def test_an_exception_leaves_all_as_it_was(table_path, monkeypatch, module, name, applied):
    """In the midst of the work: what was made so far is gone, what was there is unchanged."""
    obj = tan_object(table_path)
    if applied:
        apply(obj)
    copy, before = linked_duplicate(obj), inventory()

    def fail(*arguments, **more):
        raise MemoryError

    monkeypatch.setattr(module, name, fail)
    obj.skin_tan.exposures[0].dose = 8.0
    if applied and name == "new_material":
        return
    with pytest.raises((RuntimeError, MemoryError)):
        apply(obj)
    assert inventory() == before
    if applied:
        assert look(obj) == look(copy)
        assert obj.animation_data.action == copy.animation_data.action
    else:
        assert not obj.material_slots and "tan_day" not in obj and obj.animation_data is None


def inventory() -> list[str]:
    collections = ("materials", "node_groups", "images", "actions", "meshes", "objects")
    return [repr(block) for name in collections for block in getattr(bpy.data, name)]
