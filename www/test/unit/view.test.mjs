import assert from 'node:assert/strict';
import { test } from 'node:test';
import { between, pan, placement, zoomAt } from '../../js/view.js';
import { dice } from './random.mjs';

/** Where a point, in fitted extents about the fitted centre, is seen: CSS pixels right of and below the canvas's centre. */
const seen = (/** @type {any} */ view, /** @type {number} */ scale, /** @type {number} */ x, /** @type {number} */ y) => [(x - view.x) * scale * view.zoom, (view.y - y) * scale * view.zoom];

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
    assert.equal(zoomAt({ x: 0, y: 0, zoom: 1e12 }, 10, 5, 5, 700).zoom, 1e12);
    assert.deepEqual(zoomAt({ x: 0, y: 0, zoom: 1e12 }, 10, 5, 5, 700), { x: 0, y: 0, zoom: 1e12 });
});

test('an old picture is placed where its points are seen now', () => {
    const roll = dice(3);
    for (let round = 0; round < 200; round++) {
        const [then, now] = [randomView(roll), randomView(roll)];
        const at = placement(then, now, 700);
        const [x, y] = seen(then, 700, 0.3, -0.4);
        near([Number(x) * at.factor + at.x, Number(y) * at.factor + at.y], seen(now, 700, 0.3, -0.4), 1e-6 * now.zoom * Math.max(1, 1 / then.zoom));
    }
});

test('a glide begins and ends where it should', () => {
    const [from, to] = [{ x: 0.2, y: -0.3, zoom: 500 }, { x: 0, y: 0, zoom: 1 }];
    near(Object.values(between(from, to, 0)), Object.values(from), 1e-9);
    near(Object.values(between(from, to, 1)), Object.values(to), 1e-9);
    near(Object.values(between({ ...from, zoom: 1 }, to, 0.5)), [0.1, -0.15, 1], 1e-12);
});
