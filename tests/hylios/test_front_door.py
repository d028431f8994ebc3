"""`import hylios`: the names a researcher needs, loaded when used, and their examples."""

import ast
import doctest
import inspect
import json
import re
import subprocess
import sys
from datetime import date
from pathlib import Path

import pytest

import hylios

ROOT = Path(__file__).parents[2]
HEAVY = ("numba", "colour", "scipy", "matplotlib", "bpy")


def in_python(code, *path):
    """Standard output of code in a Python of its own, with folders first on its path."""
    done = subprocess.run(
        [sys.executable, "-c", f"import sys; sys.path[:0] = {[str(p) for p in path]}\n{code}"],
        capture_output=True,
        text=True,
        cwd=ROOT,
    )
    assert done.returncode == 0, done.stderr
    return done.stdout.split()


def test_importing_is_quick_and_loads_nothing_heavy():
    """Of processor time, lest it depend on what else the machine does."""
    seconds, *modules = in_python(
        "import time; start = time.process_time(); import hylios\n"
        "print(time.process_time() - start, *sys.modules)"
    )
    assert float(seconds) < 0.1
    assert not set(modules) & {*HEAVY, "numpy"}


def test_a_tan_without_its_colour_loads_numpy_alone():
    modules = in_python(
        "import hylios; skin = hylios.skin_type('III')\n"
        "state = skin.states(hylios.Exposures([0], [30]), times=[240])[0]\n"
        "hylios.solve_spectrum(skin.at(state), [550]); hylios.Model; print(*sys.modules)"
    )
    assert "numpy" in modules and not set(modules) & set(HEAVY)


@pytest.mark.parametrize("name", hylios.__all__)
def test_a_name_is_what_a_type_checker_takes_it_for(name):
    source = ast.parse((ROOT / "hylios" / "__init__.py").read_text(encoding="utf-8"))
    typed = {
        alias.asname or alias.name: (node.module, alias.name)
        for node in ast.walk(source)
        if isinstance(node, ast.ImportFrom)
        for alias in node.names
    }
    module, original = typed[name]
    __import__(module)
    assert getattr(hylios, name) is getattr(sys.modules[module], original)
    assert name in dir(hylios)


def test_there_is_no_other_name():
    with pytest.raises(AttributeError, match="hylios has no name 'spectrums'; dir\\(hylios\\)"):
        _ = hylios.spectrums


@pytest.mark.parametrize("name", hylios.__all__)
def test_examples_of_the_reference_run(name):
    value = getattr(hylios, name)
    tests = [test for test in doctest.DocTestFinder(recurse=False).find(value, name)]
    for test in tests:
        ended = doctest.DocTestRunner(optionflags=doctest.FAIL_FAST).run(test)
        assert ended.failed == 0
    shown = inspect.isclass(value) or inspect.isfunction(value)
    if shown and not issubclass(value if inspect.isclass(value) else object, Exception):
        assert any(test.examples for test in tests), f"hylios.{name} has no example"


def test_type_iii_on_day_10_is_five_lines():
    skin = hylios.skin_type("III")
    state = skin.states(hylios.Exposures([0], [30]), times=[240])[0]
    spectrum = hylios.solve_spectrum(skin.at(state), range(380, 781, 5))
    colour = hylios.Colour.of(spectrum)
    assert spectrum.total.shape == (81,)
    assert colour.lab == pytest.approx([53.3, 9.1, 20.1], abs=0.1)
    assert colour.srgb == pytest.approx([0.605, 0.474, 0.366], abs=0.002)


def test_the_part_that_the_add_on_carries_says_what_it_lacks(tmp_path):
    """As in Blender, where the rooms of a laboratory are left out."""
    for source in (ROOT / "hylios").rglob("*"):
        place = source.relative_to(ROOT)
        if source.is_file() and place.parts[1] not in ("lab", "transport", "commands"):
            (tmp_path / place).parent.mkdir(parents=True, exist_ok=True)
            (tmp_path / place).write_bytes(source.read_bytes())
    code = (
        # Else what an editable installation finds elsewhere would fill the gaps.
        "ours = [finder for finder in sys.meta_path if 'editable' not in repr(finder)]\n"
        "sys.meta_path[:] = ours\n"
        "import hylios; hylios.skin_type('II'); assert hylios.__file__.startswith(sys.path[0])\n"
        "try:\n    hylios.walk_spectrum\n"
        "except ImportError as error:\n    print(error)"
    )
    assert " ".join(in_python(code, tmp_path)) == (
        "hylios.walk_spectrum is not in this copy of hylios, which a Blender add-on carries; "
        "the project's own installation has all of it."
    )


SKIN, LIGHT = hylios.skin_type("III"), range(400, 701, 50)
ARM = hylios.specimen("S3")

MISTAKEN = {
    "a text without a file": (lambda: hylios.read_table("x.exr"), "x.exr cannot be read: No such"),
    "a number for a table": (lambda: hylios.read_table(3), "named '3'; expected a path"),
    "a number for a file": (lambda: hylios.read_specimen(3), "named '3'; expected a path"),
    "an empty name": (lambda: hylios.read_specimen(""), "named ''; expected a path"),
    "a skin solved": (lambda: hylios.solve_spectrum(SKIN, LIGHT), "skin.at(state) is a specimen"),
    "a skin walked": (lambda: hylios.walk_spectrum(SKIN, LIGHT), "skin.at(state) is a specimen"),
    "a skin's BRDF": (lambda: hylios.brdf(SKIN, 550), "skin.at(state) is a specimen"),
    "a skin's profile": (lambda: hylios.profile(SKIN, 550), "skin.at(state) is a specimen"),
    "a skin in the sun": (lambda: hylios.ultraviolet_absorptance(SKIN), "skin.at(state) is a"),
    "a skin fitted": (lambda: hylios.fit_spectrum(SKIN, [500], [0.3]), "skin.at(state) is a"),
    "a name solved": (lambda: hylios.solve_spectrum("III", LIGHT), "the specimen is 'III'; expe"),
    "a name tanned": (lambda: hylios.Skin.of("S3"), "the specimen is 'S3'; expected a Specimen"),
    "nothing seen": (lambda: hylios.Colour.of(None), "the spectrum is 'None'; expected one with"),
    "a dose alone": (lambda: SKIN.states(30, times=[1]), "exposures are '30'; expected Exposures("),
    "a dose's history": (lambda: SKIN.history(30, 1), "exposures are '30'; expected Exposures("),
    "a day as text": (
        lambda: hylios.sun_doses("2025-06-21", 10, 16, 40, None),
        "the day is '2025-06-21'; expected a datetime.date",
    ),
    "no absorptance": (
        lambda: hylios.sun_doses(date(2025, 6, 21), 10, 16, 40, None),
        "the absorptance is 'None'; expected a skin's",
    ),
    "types in a list": (lambda: hylios.skin_type(["III"]), "no skin type \"['III']\"; there are I"),
    "names in a list": (lambda: hylios.specimen(["S3"]), "no specimen \"['S3']\"; there are S1"),
    "a text as a colour": (lambda: hylios.fit_colour(ARM, "red"), "red; expected an array of num"),
}


@pytest.mark.parametrize("name", MISTAKEN)
def test_what_is_mistaken_for_something_else_is_one_sentence(name):
    call, sentence = MISTAKEN[name]
    with pytest.raises(hylios.InputError, match=re.escape(sentence)):
        call()


@pytest.mark.parametrize("wavelengths", [[500], range(500, 601, 10), range(400, 691, 10)])
def test_a_spectrum_that_ends_in_the_visible_has_no_colour(wavelengths):
    """`hylios swatch` refuses the same."""
    with pytest.raises(hylios.InputError, match="a colour needs 400 to 700 nm"):
        hylios.Colour.of(hylios.solve_spectrum(ARM, wavelengths))


def test_files_are_named_by_text_or_path(tmp_path):
    file = tmp_path / "mine.toml"
    file.write_text('base = "S3"\npapillary_blood = 0.4\n')
    assert hylios.read_specimen(str(file)) == hylios.read_specimen(file)
    table = ROOT / "blender_addon" / "tables" / "III.exr"
    first, second = hylios.read_table(str(table)), hylios.read_table(table)
    assert first.provenance == second.provenance


def test_an_editor_knows_the_types_of_the_readmes_lines(tmp_path):
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    (lines,) = re.findall(r"```python\n(.*?)```", readme, re.DOTALL)
    shown = ("colour.srgb", "colour.lab", "spectrum.total", "skin.states(hylios.Exposures(), [1])")
    file = tmp_path / "readme.py"
    file.write_text(lines + "".join(f"reveal_type({name})\n" for name in shown))
    checker = Path(sys.executable).with_name("basedpyright")
    (tmp_path / "pyrightconfig.json").write_text(
        json.dumps({"typeCheckingMode": "standard", "extraPaths": [str(ROOT)]})
    )
    command = [checker, "-p", tmp_path, "--pythonpath", sys.executable, "--outputjson"]
    output = subprocess.run(command, capture_output=True, text=True, cwd=tmp_path)
    said = json.loads(output.stdout)["generalDiagnostics"]
    assert [one["message"] for one in said if one["severity"] == "error"] == []
    types = [one["message"] for one in said if one["severity"] == "information"]
    assert len(types) == len(shown)
    assert all("float64" in text or "floating[_64Bit]" in text for text in types), types
