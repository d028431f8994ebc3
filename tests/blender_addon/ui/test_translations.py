"""Labels in German, and that lines fit into the sidebar in English and in German."""

import ast
from pathlib import Path
from string import Formatter

import pytest

import blender_addon
from blender_addon import translations
from blender_addon.model.lines import Line

SOURCES = Path(blender_addon.__file__).parent
WIDEST = 205
"""Pixels for text beside an icon, in the sidebar at its default width."""

WIDEST_BUTTON = 85
"""Pixels for text in one of two buttons side by side, beside an icon."""

VALUES = {
    "day": 364.5,
    "mmd": 56.7,
    "med": 33.3,
    "dose": 100.0,
    "multiple": 12.5,
    "index": 11.0,
    "hours": 12.5,
    "minutes": 59.0,
    "start": 10.5,
    "end": 15.5,
    "meter": 123.0,
    "tanning": 123.0,
    "darkest": 120.0,
    "last": 365.0,
    "half": 211.0,
    "first": 100.0,
    "count": 20,
    "until": 120.0,
    "again": 240.0,
    "gone": 365.0,
    "times": 3.28,
    "length": 0.0123,
}


def texts():
    """All texts of the add-on's sources but those of its translations."""
    for path in SOURCES.rglob("*.py"):
        if path.name != "translations.py":
            for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
                if isinstance(node, ast.Constant) and isinstance(node.value, str):
                    yield node.value


def lines():
    """English lines with fields, as the sources make them."""
    for path in SOURCES.rglob("*.py"):
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"))):
            if isinstance(node, ast.Call) and getattr(node.func, "id", "") == "Line":
                yield node.args[0].value


def fields(text):
    return {name for _, name, _, _ in Formatter().parse(text) if name}


def width(text):
    import blf  # which is there once bpy is

    blf.size(0, 11.0)
    return blf.dimensions(0, text)[0]


def test_what_is_translated_is_in_the_add_on():
    assert set(translations.GERMAN) <= set(texts())


def test_translations_have_the_same_values():
    for english, german in translations.GERMAN.items():
        assert fields(english) == fields(german), english


def test_a_line_is_told_in_the_language_of_the_interface(monkeypatch):
    line = Line("Darkest on day {darkest:.0f},", darkest=10.8)
    assert line == translations.told(line) == "Darkest on day 11,"
    german = type("Translations", (), {"pgettext_iface": translations.GERMAN.get})
    app = type("App", (), {"translations": german})
    with monkeypatch.context() as patched:
        patched.setattr(translations, "bpy", type("Bpy", (), {"app": app}))
        assert translations.told(line) == "Am dunkelsten an Tag 11,"
        assert translations.told("as Blender has it") == "as Blender has it"


@pytest.mark.parametrize("message", sorted(set(lines())))
def test_lines_fit_into_the_sidebar(message):
    for text in (message, translations.GERMAN.get(message, "")):
        assert width(text.format(**VALUES)) <= WIDEST, text


def words_of_panels():
    """Plain texts of several words in panels, but for docstrings."""
    for path in (SOURCES / "ui").glob("*.py"):
        tree = ast.parse(path.read_text(encoding="utf-8"))
        said = [node.value for node in ast.walk(tree) if isinstance(node, ast.Expr)]
        for node in ast.walk(tree):
            if isinstance(node, ast.Constant) and node not in said and " " in str(node.value):
                yield node.value


def test_other_words_fit_too():
    plain = {text for text in words_of_panels() if not fields(text)}
    assert "Select a mesh object" in plain
    for text in (*plain, *translations.GERMAN.values()):
        assert width(text.format(**VALUES)) <= WIDEST, text


@pytest.mark.parametrize("english", ["Paint Mask", "From Clothes", "Darkest Day", "Reset"])
def test_words_of_half_a_row_fit(english):
    for text in (english, translations.GERMAN[english]):
        assert width(text) <= WIDEST_BUTTON, text
