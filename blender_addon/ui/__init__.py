"""The panel in the 3D view's sidebar. It shows values and kept lines, and computes nothing."""

from .exposures import SKIN_TAN_UL_exposures
from .panel import VIEW3D_PT_skin_tan
from .presets import SKIN_TAN_PT_schedule_presets, SKIN_TAN_PT_skin_presets
from .view import VIEW3D_PT_skin_tan_view

CLASSES = (
    SKIN_TAN_UL_exposures,
    VIEW3D_PT_skin_tan,
    VIEW3D_PT_skin_tan_view,
    SKIN_TAN_PT_skin_presets,
    SKIN_TAN_PT_schedule_presets,
)
