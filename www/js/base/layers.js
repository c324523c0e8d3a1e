/** The open parts of the page, and Escape, which closes the one opened last. Dialogs close themselves. */

/** How to close each open part, the one opened last at the end. @type {(() => void)[]} */
const open = [];

/**
 * Notes that a part of the page is open or closed.
 * @param {() => void} close closes the part; the same function each time
 * @param {boolean} isOpen
 */
export function setLayer(close, isOpen) {
    const at = open.indexOf(close);
    if (at >= 0) open.splice(at, 1);
    if (isOpen) open.push(close);
}

addEventListener('keydown', (event) => {
    if (event.key !== 'Escape' || event.defaultPrevented || event.isComposing || document.querySelector('dialog[open]'))
        return;
    const close = open.at(-1);
    if (!close) return;
    event.preventDefault();
    close();
});
