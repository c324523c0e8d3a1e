/** The browser's storage for this page. Private windows and sandboxed frames may refuse storage. */

import '../base/settled.js';

/** @typedef {ReturnType<typeof createStorage>} SafeStorage */

/** Longer entries are not read, in UTF-16 units. No browser stores more per site, and other pages may write there. */
const LONGEST = 5 << 20;

/** The prefix of keys, because pages of the same host share the storage. */
const PREFIX = 'l-systems:';

/**
 * @param {() => Storage} area throws if the browser refuses
 * @param {string} [prefix] of keys
 * @param {Pick<Window, 'addEventListener'>} [page] hears of other windows
 */
export function createStorage(area, prefix = PREFIX, page = globalThis) {
    /** @type {Storage | null} */
    let storage = null;
    try {
        storage = area();
        // Some browsers return a storage that refuses every entry.
        storage.setItem(`${prefix}probe`, '');
        storage.removeItem(`${prefix}probe`);
    } catch {
        // A full storage can still be read.
        if (!storage?.length) storage = null;
    }

    /** @param {string | null} text @returns {unknown} undefined if it is no entry */
    function parse(text) {
        try {
            return text === null || text.length > LONGEST ? undefined : JSON.parse(text);
        } catch {
            return undefined;
        }
    }

    return {
        /** Whether anything can be stored. */
        available: storage !== null,

        /** @param {string} key @returns {unknown} undefined if there is no valid entry */
        read(key) {
            try {
                return parse(storage?.getItem(prefix + key) ?? null);
            } catch {
                return undefined;
            }
        },

        /** @param {string} key @param {unknown} value none removes the entry @returns {boolean} whether the value is stored: the storage may be full */
        write(key, value) {
            try {
                if (value === undefined) storage?.removeItem(prefix + key);
                else storage?.setItem(prefix + key, JSON.stringify(value));
                return storage !== null;
            } catch {
                return false;
            }
        },

        /** The entries whose names are a key and a value, with these values. @param {string} key @returns {[name: string, value: unknown][]} */
        named(key) {
            try {
                const names = Array.from({ length: storage?.length ?? 0 }, (_, at) => storage?.key(at) ?? '');
                const own = names.filter((name) => name.startsWith(`${prefix + key} {`));
                return own.map((name) => [name.slice(prefix.length), parse(name.slice(prefix.length + key.length))]);
            } catch {
                return [];
            }
        },

        /** Hears of what other windows write under a key, or as its named entries. @param {string} key @param {() => void} heard */
        follow(key, heard) {
            if (storage)
                page.addEventListener?.('storage', ({ key: changed }) => {
                    if (changed === null || changed === prefix + key || changed.startsWith(`${prefix + key} {`))
                        heard();
                });
        },
    };
}
