"""What the buttons do."""

from .apply import SKIN_TAN_OT_apply, SKIN_TAN_OT_copy_to_selected
from .csv_files import (
    SKIN_TAN_OT_export_exposures,
    SKIN_TAN_OT_export_schedule,
    SKIN_TAN_OT_import_exposures,
    SKIN_TAN_OT_import_weather,
)
from .exposures import (
    SKIN_TAN_OT_add_exposure,
    SKIN_TAN_OT_duplicate_exposure,
    SKIN_TAN_OT_move_exposure,
    SKIN_TAN_OT_remove_exposure,
)
from .masks import SKIN_TAN_OT_mask_from_clothes, SKIN_TAN_OT_paint_mask
from .materials import SKIN_TAN_OT_list_materials
from .presets import SKIN_TAN_OT_schedule_preset_add, SKIN_TAN_OT_skin_preset_add
from .regions import SKIN_TAN_OT_add_region, SKIN_TAN_OT_remove_region
from .remove import SKIN_TAN_OT_remove
from .size import SKIN_TAN_OT_fit_size
from .skin import (
    SKIN_TAN_OT_choose_type,
    SKIN_TAN_OT_copy_build_command,
    SKIN_TAN_OT_match_colour,
    SKIN_TAN_OT_match_texture,
    SKIN_TAN_OT_reset_biology,
)
from .timing import SKIN_TAN_OT_go_to_darkest_day, SKIN_TAN_OT_reset_timing
from .view import SKIN_TAN_OT_switch_view

CLASSES = (
    SKIN_TAN_OT_add_exposure,
    SKIN_TAN_OT_duplicate_exposure,
    SKIN_TAN_OT_move_exposure,
    SKIN_TAN_OT_remove_exposure,
    SKIN_TAN_OT_add_region,
    SKIN_TAN_OT_remove_region,
    SKIN_TAN_OT_list_materials,
    SKIN_TAN_OT_paint_mask,
    SKIN_TAN_OT_mask_from_clothes,
    SKIN_TAN_OT_apply,
    SKIN_TAN_OT_remove,
    SKIN_TAN_OT_copy_to_selected,
    SKIN_TAN_OT_reset_timing,
    SKIN_TAN_OT_go_to_darkest_day,
    SKIN_TAN_OT_import_exposures,
    SKIN_TAN_OT_import_weather,
    SKIN_TAN_OT_export_exposures,
    SKIN_TAN_OT_export_schedule,
    SKIN_TAN_OT_fit_size,
    SKIN_TAN_OT_choose_type,
    SKIN_TAN_OT_match_colour,
    SKIN_TAN_OT_match_texture,
    SKIN_TAN_OT_reset_biology,
    SKIN_TAN_OT_copy_build_command,
    SKIN_TAN_OT_skin_preset_add,
    SKIN_TAN_OT_schedule_preset_add,
    SKIN_TAN_OT_switch_view,
)
