/**
 * The talk with the page that embeds the drawing: docs/embedding.md. Only the window that holds this one is heard, and
 * nothing but a greeting is said to it before it has spoken or was named in the address by its origin.
 */

import { bestLink, openLink } from '../packed.js';
import { readControls } from './options.js';
import { fieldsOf, valuesOf } from './values.js';

/** @typedef {import('../protocol.js').Report} Report */
/** @typedef {import('./options.js').Control} Control */

/** Changes that follow one another more quickly are told as one, in milliseconds. */
const PAUSE = 50;
/** So much is kept for a page that has not spoken yet. */
const MOST = 20;

/**
 * @param {import('../store.js').Store} store
 * @param {{host: string | null, offer: (controls: Control[]) => void, play: (on: boolean) => void, facts: () => {description: string, symbols: string | null, segments: string | null}}} page
 */
export function talk(store, { host, offer, play, facts }) {
    const holder = parent === window ? null : parent;
    /** Whom to answer, by origin. @type {string | null} */
    let listener = host;
    let byHost = false;
    let timer = 0;
    /** What was said while nobody was there to hear it. @type {object[]} */
    let unsaid = [];

    /** @param {object} message */
    function say(message) {
        if (!holder) return;
        if (listener === null) unsaid = [...unsaid, message].slice(-MOST);
        else holder.postMessage(message, listener);
    }

    async function state() {
        return { values: valuesOf(store.state), link: await bestLink(store.state) };
    }

    /** Changes the drawing for the page. @param {() => void} change */
    function asHost(change) {
        byHost = true;
        change();
        byHost = false;
    }

    /** What can be asked of the drawing. @type {Record<string, (message: Record<string, unknown>) => void | Promise<void>>} */
    const REQUESTS = {
        hello: () => {},
        get: async ({ id }) => say({ lsystem: 'state', id, ...(await state()), ...facts() }),
        set: ({ values }) => {
            const { fields, problems } = fieldsOf(values);
            asHost(() => store.restyle(fields));
            if (problems.length > 0) say({ lsystem: 'error', message: problems.join(' '), problems: [] });
        },
        open: async ({ link }) => {
            const opened = typeof link === 'string' ? await openLink(link) : null;
            if (opened) asHost(() => store.open(opened.state));
            const problems = opened ? opened.problems : ['This link holds no drawing.'];
            if (problems.length > 0) say({ lsystem: 'error', message: problems.join(' '), problems: [] });
        },
        reset: () => asHost(store.reset),
        // Objects of the host may have no form as text.
        controls: ({ controls }) => offer(readControls([controls].flat().filter((one) => typeof one === 'string').join())),
        play: () => play(true),
        pause: () => play(false),
    };

    addEventListener('message', (event) => {
        if (!holder || event.source !== holder) return;
        const { data, origin } = event;
        if (typeof data !== 'object' || data === null || typeof data.lsystem !== 'string' || !Object.hasOwn(REQUESTS, data.lsystem)) return;
        if (host !== null && origin !== host) return;
        // A page without an origin of its own, such as a file, can only be addressed as whoever is there.
        listener = origin === 'null' ? '*' : origin;
        const waiting = unsaid;
        unsaid = [];
        for (const message of waiting) say(message);
        REQUESTS[data.lsystem]?.(data);
    });

    // That there is somebody to talk to is no secret.
    holder?.postMessage({ lsystem: 'hello' }, '*');

    store.subscribe(() => {
        const by = byHost ? 'host' : 'visitor';
        clearTimeout(timer);
        timer = window.setTimeout(async () => say({ lsystem: 'change', by, ...(await state()) }), PAUSE);
    });

    return {
        /** The first picture is there. */
        async ready() {
            say({ lsystem: 'ready', ...(await state()), ...facts() });
        },

        /** @param {string} message @param {import('../protocol.js').Diagnostic[]} [problems] */
        error(message, problems = []) {
            say({ lsystem: 'error', message, problems });
        },
    };
}
