/**
 * Windows of a browser that share a storage, as browsers of several processes do it: each window has a copy, writes reach
 * the others late, and a write that crosses another one is not seen before its own has arrived.
 */

/** @typedef {{key: string, value: string | null}} Write */
/** @typedef {{copy: Map<string, string>, sent: Write[], told: (Write & {isOwn: boolean})[], open: Map<string, number>, listeners: ((event: any) => void)[], isClosed: boolean}} Place */

export function createBrowser() {
    /** @type {Map<string, string>} */
    const stored = new Map();
    /** @type {Set<Place>} */
    const places = new Set();
    /** @param {Map<string, string>} map @param {Write} write */
    const apply = (map, { key, value }) => (value === null ? map.delete(key) : map.set(key, value));

    /** A write of a window arrives at the browser. @param {Place} from */
    function arrive(from) {
        const write = from.sent.shift();
        if (!write) return;
        apply(stored, write);
        for (const place of places) if (!place.isClosed) place.told.push({ ...write, isOwn: place === from });
    }

    /** A window hears of a write. @param {Place} place */
    function hear(place) {
        const told = place.told.shift();
        if (!told) return;
        const open = place.open.get(told.key) ?? 0;
        if (told.isOwn) return void place.open.set(told.key, open - 1);
        if (open === 0) apply(place.copy, told);
        for (const listener of place.listeners) listener({ key: told.key, newValue: told.value });
    }

    const waiting = () =>
        [...places].flatMap((place) => [
            ...(place.sent.length > 0 ? [() => arrive(place)] : []),
            ...(place.told.length > 0 ? [() => hear(place)] : []),
        ]);

    return {
        stored,
        /** A message is delivered, if there is one. @param {() => number} roll */
        deliver(roll) {
            const all = waiting();
            all[Math.floor(roll() * all.length)]?.();
        },
        /** All messages are delivered. Fails if windows answer each other for ever. */
        settle() {
            for (let left = 10_000; ; left--) {
                const [first] = waiting();
                if (!first) return;
                if (left === 0) throw new Error('the windows do not come to rest');
                first();
            }
        },
        open() {
            /** @type {Place} */
            const place = {
                copy: new Map(stored),
                sent: [],
                told: [],
                open: new Map(),
                listeners: [],
                isClosed: false,
            };
            places.add(place);
            /** @param {string} key @param {string | null} value */
            const write = (key, value) => {
                apply(place.copy, { key, value });
                place.open.set(key, (place.open.get(key) ?? 0) + 1);
                place.sent.push({ key, value });
            };
            return {
                area: /** @type {Storage} */ (
                    /** @type {any} */ ({
                        get length() {
                            return place.copy.size;
                        },
                        key: (/** @type {number} */ at) => [...place.copy.keys()][at] ?? null,
                        getItem: (/** @type {string} */ key) => place.copy.get(key) ?? null,
                        setItem: write,
                        removeItem: (/** @type {string} */ key) => write(key, null),
                    })
                ),
                page: /** @type {Window} */ (
                    /** @type {any} */ ({
                        addEventListener: (/** @type {string} */ _, /** @type {any} */ listener) =>
                            place.listeners.push(listener),
                    })
                ),
                /** A closed window hears nothing, but what it has written arrives. */
                close() {
                    Object.assign(place, { isClosed: true, told: [] });
                },
            };
        },
    };
}
