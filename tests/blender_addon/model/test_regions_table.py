"""Spots of regions, and what regions are in a skin of the add-on's."""

from dataclasses import replace

import numpy as np
import pytest

from blender_addon.model import catalogue
from blender_addon.model.regions import Spots, is_estimate, shown, spots
from blender_addon.model.settings import TanSettings
from hylios.colour_difference import ciede2000, lab
from hylios.region_colour import colour_factor, compared, subsurface_colours
from hylios.skin.biology import Biology
from hylios.skin.regions import REGIONS
from hylios.table import skin_of


def settings_of(name: str, biology: Biology | None = None) -> TanSettings:
    table = catalogue.shipped_path(name)
    return TanSettings(table, None, (), 0.0, 30.0, biology or Biology())


def test_spots_cover_the_share_that_balls_fill():
    """Of balls of one size it is the volume of a ball over that of the place that it has."""
    same = Spots(least=1.0, largest=1.0, edge=0.2, apart=2.0, held=0.5)
    assert same.share_of_area(1.0) == pytest.approx(0.5 * np.pi / 6.0 / 8.0)
    assert same.share_of_area(4.0) == pytest.approx(np.pi / 6.0 / 8.0)
    mixed = Spots(least=1.0, largest=3.0, edge=0.2, apart=5.0, held=1.0)
    diameters = 1.0 + 2.0 * np.linspace(0.0, 1.0, 100001) ** 2
    assert mixed.share_of_area(1.0) == pytest.approx(
        np.pi / 6.0 * (diameters**3).mean() / 125.0, rel=1e-4
    )


def test_spots_and_estimates_are_those_of_the_regions():
    assert set(spots()) == {"freckles", "lentigines", "moles"}
    marked = {name for name in REGIONS if is_estimate(name)}
    assert marked == {"flush", "freckles", "lentigines", "moles", "palms", "lips"}


TYPES = ("I", "II", "III", "IV", "V", "VI")


def off(name: str, kind: str, kinetics: str = "thesis") -> float:
    """CIEDE2000 of a table's colours from the region solved by itself, the mean of three tans."""
    settings = replace(settings_of(name), kinetics=kinetics)
    table = catalogue.table(settings.table)
    skin = replace(skin_of(table.provenance), kinetics=kinetics)
    told = shown(settings, kind, 1.0)
    solved, states = compared(skin, table.axes, told.region)
    seen = table.lookup(states, ["subsurface_colour"])["subsurface_colour"] * told.colour
    return float(ciede2000(lab(seen), lab(subsurface_colours(solved))).mean())


@pytest.mark.parametrize("kind", REGIONS)
def test_a_table_shows_regions_as_they_are_solved_by_themselves(kind):
    assert np.mean([off("II", kind), off("V", kind, "measured")]) < 0.5


@pytest.mark.slow
@pytest.mark.parametrize("kinetics", ["thesis", "measured"])
@pytest.mark.parametrize("kind", REGIONS)
def test_so_it_does_for_all_types(kind, kinetics):
    assert np.mean([off(name, kind, kinetics) for name in TYPES]) < 0.5


def test_another_biology_is_another_region():
    dark = settings_of("II", Biology(melanin=4.0))
    assert (
        shown(dark, "palms", 1.0).region.melanin
        < shown(settings_of("II"), "palms", 1.0).region.melanin
    )


def test_the_colour_is_that_of_the_strength_at_its_power():
    settings = settings_of("II")
    table = catalogue.table(settings.table)
    told = shown(settings, "fingers", 0.5)
    right = colour_factor(skin_of(table.provenance), table.axes, told.region, 0.5)
    assert np.power(told.colour, 0.5) == pytest.approx(right, abs=1e-3)
    assert right[0] > 1.06
