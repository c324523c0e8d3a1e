/** Opens the parts of the page that load late (parts.js): by keys, and by elements with `data-opens` that name a part. */

import { html } from '../base/dom.js';
import { createLate } from '../base/late.js';

/** @typedef {import('../state/state.js').Definition} Definition */
/**
 * What the parts need of the page.
 * @typedef {object} Page
 * @property {import('../state/store.js').Store} store
 * @property {import('../engine/engine.js').Engine} engine
 * @property {import('../state/storage.js').SafeStorage} storage
 * @property {ReturnType<typeof import('../state/session.js').createSession>} session
 * @property {ReturnType<typeof import('../favourites/stored.js').createStored>} favourites
 * @property {{readonly space: boolean, readonly branches: boolean, camera: () => import('../view/camera.js').Camera, resolution: () => import('../protocol.js').Canvas}} stage
 * @property {{play: () => void, present: (show: import('../motion/playback.js').Show | null) => void, mark: (places: number[][]) => void}} listening plays the segments, or something else in their place, and marks places
 * @property {(index: bigint) => void} readAt opens the string at a symbol
 * @property {() => string} theme its name
 * @property {(definition: Definition) => Definition} restyle gives a system with default colours the theme's colours
 * @property {<K extends keyof Parts>(name: K) => Promise<Parts[K] | null>} part another part
 * @property {<K extends keyof Parts>(name: K, ...words: Parameters<Parts[K]['open']>) => Promise<void>} open opens another part
 */

/** @typedef {typeof import('../parts.js').PARTS} Rows */
/** @typedef {{[K in keyof Rows]: ReturnType<Rows[K]>}} Parts */

/** The entry whether keys without Ctrl act everywhere. Whoever speaks to the machine may type them unawares. */
export const PLAIN_KEYS = 'plain-keys';

/** The part that a key opens outside of dialogs, if any. @param {KeyboardEvent} event @param {import('../state/storage.js').SafeStorage} storage @returns {keyof Parts | null} */
function partOfKey(event, storage) {
    const command = event.ctrlKey || event.metaKey;
    if (event.altKey) return null;
    const plain = event.key === '?' ? 'shortcuts' : event.key.toLowerCase() === 'f' ? 'projector' : null;
    if (plain && !command && !isTypedInto(event.target))
        return event.target === html('drawing') || storage.read(PLAIN_KEYS) !== false ? plain : null;
    return event.key.toLowerCase() === 's' && command && !event.shiftKey ? 'save' : null;
}

/** Whether an element accepts typed text. @param {EventTarget | null} target */
function isTypedInto(target) {
    if (target instanceof HTMLInputElement)
        return !['range', 'checkbox', 'radio', 'color', 'button', 'file'].includes(target.type);
    return target instanceof HTMLTextAreaElement || target instanceof HTMLSelectElement;
}

/** The part that an element opens, if any. @param {EventTarget | null} target */
const openerOf = (target) => (target instanceof Element ? target.closest('[data-opens]') : null);

/** @param {Omit<Page, 'open' | 'part'>} own */
export function createDialogs(own) {
    /** @type {Page} */
    const page = { ...own, part, open };
    const load = createLate(async () => (await import('../parts.js')).PARTS);
    /** The parts that were needed so far. @type {Partial<Parts>} */
    const made = {};

    /** A part of the page; null if it could not be loaded. @template {keyof Parts} K @param {K} name @returns {Promise<Parts[K] | null>} */
    async function part(name) {
        const parts = await load();
        if (!parts) return null;
        const make = /** @type {(page: Page) => Parts[K]} */ (parts[name]);
        return (made[name] ??= make(page));
    }

    /** The parts that are on their way. */
    let coming = 0;

    /** @template {keyof Parts} K @param {K} name @param {Parameters<Parts[K]['open']>} words */
    async function open(name, ...words) {
        coming += 1;
        document.documentElement.dataset.opening = name;
        try {
            const opens = /** @type {((...words: any[]) => unknown) | undefined} */ ((await part(name))?.open);
            // Only until it is on the page: some parts answer when they are closed.
            void opens?.(...words);
        } finally {
            if (--coming === 0) delete document.documentElement.dataset.opening;
        }
    }

    // A pointer on the way to an opener loads the parts, so that they open at once.
    document.addEventListener(
        'pointerover',
        ({ target }) => openerOf(target) && void import('../parts.js').catch(() => {}),
        { passive: true },
    );
    document.addEventListener('click', (event) => {
        const opener = openerOf(event.target);
        if (!(opener instanceof HTMLElement)) return;
        opener.closest('dialog')?.close();
        void open(/** @type {keyof Parts} */ (opener.dataset['opens']));
    });
    addEventListener('keydown', (event) => {
        const name = partOfKey(event, page.storage);
        // A dialog, too, may fill the screen.
        const isFree = name === 'projector' || !document.querySelector('dialog[open]');
        if (!name || (name === 'shortcuts' && !isFree)) return;
        event.preventDefault();
        if (isFree) void open(name);
    });

    return { part, open };
}
