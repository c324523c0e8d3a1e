#!/usr/bin/env bash
# Two lines, from (10, 20) to (30, 20) and from (10, 40) to (30, 45) mm, in two layers, by the profiles of vpype-gcode.
# Seen with vpype 1.15.0 and vpype-gcode 0.13.0: `gcodemm` has no Z, M3 or M5, so that a pen stays down between the lines and the layers;
# `csv` writes x twice and never y; `json` has the same key for each layer, so that Python's json keeps the last one alone.
set -euo pipefail
export PYTHONWARNINGS=ignore
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

python3 -m venv python
python/bin/pip install --quiet --disable-pip-version-check vpype==1.15.0 vpype-gcode==0.13.0

write() {
    python/bin/vpype pagesize a4 line --layer 1 10mm 20mm 30mm 20mm line --layer 2 10mm 40mm 30mm 45mm gwrite --profile "$1" "lines.$1"
}
{
    write gcodemm
    echo "gcodemm: $(grep -c '^G00' lines.gcodemm) moves, $(grep -cE 'Z|M3|M5' lines.gcodemm || true) commands of the pen"
    write csv
    cat lines.csv
    write json
    echo "json: $(grep -c Layer lines.json) layers"
    python/bin/python -c 'import json; print("read:", json.load(open("lines.json")))'
} 2>/dev/null | tee seen.txt

diff - seen.txt <<'END' && echo 'as stated'
gcodemm: 2 moves, 0 commands of the pen
#Operation, X-value, Y-value
Move, 10.000000, 10.000000
Stop, 30.000000, 30.000000
Move, 10.000000, 10.000000
Stop, 30.000000, 30.000000
json: 2 layers
read: {'Layer': {'Line0': [{'X': 10, 'Y': 40}, {'X': 30, 'Y': 45}]}}
END
