#!/bin/sh
# Makes the virtual environment VENV with everything that the project needs, and says in one
# sentence what is missing where it cannot. Usage: tools/environment.sh VENV [PYTHON]
set -eu
venv=$1
wanted=${2:-}
root=$(cd "$(dirname "$0")/.." && pwd)

version_of() {
    "$1" -c 'import sys; print("%d.%d" % sys.version_info[:2])' 2>/dev/null || echo none
}

fits() {
    case $(version_of "$1") in 3.11 | 3.13) return 0 ;; *) return 1 ;; esac
}

python=""
if [ -n "$wanted" ]; then
    fits "$wanted" && python=$wanted
else
    for candidate in python3.11 python3.13 python3 "$HOME"/.pyenv/versions/3.1[13].*/bin/python; do
        if fits "$candidate"; then
            python=$candidate
            break
        fi
    done
fi
if [ -z "$python" ]; then
    looked=${wanted:-python3}
    echo "Python 3.11 or 3.13 is needed (Blender exists for no other); $looked is" \
        "$(version_of "$looked"): set PYTHON=... to one that fits." >&2
    exit 2
fi

stamp=$venv/.ready
# The interpreter and the requirements together say whether what is there can be kept.
want="$(version_of "$python") ${BPY:-} $(cksum <"$root/pyproject.toml")"
if [ -f "$stamp" ] && [ "$(cat "$stamp")" = "$want" ]; then
    exit 0
fi
echo "Setting up $venv with $python (Python $(version_of "$python"))."
rm -rf "$venv"
if ! "$python" -m venv "$venv" >/dev/null 2>&1; then
    echo "$python cannot make a virtual environment: install the Debian package" \
        "python$(version_of "$python")-venv." >&2
    exit 2
fi
if [ -n "${BPY:-}" ]; then
    set -- "$root[test]" "bpy==$BPY" "numpy<2"
else
    set -- "$root[test,blender]"
fi
"$venv/bin/python" -m pip install --quiet --disable-pip-version-check --editable "$@"
"$venv/bin/python" "$root/tools/check_libraries.py"
echo "$want" >"$stamp"
