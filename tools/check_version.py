"""Says where the project's version is not that of a tag: tools/check_version.py v1.2.3."""

import argparse
import re
import sys
from pathlib import Path

ROOT = Path(__file__).parent.parent
PLACES = {
    "hylios/__init__.py": r'^__version__ = "(.+)"$',
    "blender_addon/blender_manifest.toml": r'^version = "(.+)"$',
    "CITATION.cff": r"^version: (.+)$",
}
"""The files that state the version, and the line that does."""


def versions(root: Path = ROOT) -> dict[str, str]:
    """The version that each file states; empty where it states none."""
    stated = {}
    for name, line in PLACES.items():
        match = re.search(line, (root / name).read_text(encoding="utf-8"), re.MULTILINE)
        stated[name] = match[1].strip() if match else ""
    return stated


def main(tag: str) -> int:
    """Status 2, and a sentence for each file that states another version than the tag `vX.Y.Z`."""
    stated = versions()
    wrong = {name: version for name, version in stated.items() if f"v{version}" != tag}
    for name, version in wrong.items():
        print(f"{name} has version {version or 'none'}, the tag is {tag}.", file=sys.stderr)
    return 2 if wrong else 0


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("tag", help="of the release, as v1.2.3")
    sys.exit(main(parser.parse_args().tag))
