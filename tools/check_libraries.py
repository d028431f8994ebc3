"""Says which Debian packages to install where system libraries that bpy loads are missing.

With --packages it prints the packages of all libraries that bpy loads.
"""

import argparse
import importlib.util
import subprocess
import sys

DEBIAN_PACKAGES = {
    "libEGL.so.1": "libegl1",
    "libGL.so.1": "libgl1",
    "libICE.so.6": "libice6",
    "libSM.so.6": "libsm6",
    "libX11.so.6": "libx11-6",
    "libXfixes.so.3": "libxfixes3",
    "libXi.so.6": "libxi6",
    "libXrender.so.1": "libxrender1",
    "libXxf86vm.so.1": "libxxf86vm1",
    "libgomp.so.1": "libgomp1",
    "libxkbcommon.so.0": "libxkbcommon0",
}


def missing_libraries(linked: str) -> list[str]:
    """Names of the libraries that the output of `ldd` reports as not found."""
    return [line.split()[0] for line in linked.splitlines() if line.endswith("not found")]


def sentence(missing: list[str]) -> str:
    """What to install for the missing libraries."""
    packages = sorted({DEBIAN_PACKAGES[name] for name in missing if name in DEBIAN_PACKAGES})
    unknown = [name for name in missing if name not in DEBIAN_PACKAGES]
    said = f"Blender needs the system libraries {', '.join(missing)}"
    if packages:
        said += f": install them with apt-get install {' '.join(packages)}"
    if unknown:
        said += f" (the packages that hold {', '.join(unknown)} are not known here)"
    return f"{said}."


def main() -> int:
    """Check the installed bpy; status 2 and a sentence where libraries are missing."""
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--packages", action="store_true", help="print the packages of all")
    if parser.parse_args().packages:
        print(*DEBIAN_PACKAGES.values())
        return 0
    module = importlib.util.find_spec("bpy")
    if module is None or module.origin is None:
        print("The Python package bpy is not installed.", file=sys.stderr)
        return 2
    linked = subprocess.run(["ldd", module.origin], capture_output=True, text=True).stdout
    missing = missing_libraries(linked)
    if missing:
        print(sentence(missing), file=sys.stderr)
    return 2 if missing else 0


if __name__ == "__main__":
    sys.exit(main())
