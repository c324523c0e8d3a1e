/**
 * Buttons whose script comes after the first picture: elements with `data-later` have them inside, until it is there. A
 * click before that fetches the script, and takes effect when it has come.
 */

import { toast } from './announce.js';

/** @param {() => Promise<void>} load */
export function createWaiting(load) {
    /** @type {Promise<void> | null} */
    let loading = null;
    let tried = false;

    const fetched = () => (loading ??= load().then(done, refused));

    function done() {
        removeEventListener('click', early, true);
        for (const element of document.querySelectorAll('[data-later]')) element.removeAttribute('data-later');
    }

    /** @param {Error} error */
    function refused(error) {
        loading = null;
        throw error;
    }

    /** @param {MouseEvent} event */
    async function early(event) {
        const button = event.target instanceof Element ? event.target.closest('button') : null;
        if (!button?.closest('[data-later]')) return;
        event.preventDefault();
        event.stopPropagation();
        try {
            await fetched();
            button.click();
        } catch (error) {
            toast(`This part of the page could not be loaded (${error instanceof Error ? error.message : error}).`);
        }
    }

    addEventListener('click', early, true);

    return {
        /** Fetches the script in good time. What fails is tried again with the next click. */
        fetch() {
            if (!tried) fetched().catch(() => {});
            tried = true;
        },
    };
}
