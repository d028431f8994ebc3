"""The buttons that read the list of exposures from files, and write it."""

import math
from pathlib import Path
from typing import Any, cast

import bpy
from bpy_extras.io_utils import ExportHelper, ImportHelper

from hylios.errors import InputError, require_range
from hylios.files import require_target, written_beside

from ..model.exposures_csv import ReadSchedule, exposures_text, read_exposures
from ..model.schedule import csv_text
from ..model.settings import LAST_DAY_LIMIT, USUAL_DATE, USUAL_HOURS
from ..model.weather import weather_exposures
from ..props import HOUR_OF_DAY, SkinTanSettings, settings_of
from ..tannable import tannable
from .active import active_mesh, active_object, active_settings, can_edit, has_mesh
from .lists import clear
from .reports import finished


def _path_of(operator: Any) -> Path:
    """The file that an operator is given.

    Raises
    ------
    InputError
        If it is given none.
    """
    if not operator.filepath:
        raise InputError("No file is chosen; choose one.")
    return Path(bpy.path.abspath(operator.filepath))


class _SavesCsv(ExportHelper):
    """An operator that writes the active object's exposures into a CSV file."""

    filename_ext = ".csv"
    filter_glob: bpy.props.StringProperty(default="*.csv", options={"HIDDEN"})

    @classmethod
    def poll(cls, context):
        return has_mesh(cls, context)

    def execute(self, context):
        return finished(self, lambda: self._save(context))

    def _save(self, context: bpy.types.Context) -> str:
        path = _path_of(self)
        obj = self.subject(context)
        require_target(path, (".csv",), replacing=True)
        text = self.text(obj)
        with written_beside(path) as beside:
            beside.write_text(text, encoding="utf-8")
        return f"Saved {path}."

    def subject(self, context: bpy.types.Context) -> bpy.types.Object:
        """The object whose exposures are written; InputError if they cannot be."""
        return cast(bpy.types.Object, active_mesh(context))

    def text(self, obj: bpy.types.Object) -> str:
        """The text of the file; InputError if a setting cannot be used."""
        raise NotImplementedError


class SKIN_TAN_OT_export_exposures(_SavesCsv, bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.export_exposures"
    bl_label = "Export CSV"
    bl_description = "Save what counts of the times in the sun as CSV, without the masks"

    def text(self, obj: bpy.types.Object) -> str:
        return exposures_text(settings_of(obj).exposures)


class SKIN_TAN_OT_export_schedule(_SavesCsv, bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.export_schedule"
    bl_label = "Export for lut-builder"
    bl_description = (
        "Save these times in the sun as CSV, to build a smaller table for this scene only"
    )

    def subject(self, context: bpy.types.Context) -> bpy.types.Object:
        return tannable(active_object(context))

    def text(self, obj: bpy.types.Object) -> str:
        return csv_text(obj.name, settings_of(obj).values())


REPLACE = bpy.props.BoolProperty(
    name="Replace",
    description="Put these in place of the times in the sun that are listed. Off: add them",
    default=True,
)
"""Of operators that read exposures; last in both, since Blender shows properties in their order."""


class _Reads(ImportHelper):
    """An operator that reads the active object's exposures from a file."""

    replace: bool

    @classmethod
    def poll(cls, context):
        return can_edit(cls, context)

    def execute(self, context):
        settings = active_settings(context)
        try:
            read = self.read(_path_of(self))
            start = 0.0 if self.replace else self.start_beside(settings, read)
        except InputError as error:
            cast(Any, self).report({"ERROR"}, str(error))
            return {"CANCELLED"}
        off = clear(settings.exposures) if self.replace else 0
        for values in read.exposures:
            exposure = settings.exposures.add()
            for name, value in values.items():
                setattr(exposure, name, value)
            exposure.day += start
        settings.exposure_index = max(0, len(settings.exposures) - 1)
        said = [f"Read times in the sun: {len(read.exposures)}.", *read.remarks]
        if off:
            said.append(f"Turned off those of the character's own file: {off}.")
        cast(Any, self).report({"INFO"}, " ".join(said))
        return {"FINISHED"}

    def read(self, path: Path) -> ReadSchedule:
        """What a file says; InputError if it cannot be used."""
        raise NotImplementedError

    def start_beside(self, settings: SkinTanSettings, read: ReadSchedule) -> float:
        """Day that is a file's day 0 beside what is listed; InputError if days end too late."""
        return 0.0


class SKIN_TAN_OT_import_exposures(_Reads, bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.import_exposures"
    bl_label = "Import CSV"
    bl_description = (
        "Read times in the sun from CSV: columns day and SED are enough, a table's own export, or "
        "what Export CSV has saved"
    )
    bl_options = {"REGISTER", "UNDO"}
    filter_glob: bpy.props.StringProperty(default="*.csv;*.txt", options={"HIDDEN"})
    replace: REPLACE

    def read(self, path: Path) -> ReadSchedule:
        return read_exposures(path)


class SKIN_TAN_OT_import_weather(_Reads, bpy.types.Operator):  # noqa: N801
    bl_idname = "skin_tan.import_weather"
    bl_label = "Import Weather"
    bl_description = (
        "Read days in the sun from a weather file: an EPW file, or UV indices by time (CSV, JSON)"
    )
    bl_options = {"REGISTER", "UNDO"}
    filter_glob: bpy.props.StringProperty(default="*.epw;*.csv;*.json;*.txt", options={"HIDDEN"})
    month: bpy.props.IntProperty(
        name="Month",
        description="Month of the first day that is read of an EPW file. UV indices are read from "
        "their first day on",
        default=USUAL_DATE[0],
        min=1,
        max=12,
    )
    day_of_month: bpy.props.IntProperty(
        name="Day of Month",
        description="First day that is read of an EPW file. UV indices are read from their first "
        "day on",
        default=USUAL_DATE[1],
        min=1,
        max=31,
    )
    days: bpy.props.IntProperty(
        name="Days",
        description="How many days in a row to read; every one becomes a time in the sun",
        default=7,
        min=0,
        soft_min=1,
        max=int(LAST_DAY_LIMIT),
    )
    from_hour: bpy.props.FloatProperty(
        name="From (h)",
        description="When the skin goes into the sun every day, in hours of the file's clock (of "
        "an EPW file: without daylight saving)",
        default=USUAL_HOURS[0],
        **HOUR_OF_DAY,
    )
    to_hour: bpy.props.FloatProperty(
        name="To (h)",
        description="When it leaves the sun every day, in hours of the file's clock",
        default=USUAL_HOURS[1],
        **HOUR_OF_DAY,
    )
    replace: REPLACE

    def read(self, path: Path) -> ReadSchedule:
        return weather_exposures(
            path,
            month=self.month,
            day_of_month=self.day_of_month,
            days=self.days,
            first=self.from_hour,
            last=self.to_hour,
        )

    def start_beside(self, settings: SkinTanSettings, read: ReadSchedule) -> float:
        """The day after the last that is listed, as + has it."""
        if not settings.exposures:
            return 0.0
        start = math.floor(max(exposure.day for exposure in settings.exposures)) + 1.0
        end = start + max(values["day"] for values in read.exposures)
        require_range("day of the last time in the sun", end, 0.0, LAST_DAY_LIMIT)
        return start
