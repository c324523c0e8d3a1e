/** The address bar: follows the state, and opens pasted links. */

import { bestLink, openLink } from './packed.js';

/** The delay after the last change, in milliseconds: Safari refuses more than 100 changes in 30 s. */
const PAUSE = 300;

/**
 * @param {import('./store.js').Store} store
 * @param {{open: (link: import('./link.js').Link) => void}} page
 */
export function followAddress(store, { open }) {
    let timer = 0;
    let written = location.hash;
    /** The number of the last link; links are packed and unpacked asynchronously, and older ones are dropped. */
    let turn = 0;

    /** @param {string} hash */
    function put(hash) {
        if (hash === written) return;
        written = hash;
        try {
            history.replaceState(null, '', hash);
        } catch {
            // Some frames refuse; the share dialog still shows the link.
        }
    }

    async function write() {
        clearTimeout(timer);
        timer = 0;
        const own = ++turn;
        const hash = await bestLink(store.state);
        if (own === turn) put(hash);
    }

    store.subscribe(() => {
        clearTimeout(timer);
        timer = window.setTimeout(write, PAUSE);
    });
    addEventListener('hashchange', async () => {
        if (location.hash === written) return;
        written = location.hash;
        const own = ++turn;
        const link = await openLink(written);
        if (own !== turn) return;
        if (link) open(link);
        else write();
    });

    /** Writes the shown state to the address at once. */
    return write;
}
