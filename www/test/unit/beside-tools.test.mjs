import assert from 'node:assert/strict';
import { test } from 'node:test';
import { viewBeside } from '../../js/view/beside-tools.js';
import { FITTED } from '../../js/view/view.js';

const STAGE = { width: 400, height: 400 };
/** A tool in a corner. @param {number} left @param {number} top @param {number} width @param {number} height */
const tool = (left, top, width = 100, height = 50) => ({ left, top, right: left + width, bottom: top + height });

/** The drawing's box in a view. @param {number} aspect @param {import('../../js/state/state.js').View} view */
function boxOf(aspect, { x, y, zoom }) {
    const wide = Math.min(352, 352 * aspect);
    const high = wide / aspect;
    const extent = Math.max(wide, high) * zoom;
    const [cx, cy] = [200 - x * extent, 200 + y * extent];
    return [cx - (wide * zoom) / 2, cy - (high * zoom) / 2, cx + (wide * zoom) / 2, cy + (high * zoom) / 2];
}

test('a drawing that touches no tool is fitted', () => {
    assert.equal(viewBeside(STAGE, 0.3, [tool(290, 10)]), FITTED);
    assert.equal(viewBeside(STAGE, 4, [tool(10, 10), tool(290, 340)]), FITTED);
    for (const unknown of [null, undefined, 0]) assert.equal(viewBeside(STAGE, unknown, [tool(290, 10)]), FITTED);
    assert.equal(viewBeside({ width: 0, height: 0 }, 1, []), FITTED);
});

test('a narrow drawing moves aside, at its full size', () => {
    const view = viewBeside(STAGE, 0.6, [tool(290, 10)]);
    assert.equal(view.zoom, 1);
    const [, , right] = boxOf(0.6, view);
    assert.ok(right !== undefined && right <= 290, `${right}`);
});

test('a drawing that fills the stage becomes smaller, inside the stage and beside all tools', () => {
    for (const aspect of [0.7, 1, 1.4, 2]) {
        const tools = [tool(290, 10), tool(10, 10), tool(290, 340)];
        const view = viewBeside(STAGE, aspect, tools);
        const [left = 0, top = 0, right = 0, bottom = 0] = boxOf(aspect, view);
        assert.ok(left >= 0 && top >= 0 && right <= 400 && bottom <= 400, `${aspect}: inside`);
        for (const each of tools)
            assert.ok(
                each.right <= left || each.left >= right || each.bottom <= top || each.top >= bottom,
                `${aspect}: free`,
            );
        assert.ok(view.zoom >= 0.55);
    }
});

test('a drawing is not made tiny for tools that take most of the stage', () => {
    assert.equal(viewBeside(STAGE, 1, [tool(0, 0, 400, 250)]), FITTED);
});
