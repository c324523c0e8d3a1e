import assert from 'node:assert/strict';
import { test } from 'node:test';
import {
    along,
    curvesIn,
    extentOf,
    moved,
    onSteps,
    stepOf,
    widestGap,
    withPoint,
    withoutPoint,
    written,
} from '../../js/curves/curve.js';

const RULES = `// curve no = (0, 1) (1, 2)
r = 2
  curve taper = (0, 1)(.4,-8e-1), (1, 0.1) /* narrow */
curve wrong = (0, r) (1, 2)
curve back = (0, 1) (2, 1) (1, 0)
curve one = (0, 1)
curve = (0, 1) (1, 2)
curved x = (0, 1) (1, 2)
curve länge=(0,1)(1,2)
A(x) -> F(taper(x))`;

test('curves are found by their places, and others are left alone', () => {
    const curves = curvesIn(RULES);
    assert.deepEqual(
        curves.map(({ name }) => name),
        ['taper', 'länge'],
    );
    const [taper] = curves;
    assert.deepEqual(taper?.points, [
        [0, 1],
        [0.4, -0.8],
        [1, 0.1],
    ]);
    assert.equal(RULES.slice(taper?.start, taper?.end), '(0, 1)(.4,-8e-1), (1, 0.1)');
    const changed =
        RULES.slice(0, taper?.start) +
        written([
            [0, 0.5],
            [3, 1e-7],
        ]) +
        RULES.slice(taper?.end);
    assert.match(changed, /curve taper = \(0, 0\.5\) \(3, 1e-7\) \/\* narrow \*\/\n/);
    assert.deepEqual(curvesIn(changed)[0]?.points, [
        [0, 0.5],
        [3, 1e-7],
    ]);
});

/**
 * A spline by the recursive definition of its blending functions.
 * @param {readonly (readonly [number, number])[]} points @param {number} u
 */
function naive(points, u) {
    const degree = Math.min(3, points.length - 1);
    const knot = (/** @type {number} */ at) => Math.min(Math.max(at - degree, 0), points.length - degree);
    /** @type {(k: number, order: number) => number} */
    const blend = (k, order) => {
        if (order === 1) return knot(k) <= u && u < knot(k + 1) ? 1 : 0;
        const part = (/** @type {number} */ a, /** @type {number} */ b) => (b === 0 ? 0 : a / b);
        return (
            part(u - knot(k), knot(k + order - 1) - knot(k)) * blend(k, order - 1) +
            part(knot(k + order) - u, knot(k + order) - knot(k + 1)) * blend(k + 1, order - 1)
        );
    };
    return [0, 1].map((axis) => points.reduce((sum, point, k) => sum + Number(point[axis]) * blend(k, degree + 1), 0));
}

test('the drawn curve is the spline of the points', () => {
    /** @type {[number, number][]} */
    const all = [
        [0, 1],
        [1, 4],
        [1.5, -2],
        [1.5, 3],
        [4, 0],
        [5, 5],
        [7, 1],
        [8, 2],
    ];
    for (let count = 2; count <= all.length; count++) {
        const points = all.slice(0, count);
        const line = along(points, 10);
        assert.deepEqual([line[0], line.at(-1)], [points[0], points.at(-1)]);
        for (const [at, found] of line.slice(0, -1).entries()) {
            const expected = naive(points, at / 10);
            for (const axis of [0, 1])
                assert.ok(Math.abs(Number(found[axis]) - Number(expected[axis])) < 1e-9, `${count} ${at}`);
        }
    }
});

test('points move between their neighbours, and come and go', () => {
    /** @type {[number, number][]} */
    const points = [
        [0, 1],
        [2, 3],
        [4, 1],
    ];
    assert.deepEqual(moved(points, 1, [9, 7])[1], [4, 7]);
    assert.deepEqual(moved(points, 1, [-9, 7])[1], [0, 7]);
    assert.deepEqual(moved(points, 0, [-1, 0])[0], [-1, 0]);
    assert.deepEqual(
        moved(
            [
                [0, 1],
                [4, 1],
            ],
            1,
            [-3, 0],
        ),
        [
            [0, 1],
            [4, 1],
        ],
        'the ends stay apart',
    );
    assert.deepEqual(withPoint(points, [1, 5]), {
        points: [
            [0, 1],
            [1, 5],
            [2, 3],
            [4, 1],
        ],
        at: 1,
    });
    assert.equal(withPoint(points, [-1, 5]).at, 0);
    assert.equal(withPoint(points, [9, 5]).at, 3);
    assert.deepEqual(withoutPoint(points, 1), [
        [0, 1],
        [4, 1],
    ]);
    for (const at of [0, 2]) assert.deepEqual(withoutPoint(points, at), points);
    const [x, y] = widestGap([
        [0, 1],
        [1, 2],
        [5, 6],
    ]);
    assert.equal(x, 3);
    assert.ok(y > 3 && y < 5);
});

test('steps and extents fit the numbers', () => {
    assert.deepEqual([1, 0.5, 12, 1000].map(stepOf), [0.01, 0.001, 0.1, 10]);
    assert.equal(onSteps(0.30000000000000004, 0.01), 0.3);
    assert.deepEqual(
        extentOf([
            [0, 1],
            [2, 0.5],
        ]),
        { left: 0, right: 2, bottom: 0, top: 1.1 },
    );
    const flat = extentOf([
        [0, 5],
        [2, 5],
    ]);
    assert.ok(flat.bottom < 5 && flat.top > 5);
});
