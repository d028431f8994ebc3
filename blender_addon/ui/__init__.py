"""The panels. They show values and kept lines, and compute nothing."""

from .curve import forget_curve
from .exposures import SKIN_TAN_MT_exposures, SKIN_TAN_UL_exposures
from .panel import MATERIAL_TAB, SIDEBAR
from .presets import SKIN_TAN_PT_schedule_presets, SKIN_TAN_PT_skin_presets
from .regions import SKIN_TAN_UL_regions
from .swatches import forget_swatches
from .view import VIEW3D_PT_skin_tan_view

__all__ = ["CLASSES", "forget_curve", "forget_swatches"]

CLASSES = (
    SKIN_TAN_PT_skin_presets,
    SKIN_TAN_PT_schedule_presets,
    SKIN_TAN_UL_exposures,
    SKIN_TAN_UL_regions,
    SKIN_TAN_MT_exposures,
    *SIDEBAR,
    *MATERIAL_TAB,
    VIEW3D_PT_skin_tan_view,
)
