"""The button that saves an object's exposures."""

from pathlib import Path
from typing import Any, cast

import bpy
from bpy_extras.io_utils import ExportHelper

from hylios.errors import InputError
from hylios.files import require_target, written_beside

from ..apply import tannable
from ..model.schedule import csv_text
from ..props import settings_of
from .active import active_mesh, active_object


class SKIN_TAN_OT_export_schedule(bpy.types.Operator, ExportHelper):  # noqa: N801
    bl_idname = "skin_tan.export_schedule"
    bl_label = "Export Schedule"
    bl_description = "Save these exposures as CSV, to build a smaller table for this scene only"
    filename_ext = ".csv"
    filter_glob: bpy.props.StringProperty(default="*.csv", options={"HIDDEN"})

    @classmethod
    def poll(cls, context):
        return active_mesh(context) is not None

    def execute(self, context):
        path = Path(bpy.path.abspath(cast(Any, self).filepath))
        try:
            _export(tannable(active_object(context)), path)
        except InputError as error:
            self.report({"ERROR"}, str(error))
            return {"CANCELLED"}
        self.report({"INFO"}, f"Saved {path}.")
        return {"FINISHED"}


def _export(obj: bpy.types.Object, path: Path) -> None:
    require_target(path, (".csv",), replacing=True)
    text = csv_text(obj.name, settings_of(obj).values())
    with written_beside(path) as beside:
        beside.write_text(text, encoding="utf-8")
