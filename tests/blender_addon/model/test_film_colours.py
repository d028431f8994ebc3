"""Films on the skin as a shader's numbers, beside tables' wet colours and Fresnel's equations."""

import numpy as np
import pytest

from blender_addon.model import catalogue
from blender_addon.model.film import film_of
from blender_addon.model.layer import INDEX, let_through
from blender_addon.model.look import NORMAL_ANGLE
from hylios.lab.colour import difference
from hylios.table import melanin_dynamics, minimal_doses
from hylios.tanning import Exposures, states_at
from hylios.tissue.liquids import LIQUIDS

WATER_LETS_THROUGH = 0.9742
"""As Cycles renders it at 8 degrees: a coat of 1.33 over a gloss of 1.5526 / 1.33."""


@pytest.mark.parametrize("name", ["I", "III", "VI"])
def test_wet_skin_has_the_colour_that_its_table_says(name):
    table = catalogue.table(catalogue.shipped_path(name))
    minimal = minimal_doses(table.provenance)
    doses = np.linspace(0.0, 8.0, 12)[:, None] * minimal.mmd
    states = states_at(
        Exposures(np.array([0]), doses),
        melanin_dynamics(table.provenance),
        times=np.array([72.0, 240.0, 720.0]),
        mmd=minimal.mmd,
        med=minimal.med,
    ).reshape(-1, 4)
    dry = table.plane("subsurface_colour", states)
    roughness = float(np.sqrt(0.1))
    water = film_of("water", roughness)
    base = dry / let_through(roughness, NORMAL_ANGLE)
    wet = WATER_LETS_THROUGH * base * (1.0 + np.array(water.start) + np.array(water.slope) * dry)
    apart = difference(wet, table.plane("wet_subsurface_colour", states))
    assert apart.mean() < 0.2
    assert apart.max() < 0.3
    unchanged = difference(dry, table.plane("wet_subsurface_colour", states))
    assert unchanged.mean() > 3.0 * apart.mean()


def test_a_film_lies_between_air_and_skin_and_thin_ones_show_the_relief():
    films = {name: film_of(name, 0.3) for name in LIQUIDS}
    assert films["water"].index < films["sunscreen"].index < films["oil"].index < INDEX
    assert 0.0 < films["water"].relief < films["oil"].relief < films["sunscreen"].relief < 1.0
    assert films["water"].roughness < films["oil"].roughness < films["sunscreen"].roughness


def test_rough_skin_loses_as_much_colour_under_a_film_as_smooth_skin_has_more():
    """What the base loses to the dry gloss depends on its roughness; under water hardly."""
    smooth, rough = (1.0 + np.array(film_of("water", value).start) for value in (0.3, 0.7))
    ratio = let_through(0.7, NORMAL_ANGLE) / let_through(0.3, NORMAL_ANGLE)
    assert rough / smooth == pytest.approx(ratio, abs=1e-6)
