/** The tool for courses, which the page's late parts share. */

import { createTool } from '../tool.js';

/** @typedef {{call: ReturnType<typeof createTool<import('../protocol.js').CourseCalls>>['call']}} CourseTool */

/** @type {CourseTool} */
export const courseTool = createTool('course');
