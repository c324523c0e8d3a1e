import assert from 'node:assert/strict';
import { test } from 'node:test';
import { between, isFarOff, pan, placement, viewFrom, zoomAt } from '../../js/view/view.js';
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
    const numbers = (/** @type {import('../../js/state/state.js').View} */ { x, y, zoom }) => [x, y, zoom];
    near(numbers(between(from, to, 0)), numbers(from), 1e-9);
    near(numbers(between(from, to, 1)), numbers(to), 1e-9);
    near(numbers(between({ ...from, zoom: 1 }, to, 0.5)), [0.1, -0.15, 1], 1e-12);
});

test('a view about a segment zooms on where a usual view ends', () => {
    const usual = { x: 0.25, y: -0.125, zoom: 1e20 };
    assert.ok(isFarOff(usual) && !isFarOff({ ...usual, zoom: 1e10 }));
    assert.equal(zoomAt(usual, 1e9, 0, 0, 500).zoom, 1e25);
    // The segment begins a little to the right of the centre.
    const own = viewFrom(usual, [0.25, -0.125, 3e-21, -1e-21], '17');
    assert.equal(own.at, '17');
    near([own.x + (own.fx ?? 0), own.y + (own.fy ?? 0)], [-3e-21, 1e-21], 1e-33);
    assert.ok(!isFarOff(own));
    const deep = zoomAt(own, 1e200, 10, 20, 500);
    assert.deepEqual([deep.zoom > 9e219, deep.at], [true, '17']);
    assert.equal(zoomAt(deep, 1e100, 0, 0, 500).zoom, 1e301);
    // Far from the segment, another origin is needed.
    assert.ok(isFarOff({ ...deep, x: 1e-200 }));
});
