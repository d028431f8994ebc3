#!/bin/sh
# Installs the project, plain and with each extra alone, into fresh environments outside the
# checkout, and tries what each is there for. Minutes an extra, and packages are fetched.
# Usage: tools/check_extras.sh [PYTHON [EXTRA...]], where the plain installation is called plain.
set -eu
root=$(cd "$(dirname "$0")/.." && pwd)
python=${1:-python3}
[ $# -eq 0 ] || shift
[ $# -gt 0 ] || set -- plain blender cluster docs release test
version=$("$python" -c 'import sys; print("%d.%d" % sys.version_info[:2])')
export OPENBLAS_NUM_THREADS=1

work=$(mktemp -d)
trap 'rm -rf "$work"' EXIT
# What git tracks, as it is now: nothing left over in build/ gets in.
git -C "$root" ls-files -z | (cd "$root" && xargs -0 tar cf - --) | (mkdir "$work/source" &&
    tar xf - -C "$work/source")
git init -q "$work/source"
git -C "$work/source" add .

check_plain() {
    hylios tan --dose 0:5 --hours 24 >tan.csv
    hylios reflectance --wavelengths 550 --rays 500 >reflectance.csv
    hylios plot reflectance.csv -o plot.png
    hylios swatch --rays 200 -o swatch.png
    lut-builder build --preset preview --knots 1 --no-profile --bands visible -o table.exr
    lut-builder info table.exr >information.txt
    if python -c "import blender_addon" 2>/dev/null; then
        echo "The add-on is installed as a package of its own." >&2
        exit 1
    fi
    git -C "$work/source" ls-files hylios lut_builder >tracked.txt
    python - <<'END'
from importlib.metadata import files
from pathlib import Path

installed = {str(path) for path in files("skin-tan")}
assert any(name.endswith("licenses/LICENSE") for name in installed), "no licence"
missing = set(Path("tracked.txt").read_text().splitlines()) - installed
assert not missing, missing
END
}

check_blender() {
    cd "$work/source"
    python -m blender_addon.package --output-dir dist
}

check_cluster() {
    python - <<'END'
from distributed import Client, LocalCluster

from lut_builder.jobs.cluster import on_cluster  # noqa: F401

with LocalCluster(n_workers=1, processes=False, dashboard_address=None) as cluster:
    with Client(cluster) as client:
        assert client.submit(sum, [1, 2]).result() == 3
END
}

check_docs() {
    cd "$work/source"
    python -m sphinx -W --keep-going -q -b html docs out/docs
}

check_release() {
    cd "$work/source"
    python -m build --outdir dist >/dev/null
    if python -m zipfile --list dist/*.whl | grep blender_addon; then
        echo "The add-on is in the wheel." >&2
        exit 1
    fi
}

check_test() {
    cd "$work/source"
    python -m ruff check .
    basedpyright --version
    python -m pytest -q -m "not slow" -n 1 tests/hylios/tanning tests/hylios/table
}

for extra in "$@"; do
    wanted=$work/source
    [ "$extra" = plain ] || wanted="$wanted[$extra]"
    echo "== $extra, Python $version"
    "$python" -m venv "$work/$extra"
    "$work/$extra/bin/python" -m pip install --quiet --disable-pip-version-check \
        --constraint "$root/constraints/python$version.txt" "$wanted"
    mkdir "$work/in-$extra"
    (PATH=$work/$extra/bin:$PATH && cd "$work/in-$extra" && "check_$extra")
    rm -rf "${work:?}/$extra"
done
echo "Each installs and works alone: $*"
