#!/bin/sh
# Builds the wheel, installs it in a fresh environment outside the checkout, runs the main job there.
set -eu
python=$1
checkout=$(pwd)
place=$(mktemp -d)
trap 'rm -rf "$place"' EXIT
"$python" -m build --outdir "$place/dist" "$checkout" >"$place/build.log" 2>&1 || {
    cat "$place/build.log"
    exit 1
}
"$python" -m venv "$place/venv"
"$place/venv/bin/python" -m pip --disable-pip-version-check install --quiet \
    --constraint "$checkout/constraints.txt" "$place"/dist/*.whl
cd "$place"
venv/bin/ssrics --version
venv/bin/ssrics list
venv/bin/ssrics run simple --out results
venv/bin/ssrics run demo --out demo --quiet
for name in manifest.json decisions.csv landmarks.csv path.csv map/map.png scores.json report.html; do
    test -s "results/$name" || { echo "wheel: results/$name is missing" >&2; exit 1; }
done
echo "wheel: $(basename dist/*.whl) works outside the checkout"
