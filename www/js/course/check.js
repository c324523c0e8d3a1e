/** The dialog that compares what a program of one's own printed with the shown system. */

import styles from '../../css/course.css';
import { button, byId, closes, html, input, setText } from '../dom.js';
import { showFailure } from '../failure.js';
import { addElements } from '../late.js';
import { definitionOf } from '../state.js';
import markup from './check.html';
import { courseTool as tool } from './tool.js';

/** Longer outputs are not read, in characters. */
const LONGEST = 16 << 20;
/** A change waits for a pause of this length, in milliseconds. */
const PAUSE = 250;

/** @param {import('../dialogs.js').Page} page */
export function createCheck({ store, readAt }) {
    addElements(markup, [styles]);
    const dialog = byId('program-check', HTMLDialogElement);
    const output = byId('check-output', HTMLTextAreaElement);
    const file = input('check-file');
    let timer = 0;
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
        if (text.length > LONGEST) return setText(told, 'The output has more than 16 MiB.');
        setText(told, 'Comparing…');
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

    /** @param {File | undefined} chosen */
    async function read(chosen) {
        if (!chosen) return;
        if (chosen.size > LONGEST) return setText(html('check-result'), 'The file has more than 16 MiB.');
        const text = await chosen.text();
        // A text field with megabytes is slow, so it shows the beginning.
        output.value = text.slice(0, 20_000);
        await compare(text);
    }

    output.addEventListener('input', () => {
        clearTimeout(timer);
        timer = window.setTimeout(() => void compare(output.value), PAUSE);
    });
    button('check-open').addEventListener('click', () => file.click());
    file.addEventListener('change', () => {
        void read(file.files?.[0]);
        file.value = '';
    });
    dialog.addEventListener('dragover', (event) => event.preventDefault());
    dialog.addEventListener('drop', (event) => {
        event.preventDefault();
        event.stopPropagation();
        const [dropped] = event.dataTransfer?.files ?? [];
        if (dropped) return void read(dropped);
        output.value = event.dataTransfer?.getData('text/plain') ?? '';
        void compare(output.value);
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
                `What it printed for “${title || name || 'this system'}” after ${iterations} iteration${iterations === 1 ? '' : 's'}:`,
            );
            dialog.showModal();
            void compare(output.value);
        },
    };
}
