"""The page for studios names all operators with their keywords, and all settings, and no others."""

import re
from pathlib import Path

import pytest

from blender_addon import ops, props

TEXT = (Path(__file__).parents[2] / "docs" / "studio.md").read_text(encoding="utf-8")
OPERATORS = {cls.bl_idname.removeprefix("skin_tan."): cls for cls in ops.CLASSES}
OF_A_DIALOG = {"filter_glob"}
"""A keyword that does nothing in a script."""

HEADINGS = {
    "### Settings": props.SkinTanSettings,
    "#### A region": props.SkinTanRegion,
    "#### An exposure": props.SkinTanExposure,
    "#### A mask": props.SkinTanMask,
    "#### Biology": props.SkinTanBiology,
    "#### The scene's": props.SkinTanScene,
}


def first_cells(heading):
    """The first cell of all rows of the table under a heading."""
    section = re.split(r"^#+ ", TEXT.split(f"{heading}\n")[1], flags=re.MULTILINE)[0]
    return [row.split("|")[1] for row in re.findall(r"^\| `.*$", section, re.MULTILINE)]


def calls():
    """Operators of the page with their keywords."""
    cells = " ".join(first_cells("### Operators"))
    return {
        name: set(re.findall(r"(\w+)=", keywords))
        for name, keywords in re.findall(r"(\w+)\(([^`]*)\)`", cells)
    }


def settings_of(cls):
    """Settings of a group, but for what Apply notes, and its name, which all groups have."""
    return {
        name
        for name, deferred in cls.__annotations__.items()
        if name != "name" and "HIDDEN" not in deferred.keywords.get("options", ())
    }


def test_all_operators_are_on_the_page():
    assert set(calls()) == set(OPERATORS)


@pytest.mark.parametrize("name", OPERATORS)
def test_all_keywords_are_on_the_page(name):
    is_preset = name.endswith("preset_add")
    ours = [cls for cls in OPERATORS[name].__mro__ if cls.__module__.startswith("blender_addon")]
    ours = ours[:1] if is_preset else ours
    declared = {keyword for cls in ours for keyword in cls.__dict__.get("__annotations__", ())}
    own = {keyword for keyword in declared if not keyword.startswith("_")} - OF_A_DIALOG
    inherited = {"filepath"} if name.endswith(("exposures", "schedule", "weather")) else set()
    if is_preset:
        inherited = {"name"}
    assert calls()[name] == own | inherited


@pytest.mark.parametrize("heading", HEADINGS)
def test_all_settings_are_on_the_page(heading):
    named = set(re.findall(r"`(\w+)`", " ".join(first_cells(heading))))
    assert named - {"name"} == settings_of(HEADINGS[heading])


def test_films_and_regions_have_the_settings_of_a_mask():
    wanted = settings_of(props.SkinTanMask)
    assert settings_of(props.SkinTanFilmMask) == settings_of(props.SkinTanRegionMask) == wanted
