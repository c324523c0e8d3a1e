/**
 * Rows in the browser's storage that several windows change. Each row is an entry of its own, whose name holds all of it, so
 * that windows never write over each other. Of several rows with one id, all windows read the same one. A window removes
 * the others only after it has stored what replaces them: nothing is lost, also if windows are closed before they hear of
 * each other. Locks would not help, since they do not order the storage of two processes.
 */

/** The most deleted rows that are remembered. */
const MOST_GONE = 500;
/** Later times are none. */
const LATEST = 1e15;

/**
 * `time` is that of the last change, in milliseconds. A row that is `gone` was deleted, which is a change like others.
 * @typedef {{id: string, time: number, gone?: boolean}} Row
 */
/** A change of a row, or what deletes it. It gets its time when it is written. @template {Row} R @typedef {(Omit<R, 'time'> & {time?: number}) | {id: string, time?: number, gone: true}} Change */

/** Whether one row replaces another: it weighs more, or is newer. At last the texts decide, so that all windows agree. @param {any} row @param {any} other @param {(row: any) => number} weigh */
function replaces(row, other, weigh) {
    const by = weigh(row) - weigh(other) || row.time - other.time;
    if (by !== 0) return by > 0;
    const [text, former] = [JSON.stringify(row), JSON.stringify(other)];
    return text.length > former.length || (text.length === former.length && text > former);
}

/**
 * One row of each id: the same in every order of the lists. Rows stand where their id was first.
 * @template {Row} R
 * @param {Iterable<R>} rows
 * @param {(row: R) => number} weigh what weighs more stays, older or newer
 * @returns {R[]}
 */
export function joined(rows, weigh) {
    /** @type {Map<string, R>} */
    const best = new Map();
    for (const row of rows) {
        const other = best.get(row.id);
        if (!other || replaces(row, other, weigh)) best.set(row.id, row);
    }
    return [...best.values()];
}

/** The order of rows: newest first. @param {Row} a @param {Row} b */
export const newestFirst = (a, b) => b.time - a.time || (a.id < b.id ? -1 : 1);

/**
 * @template {Row} R
 * @param {import('./storage.js').SafeStorage} storage
 * @param {string} key
 * @param {object} how
 * @param {(stored: unknown) => Change<R>[]} how.read reads rows from any value, without those that are gone
 * @param {(rows: R[]) => R[]} [how.tidy] the order of all rows and the limits, equal for equal rows
 * @param {(row: R) => number} [how.weigh]
 * @param {(() => void) | undefined} [how.changed] another window has changed something
 */
export function createRows(storage, key, { read, tidy = (rows) => rows.sort(newestFirst), weigh = () => 0, changed }) {
    /** @param {unknown} stored @returns {R[]} */
    function rowsIn(stored) {
        const gone = Array.isArray(stored) ? stored.filter((row) => row?.gone && typeof row.id === 'string') : [];
        const rows = /** @type {R[]} */ ([...read(stored), ...gone]);
        return rows.map((row) => ({ ...row, time: Math.abs(row.time) < LATEST ? Number(row.time) : 0 }));
    }

    /** All rows, with the names of their entries: that of the one entry in which earlier versions kept all, or their own. */
    function load() {
        const there = new Map(rowsIn(storage.read(key)).map((row) => [row, key]));
        for (const [name, value] of storage.named(key)) for (const row of rowsIn([value])) there.set(row, name);
        return there;
    }

    /** The rows that count. @param {Iterable<R>} rows */
    function best(rows) {
        const all = joined(rows, weigh);
        const gone = all.filter((row) => row.gone).sort(newestFirst);
        return [...tidy(all.filter((row) => !row.gone)), ...gone.slice(0, MOST_GONE)];
    }

    if (changed) storage.follow(key, changed);

    return {
        /** All rows that are not gone. */
        list: () => best(load().keys()).filter((row) => !row.gone),

        /** Changes rows, or adds them. @param {readonly Change<R>[]} changes @returns {boolean} whether that is stored */
        put(changes) {
            const there = load();
            const times = new Map(best(there.keys()).map(({ id, time }) => [id, time]));
            const stamp = (/** @type {string} */ id) => Math.max(Date.now(), (times.get(id) ?? 0) + 1);
            const rows = /** @type {R[]} */ (changes.map((row) => ({ ...row, time: row.time ?? stamp(row.id) })));
            const next = new Set(best([...there.keys(), ...rows]));
            const news = rows.filter((row) => next.has(row)).map((row) => `${key} ${JSON.stringify(row)}`);
            const replaced = new Set([...there].flatMap(([row, name]) => (next.has(row) ? [] : [name])));
            const left = [...there].flatMap(([row, name]) => (name === key && next.has(row) ? [row] : []));
            const former = storage.read(key);

            const add = () => news.every((name) => storage.write(name, 0));
            const remove = () =>
                replaced.forEach((name) => storage.write(name, name === key && left.length > 0 ? left : undefined));
            if (add()) return (remove(), true);
            // Where there is no room for both, what is replaced goes first.
            remove();
            if (add()) return true;
            for (const name of news) storage.write(name, undefined);
            for (const name of replaced) storage.write(name, name === key ? former : 0);
            return false;
        },

        /** Removes all rows. */
        clear: () => [key, ...load().values()].forEach((name) => storage.write(name, undefined)),
    };
}

/** One value of a record. Its id is a name, or that of a group and of the value in it: `values.dpi`. @typedef {Row & {value: unknown}} Setting */

/** @param {object} record */
const settingsOf = (record) =>
    Object.entries(record).flatMap(([name, value]) =>
        Object(value) === value
            ? Object.entries(value).map(([inner, one]) => ({ id: `${name}.${inner}`, value: one }))
            : [{ id: name, value }],
    );

/**
 * A record of settings, of which each window writes what it changes.
 * @param {import('./storage.js').SafeStorage} storage
 * @param {string} key
 * @param {() => void} [changed] another window has changed something
 */
export function createSettings(storage, key, changed) {
    /** @type {ReturnType<typeof createRows<Setting>>} */
    const rows = createRows(storage, key, {
        read: (stored) =>
            Array.isArray(stored)
                ? stored.filter((row) => typeof row?.id === 'string' && 'value' in row)
                : settingsOf(Object(stored)),
        changed,
    });
    /** What this window shows. @type {Map<string, unknown>} */
    let known = new Map();

    return {
        /** @returns {Record<string, any>} */
        read() {
            const record = Object.create(null);
            for (const { id, value } of rows.list()) {
                const [name = '', inner] = id.split('.');
                if (inner === undefined) record[name] = value;
                else record[name] = Object.assign(Object.create(null), record[name], { [inner]: value });
            }
            return record;
        },

        /** Notes what this window shows of it, with defaults. @param {object} record */
        show(record) {
            known = new Map(settingsOf(record).map(({ id, value }) => [id, value]));
        },

        /** Keeps what is no longer as it was shown. @param {object} record */
        write(record) {
            const changes = settingsOf(record).filter(({ id, value }) => known.get(id) !== value);
            this.show(record);
            if (changes.length > 0) rows.put(changes);
        },
    };
}
