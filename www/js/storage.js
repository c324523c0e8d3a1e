/** What the browser keeps for this page, where it keeps anything: private windows and sandboxed frames refuse. */

/** @typedef {ReturnType<typeof createStorage>} SafeStorage */

/** Longer entries are not read, in UTF-16 units: no browser keeps more for a site, and others may have written there. */
const LONGEST = 5 << 20;

/** Other pages of the same host share the storage. */
const PREFIX = 'l-systems:';

/**
 * @param {() => Storage} area throws where it is refused
 */
export function createStorage(area) {
    /** @type {Storage | null} */
    let storage = null;
    try {
        storage = area();
        // Some browsers hand out a storage that then refuses every entry.
        storage.setItem(`${PREFIX}probe`, '');
        storage.removeItem(`${PREFIX}probe`);
    } catch {
        // A storage that is only full still gives what it holds.
        if (!storage?.length) storage = null;
    }

    return {
        /** Whether anything can be kept at all. */
        available: storage !== null,

        /** @param {string} key @returns {unknown} undefined where there is nothing that can be read */
        read(key) {
            try {
                const text = storage?.getItem(PREFIX + key) ?? '';
                return text.length > LONGEST ? undefined : JSON.parse(text);
            } catch {
                return undefined;
            }
        },

        /** @param {string} key @param {unknown} value @returns {boolean} whether it is kept: there may be no room */
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
