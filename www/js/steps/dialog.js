/** Step by step, on the playground. */

import { courseTool } from '../course/tool.js';
import { button } from '../dom.js';
import { definitionOf } from '../state.js';
import { createSteps } from './steps.js';

/** @param {import('../dialogs.js').Page} page */
export function createStepsDialog({ store, open }) {
    const steps = createSteps(courseTool, () => definitionOf(store.state));
    button('steps-project').hidden = false;
    button('steps-project').addEventListener('click', () => void open('projector'));
    return steps;
}
