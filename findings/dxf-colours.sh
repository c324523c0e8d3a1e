#!/usr/bin/env bash
# A small DXF (R2000) without tables, as plotters' programs write it: one closed polyline on layer 0 with its own colour, red (62 is 1).
# Seen with dxf 5.3.1: `toPolylines` says red, `toSVG` of the same helper draws black; with a table that names the layer both say red. dxf-parser
# 1.1.2 says red.
set -euo pipefail
export PYTHONWARNINGS=ignore
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --prefix . dxf@5.3.1 dxf-parser@1.1.2

cat >read.mjs <<'END'
import { Helper } from 'dxf';
import parser from 'dxf-parser';

const section = (name, ...lines) => ['0', 'SECTION', '2', name, ...lines, '0', 'ENDSEC'];
const layer = ['0', 'LAYER', '2', '0', '70', '0', '62', '7', '6', 'CONTINUOUS'];
const header = section('HEADER', '9', '$ACADVER', '1', 'AC1015');
const tables = section('TABLES', '0', 'TABLE', '2', 'LAYER', '70', '1', ...layer, '0', 'ENDTAB');
const corners = ['10', '0', '20', '0', '10', '9', '20', '0', '10', '9', '20', '9'];
const drawing = section('ENTITIES', '0', 'LWPOLYLINE', '8', '0', '62', '1', '90', '3', '70', '1', ...corners);
for (const [name, lines] of [
    ['without tables', [...header, ...drawing]],
    ['with a layer', [...header, ...tables, ...drawing]],
]) {
    const text = [...lines, '0', 'EOF', ''].join('\n');
    const helper = new Helper(text);
    console.log(name, 'toPolylines', helper.toPolylines().polylines[0].rgb.join());
    console.log(name, 'toSVG', helper.toSVG().match(/stroke="(rgb[^"]*)"/)[1]);
    console.log(name, 'dxf-parser', new (parser.default ?? parser)().parseSync(text).entities[0].color.toString(16));
}
END

{
    node read.mjs
} | tee seen.txt

diff - seen.txt <<'END' && echo 'as stated'
without tables toPolylines 255,0,0
without tables toSVG rgb(0, 0, 0)
without tables dxf-parser ff0000
with a layer toPolylines 255,0,0
with a layer toSVG rgb(255, 0, 0)
with a layer dxf-parser ff0000
END
