"""Writes the extension's zip: `python -m blender_addon.package`, from the root of a checkout.

The zip holds the files of this add-on that git tracks, the licence, and a wheel of what a scene
needs of hylios. Its bytes depend on these files alone: names are sorted, times and modes fixed,
and nothing is compressed, as versions of zlib differ. Blender's own extension tool validates it.
"""

import argparse
import base64
import hashlib
import io
import os
import subprocess
import sys
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any, cast
from zipfile import ZIP_STORED, ZipFile, ZipInfo

import bpy

from hylios.errors import InputError
from hylios.files import written_beside

ADDON = Path(__file__).parent
ROOT = ADDON.parent
NOT_CARRIED = ("lab", "transport", "commands")
"""Rooms of `hylios` that a scene never needs; the wheel holds all others."""

MANIFEST = "blender_manifest.toml"
LICENSE = "LICENSE"
FIRST_DAY = (1980, 1, 1, 0, 0, 0)
"""The first time that a zip can hold: the time of every file in it."""


def build(destination: Path, root: Path = ROOT) -> Path:
    """Build and validate the extension from the checkout `root`, and return the zip's path.

    Raises
    ------
    InputError
        If `root` is no git checkout, if the zip cannot be written, or if Blender's extension
        tool refuses it.
    OSError
        If a tracked file is missing or the folder cannot be made.
    """
    files = extension_files(root)
    manifest = tomllib.loads(files[MANIFEST].decode())
    destination.mkdir(parents=True, exist_ok=True)
    path = destination / f"{manifest['id']}-{manifest['version']}.zip"
    with written_beside(path) as unfinished:
        unfinished.write_bytes(zipped(files))
        extension_tool("validate", str(unfinished))
    return path


def extension_files(root: Path = ROOT) -> dict[str, bytes]:
    """Contents of the extension's zip by name, with the wheel among them.

    Raises
    ------
    InputError
        If `root` is no git checkout.
    """
    addon = f"{ADDON.name}/"
    left_out = addon + Path(__file__).name
    names = [name for name in tracked(root, addon) if name != left_out]
    files = {name.removeprefix(addon): (root / name).read_bytes() for name in names}
    wheel, content = wheel_of_hylios(root)
    manifest = f'wheels = ["./wheels/{wheel}"]\n'.encode() + files[MANIFEST]
    license_text = (root / LICENSE).read_bytes()
    return {**files, MANIFEST: manifest, LICENSE: license_text, f"wheels/{wheel}": content}


def hylios_files(root: Path = ROOT) -> list[str]:
    """Names within hylios of what the add-on carries: all but the rooms of `NOT_CARRIED`."""
    names = (name.removeprefix("hylios/") for name in tracked(root, "hylios/"))
    return [name for name in names if name.split("/")[0] not in NOT_CARRIED]


def wheel_of_hylios(root: Path = ROOT) -> tuple[str, bytes]:
    """Name and content of the wheel of what a scene needs of hylios.

    Blender keeps an installed wheel as long as its name stays the same, so the version carries
    a digest of what is inside.
    """
    files = {f"hylios/{name}": (root / "hylios" / name).read_bytes() for name in hylios_files(root)}
    manifest = tomllib.loads((root / ADDON.name / MANIFEST).read_text(encoding="utf-8"))
    version = f"{manifest['version']}+{hashlib.sha256(zipped(files)).hexdigest()[:12]}"
    information = f"hylios-{version}.dist-info"
    files[f"{information}/licenses/{LICENSE}"] = (root / LICENSE).read_bytes()
    files[f"{information}/METADATA"] = (
        f"Metadata-Version: 2.4\nName: hylios\nVersion: {version}\n"
        "Summary: Skin, sun, tanning and look-up tables of HyLIoS\n"
        f"License-Expression: GPL-3.0-or-later\nLicense-File: {LICENSE}\nRequires-Dist: numpy\n"
    ).encode()
    files[f"{information}/WHEEL"] = (
        b"Wheel-Version: 1.0\nGenerator: blender_addon.package\n"
        b"Root-Is-Purelib: true\nTag: py3-none-any\n"
    )
    record = f"{information}/RECORD"
    lines = [f"{name},sha256={_digest(files[name])},{len(files[name])}\n" for name in sorted(files)]
    files[record] = f"{''.join(lines)}{record},,\n".encode()
    return f"hylios-{version}-py3-none-any.whl", zipped(files)


def zipped(files: Mapping[str, bytes]) -> bytes:
    """A zip of files by name whose bytes depend on the names and contents alone."""
    buffer = io.BytesIO()
    with ZipFile(buffer, "w") as archive:
        for name in sorted(files):
            member = ZipInfo(name, FIRST_DAY)
            member.compress_type = ZIP_STORED
            member.create_system = 3  # Unix, wherever it is written
            member.external_attr = 0o100644 << 16
            archive.writestr(member, files[name])
    return buffer.getvalue()


def tracked(root: Path, folder: str) -> list[str]:
    """Sorted names, from `root`, of the files in a folder that git tracks.

    Raises
    ------
    InputError
        If `root` is no git checkout that tracks files there.
    """
    names = _git_files(root, folder)
    if not names:
        raise InputError(f"The zip holds what git tracks, and git tracks no {folder} in {root}.")
    return names


def untracked(root: Path = ROOT) -> list[str]:
    """Sorted names of files beside the packed ones that git neither tracks nor ignores."""
    return _git_files(root, "--others", "--exclude-standard", f"{ADDON.name}/", "hylios/")


def _git_files(root: Path, *arguments: str) -> list[str]:
    # In a git hook these variables name another repository.
    environment = {name: text for name, text in os.environ.items() if not name.startswith("GIT_")}
    command = ["git", "-C", str(root), "ls-files", "-z", *arguments]
    try:
        listed = subprocess.run(command, capture_output=True, text=True, env=environment)
    except FileNotFoundError as error:
        raise InputError("The zip holds what git tracks, and git is not installed.") from error
    if listed.returncode:
        said = " ".join(listed.stderr.split())
        raise InputError(f"The zip holds what git tracks, and {root} is no checkout of it: {said}")
    return sorted(filter(None, listed.stdout.split("\0")))


def _digest(content: bytes) -> str:
    return base64.urlsafe_b64encode(hashlib.sha256(content).digest()).rstrip(b"=").decode()


def extension_tool(*arguments: str) -> None:
    """Have Blender's own tool for extensions do something.

    Raises
    ------
    InputError
        If it refuses, with what it says.
    """
    folder = cast(Any, bpy.utils).system_resource("SCRIPTS", path="addons_core/bl_pkg/cli")
    tool = [sys.executable, str(Path(folder, "blender_ext.py"))]
    done = subprocess.run([*tool, *arguments], capture_output=True, text=True)
    if done.returncode:
        said = " ".join((done.stdout + done.stderr).split())
        raise InputError(f"Blender's extension tool refuses to {arguments[0]}: {said}")


def main() -> int:
    """Build the zip and print its path; status 2 and a sentence where that fails."""
    parser = argparse.ArgumentParser(prog="python -m blender_addon.package", description=__doc__)
    parser.add_argument(
        "--output-dir", type=Path, default=Path("dist"), help="folder for the zip (default: dist)"
    )
    arguments = parser.parse_args()
    try:
        print(build(arguments.output_dir))
        for name in untracked():
            print(f"Not packed, as git does not track it: {name}", file=sys.stderr)
    except (InputError, OSError) as error:
        print(error, file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
