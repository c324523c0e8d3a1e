import assert from 'node:assert/strict';
import { test } from 'node:test';
import {
    FRONT,
    axes,
    isWhole,
    midway,
    orbit,
    seen as projected,
    slide,
    turned,
    whole,
    zoomed,
} from '../../js/view/camera.js';
import { clean } from '../../js/state/state.js';
import { dice } from './random.mjs';

/** @typedef {import('../../js/state/state.js').Camera} Camera */

/** Projects a point, in fitted extents, without perspective: CSS pixels right of and above the middle. @param {Camera} camera @param {number[]} point */
function seen(camera, point, scale = 700) {
    const away = [camera.x, camera.y, camera.z].map((c, i) => Number(point[i]) - c);
    return axes(camera)
        .slice(0, 2)
        .map((axis) => scale * camera.zoom * axis.reduce((sum, c, i) => sum + c * Number(away[i]), 0));
}

/** @param {number} degrees */
const short = (degrees) => Math.round(degrees * 1e6) / 1e6;

/** @param {() => number} roll @returns {Camera} */
const random = (roll) => ({
    azimuth: short(roll() * 360 - 180),
    elevation: short(roll() * 180 - 90),
    zoom: 10 ** (roll() * 4 - 1),
    x: roll() - 0.5,
    y: roll() - 0.5,
    z: roll() - 0.5,
    perspective: roll() < 0.5,
    fade: roll(),
});

/** @param {number[]} a @param {number[]} b @param {number} within */
const near = (a, b, within) =>
    a.forEach((value, i) => assert.ok(Math.abs(value - Number(b[i])) <= within, `${a} is not ${b}`));

test('axes are orthogonal, and up never points below the horizon', () => {
    const roll = dice(1);
    near(axes({ ...FRONT, azimuth: 0, elevation: 0 }).flat(), [1, 0, 0, 0, 1, 0, 0, 0, 1], 1e-12);
    near(axes({ ...FRONT, azimuth: 90, elevation: 0 })[2], [1, 0, 0], 1e-12);
    for (let round = 0; round < 200; round++) {
        const [r, u, b] = axes(random(roll));
        const dot = (/** @type {number[]} */ p, /** @type {number[]} */ q) =>
            p.reduce((sum, c, i) => sum + c * Number(q[i]), 0);
        near([dot(r, r), dot(u, u), dot(b, b), dot(r, u), dot(u, b), dot(b, r)], [1, 1, 1, 0, 0, 0], 1e-12);
        assert.ok(u[1] > -1e-12);
    }
});

test('a slide follows the pointer, and a zoom keeps the point under the pointer', () => {
    const roll = dice(2);
    for (let round = 0; round < 200; round++) {
        const camera = random(roll);
        const point = [roll() - 0.5, roll() - 0.5, roll() - 0.5];
        const [x, y] = seen(camera, point);
        near(seen(slide(camera, 30, -20, 700), point), [Number(x) + 30, Number(y) + 20], 1e-6 * camera.zoom);
        near(seen(zoomed(camera, 1.7, Number(x), -Number(y), 700), point), [Number(x), Number(y)], 1e-6 * camera.zoom);
    }
});

test('a drag to the right turns the drawing right, and a drag stops at the poles', () => {
    assert.ok(orbit(FRONT, 10, 0).azimuth < FRONT.azimuth);
    assert.ok(orbit(FRONT, 0, 10).elevation > FRONT.elevation);
    assert.equal(orbit(FRONT, 0, 1e6).elevation, 90);
    assert.equal(turned(FRONT, 190, 0).azimuth, -170);
});

test('interpolation takes the shorter way round and reaches both ends', () => {
    const roll = dice(3);
    const [from, to] = [turned(FRONT, 170, 0), turned(FRONT, -170, 0)];
    assert.equal(Math.abs(midway(from, to, 0.5).azimuth), 180);
    for (let round = 0; round < 100; round++) {
        const [a, b] = [random(roll), random(roll)];
        const numbers = (/** @type {Camera} */ c) => [c.elevation, c.zoom, c.x, c.y, c.z, c.fade, ...axes(c).flat()];
        near(numbers(midway(a, b, 0)), numbers(a), 1e-9 * a.zoom + 1e-9);
        near(numbers(midway(a, b, 1)), numbers(b), 1e-9 * b.zoom + 1e-9);
    }
    assert.ok(isWhole(whole(random(roll))) && !isWhole(zoomed(FRONT, 2, 0, 0, 700)));
});

test('an untrusted camera becomes valid or null', () => {
    assert.deepEqual(clean({ camera: FRONT }).camera, FRONT);
    assert.deepEqual(clean({ camera: { ...FRONT, elevation: 500, zoom: 1e99, fade: 7 } }).camera, {
        ...FRONT,
        elevation: 90,
        zoom: 1e4,
        fade: 1,
    });
    for (const nonsense of [1, 'x', {}, { ...FRONT, azimuth: NaN }, { ...FRONT, perspective: 1 }])
        assert.equal(clean({ camera: nonsense }).camera, null);
});

test('with perspective, points nearer to the eye are projected farther from the middle', () => {
    const roll = dice(5);
    near(projected({ ...FRONT, azimuth: 0, elevation: 0 }, [0.1, 0.2, 0], 700), [70, -140], 1e-9);
    // Half-way to the eye, which is two fitted extents from the target, everything is twice as large.
    near(projected({ ...FRONT, azimuth: 0, elevation: 0 }, [0.1, 0.2, 1], 700), [140, -280], 1e-9);
    near(projected({ ...FRONT, azimuth: 90, elevation: 0, zoom: 3 }, [1, 0.2, -0.1], 700), [420, -840], 1e-9);
    for (let round = 0; round < 100; round++) {
        const camera = random(roll);
        const point = [camera.x + (roll() - 0.5) / 2, camera.y + (roll() - 0.5) / 2, camera.z + (roll() - 0.5) / 2];
        const [x, y] = seen({ ...camera }, point);
        const [px, py] = projected({ ...camera, perspective: false }, point, 700);
        near([px, -py], [Number(x), Number(y)], 1e-6 * camera.zoom);
        // In the same direction from the middle.
        const [qx, qy] = projected({ ...camera, perspective: true }, point, 700);
        assert.ok(Math.abs(qx * py - qy * px) <= 1e-9 * (px * px + py * py) + 1e-9 && qx * px + qy * py >= 0);
    }
});

test('after many turns the angles have few digits', () => {
    let camera = { ...FRONT, azimuth: 30, elevation: 20 };
    for (let round = 0; round < 1000; round++) camera = orbit(camera, 0.3, round % 2 ? 0.7 : -0.7);
    near([camera.azimuth, camera.elevation], [30 - 120, 20], 1e-3);
    for (const angle of [camera.azimuth, camera.elevation]) assert.ok(String(angle).length <= 11, String(angle));
});
