#!/usr/bin/env bash
# A symbol that vanishes is a rule with an empty successor.
# Seen: with lindenmayer 1.5.4, `F: ''` and a function with the result '' leave every F, because the empty text counts as no
# successor, and `F: ['']` takes it away; of two rules by setProduction the last counts, and of `A` and `B<A` in one object the one
# that was written first.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

npm install --silent --no-audit --no-fund --prefix . lindenmayer@1.5.4

cat >derive.mjs <<'END'
import LSystem from 'lindenmayer';

const derive = (axiom, productions) => new LSystem({ axiom, productions }).iterate(1);
console.log("'':", derive('FXF', { F: '' }));
console.log("['']:", derive('FXF', { F: [''] }));
console.log('a function:', derive('FXF', { F: () => '' }));
const twice = new LSystem({ axiom: 'F' });
twice.setProduction('F', 'A');
twice.setProduction('F', 'B');
console.log('setProduction twice:', twice.iterate(1));
console.log('A, B<A:', derive('BA', { A: 'x', 'B<A': 'y' }));
console.log('B<A, A:', derive('BA', { 'B<A': 'y', A: 'x' }));
END
node derive.mjs | tee seen.txt

diff - seen.txt <<'END' && echo 'as stated'
'': FXF
['']: X
a function: FXF
setProduction twice: B
A, B<A: Bx
B<A, A: By
END
