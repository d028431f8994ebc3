"""The panel drawn on a layout that raises where Blender would only print."""

from dataclasses import replace

import bpy
import pytest
from artist_skins import plain, wear
from drawing import Layout, drawn
from scenes import tan_object

from blender_addon import applied
from blender_addon.model import catalogue, doses
from blender_addon.model.summary import LINE
from blender_addon.ui import panel, view
from lut_builder.exr_writer import write_table


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
    assert "30 SED: 4.2 h of strong sun" in labels
    obj.skin_tan.exposures[0].dose = 0.5
    assert "0.5 SED: 4 min of strong sun" in drawn()
    bpy.ops.skin_tan.apply()
    assert "This frame shows day 0.0" in drawn()


def test_new_material_is_settled_once_all_that_is_ticked_has_a_tan(table_path):
    obj = tan_object(table_path, [1.0, 1.0])
    wear(obj, [plain("skin"), plain("ears")])
    assert "Remove Tan to change this" not in drawn()
    bpy.ops.skin_tan.apply()
    assert "Remove Tan to change this" in drawn()
    obj.data.materials[1] = plain("lips")
    obj.skin_tan.materials[1].material = obj.data.materials[1]
    assert "Remove Tan to change this" not in drawn()


def test_a_region_says_where_it_lies(table_path):
    obj = tan_object(table_path)
    bpy.ops.skin_tan.add_region(kind="FRECKLES")
    assert "No mask: they are everywhere" in drawn()
    obj.skin_tan.regions[0].painted = True
    assert "No mask: it is nowhere" in drawn()
    bpy.ops.skin_tan.add_region(kind="LIPS", mask="mouth")
    assert "The mesh does not have this mask:" in drawn()


@pytest.mark.parametrize(
    ("unit", "line", "label"),
    [
        ("MMD", "2 tanning doses", "9.8 SED: 1.4 h of strong sun"),
        ("UV_INDEX", "UV 8, 2 h", "14.4 SED: 2.0 h of strong sun"),
        ("SUN", "Sun 11-15 h", "30.4 SED: 4.2 h of strong sun"),
    ],
)
def test_every_unit_says_what_reaches_the_skin(table_path, unit, line, label):
    obj = tan_object(table_path)
    obj.skin_tan.exposures[0].unit = unit
    labels = drawn()
    assert line in labels and label in labels
    obj.skin_tan.exposures[0].sunscreen = True
    assert label not in drawn()


def test_the_sun_needs_a_table_that_says_what_skin_absorbs(tmp_path, table):
    without = {name: what for name, what in table.provenance.items() if name != "absorptance"}
    path = tmp_path / "without.exr"
    write_table(path, replace(table, provenance=without))
    tan_object(path).skin_tan.exposures[0].unit = "SUN"
    assert "No dose: the table does not say what its skin abs" in drawn()


def test_a_multiple_is_of_the_dose_that_is_set_by_hand(table_path):
    obj = tan_object(table_path)
    obj.skin_tan.exposures[0].unit = "MMD"
    obj.skin_tan.own_minimal_doses, obj.skin_tan.mmd = True, 7.2
    assert "14.4 SED: 2.0 h of strong sun" in drawn()


def test_the_sun_says_what_its_dose_tans_like(table_path):
    obj = tan_object(table_path)
    obj.skin_tan.exposures[0].unit = "SUN"
    assert any(label.startswith("tans like ") for label in drawn())


def test_a_new_object_says_what_to_do():
    bpy.ops.mesh.primitive_cube_add()
    bpy.context.object.skin_tan.skin = "FILE"
    labels = drawn()
    assert "Choose a skin table (EXR file)" in labels
    assert "Add a time in the sun with +" in labels
    assert "No mask: the whole body is bare" in labels


def test_a_file_that_is_no_table_is_read_once(table_path, tmp_path, monkeypatch):
    """However often the panel is drawn, until the file changes."""
    obj = tan_object(table_path)
    path = tmp_path / "bad.exr"
    obj.skin_tan.table_path = str(path)
    assert "This is not a usable skin table" in drawn()
    reads = counted(monkeypatch, catalogue, "read_table")
    path.write_text("no table")
    for _ in range(3):
        assert "This is not a usable skin table" in drawn()
    assert len(reads) == 1
    path.write_bytes(table_path.read_bytes())
    for _ in range(3):
        assert "Tans from 4.9 SED of sun," in drawn()
    assert len(reads) == 2


def test_a_dose_of_sun_is_computed_once(table_path, monkeypatch):
    """Until a value changes that it follows from."""
    exposure = tan_object(table_path).skin_tan.exposures[0]
    exposure.unit, exposure.latitude = "SUN", 41.5
    computed = counted(monkeypatch, doses, "of_exposure")
    before = [drawn() for _ in range(3)]
    assert len(computed) == 1 and before[0] == before[1] == before[2]
    exposure.to_hour = 12.0
    assert drawn() != before[0]
    assert len(computed) == 2


def counted(monkeypatch, module, name: str) -> list:
    """A list that grows with every call of a function."""
    calls, function = [], getattr(module, name)

    def wrapper(*arguments):
        calls.append(arguments)
        return function(*arguments)

    monkeypatch.setattr(module, name, wrapper)
    return calls


def test_a_shipped_table_that_is_damaged_is_told(tmp_path, monkeypatch):
    path = tmp_path / "III.exr"
    path.write_bytes((catalogue.FOLDER / "III.exr").read_bytes()[:3000])
    monkeypatch.setattr(catalogue, "SHIPPED", catalogue.shipped_tables(tmp_path))
    bpy.ops.mesh.primitive_cube_add()
    bpy.context.object.skin_tan.skin = "III"
    assert "This skin's table is damaged:" in drawn()


@pytest.mark.parametrize("value", ["Tuesday", [1.0, 2.0], {"a": 1}, True, 3])
def test_a_day_that_is_no_day_does_not_stop_the_panel(table_path, value):
    tan_object(table_path)["tan_day"] = value
    shown = [label for label in drawn() if label.startswith("This frame shows day")]
    assert shown == ([f"This frame shows day {value:.1f}"] if isinstance(value, int) else [])


def test_a_unit_of_a_later_version_does_not_stop_the_panel(table_path):
    exposure = tan_object(table_path).skin_tan.exposures[0]
    unknown(exposure)
    labels = drawn()
    assert "Unknown unit" in labels and "No dose: unit of a time in the sun is ''" in labels


def unknown(exposure) -> None:
    """Give an exposure a unit that this version does not know."""
    stored = getattr(exposure, "bl_system_properties_get", lambda: exposure)()
    stored["unit"] = 99


@pytest.mark.parametrize("unit", ["SED", "MMD", "UV_INDEX", "SUN"])
@pytest.mark.parametrize("value", [float("nan"), 1e308, -1.0])
def test_values_set_by_scripts_do_not_stop_the_panel(table_path, unit, value):
    """Some past the limits of the properties, some that the limits change."""
    exposure = tan_object(table_path).skin_tan.exposures[0]
    exposure.unit, exposure.sunscreen = unit, True
    for name in ("day", "dose", "multiple", "uv_index", "duration", "latitude", "from_hour"):
        setattr(exposure, name, value)
    for name in ("to_hour", "spf", "sunscreen_amount", "altitude", "cloud", "depth"):
        setattr(exposure, name, value)
    labels = drawn()
    assert any("SED: " in label or label.startswith("No dose: ") for label in labels)
    assert any(label.startswith("No dose: ") for label in labels) or value == value


def test_every_shipped_skin_has_its_estimate():
    bpy.ops.mesh.primitive_cube_add()
    for shipped in catalogue.SHIPPED:
        bpy.context.object.skin_tan.skin = shipped.name
        assert any("(estimates)" in label for label in drawn())


def test_the_view_of_the_file_is_pressed(table_path):
    kind = view.VIEW3D_PT_skin_tan_view
    assert drawn(kind) == ["[Visible]"]
    obj = tan_object(table_path)
    bpy.ops.skin_tan.apply()
    bpy.ops.skin_tan.switch_view(view="NM1650")
    assert drawn(kind) == ["[1650 nm]"]
    del obj.skin_tan.group["skin_tan_view"]  # as skin that could not switch has it
    assert drawn(kind)[1:] == ["This skin shows another view:", "press the button to see why"]


def test_a_mask_that_is_gone_is_marked(table_path):
    obj = tan_object(table_path, [0.0, 1.0])
    gone = "The mesh does not have this mask:"
    assert gone not in drawn()
    obj.data.attributes["sun"].name = "shade"
    assert gone in drawn()
    exposure = obj.skin_tan.exposures[0]
    obj.skin_tan.mask.source = "shade"
    assert gone not in drawn()
    exposure.own_mask, exposure.mask.source = True, "absent"
    assert gone in drawn()


@pytest.mark.parametrize("of", ["object", "exposure", "film", "region"])
def test_why_apply_would_refuse_a_mask_is_told(table_path, of):
    obj = tan_object(table_path)
    settings = obj.skin_tan
    bpy.ops.skin_tan.apply()
    gone, refused = "The mesh does not have this mask:", "Apply Tan cannot show it:"
    assert not {gone, refused} & set(drawn())
    settings.exposures[0].own_mask = of == "exposure"
    settings.film = "WATER" if of == "film" else "NONE"
    if of == "region":
        bpy.ops.skin_tan.add_region(kind="LIPS")
    masks = {
        "object": settings.mask,
        "exposure": settings.exposures[0].mask,
        "film": settings.film_mask,
        "region": settings.regions[0].mask if settings.regions else None,
    }
    masks[of].source = "absent"
    assert gone in drawn()
    said = drawn(panel.VIEW3D_PT_skin_tan)
    told = said[said.index(refused) + 1 :]
    assert "'absent'" in " ".join(told) and max(map(len, told)) <= LINE
    masks[of].source = ""
    assert not {gone, refused} & set(drawn())


def test_what_waits_for_apply_is_told(table_path):
    settings = tan_object(table_path).skin_tan
    bpy.ops.skin_tan.apply()
    settings.exposures[0].dose = 3.0
    waits = "Changed: Apply Tan shows it"
    assert waits not in drawn()
    settings.undone = applied.text_of(bpy.context.object, bpy.context.scene)
    assert waits in drawn()
    settings.live, settings.undone = False, ""
    assert waits in drawn()


def test_what_has_no_effect_is_told(table_path):
    settings = tan_object(table_path).skin_tan
    film, late = "A recoloured material", "After the last day: no effect"
    settings.film = "WATER"
    assert not {film, late} & set(drawn())
    wear(bpy.context.object, [plain("skin")])
    settings.exposures[0].day = 31.0
    assert {film, late} <= set(drawn())
    bpy.ops.skin_tan.apply()
    assert film in drawn()
    bpy.ops.skin_tan.remove()
    settings.new_material, settings.last_day = True, 40.0
    assert not {film, late} & set(drawn())
    bpy.ops.skin_tan.apply()
    assert film not in drawn()


def test_an_empty_mask_says_what_its_field_is_for(table_path):
    settings = tan_object(table_path, [0.0, 1.0]).skin_tan
    assert "Choose a mask" not in drawn(panel.VIEW3D_PT_skin_tan_mask)
    settings.mask.source = ""
    assert drawn(panel.VIEW3D_PT_skin_tan_mask)[0] == "Choose a mask"
