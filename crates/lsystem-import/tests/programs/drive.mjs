// Runs sketches with stubs of p5.js, and prints a line with the ends of all lines for each, y up.
//
// node drive.mjs ROLL FILE... : every random choice takes the share ROLL (0 to 1) of the weights.

import { readFileSync } from 'node:fs';
import { createContext, runInContext } from 'node:vm';

const [roll, ...files] = process.argv.slice(2);
for (const file of files) {
    const found = [];
    const context = createContext({
        width: 800,
        height: 800,
        createCanvas() {},
        noLoop() {},
        background() {},
        translate() {},
        randomSeed() {},
        random: (most) => Number(roll) * most,
        line: (x0, y0, x1, y1) => found.push(x0, -y0, x1, -y1),
    });
    runInContext(`${readFileSync(file, 'utf8')}\nsetup();\ndraw();`, context);
    console.log(found.join(' '));
}
