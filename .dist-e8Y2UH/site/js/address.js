/** The address bar: follows the state, and opens what is pasted into it. */

import { bestLink, openLink } from './packed.js';

/** After the last change, in milliseconds: Safari refuses more than 100 changes in 30 s. */
const PAUSE = 300;

/**
 * @param {import('./store.js').Store} store
 * @param {{open: (link: import('./link.js').Link) => void}} page
 */
export function followAddress(store, { open }) {
    let timer = 0;
    let written = location.hash;
    /** Links are compressed and unpacked in the background; only the last of them counts. */
    let turn = 0;

    /** @param {string} hash */
    function put(hash) {
        if (hash === written) return;
        written = hash;
        try {
            history.replaceState(null, '', hash);
        } catch {
            // Some frames refuse it; the share dialog still gives the link.
        }
    }

    async function write() {
        clearTimeout(timer);
        timer = 0;
        const mine = ++turn;
        const hash = await bestLink(store.state);
        if (mine === turn) put(hash);
    }

    store.subscribe(() => {
        clearTimeout(timer);
        timer = window.setTimeout(write, PAUSE);
    });
    addEventListener('hashchange', async () => {
        if (location.hash === written) return;
        written = location.hash;
        const mine = ++turn;
        const link = await openLink(written);
        if (mine !== turn) return;
        if (link) open(link);
        else write();
    });

    /** Puts what is shown into the address now. */
    return write;
}
