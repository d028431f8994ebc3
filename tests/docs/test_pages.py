"""What the pages say can be followed: links lead somewhere, commands and options exist."""

import contextlib
import io
import re
import shlex
from functools import cache
from pathlib import Path

import pytest

import hylios.commands.cli
import lut_builder.cli

ROOT = Path(__file__).parents[2]
PAGES = sorted([*ROOT.glob("*.md"), *ROOT.glob("docs/*.md"), *ROOT.glob("examples/*.md")])
PROGRAMS = {"hylios": hylios.commands.cli.main, "lut-builder": lut_builder.cli.main}

page = pytest.mark.parametrize("page", PAGES, ids=lambda path: path.relative_to(ROOT).as_posix())


def shell_lines(text):
    """Command lines of a page's indented blocks, without their comments and redirections."""
    for line in re.findall(r"^ {4}((?:hylios|lut-builder) .+)$", text, re.MULTILINE):
        words = shlex.split(line, comments=True)
        yield words[: words.index(">")] if ">" in words else words


@cache
def help_of(program, subcommand):
    output = io.StringIO()
    with contextlib.redirect_stdout(output), pytest.raises(SystemExit) as ended:
        PROGRAMS[program]([subcommand, "--help"])
    assert ended.value.code == 0, f"there is no {program} {subcommand}"
    return set(re.findall(r"(?<![\w-])--?[a-z][a-z-]*", output.getvalue()))


@page
def test_commands_on_the_pages_exist(page):
    for program, subcommand, *words in shell_lines(page.read_text(encoding="utf-8")):
        options = {word.split("=")[0] for word in words if re.match(r"--?[a-z]", word)}
        assert options <= help_of(program, subcommand), f"{program} {subcommand} {options}"


@page
def test_make_targets_on_the_pages_exist(page):
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    targets = set(re.findall(r"^([a-z-]+):", makefile, re.MULTILINE))
    text = page.read_text(encoding="utf-8")
    named = set(re.findall(r"(?:^ {4}|`)make ([a-z-]+)", text, re.MULTILINE))
    assert named <= targets, named - targets


@page
def test_links_lead_somewhere(page):
    text = re.sub(r"`[^`]*`", "", page.read_text(encoding="utf-8"))
    for target in re.findall(r"\]\(([^)\s]+)\)", text):
        if not target.startswith(("http:", "https:", "#")):
            assert (page.parent / target.split("#")[0]).exists(), f"{page.name} links to {target}"


@page
def test_files_named_on_the_pages_exist(page):
    """A path into the sources, such as `hylios/sun/sky.py`, is one that is there."""
    folders = "hylios|lut_builder|blender_addon|examples|tools|docs"
    text = page.read_text(encoding="utf-8")
    for path in re.findall(rf"`((?:{folders})/[\w/.-]*)`", text):
        assert (ROOT / path).exists(), f"{page.name} names {path}"


def test_the_readme_is_short():
    assert len((ROOT / "README.md").read_text(encoding="utf-8").splitlines()) <= 120
