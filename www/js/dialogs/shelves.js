/** The shelves of the gallery: where each system stands, and which systems a filter or a search finds. Pure functions. */

import { said, say } from '../base/words.js';
import TABLE from '../shelves.json' with { type: 'json' };

/** @typedef {import('../state/state.js').Definition} Definition */
/** @typedef {{path: string, kinds: string[], solid: boolean, definition: Definition}} Entry */

/**
 * Every system of data_in, by shelf and file name without its ending, in the order of the gallery. The value names
 * another shelf whose filter also finds the system. Systems in space, with chance and with contexts need none.
 * Of systems that look nearly equal, all but one stand on the last shelf.
 * @type {Readonly<Record<string, Readonly<Record<string, string>>>>}
 */
export const SHELVES = TABLE;

/** The names of the shelves, which are also the filters. */
export const NAMES = Object.freeze(Object.keys(SHELVES));

/** The names as they are read. @type {Readonly<Record<string, string>>} */
export const LABELS = {
    'Start here': say`Start here`,
    Trees: say`Trees`,
    'Flowers and leaves': say`Flowers and leaves`,
    Curves: say`Curves`,
    Tilings: say`Tilings`,
    Stars: say`Stars`,
    'In space': say`In space`,
    'Plants that look around': say`Plants that look around`,
    'By chance': say`By chance`,
    Signals: say`Signals`,
    'Books and courses': say`Books and courses`,
};

/** The shelf of systems that the table does not have. */
const LAST = /** @type {string} */ (NAMES.at(-1));

/** The shelf of each path, the place on all shelves, and the other filter. */
const PLACES = new Map(
    Object.entries(SHELVES)
        .flatMap(([shelf, systems]) =>
            Object.entries(systems).map(([path, other]) => /** @type {const} */ ([path, { shelf, other }])),
        )
        .map(([path, place], at) => [path, { ...place, at }]),
);

/** @param {string} path */
const placeOf = (path) => PLACES.get(path.replace(/\.json$/, '')) ?? { shelf: LAST, other: '', at: Infinity };

/**
 * The systems by shelf, in the order of the gallery, without empty shelves.
 * @template {{path: string}} E
 * @param {readonly E[]} entries
 * @returns {[string, E[]][]}
 */
export function shelved(entries) {
    const placed = entries
        .map((entry) => ({ entry, ...placeOf(entry.path) }))
        .sort((a, b) => (a.at === b.at ? 0 : a.at - b.at));
    return NAMES.map(
        (name) =>
            /** @type {[string, E[]]} */ ([
                name,
                placed.filter(({ shelf }) => shelf === name).map(({ entry }) => entry),
            ]),
    ).filter(([, inside]) => inside.length > 0);
}

/** The filters that find a system. @param {Pick<Entry, 'path' | 'kinds' | 'solid'>} entry @returns {string[]} */
export function filtersOf({ path, kinds, solid }) {
    const { shelf, other } = placeOf(path);
    const own = [
        shelf,
        other,
        solid && 'In space',
        kinds.includes('stochastic') && 'By chance',
        kinds.includes('context-sensitive') && !kinds.includes('environmentally sensitive') && 'Signals',
    ];
    return NAMES.filter((name) => own.includes(name));
}

/**
 * Adds a filter to the chosen filters, or removes it. A filter that has no system in common with the chosen ones
 * replaces them.
 * @param {ReadonlySet<string>} chosen
 * @param {string} filter
 * @param {readonly string[][]} found the filters of each system
 * @returns {Set<string>}
 */
export function choose(chosen, filter, found) {
    if (chosen.has(filter)) return new Set([...chosen].filter((each) => each !== filter));
    const both = new Set([...chosen, filter]);
    return count(found, both) > 0 ? both : new Set([filter]);
}

/**
 * How many systems have all the chosen filters.
 * @param {readonly string[][]} found the filters of each system
 * @param {ReadonlySet<string>} chosen
 */
export function count(found, chosen) {
    return found.filter((own) => [...chosen].every((filter) => own.includes(filter))).length;
}

/** The text that a search reads. Sources are left out, because one book is the source of half the gallery. @param {Pick<Definition, 'title' | 'name' | 'notes' | 'rules'>} definition */
export function searchText({ title, name, notes, rules }) {
    return [title, name, notes, rules, said(title), said(notes)].join('\n').toLowerCase();
}

/** Whether a text has every word of a search. @param {string} text in lower case @param {string} search */
export function matches(text, search) {
    return search
        .toLowerCase()
        .split(/\s+/)
        .every((word) => text.includes(word));
}

/** The author or book of a source and its year, short enough for a card. @param {string} source */
export function shortSource(source) {
    const year = /\((?:[^()]*\D)?(1[89]\d\d|20\d\d)\)/.exec(source)?.[1] ?? '';
    const named =
        /^(?:(?:After|In the manner of) )?figure [\d.]+[a-z]? of (The Algorithmic Beauty of Plants)|^(.*?)(?:,| \(|: |;|$)/i.exec(
            source,
        );
    const name = named?.[1] ? say`After ${named[1]}` : (named?.[2] ?? '');
    return [name, year].filter(Boolean).join(', ');
}
