"""The panel drawn on a layout that raises where Blender would only print."""

import bpy
import pytest
from synthetic import tan_object

from blender_addon import doses, panels, tables
from hylios.sun.action_spectra import Absorptance

ICONS = {
    item.identifier
    for item in bpy.types.UILayout.bl_rna.functions["label"].parameters["icon"].enum_items
}


class Layout:
    """Records the labels; refuses properties, operators and icons that do not exist."""

    ATTRIBUTES = {"use_property_split", "use_property_decorate", "scale_y"}

    def __init__(self, labels: list[str]):
        object.__setattr__(self, "labels", labels)

    def __setattr__(self, name, value):
        assert name in self.ATTRIBUTES and name in bpy.types.UILayout.bl_rna.properties

    def row(self, align=False):
        return Layout(self.labels)

    column = row

    def separator(self):
        pass

    def label(self, *, text, icon="NONE"):
        assert icon in ICONS
        self.labels.append(text)

    def prop(self, data, name, *, text=None, emboss=True):
        assert name in data.bl_rna.properties

    def prop_search(self, data, name, collection, items, *, text, icon):
        assert name in data.bl_rna.properties and items in collection.bl_rna.properties
        assert icon in ICONS

    def operator(self, name, *, text=None, icon="NONE"):
        assert icon in ICONS
        module, function = name.split(".")
        getattr(getattr(bpy.ops, module), function).get_rna_type()

    def template_list(self, kind, identifier, data, name, active_data, active_name, *, rows):
        assert hasattr(bpy.types, kind)
        assert name in data.bl_rna.properties and active_name in active_data.bl_rna.properties
        for item in getattr(data, name):
            panels.SKIN_TAN_UL_exposures.draw_item(
                None, bpy.context, Layout(self.labels), data, item, 0, active_data, active_name
            )


class Panel:
    def __init__(self, labels):
        self.layout = Layout(labels)


def drawn() -> list[str]:
    labels: list[str] = []
    panels.VIEW3D_PT_skin_tan.draw(Panel(labels), bpy.context)
    return labels


def test_the_mock_raises_on_what_does_not_exist(table_path):
    obj = tan_object(table_path)
    with pytest.raises(AssertionError):
        Layout([]).prop(obj.skin_tan, "absent")
    with pytest.raises(KeyError):
        Layout([]).operator("skin_tan.absent")


def test_without_an_object():
    assert drawn() == ["Select a mesh object"]


def test_with_every_setting(table_path):
    obj = tan_object(table_path, [0.0, 1.0])
    obj.skin_tan.own_minimal_doses = True
    labels = drawn()
    assert "Tans from 4.9 SED of sun," in labels
    assert "burns from 2.9 SED (estimates)" in labels
    assert "30 SED: 4.2 h of strong summer sun" in labels
    bpy.ops.skin_tan.apply()
    assert "This frame shows day 0.0" in drawn()


@pytest.mark.parametrize(
    ("unit", "line", "label"),
    [
        ("MMD", "2 MMD", "9.8 SED: 1.4 h of strong summer sun"),
        ("UV_INDEX", "UV 8, 2 h", "14.4 SED: 2.0 h of strong summer sun"),
        ("SUN", "Sun 11-15 h", "No dose: the table does not say what its skin abs"),
    ],
)
def test_every_unit_says_what_reaches_the_skin(table_path, unit, line, label):
    """This table does not say what its skin absorbs, as the sun by date needs it."""
    obj = tan_object(table_path)
    obj.skin_tan.exposures[0].unit = unit
    labels = drawn()
    assert line in labels and label in labels
    obj.skin_tan.exposures[0].sunscreen = True
    assert label not in drawn() or unit == "SUN"


def test_a_multiple_is_of_the_dose_that_is_set_by_hand(table_path):
    obj = tan_object(table_path)
    obj.skin_tan.exposures[0].unit = "MMD"
    obj.skin_tan.own_minimal_doses, obj.skin_tan.mmd = True, 7.2
    assert "14.4 SED: 2.0 h of strong summer sun" in drawn()


def test_the_sun_says_that_its_dose_is_provisional(table_path, monkeypatch):
    obj = tan_object(table_path)
    obj.skin_tan.exposures[0].unit = "SUN"
    monkeypatch.setattr(doses, "absorptance", lambda _: Absorptance([280.0, 400.0], [0.9, 0.9]))
    assert any("SED (provisional)" in label for label in drawn())


def test_a_new_object_says_what_to_do():
    bpy.ops.mesh.primitive_cube_add()
    bpy.context.object.skin_tan.skin = "FILE"
    labels = drawn()
    assert "Choose a skin table (EXR file)" in labels
    assert "Add a time in the sun with +" in labels
    assert "No mask: the whole body is bare" in labels


def test_a_file_that_is_no_table(table_path, tmp_path):
    obj = tan_object(table_path)
    obj.skin_tan.table_path = str(tmp_path / "absent.exr")
    assert "This is not a usable skin table" in drawn()


def test_every_shipped_skin_has_its_estimate():
    bpy.ops.mesh.primitive_cube_add()
    for shipped in tables.SHIPPED:
        bpy.context.object.skin_tan.skin = shipped.name
        assert any("(estimates)" in label for label in drawn())
