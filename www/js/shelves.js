/** The shelves of the gallery: where each system stands, and which systems a filter or a search finds. Pure functions. */

import { said, say } from './words.js';

/** @typedef {import('./state.js').Definition} Definition */
/** @typedef {{path: string, kinds: string[], solid: boolean, definition: Definition}} Entry */

/**
 * Every system of data_in, by shelf and file name without its ending, in the order of the gallery. The value names
 * another shelf whose filter also finds the system. Systems in space, with chance and with contexts need none.
 * Of systems that look nearly equal, all but one stand on the last shelf.
 * @type {Readonly<Record<string, Readonly<Record<string, string>>>>}
 */
export const SHELVES = {
    'Start here': {
        'curves/koch-snowflake': 'Curves',
        'abop/1.24e': 'Trees',
        'curves/heighway-dragon': 'Curves',
        'garden/lime-twig': 'Flowers and leaves',
        'curves/sierpinski-gasket': 'Tilings',
        'garden/levy-tapestry': 'Tilings',
    },
    Trees: {
        'garden/winter-oak': '',
        'garden/smoke-bush': '',
        'abop/1.24d': '',
        'garden/sea-fan': '',
        'abop/row-of-trees': '',
        'garden/budding-bush': '',
    },
    'Flowers and leaves': {
        'garden/sunflower': '',
        'garden/ox-eye-daisy': '',
        'garden/night-fern': '',
        'abop/1.24b': '',
        'abop/1.24a': '',
        'abop/1.24f': '',
        'practical-1/tree1': '',
        'focs-lsystems/fractal-plant': '',
        'garden/left-fern': '',
    },
    Curves: {
        'curves/hilbert': '',
        'curves/gosper': '',
        'garden/night-river': '',
        'curves/peano': '',
        'curves/levy-c': '',
        'curves/moore': '',
        'curves/koch-island': '',
        'curves/sierpinski-arrowhead': '',
        'curves/twindragon': '',
        'curves/quadratic-gosper': '',
        'curves/quadric-32': '',
        'curves/sierpinski-curve': '',
        'curves/cesaro': '',
        'curves/snake-kolam': '',
        'abop/1.7a': '',
        'curves/anklets-of-krishna': '',
        'abop/1.7b': '',
    },
    Tilings: {
        'curves/penrose': '',
        'curves/four-dragons': '',
        'curves/seven-gosper-curves': '',
        'curves/pentigree': '',
        'abop/1.9b': '',
        'curves/terdragon': '',
        'curves/islands-and-lakes': '',
        'curves/pentaflake': '',
        'abop/1.9c': '',
        'abop/1.9e': '',
        'curves/box-fractal': '',
        'garden/pierced-diamond': '',
        'abop/1.9a': '',
        'curves/crystal': '',
        'garden/ice-shield': '',
        'abop/1.9f': '',
        'garden/four-winds': '',
    },
    Stars: {
        'garden/snow-crystal': '',
        'garden/frost-star': '',
        'garden/gilded-star': '',
        'garden/rose-window': '',
        'garden/flower-wheel': 'Flowers and leaves',
    },
    'In space': {
        'garden/summer-lime': 'Trees',
        'abop/1.25': 'Flowers and leaves',
        'garden/jacaranda': 'Trees',
        'garden/fir': 'Trees',
        'garden/dandelion-clock': 'Flowers and leaves',
        'garden/copper-beech': 'Trees',
        'garden/weeping-willow': 'Trees',
        'garden/ember-coral': 'Trees',
        'garden/hydrangea': 'Trees',
        'garden/baobab': 'Trees',
        'garden/star-cluster': '',
        'garden/jellyfish': '',
        'abop/2.8b': 'Trees',
        'abop/1.19': 'Curves',
        'abop/2.6c': 'Trees',
        'abop/2.8a': 'Trees',
        'abop/2.7b': 'Trees',
        'garden/coral': 'Trees',
        'abop/2.8d': 'Trees',
        'abop/2.6a': 'Trees',
        'abop/2.7c': 'Trees',
        'garden/five-ways': 'Trees',
        'abop/2.6b': 'Trees',
        'abop/2.7a': 'Trees',
        'abop/2.6d': 'Trees',
        'abop/2.7d': 'Trees',
        'garden/turtle-tree': 'Trees',
    },
    'Plants that look around': {
        'garden/topiary-ball': 'Trees',
        'garden/two-trees': 'Trees',
        'garden/vine-letter': 'Flowers and leaves',
        'garden/roots-and-stones': '',
        'garden/elbow-room': 'Curves',
        'garden/hedge-arch': 'Trees',
        'garden/tabebuia': 'Trees',
        'garden/ivy-trellis': 'Flowers and leaves',
        'garden/cloud-pine': 'Trees',
    },
    'By chance': {
        'garden/cherry-in-bloom': 'Flowers and leaves',
        'garden/birch-in-the-wind': 'Trees',
        'garden/tulips': 'Flowers and leaves',
        'garden/meadow': 'Flowers and leaves',
        'abop/1.27': 'Flowers and leaves',
        'garden/hillside': 'Flowers and leaves',
        'garden/eelgrass': 'Flowers and leaves',
    },
    Signals: {
        'abop/1.30a': '',
        'abop/1.30b': '',
        'abop/1.31a': 'Flowers and leaves',
        'abop/1.31b': 'Flowers and leaves',
        'abop/1.31c': 'Flowers and leaves',
        'abop/1.31d': 'Flowers and leaves',
        'abop/1.31e': 'Flowers and leaves',
    },
    'Books and courses': {
        'abop/1.24c': 'Trees',
        'garden/levy-lace': 'Curves',
        'practical-1/text-example': 'Trees',
        'practical-1/koch': 'Curves',
        'practical-1/koch90': 'Curves',
        'practical-1/sierpinski': 'Tilings',
        'practical-1/tree0': 'Flowers and leaves',
        'practical-1/tree2': 'Trees',
        'practical-1/tree3': 'Trees',
        'practical-1/tree4': 'Trees',
        'practical-1/tree5': 'Flowers and leaves',
        'practical-1/tree3d0': 'Trees',
        'practical-1/tree3d1': 'Trees',
        'assignment-8/plant_01': 'Trees',
        'assignment-8/plant_02': 'Flowers and leaves',
        'assignment-8/plant_03': 'Trees',
        'assignment-8/plant_04': 'Flowers and leaves',
        'assignment-8/plant_05': 'Trees',
        'assignment-8/plant_06': 'Flowers and leaves',
        'assignment-8/sierpinski_square': 'Tilings',
        'assignment-8/sierpinski_triangle': 'Curves',
        'assignment-8/square_01': 'Tilings',
        'assignment-8/square_02': 'Tilings',
        'assignment-8/square_03': 'Tilings',
        'assignment-8/square_04': 'Tilings',
        'assignment-8/square_05': 'Tilings',
        'assignment-8/crossout': 'Tilings',
        'assignment-8/hexerode': 'Tilings',
        'assignment-8/flower_plant': 'Trees',
        'assignment-8/left_plant': 'Flowers and leaves',
        'assignment-8/stochastic_00': 'Curves',
        'assignment-8/stochastic_01': 'Flowers and leaves',
        'assignment-8/stochastic_path': 'Curves',
        'assignment-8/stochastic_02': 'Flowers and leaves',
        'focs-lsystems/koch-curve': 'Curves',
        'focs-lsystems/dragon-curve': 'Curves',
        'focs-lsystems/sierpinski-triangle': 'Tilings',
        'focs-lsystems/stochastic-fractal-plant': 'Flowers and leaves',
        'focs-lsystems/readme-a-b': '',
        'focs-lsystems/readme-s-to-ss': '',
        'turtle-blog/simple-plant': 'Trees',
        'turtle-blog/1.24c': 'Trees',
        'turtle-blog/1.24d': 'Trees',
        'turtle-blog/1.24e': 'Trees',
        'turtle-blog/1.24f': 'Flowers and leaves',
        'turtle-blog/another-example-plant': 'Trees',
        'turtle-blog/dragon': 'Curves',
        'turtle-blog/koch-island': 'Curves',
        'turtle-blog/plant-with-a-bud': 'Trees',
        'turtle-blog/lri-plant-with-a-bud': 'Trees',
        'turtle-blog/lri-prose-rule': '',
        'trees-and-turtles/of-trees-and-turtles': 'Trees',
        'abop/2.8c': 'Trees',
    },
};

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
