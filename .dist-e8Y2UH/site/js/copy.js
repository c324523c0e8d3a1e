/** The clipboard, in all the ways a page may reach it. */

/**
 * Copies the text of a field. Where the browser refuses, the text is left selected, so that a key copies it.
 * @param {HTMLInputElement | HTMLTextAreaElement} field
 * @returns {Promise<boolean>} whether it is copied
 */
export async function copyField(field) {
    if (await copyText(field.value)) return true;
    field.focus();
    field.select();
    try {
        // Long deprecated, and still what works from disk and in frames.
        return document.execCommand('copy');
    } catch {
        return false;
    }
}

/** @param {string} text @returns {Promise<boolean>} whether it is copied */
export async function copyText(text) {
    try {
        await navigator.clipboard.writeText(text);
        return true;
    } catch {
        return false;
    }
}

/** What copies a selection here. */
export const copyKeys = () => (/Mac|iPhone|iPad/.test(navigator.userAgent) ? '⌘C' : 'Ctrl+C');
