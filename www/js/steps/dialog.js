/** Step by step, on the playground. */

import { courseTool } from '../course/tool.js';
import { definitionOf } from '../state.js';
import { createSteps } from './steps.js';

/** @param {import('../dialogs.js').Page} page */
export const createStepsDialog = ({ store }) => createSteps(courseTool, () => definitionOf(store.state));
