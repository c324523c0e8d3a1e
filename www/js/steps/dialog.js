/** Step by step, on the playground. */

import { studyTool } from '../course/tool.js';
import { button } from '../base/dom.js';
import { definitionOf } from '../state/state.js';
import { createSteps } from './steps.js';

/** @param {import('../dialogs/dialogs.js').Page} page */
export function createStepsDialog({ store, open }) {
    const steps = createSteps(studyTool, () => definitionOf(store.state));
    button('steps-project').hidden = false;
    button('steps-project').addEventListener('click', () => void open('projector'));
    return steps;
}
