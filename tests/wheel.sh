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
venv/bin/ssrics view results --out run.html
test -s run.html
venv/bin/python -m pip --disable-pip-version-check install --quiet \
    --constraint "$checkout/constraints.txt" "$(echo "$place"/dist/*.whl)[study]"
venv/bin/ssrics study new mine --out study
venv/bin/ssrics study simulate simple --participants 3 --out people.csv
venv/bin/ssrics compare results people.csv --out compared >compared.txt
test -s compared/comparison.html
venv/bin/python - <<'END'
from importlib import resources

for name in ("static/plan.js", "template/plan.html"):
    assert resources.files("ssrics_like.study").joinpath(name).is_file(), name
END
for name in manifest.json decisions.csv landmarks.csv path.csv map/map.png scores.json report.html; do
    test -s "results/$name" || { echo "wheel: results/$name is missing" >&2; exit 1; }
done
echo "wheel: $(basename dist/*.whl) works outside the checkout"
