/** Copying to the clipboard. */

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
