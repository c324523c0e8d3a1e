// Writes a plant as SVG to standard output: node node.mjs > plant.svg
import { draw, expand } from 'lsystem';

const plant = { axiom: 'X', rules: 'X -> F-[[X]+X]+F[+FX]-X\nF -> FF', angle: 22.5, heading: 65 };
console.error(`${expand(plant, 5).length} symbols`);

const { segments } = draw(plant, 5);
let path = '';
let [left, top, right, bottom] = [Infinity, Infinity, -Infinity, -Infinity];
for (let i = 0; i < segments.length; i += 4) {
    // The y axis of SVG points down.
    const [x0, y0, x1, y1] = [segments[i], -segments[i + 1], segments[i + 2], -segments[i + 3]];
    path += `M${x0} ${y0}L${x1} ${y1}`;
    [left, right] = [Math.min(left, x0, x1), Math.max(right, x0, x1)];
    [top, bottom] = [Math.min(top, y0, y1), Math.max(bottom, y0, y1)];
}
const box = [left - 1, top - 1, right - left + 2, bottom - top + 2].join(' ');
console.log(
    `<svg xmlns="http://www.w3.org/2000/svg" viewBox="${box}">` +
        `<path d="${path}" fill="none" stroke="#1f5c3a" stroke-width="0.4" stroke-linecap="round"/></svg>`,
);
