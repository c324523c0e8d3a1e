/** Copying to the clipboard. */

import { setText } from './dom.js';
import { say } from './words.js';

/** How long a button shows “Copied”, in milliseconds. */
const COPIED_MS = 2500;

/**
 * Copies the text of a field. If the browser refuses, the text stays selected, so that a key can copy it.
 * @param {HTMLInputElement | HTMLTextAreaElement} field
 * @returns {Promise<boolean>} whether the text was copied
 */
export async function copyField(field) {
    if (await copyText(field.value)) return true;
    field.focus();
    field.select();
    try {
        // Deprecated, but works for pages from disk and in frames.
        return document.execCommand('copy');
    } catch {
        return false;
    }
}

/** @param {string} text @returns {Promise<boolean>} whether the text was copied */
export async function copyText(text) {
    try {
        await navigator.clipboard.writeText(text);
        return true;
    } catch {
        return false;
    }
}

/** The keys that copy a selection on this system. */
export const copyKeys = () => (/Mac|iPhone|iPad/.test(navigator.userAgent) ? '⌘C' : 'Ctrl+C');

/**
 * Makes a button copy the text of a field, and tell so in its label; an empty field waits for its text.
 * @param {HTMLButtonElement} copier with its label in a span
 * @param {HTMLInputElement | HTMLTextAreaElement} field
 * @param {string} what
 * @param {(words: string, isAlert: boolean) => void} tell
 */
export function copies(copier, field, what, tell) {
    const label = /** @type {Element} */ (copier.querySelector('span'));
    const before = String(label.textContent);
    let timer = 0;
    copier.addEventListener('click', async () => {
        if (field.value === '') return;
        const copied = await copyField(field);
        tell(
            copied
                ? say`${what} copied`
                : say`The browser refuses clipboard access. The text is selected: press ${copyKeys()} to copy.`,
            !copied,
        );
        if (!copied) return;
        copier.focus();
        setText(label, say`Copied`);
        clearTimeout(timer);
        timer = window.setTimeout(() => setText(label, before), COPIED_MS);
    });
    field.addEventListener('focus', () => field.select());
}
