/** The scroll bar of the string view, because strings are too long for the browser's scroll bars. */

import { html } from '../base/dom.js';

/** @param {(part: number) => void} moved called with the new position, from 0 to 1 */
export function createScrollbar(moved) {
    const bar = html('reader-bar');
    const thumb = html('reader-thumb');

    bar.addEventListener('pointerdown', (event) => {
        if (event.button !== 0) return;
        event.preventDefault();
        bar.setPointerCapture(event.pointerId);
        const grip = thumb.getBoundingClientRect();
        const inside =
            event.clientY >= grip.top && event.clientY <= grip.bottom ? event.clientY - grip.top : grip.height / 2;
        const move = (/** @type {PointerEvent} */ { clientY }) => {
            const box = bar.getBoundingClientRect();
            const track = Math.max(1, box.height - grip.height);
            moved(Math.min(1, Math.max(0, (clientY - box.top - inside) / track)));
        };
        move(event);
        bar.addEventListener('pointermove', move);
        const stop = () => bar.removeEventListener('pointermove', move);
        bar.addEventListener('pointerup', stop, { once: true });
        bar.addEventListener('pointercancel', stop, { once: true });
    });

    return {
        /** @param {{part: number, size: number, needed: boolean}} state `part`: the fraction before the window; `size`: the fraction in the window */
        show({ part, size, needed }) {
            bar.hidden = !needed;
            bar.setAttribute('aria-valuenow', (part * 100).toFixed(1));
            bar.style.setProperty('--part', String(part));
            bar.style.setProperty('--size', String(size));
        },
    };
}
