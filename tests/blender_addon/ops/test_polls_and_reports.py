"""What an artist reads of a button that cannot be pressed, or of one that was."""

import bpy
import pytest
from scenes import apply, tan_object

from blender_addon.ops import CLASSES

WITHOUT_A_POLL = {"apply", "switch_view"}
"""Apply says by an error what is to be selected; views are of all skin."""

NAMES = sorted(
    {
        name.removeprefix("skin_tan.")
        for item in CLASSES
        if issubclass(item, bpy.types.Operator) and (name := item.bl_idname)
    }
)


def refusal(name: str) -> str:
    with pytest.raises(RuntimeError, match="poll") as refused:
        getattr(bpy.ops.skin_tan, name)()
    return str(refused.value).split("poll() ")[1]


@pytest.mark.parametrize("name", [name for name in NAMES if name not in WITHOUT_A_POLL])
@pytest.mark.parametrize("kind", [None, "EMPTY"])
def test_every_button_says_what_to_select(name, kind):
    if kind is not None:
        bpy.ops.object.empty_add()
    assert "elect" in refusal(name) and "context is incorrect" not in refusal(name)


@pytest.mark.parametrize(
    ("name", "sentence"),
    [
        ("duplicate_exposure", "The object has no time in the sun: add one with +"),
        ("move_exposure", "The object has no time in the sun: add one with +"),
        ("remove_exposure", "The object has no time in the sun: add one with +"),
        ("remove_region", "The object has no region of the skin: add one with +"),
        ("list_materials", "The object has no material: Apply Tan makes a skin"),
        ("remove", "The active object has no tan"),
    ],
)
def test_buttons_say_what_is_missing(table_path, name, sentence):
    tan_object(table_path).skin_tan.exposures.clear()
    assert sentence in refusal(name)


@pytest.mark.parametrize("name", ["export_exposures", "export_schedule", "import_exposures"])
def test_without_a_file_a_sentence(table_path, name):
    tan_object(table_path)
    with pytest.raises(RuntimeError, match="No file is chosen; choose one"):
        getattr(bpy.ops.skin_tan, name)(filepath="")


def test_what_a_panel_may_not_show_is_told(table_path, capfd):
    obj = tan_object(table_path)
    bpy.ops.skin_tan.choose_type(type="IV")
    bpy.ops.skin_tan.reset_biology()
    bpy.ops.skin_tan.add_exposure()
    apply(obj)
    bpy.ops.skin_tan.list_materials()
    said = capfd.readouterr().out
    assert "The skin is of type IV, with that type's usual melanin and blood." in said
    assert "Melanin, blood, oxygen and thickness are those of the skin type." in said
    assert "Added a time in the sun on day 1, with what is set of the last one." in said
    assert "Ticked as skin: 'Skin Tan Body'." in said
