"""Writes the extension's zip: `python -m blender_addon.package`.

The zip holds this add-on, the tables in its folder and a wheel of the part of hylios that needs
numpy alone. Blender's own extension tool builds and validates it.
"""

import argparse
import hashlib
import json
import os
import shutil
import subprocess
import sys
import tempfile
from pathlib import Path
from zipfile import ZIP_DEFLATED, ZipInfo

import bpy
from wheel.wheelfile import WheelFile

import hylios
from hylios.errors import InputError

ADDON = Path(__file__).parent
HYLIOS = Path(hylios.__file__).parent
NOT_CARRIED = ("lab", "transport", "commands")
"""Rooms of `hylios` that a scene never needs, as `tests/project/test_layout.py` holds them."""

MANIFEST = "blender_manifest.toml"
# The first day that a zip can hold: the same sources give the same bytes.
EPOCH = (1980, 1, 1, 0, 0, 0)
EPOCH_SECONDS = 315532800


def build(destination: Path, tables: Path = ADDON / "tables") -> Path:
    """Build and validate the extension with the EXR files of a folder, and return its path.

    Raises
    ------
    InputError
        If Blender's extension tool refuses it, with what the tool said.
    """
    destination.mkdir(parents=True, exist_ok=True)
    with tempfile.TemporaryDirectory() as folder:
        staged, built = Path(folder, "skin_tan"), Path(folder, "built")
        built.mkdir()
        _stage(staged, tables)
        _extension_tool("build", "--source-dir", str(staged), "--output-dir", str(built))
        (archive,) = built.glob("*.zip")
        _extension_tool("validate", str(archive))
        return Path(shutil.move(archive, destination / archive.name))


def hylios_files() -> list[str]:
    """Paths within hylios of what the add-on carries: all but the rooms of `NOT_CARRIED`."""
    return sorted(
        path.relative_to(HYLIOS).as_posix()
        for path in HYLIOS.rglob("*")
        if path.is_file()
        and "__pycache__" not in path.parts
        and path.relative_to(HYLIOS).parts[0] not in NOT_CARRIED
    )


def write_wheel(folder: Path) -> Path:
    """Write the wheel of hylios's numpy-only part into a folder and return its path.

    Blender keeps an installed wheel as long as its name stays the same, so the version carries
    a digest of what is inside.
    """
    contents = {f"hylios/{name}": (HYLIOS / name).read_bytes() for name in hylios_files()}
    digest = hashlib.sha256(b"\0".join(contents.values())).hexdigest()[:12]
    version = f"{hylios.__version__}+{digest}"
    information = f"hylios-{version}.dist-info"
    contents[f"{information}/METADATA"] = (
        f"Metadata-Version: 2.4\nName: hylios\nVersion: {version}\n"
        "Summary: Tanning dynamics and look-up tables of skin\n"
        "License-Expression: GPL-3.0-or-later\nRequires-Dist: numpy\n"
    ).encode()
    contents[f"{information}/WHEEL"] = (
        b"Wheel-Version: 1.0\nGenerator: blender_addon.package\n"
        b"Root-Is-Purelib: true\nTag: py3-none-any\n"
    )
    path = folder / f"hylios-{version}-py3-none-any.whl"
    with WheelFile(path, "w") as archive:
        for name, data in contents.items():
            member = ZipInfo(name, EPOCH)
            member.compress_type = ZIP_DEFLATED
            member.external_attr = 0o644 << 16
            archive.writestr(member, data)
    return path


def _stage(staged: Path, tables: Path) -> None:
    """Lay out the extension as it is to be packed."""
    for folder in (staged, staged / "tables", staged / "wheels"):
        folder.mkdir()
    for source in ADDON.glob("*.py"):
        if source.name != Path(__file__).name:
            shutil.copy(source, staged)
    for table in tables.glob("*.exr"):
        shutil.copy(table, staged / "tables")
    wheel = write_wheel(staged / "wheels")
    files = [path for path in staged.rglob("*") if path.is_file() and path != wheel]
    packed = sorted(path.relative_to(staged).as_posix() for path in files)
    (staged / MANIFEST).write_text(
        f'wheels = ["./wheels/{wheel.name}"]\n{(ADDON / MANIFEST).read_text()}\n'
        f"[build]\npaths = {json.dumps(packed)}\n"
    )
    for path in staged.rglob("*"):
        path.chmod(0o755 if path.is_dir() else 0o644)
        os.utime(path, (EPOCH_SECONDS, EPOCH_SECONDS))


def _extension_tool(*arguments: str) -> None:
    folder = bpy.utils.system_resource("SCRIPTS", path="addons_core/bl_pkg/cli")
    tool = [sys.executable, str(Path(folder, "blender_ext.py"))]
    # A zip holds local times.
    environment = {**os.environ, "TZ": "UTC"}
    done = subprocess.run([*tool, *arguments], capture_output=True, text=True, env=environment)
    if done.returncode:
        said = " ".join((done.stdout + done.stderr).split())
        raise InputError(f"Blender's extension tool refuses to {arguments[0]}: {said}")


def main() -> int:
    parser = argparse.ArgumentParser(prog="python -m blender_addon.package", description=__doc__)
    parser.add_argument(
        "--output-dir", type=Path, default=Path("dist"), help="folder for the zip (default: dist)"
    )
    try:
        print(build(parser.parse_args().output_dir))
    except (InputError, OSError) as error:
        print(error, file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
