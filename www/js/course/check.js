/** The dialog that compares what a program of one's own printed with the shown system. */

import styles from '../../css/course.css';
import { button, byId, closes, html, input, setText } from '../base/dom.js';
import { showFailure } from '../base/failure.js';
import { addElements } from '../base/late.js';
import { definitionOf } from '../state/state.js';
import { counted, say } from '../base/words.js';
import markup from './check.html';
import { createTextIntake } from './text-intake.js';
import { studyTool as tool } from './tool.js';

/** @param {import('../dialogs/dialogs.js').Page} page */
export function createCheck({ store, readAt }) {
    addElements(markup, [styles]);
    const dialog = byId('program-check', HTMLDialogElement);
    let turn = 0;
    /** The place of the first difference. @type {bigint | null} */
    let place = null;

    /** @param {string} text */
    async function compare(text) {
        const own = ++turn;
        const told = html('check-result');
        told.className = '';
        place = null;
        button('check-show').hidden = true;
        if (text.trim() === '') return setText(told, '');
        setText(told, say`Comparing…`);
        const result = await tool
            .call('check', { definition: definitionOf(store.state), output: text })
            .catch((error) => {
                if (own === turn) showFailure(told, error, () => void compare(text));
            });
        if (own !== turn || !result) return;
        told.classList.add(result.isRight ? 'agrees' : 'differs');
        setText(told, result.words);
        place = result.symbol === null ? null : BigInt(result.symbol);
        button('check-show').hidden = place === null;
    }

    const intake = createTextIntake({
        dialog,
        field: byId('check-output', HTMLTextAreaElement),
        file: input('check-file'),
        opener: button('check-open'),
        taken: (text) => void compare(text),
        refused: (words) => setText(html('check-result'), words),
    });
    button('check-show').addEventListener('click', () => {
        dialog.close();
        if (place !== null) readAt(place);
    });
    closes(dialog, 'close-check');

    return {
        open() {
            const { title, name, iterations } = store.state;
            setText(
                html('check-system'),
                counted(
                    iterations,
                    'What it printed for “{1}” after {0} iteration:',
                    'What it printed for “{1}” after {0} iterations:',
                    title || name || say`this system`,
                ),
            );
            dialog.showModal();
            intake.take();
        },
    };
}
