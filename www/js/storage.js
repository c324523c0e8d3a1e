/** The browser's storage for this page. Private windows and sandboxed frames may refuse storage. */

/** @typedef {ReturnType<typeof createStorage>} SafeStorage */

/** Longer entries are not read, in UTF-16 units. No browser stores more per site, and other pages may write there. */
const LONGEST = 5 << 20;

/** The prefix of keys, because pages of the same host share the storage. */
const PREFIX = 'l-systems:';

/**
 * @param {() => Storage} area throws if the browser refuses
 */
export function createStorage(area) {
    /** @type {Storage | null} */
    let storage = null;
    try {
        storage = area();
        // Some browsers return a storage that refuses every entry.
        storage.setItem(`${PREFIX}probe`, '');
        storage.removeItem(`${PREFIX}probe`);
    } catch {
        // A full storage can still be read.
        if (!storage?.length) storage = null;
    }

    return {
        /** Whether anything can be stored. */
        available: storage !== null,

        /** @param {string} key @returns {unknown} undefined if there is no valid entry */
        read(key) {
            try {
                const text = storage?.getItem(PREFIX + key) ?? '';
                return text.length > LONGEST ? undefined : JSON.parse(text);
            } catch {
                return undefined;
            }
        },

        /** @param {string} key @param {unknown} value @returns {boolean} whether the value is stored: the storage may be full */
        write(key, value) {
            try {
                storage?.setItem(PREFIX + key, JSON.stringify(value));
                return storage !== null;
            } catch {
                return false;
            }
        },
    };
}
