/** The page exercise.html: the exercise in the address, or an embedded drawing with the steps of its making. */

import { button } from '../base/dom.js';
import { say, translatePage } from '../base/words.js';
import { followKeyboard } from '../controls/keyboard.js';
import { symbolKeys } from '../controls/symbol-keys.js';
import { createFrame } from '../embed/frame.js';
import { createTool } from '../engine/tool.js';
import { ASKS } from '../late-tables.js';
import { openLink } from '../state/packed.js';
import { createSteps } from '../steps/steps.js';
import { createExercise, openExercise } from './exercise.js';
import { showNext } from './next.js';

translatePage();
const link = await openLink(location.hash);
/** Why the exercise cannot be opened; empty if it can. */
let refusal = '';
const exercise = await openExercise(location.hash, link?.state).catch((error) => {
    refusal = error instanceof Error ? say`The exercise cannot be opened: ${error.message}.` : String(error);
    return null;
});
// Programs have a page of their own.
if (exercise?.about.asks === 'program') location.replace(`program.html${location.search}${location.hash}`);
const { store, host, drawn } = createFrame({ link, refusal, task: exercise && taskOf(exercise), hasSteps: true });
button('open-steps').addEventListener('click', createSteps(createTool('study'), () => drawn(store.state)).open);
if (exercise) {
    symbolKeys(['axiom', 'rules', 'overrides']);
    followKeyboard();
    createExercise(store, exercise, {
        marked(mark, link, isTouched) {
            host.marked(mark, link, isTouched);
            if (mark.isSolved) void showNext(exercise.text);
        },
        needs: (height) => host.needs(height),
    });
}

/** @param {NonNullable<typeof exercise>} exercise @returns {import('../embed/frame.js').Task} */
function taskOf({ start, whole, about }) {
    const { free, hidesRules, asksForRules } = about;
    const writes = asksForRules || free.includes('axiom');
    // The string and its origins would tell what is hidden.
    const reads = !hidesRules && about.axiom !== 'hidden';
    const controls = [
        ...(writes ? ['rules'] : []),
        ...(free.includes('iterations') ? ['n'] : []),
        ...(free.includes('angle') ? ['angle'] : []),
        ...(reads ? ['string', 'steps'] : []),
        'play',
    ];
    return {
        start,
        whole,
        controls: controls.map((control) => /** @type {import('../embed/options.js').Control} */ (control)),
        asksForSymbols: free.includes('dialect'),
        asksForText: ASKS[about.asks].isText,
    };
}
