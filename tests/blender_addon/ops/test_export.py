"""Tables that lack a plane or are for one schedule, and the export of a schedule."""

from dataclasses import replace

import bpy
import numpy as np
import pytest
from sampled import colours, coordinates, tan
from scenes import of_role, tan_object

import hylios
from blender_addon.model.response import response_of
from blender_addon.model.tan import history_within
from hylios.errors import InputError
from hylios.history import read_schedule
from hylios.skin import whole_thickening
from hylios.skin.phototypes import phototype
from hylios.sun.doses import of_sed
from hylios.table import MinimalDoses, from_stored, to_stored
from hylios.tanning import KINETICS, Exposures
from lut_builder.assemble import build
from lut_builder.exr_writer import write_table
from lut_builder.reachable import reached_states
from lut_builder.settings import Settings

SKIN = phototype("III").skin
QUICK = Settings(knots=(16, 3, 4, 2), colour_wavelengths=4, bands=(), profile_error=0.0)
SPAN = {"mmd": SKIN.mmd, "med": SKIN.med, "first_day": 0.0, "last_day": 10.0}
SUN = 1.5 * SKIN.mmd
"""In SED, in the first hour: of the scene that a table is built for."""


def without(table, *names):
    kept = {name: values for name, values in table.planes.items() if name not in names}
    return replace(table, planes=kept)


@pytest.fixture(scope="module")
def part():
    """The table of ten days after one exposure, as it comes back from a file of 16 bits."""
    reached = reached_states(SKIN, Exposures([0], [SUN]), 10.0, hylios.erythema(SKIN))
    return from_stored(to_stored(build(SKIN, QUICK, reached=reached), half=True))


def test_a_table_for_a_schedule_is_good_for_it(part):
    whole = build(SKIN, QUICK)
    of_part, of_whole = (colours(tan(table, of_sed(0, SUN), **SPAN)) for table in (part, whole))
    assert np.ptp(of_whole[..., 0]) > 0.05
    assert of_part == pytest.approx(of_whole, abs=0.003)


@pytest.mark.parametrize("kinetics", KINETICS)
def test_a_table_for_a_schedule_is_as_good_for_redness_and_either_kinetics(part, kinetics):
    minimal, days = MinimalDoses(mmd=SKIN.mmd, med=SKIN.med), (0.0, 10.0)
    response = response_of(part, kinetics, redness=True)
    told = history_within(part, of_sed(0, SUN), minimal, days, response=response)
    skin = replace(SKIN, kinetics=kinetics)
    states = skin.states(Exposures([0], [SUN]), [12, 24], erythema=hylios.erythema(SKIN))
    expected = np.log(whole_thickening(states)[:, 4])
    shown = coordinates(told, np.ones(2), np.array([0.5, 1.0]))[:, 2]
    assert shown == pytest.approx(expected, abs=0.02) and shown.min() > 0.5


@pytest.mark.parametrize(
    ("dose", "last_day"), [(1.2 * SUN, 10.0), (3.0 * SUN, 10.0), (10.0 * SUN, 14.0)]
)
def test_a_table_for_a_schedule_is_refused_for_another(part, dose, last_day):
    """More sun leads beyond the knots."""
    with pytest.raises(InputError, match=r"another schedule of sun and lacks .* with none\.$"):
        tan(part, of_sed(0, dose), **{**SPAN, "last_day": last_day})


@pytest.mark.parametrize(("dose", "last_day"), [(0.0, 7.3), (0.5 * SUN, 7.3), (SUN, 30.0)])
def test_a_table_for_a_schedule_holds_for_less_of_it_and_as_it_fades(part, dose, last_day):
    assert tan(part, of_sed(0, dose), **{**SPAN, "last_day": last_day}).look.colour.min() > 0.0


def test_a_table_without_colour_is_refused(table):
    with pytest.raises(InputError, match="no plane subsurface_colour, which .* it has total_col"):
        tan(without(table, "subsurface_colour"), of_sed(0, 6.0), **SPAN)


def test_a_table_without_profile_gives_a_material_without_subsurface(table, tmp_path, capfd):
    """And Apply with another table brings subsurface back, and the other way round."""
    whole, flat = tmp_path / "whole.exr", tmp_path / "flat.exr"
    write_table(whole, table)
    write_table(flat, without(table, "near_share", "far_width"))
    obj = tan_object(flat)
    for path, weight in ((flat, 0.0), (whole, 1.0), (flat, 0.0)):
        obj.skin_tan.table_path = str(path)
        assert bpy.ops.skin_tan.apply() == {"FINISHED"}
        skin = of_role(obj, "skin")
        assert skin.inputs["Subsurface Weight"].default_value == weight
        assert skin.inputs["Base Color"].is_linked
        assert ("no subsurface" in capfd.readouterr().out) == (weight == 0.0)


def exported(path) -> set:
    return bpy.ops.skin_tan.export_schedule(filepath=str(path))


def test_the_builder_reads_the_schedule_as_it_is(table_path, tmp_path):
    """Hours and doses to the last bit, sunscreen and all units but the sun by date."""
    obj = tan_object(table_path, dose=0.1 + 0.2)
    second = obj.skin_tan.exposures.add()
    second.day, second.unit, second.multiple = 2.3, "MMD", 1.7
    second.sunscreen = True
    path = tmp_path / "sun.csv"
    path.write_text("former")
    assert exported(path) == {"FINISHED"}
    read = read_schedule(path)
    assert read.hours.tolist() == [0, 55]
    expected = [np.float32(0.3), np.float32(1.7) * 4.9 / 30.0]
    assert read.doses == pytest.approx(expected, rel=1e-6)
    assert np.array_equal(read.doses, read.thickening_doses)
    head = [line for line in path.read_text().splitlines() if line.startswith("#")]
    for line in ("# skin: S3", "# MMD in SED: 4.9", "# MED in SED: 2.9", "# days: 30"):
        assert line in head
    assert [path.name for path in tmp_path.iterdir()] == ["sun.csv"]


def test_an_exported_schedule_gives_a_table_that_apply_takes(tmp_path):
    """All the way: the table of what was exported holds all that Apply looks up, and no more."""
    path, table_path = tmp_path / "sun.csv", tmp_path / "part.exr"
    write_table(table_path, build(SKIN, QUICK))
    obj = tan_object(table_path, dose=SUN)
    obj.skin_tan.first_day, obj.skin_tan.last_day = 0.7, 13.1
    assert exported(path) == {"FINISHED"}
    reached = reached_states(SKIN, read_schedule(path), 13.1, hylios.erythema(SKIN))
    write_table(table_path, build(SKIN, QUICK, reached=reached))
    obj.skin_tan.kinetics, obj.skin_tan.redness = "MEASURED", True
    assert bpy.ops.skin_tan.apply() == {"FINISHED"}
    obj.skin_tan.exposures[0].dose = 1.5 * SUN
    with pytest.raises(RuntimeError, match="or set Tan to As in the Thesis"):
        bpy.ops.skin_tan.apply()


def test_what_cannot_be_exported_is_named(table_path, tmp_path):
    obj = tan_object(table_path)
    for path, sentence in (
        (tmp_path / "sun.txt", "its name must end in .csv"),
        (tmp_path / "no" / "sun.csv", "cannot be written: No such file or directory"),
    ):
        with pytest.raises(RuntimeError, match=sentence):
            exported(path)
    obj.skin_tan.exposures[0].dose = float("nan")
    with pytest.raises(RuntimeError, match="dose of a time in the sun is nan SED; allowed is 0 to"):
        exported(tmp_path / "sun.csv")
    assert not list(tmp_path.iterdir())


def test_the_export_is_offered_for_meshes_alone():
    assert not bpy.ops.skin_tan.export_schedule.poll()
    bpy.ops.mesh.primitive_cube_add()
    assert bpy.ops.skin_tan.export_schedule.poll()
