#!/bin/sh
# Makes the virtual environment VENV with everything that the project needs, in the versions of
# constraints/, and says in one sentence what is missing where it cannot.
# Usage: tools/environment.sh VENV [PYTHON]
set -eu
venv=$1
wanted=${2:-}
root=$(cd "$(dirname "$0")/.." && pwd)

version_of() {
    "$1" -c 'import sys; print("%d.%d" % sys.version_info[:2])' 2>/dev/null || echo none
}

python=${wanted:-$("$root/tools/pythons.sh" | sed -n '1s/^[^ ]* //p')}
python=${python:-python3}
version=$(version_of "$python")
case $version in
3.11 | 3.13) ;;
*)
    echo "Python 3.11 or 3.13 is needed (Blender exists for no other); $python is" \
        "$version: set PYTHON=... to one that fits." >&2
    exit 2
    ;;
esac

constraints=$root/constraints/python$version.txt
stamp=$venv/.ready
# The interpreter and the requirements together say whether what is there can be kept.
want="$version ${BPY:-} $(cat "$root/pyproject.toml" "$constraints" | cksum)"
if [ -f "$stamp" ] && [ "$(cat "$stamp")" = "$want" ]; then
    exit 0
fi
echo "Setting up $venv with $python (Python $version)."
rm -rf "$venv"
if ! "$python" -m venv "$venv" >/dev/null 2>&1; then
    echo "$python cannot make a virtual environment: install the Debian package" \
        "python$version-venv." >&2
    exit 2
fi
if [ -n "${BPY:-}" ]; then
    # Another Blender than that of the constraints.
    grep -v '^bpy==' "$constraints" >"$venv/constraints.txt"
    set -- "$root[test]" "bpy==$BPY" "numpy<2"
else
    cp "$constraints" "$venv/constraints.txt"
    set -- "$root[test,blender]"
fi
"$venv/bin/python" -m pip install --quiet --disable-pip-version-check \
    --constraint "$venv/constraints.txt" --editable "$@"
"$venv/bin/python" "$root/tools/check_libraries.py"
echo "$want" >"$stamp"
