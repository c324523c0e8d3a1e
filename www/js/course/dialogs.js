/** What the playground has for courses: making exercises, checking programs, and how generations grow. */

import { createTool } from '../tool.js';
import { createSteps } from '../steps/steps.js';
import { definitionOf } from '../state.js';
import { createCheck } from './check.js';
import { createMaker } from './maker.js';
import { createMathematics } from './mathematics.js';

/**
 * @param {import('../store.js').Store} store
 * @param {import('../engine.js').Engine} engine
 * @param {(index: bigint) => void} readAt opens the string at a symbol
 * @returns {import('./maker.js').CourseTool}
 */
export function createCourse(store, engine, readAt) {
    /** @type {ReturnType<typeof createTool<import('../protocol.js').CourseCalls>>} */
    const tool = createTool('course');
    createMaker(store, engine, tool);
    createCheck(store, tool, readAt);
    createMathematics(store, tool);
    createSteps(tool, () => definitionOf(store.state));
    return tool;
}
