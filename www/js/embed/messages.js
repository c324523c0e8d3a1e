/**
 * Messages between the drawing and the host page that embeds it (docs/embedding.md). The drawing reads only messages of
 * its parent window. Before the host has sent a message, or is named by its origin in the address, the drawing sends
 * only `hello`.
 */

import { bestLink, openLink } from '../state/packed.js';
import { readControls, readTheme } from './options.js';
import { fieldsOf, valuesOf } from './values.js';
import { say } from '../base/words.js';

/** @typedef {import('../protocol.js').Report} Report */
/** @typedef {import('./options.js').Control} Control */

/** Changes within this time are sent as one message, in milliseconds. */
const PAUSE = 50;
/** The maximum number of messages queued for a host that has not sent a message yet. */
const MAX_QUEUED = 20;

/**
 * @param {import('../state/store.js').Store} store
 * @param {{host: string | null, offer: (controls: Control[]) => void, theme: (theme: 'light' | 'dark' | null) => void, play: (on: boolean) => void, facts: () => {description: string, symbols: string | null, segments: string | null}}} page
 */
export function connectHost(store, { host, offer, theme: paint, play, facts }) {
    const holder = parent === window ? null : parent;
    /** The origin of the host, once known. @type {string | null} */
    let listener = host;
    let byHost = false;
    let timer = 0;
    /** Messages queued until the host is known. @type {object[]} */
    let queue = [];

    /** @param {object} message */
    function send(message) {
        if (!holder) return;
        if (listener === null) queue = [...queue, message].slice(-MAX_QUEUED);
        else holder.postMessage(message, listener);
    }

    async function state() {
        return { values: valuesOf(store.state), link: await bestLink(store.state) };
    }

    /** Marks a change as the host's. @param {() => void} change */
    function asHost(change) {
        byHost = true;
        change();
        byHost = false;
    }

    /** The host's requests. @type {Record<string, (message: Record<string, unknown>) => void | Promise<void>>} */
    const REQUESTS = {
        hello: () => {},
        get: async ({ id }) => send({ lsystem: 'state', id, ...(await state()), ...facts() }),
        set: ({ values }) => {
            const { fields, problems } = fieldsOf(values);
            asHost(() => store.changeOrigin(fields));
            if (problems.length > 0) send({ lsystem: 'error', message: problems.join(' '), problems: [] });
        },
        open: async ({ link }) => {
            const opened = typeof link === 'string' ? await openLink(link) : null;
            if (opened) asHost(() => store.open(opened.state));
            const problems = opened ? opened.problems : [say`This link contains no drawing.`];
            if (problems.length > 0) send({ lsystem: 'error', message: problems.join(' '), problems: [] });
        },
        reset: () => asHost(store.reset),
        // Ignore values that are not strings, which may have no text form.
        controls: ({ controls }) =>
            offer(
                readControls(
                    [controls]
                        .flat()
                        .filter((one) => typeof one === 'string')
                        .join(),
                ),
            ),
        theme: ({ theme }) => paint(readTheme(theme)),
        play: () => play(true),
        pause: () => play(false),
    };

    addEventListener('message', (event) => {
        if (!holder || event.source !== holder) return;
        const { data, origin } = event;
        if (
            typeof data !== 'object' ||
            data === null ||
            typeof data.lsystem !== 'string' ||
            !Object.hasOwn(REQUESTS, data.lsystem)
        )
            return;
        if (host !== null && origin !== host) return;
        // A page with an opaque origin, such as a file, can only be addressed with a wildcard.
        listener = origin === 'null' ? '*' : origin;
        const waiting = queue;
        queue = [];
        for (const message of waiting) send(message);
        REQUESTS[data.lsystem]?.(data);
    });

    // This greeting contains nothing private, so any host may receive it.
    holder?.postMessage({ lsystem: 'hello' }, '*');

    store.subscribe(() => {
        const by = byHost ? 'host' : 'visitor';
        clearTimeout(timer);
        timer = window.setTimeout(async () => send({ lsystem: 'change', by, ...(await state()) }), PAUSE);
    });

    return {
        /** The first picture is shown. */
        async ready() {
            send({ lsystem: 'ready', ...(await state()), ...facts() });
        },

        /**
         * An answer to an exercise was marked.
         * @param {import('../protocol.js').Mark} mark
         * @param {string} link of the answer
         * @param {boolean} touched whether the student has changed anything in this visit
         */
        marked({ isSolved, agreement, words }, link, touched) {
            send({ lsystem: 'mark', solved: isSolved, agreement, words, link, touched });
        },

        /** The height that the page needs, in CSS pixels. @param {number} height */
        needs(height) {
            send({ lsystem: 'height', height });
        },

        /** @param {string} message @param {import('../protocol.js').Diagnostic[]} [problems] */
        error(message, problems = []) {
            send({ lsystem: 'error', message, problems });
        },
    };
}
