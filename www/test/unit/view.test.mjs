import assert from 'node:assert/strict';
import { test } from 'node:test';
import { between, pan, placement, zoomAt } from '../../js/view.js';
import { dice } from './random.mjs';

/** Projects a point, in fitted extents from the fitted centre: CSS pixels right of and below the canvas's centre. */
const seen = (
    /** @type {any} */ view,
    /** @type {number} */ scale,
    /** @type {number} */ x,
    /** @type {number} */ y,
) => [(x - view.x) * scale * view.zoom, (view.y - y) * scale * view.zoom];

/** @param {number[]} a @param {number[]} b @param {number} within */
function near(a, b, within) {
    a.forEach((value, at) => assert.ok(Math.abs(value - Number(b[at])) <= within, `${a} is not ${b}`));
}

/** @param {() => number} roll */
const randomView = (roll) => ({ x: roll() - 0.5, y: roll() - 0.5, zoom: 10 ** (roll() * 6 - 1) });

test('a drag moves every point with the pointer', () => {
    const roll = dice(1);
    for (let round = 0; round < 200; round++) {
        const view = randomView(roll);
        const [x, y] = seen(view, 700, 0.1, 0.2);
        const moved = seen(pan(view, 30, -20, 700), 700, 0.1, 0.2);
        near(moved, [Number(x) + 30, Number(y) - 20], 1e-6 * view.zoom);
    }
});

test('a zoom keeps the point under the pointer', () => {
    const roll = dice(2);
    for (let round = 0; round < 200; round++) {
        const view = randomView(roll);
        const [px, py] = [roll() * 800 - 400, roll() * 600 - 300];
        const [x, y] = [view.x + px / (700 * view.zoom), view.y - py / (700 * view.zoom)];
        near(seen(zoomAt(view, 1.3, px, py, 700), 700, x, y), [px, py], 1e-6 * view.zoom);
    }
    const deepest = { x: 0, y: 0, zoom: 1e25, fx: 0, fy: 0 };
    assert.deepEqual(zoomAt(deepest, 10, 5, 5, 700), deepest);
});

test('a drag is exact where a step is 10^-19 of the drawing', () => {
    const view = { x: 0.3, y: -0.2, zoom: 1e20, fx: 3e-18, fy: 0 };
    const dragged = pan(view, 30, -20, 700);
    const back = placement(view, dragged, 700);
    near([back.x, back.y, back.factor], [30, -20, 1], 1e-6);
    const zoomed = zoomAt(dragged, 3, 100, 50, 700);
    const at = placement(dragged, zoomed, 700);
    near([100 * at.factor + at.x, 50 * at.factor + at.y], [100, 50], 1e-6);
    assert.equal(pan({ x: 0.1, y: 0.1, zoom: 10 }, 1, 1, 700).fx, undefined);
});

test('an old picture is moved to where its points are in the new view', () => {
    const roll = dice(3);
    for (let round = 0; round < 200; round++) {
        const [then, now] = [randomView(roll), randomView(roll)];
        const at = placement(then, now, 700);
        const [x, y] = seen(then, 700, 0.3, -0.4);
        near(
            [Number(x) * at.factor + at.x, Number(y) * at.factor + at.y],
            seen(now, 700, 0.3, -0.4),
            1e-6 * now.zoom * Math.max(1, 1 / then.zoom),
        );
    }
});

test('interpolation reaches both ends', () => {
    const [from, to] = [
        { x: 0.2, y: -0.3, zoom: 500 },
        { x: 0, y: 0, zoom: 1 },
    ];
    near(Object.values(between(from, to, 0)), Object.values(from), 1e-9);
    near(Object.values(between(from, to, 1)), Object.values(to), 1e-9);
    near(Object.values(between({ ...from, zoom: 1 }, to, 0.5)), [0.1, -0.15, 1], 1e-12);
});
