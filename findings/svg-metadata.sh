#!/usr/bin/env bash
# Data in the `metadata` of an SVG, where the standard wants them, after programs that make SVG small or plain.
# Seen: SVGO 4.1.0 takes the element away by default; scour 0.38.2 keeps it, by --shorten-ids with another id, and by
# --enable-id-stripping without; picosvg 0.23.0 takes it away.
set -euo pipefail
export PYTHONWARNINGS=ignore
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

python3 -m venv python
python/bin/pip install --quiet --disable-pip-version-check scour==0.38.2 picosvg==0.23.0
npm install --silent --no-audit --no-fund --prefix . svgo@4.1.0

cat >data.svg <<'END'
<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 10 10"><metadata id="notes">{"a": 1}</metadata><path id="line" d="M0 5h10v1z"/></svg>
END
tell() { echo "$1: $(grep -o '<metadata.*</metadata>' || echo none)"; }
{
    node node_modules/svgo/bin/svgo.js --input data.svg --output - | tell SVGO
    python/bin/scour -q -i data.svg | tell scour
    python/bin/scour -q --shorten-ids -i data.svg | tell 'scour --shorten-ids'
    python/bin/scour -q --enable-id-stripping -i data.svg | tell 'scour --enable-id-stripping'
    python/bin/picosvg data.svg | tell picosvg
} | tee seen.txt

diff - seen.txt <<'END' && echo 'as stated'
SVGO: none
scour: <metadata id="notes">{"a": 1}</metadata>
scour --shorten-ids: <metadata id="a">{"a": 1}</metadata>
scour --enable-id-stripping: <metadata>{"a": 1}</metadata>
picosvg: none
END
