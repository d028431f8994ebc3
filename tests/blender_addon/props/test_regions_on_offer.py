"""Kinds of region that the panel offers."""

from blender_addon.props.region import KINDS
from hylios.skin.regions import REGIONS


def test_kinds_are_the_regions_and_files_hold_them_by_the_numbers_of_before():
    assert {name.lower() for name, *_ in KINDS} == set(REGIONS)
    numbers = {name: number for name, number, *_ in KINDS}
    former = "FRECKLES MOLES PALMS LIPS FLUSH VITILIGO".split()
    assert [numbers[name] for name in former] == list(range(6))
    assert len(set(numbers.values())) == len(KINDS)
