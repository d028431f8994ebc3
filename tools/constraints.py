"""Writes constraints/python3.X.txt anew: PYTHON tools/constraints.py, for that PYTHON's version.

The newest versions that pip finds to fit together for the project with all its extras. Nothing is
installed. A version holds on every platform; what other platforms need beyond this one's packages
stays free.
"""

import argparse
import json
import subprocess
import sys
import tempfile
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

ROOT = Path(__file__).parent.parent
PROJECT = tomllib.loads((ROOT / "pyproject.toml").read_text(encoding="utf-8"))["project"]
HEAD = "# The versions that the tests run with; `make constraints` writes this file anew.\n"


def pins(report: Mapping[str, Any]) -> str:
    """Lines NAME==VERSION of all packages but our own in pip's report of an installation."""
    packages = (entry["metadata"] for entry in report["install"])
    versions = {package["name"]: package["version"] for package in packages}
    versions.pop(PROJECT["name"], None)
    names = sorted(versions, key=str.lower)
    return "".join(f"{name}=={versions[name].split('+')[0]}\n" for name in names)


def main() -> int:
    extras = ",".join(PROJECT["optional-dependencies"])
    with tempfile.TemporaryDirectory() as folder:
        report = Path(folder, "report.json")
        command = [sys.executable, "-m", "pip", "install", "--quiet", "--disable-pip-version-check"]
        command += ["--dry-run", "--ignore-installed", "--report", str(report), f"{ROOT}[{extras}]"]
        if subprocess.run(command).returncode:
            print("pip found no versions that fit together.", file=sys.stderr)
            return 2
        text = pins(json.loads(report.read_text(encoding="utf-8")))
    path = ROOT / "constraints" / f"python{sys.version_info[0]}.{sys.version_info[1]}.txt"
    path.parent.mkdir(exist_ok=True)
    path.write_text(HEAD + text, encoding="utf-8")
    print(path)
    return 0


if __name__ == "__main__":
    argparse.ArgumentParser(description=__doc__).parse_args()
    sys.exit(main())
