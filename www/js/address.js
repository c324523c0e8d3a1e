/** The address bar: follows the state, and opens what is pasted into it. */

import { readLink, writeLink } from './link.js';

/** After the last change, in milliseconds: Safari refuses more than 100 changes in 30 s. */
const PAUSE = 300;

/**
 * @param {import('./store.js').Store} store
 * @param {{open: (link: NonNullable<ReturnType<typeof readLink>>) => void}} page
 */
export function followAddress(store, { open }) {
    let timer = 0;
    let written = location.hash;

    function write() {
        clearTimeout(timer);
        timer = 0;
        const hash = writeLink(store.state);
        if (hash === written) return;
        written = hash;
        try {
            history.replaceState(null, '', hash);
        } catch {
            // Some frames refuse it; the copy button still gives the link.
        }
    }

    store.subscribe(() => {
        clearTimeout(timer);
        timer = window.setTimeout(write, PAUSE);
    });
    addEventListener('hashchange', () => {
        if (location.hash === written) return;
        written = location.hash;
        const link = readLink(location.hash);
        if (link) open(link);
        else write();
    });
    addEventListener('pagehide', write);

    /** The address of what is shown now. */
    return () => {
        write();
        return new URL(writeLink(store.state), location.href).href;
    };
}
