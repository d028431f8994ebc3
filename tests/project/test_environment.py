"""Setting up: what a machine that lacks something is told, and which versions it gets."""

import importlib.util
import os
import re
import subprocess
import tomllib
from pathlib import Path

import pytest
from packaging.requirements import Requirement

ROOT = Path(__file__).parent.parent.parent


def fake_python(folder, version):
    path = folder / "python"
    path.write_text(f"#!/bin/sh\necho {version}\n")
    path.chmod(0o755)
    return path


def test_another_python_gets_one_sentence(tmp_path):
    python = fake_python(tmp_path, "3.12")
    command = [ROOT / "tools" / "environment.sh", tmp_path / "venv", python]
    ended = subprocess.run(command, capture_output=True, text=True)
    assert ended.returncode == 2
    assert ended.stderr.startswith("Python 3.11 or 3.13 is needed")
    assert "is 3.12: set PYTHON=" in ended.stderr
    assert ended.stderr.count("\n") == 1
    assert not (tmp_path / "venv").exists()


def test_a_python_without_venv_is_told_the_debian_package(tmp_path):
    script = '#!/bin/sh\n[ "$1" = -c ] && echo 3.13 && exit\nexit 1\n'
    python = tmp_path / "python"
    python.write_text(script)
    python.chmod(0o755)
    command = [ROOT / "tools" / "environment.sh", tmp_path / "venv", python]
    ended = subprocess.run(command, capture_output=True, text=True, env=dict(os.environ, BPY=""))
    assert ended.returncode == 2
    assert "install the Debian package python3.13-venv" in ended.stderr


def tool(name):
    place = ROOT / "tools" / f"{name}.py"
    specification = importlib.util.spec_from_file_location(name, place)
    module = importlib.util.module_from_spec(specification)
    specification.loader.exec_module(module)
    return module


def test_missing_libraries_become_debian_packages():
    module = tool("check_libraries")
    linked = (
        "\tlinux-vdso.so.1 (0x1)\n\tlibXi.so.6 => not found\n"
        "\tlibc.so.6 => /lib/libc.so.6 (0x2)\n\tlibodd.so.1 => not found\n"
    )
    assert module.missing_libraries(linked) == ["libXi.so.6", "libodd.so.1"]
    assert module.sentence(["libXi.so.6", "libSM.so.6", "libodd.so.1"]) == (
        "Blender needs the system libraries libXi.so.6, libSM.so.6, libodd.so.1: install them "
        "with apt-get install libsm6 libxi6 (the packages that hold libodd.so.1 are not known "
        "here)."
    )


@pytest.mark.parametrize("version", ["3.11", "3.13"])
def test_every_requirement_is_pinned_to_a_version_that_fits(version):
    project = tomllib.loads((ROOT / "pyproject.toml").read_text())["project"]
    lines = (ROOT / "constraints" / f"python{version}.txt").read_text().splitlines()[1:]
    assert all(re.fullmatch(r"[A-Za-z0-9._-]+==[0-9][0-9a-z.]*", line) for line in lines)
    pinned = dict(line.lower().split("==") for line in lines)
    extras = project["optional-dependencies"].values()
    for requirement in map(Requirement, [*project["dependencies"], *sum(extras, [])]):
        if requirement.marker is None or requirement.marker.evaluate({"python_version": version}):
            assert requirement.specifier.contains(pinned[requirement.name.lower()]), requirement


def test_pins_leave_out_our_own_package():
    installed = [("skin-tan", "0.1.0"), ("numpy", "2.5.5"), ("Jinja2", "3.1.6+local")]
    report = {
        "install": [
            {"metadata": {"name": name, "version": version}, "download_info": {"url": "file:///x"}}
            for name, version in installed
        ]
    }
    assert tool("constraints").pins(report) == "Jinja2==3.1.6\nnumpy==2.5.5\n"


def test_all_files_state_one_version(capsys):
    module = tool("check_version")
    (version,) = set(module.versions().values())
    assert module.main(f"v{version}") == 0
    assert module.main("v9.9.9") == 2
    assert "blender_addon/blender_manifest.toml has version " in capsys.readouterr().err
