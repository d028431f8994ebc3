"""Looks of skin with another biology, by the kinetics of the tan."""

import numpy as np

from blender_addon.model import catalogue
from blender_addon.model.look import look
from blender_addon.model.settings import TanSettings
from blender_addon.model.tan import look_of
from hylios.changed_table import changed_table
from hylios.skin.biology import Biology


def test_a_table_is_changed_where_tans_of_the_own_kinetics_lie():
    path, biology = catalogue.shipped_path("VI"), Biology(melanin=1.3)
    settings = TanSettings(path, None, (), 0.0, 30.0, biology, kinetics="measured")
    minimal = settings.minimal_doses(catalogue.provenance(path))
    changed = changed_table(catalogue.table(path), biology, kinetics="measured")
    told = look(changed, minimal, "measured").colour
    np.testing.assert_array_equal(look_of(settings).colour, told)
