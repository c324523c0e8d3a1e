/** A text that is typed, pasted, opened as a file or dropped on a dialog. */

import { say } from '../base/words.js';

/** Longer texts are not taken, in characters. */
const LONGEST = 16 << 20;
/** A field shows no more than the beginning of an opened file: megabytes make it slow. */
const SHOWN = 20_000;
/** Typing waits for a pause of this length, in milliseconds. */
const PAUSE = 300;

/**
 * @param {object} parts
 * @param {HTMLDialogElement} parts.dialog takes what is dropped
 * @param {HTMLTextAreaElement} parts.field
 * @param {HTMLInputElement} parts.file
 * @param {HTMLButtonElement} parts.opener opens a file
 * @param {(text: string) => void} parts.taken gets the whole text
 * @param {(words: string) => void} parts.refused gets the reason why a text is not taken
 */
export function createTextIntake({ dialog, field, file, opener, taken, refused }) {
    /** The whole text of an opened file, of which the field shows the beginning; null if the field has all. @type {string | null} */
    let whole = null;
    let timer = 0;

    function take() {
        clearTimeout(timer);
        const text = whole ?? field.value;
        if (text.length > LONGEST) refused(say`The text has more than 16 MiB.`);
        else taken(text);
    }

    function later() {
        clearTimeout(timer);
        timer = window.setTimeout(take, PAUSE);
    }

    /** @param {File | undefined} chosen */
    async function read(chosen) {
        if (!chosen) return;
        if (chosen.size > LONGEST) return refused(say`The file has more than 16 MiB.`);
        whole = await chosen.text();
        field.value = whole.slice(0, SHOWN);
        take();
    }

    field.addEventListener('input', () => {
        whole = null;
        later();
    });
    opener.addEventListener('click', () => file.click());
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
        whole = null;
        field.value = event.dataTransfer?.getData('text/plain') ?? '';
        take();
    });

    return {
        /** Takes the text again, at once. */
        take,
        /** Takes the text again after a pause. */
        later,
    };
}
