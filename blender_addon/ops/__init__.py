"""What the buttons do."""

from .apply import SKIN_TAN_OT_apply
from .exposures import SKIN_TAN_OT_add_exposure, SKIN_TAN_OT_remove_exposure
from .schedule import SKIN_TAN_OT_export_schedule
from .view import SKIN_TAN_OT_switch_view

CLASSES = (
    SKIN_TAN_OT_add_exposure,
    SKIN_TAN_OT_remove_exposure,
    SKIN_TAN_OT_apply,
    SKIN_TAN_OT_export_schedule,
    SKIN_TAN_OT_switch_view,
)
