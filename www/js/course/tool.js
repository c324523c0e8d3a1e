/** The tools for courses, which the page's late parts share: for exercises, for teachers, and for comparisons and steps. */

import { createTool } from '../engine/tool.js';

/** @typedef {{call: ReturnType<typeof createTool<import('../protocol.js').CourseCalls>>['call']}} CourseTool */

/** @type {CourseTool} */
export const courseTool = createTool('course');

/** @typedef {{call: ReturnType<typeof createTool<import('../protocol.js').StudyCalls>>['call']}} StudyTool */

/** @type {StudyTool} */
export const studyTool = createTool('study');

/** @type {ReturnType<typeof createTool<import('../protocol.js').ClassCalls>>} */
export const classTool = createTool('class');
