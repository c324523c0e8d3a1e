/** The string view: scrolls through a generation of any length and shows the origin of a symbol. */

import { html } from '../dom.js';
import { latest } from '../latest.js';
import { createToggled } from '../toggled.js';
import { createCopying } from './copying.js';
import { createGenerations } from './generations.js';
import { createOriginCard } from './origin-card.js';
import { outlineOf } from '../controls/trace.js';
import { createPlaceField } from './place-field.js';
import { createTextWindow } from './text-window.js';
import { partsOf } from './words.js';

/** @typedef {import('../protocol.js').AncestryLink} AncestryLink */
/** @typedef {import('../state.js').State} State */

/** The fields of the state that determine the string. @type {(keyof State)[]} */
const WRITTEN_BY = ['axiom', 'rules', 'seed', 'dialect', 'overrides'];

/**
 * @param {import('../engine.js').Engine} engine
 * @param {{mark: (outline: number[][]) => void, legend: ReturnType<typeof import('../controls/legend.js').createLegend>, opened: () => void}} page `mark` marks a part of the drawing
 */
export function createReader(engine, { mark, legend, opened }) {
    const area = html('reader-text');
    const frame = createToggled('reader', 'reading', (open) => {
        if (open) {
            text.pages.markStale();
            opened();
            generations.show();
            text.measure();
        } else {
            field.forget();
            forget();
        }
    });
    frame.onOpener(() => html('reader-text').focus({ preventScroll: true }));
    const generations = createGenerations(goTo);
    const card = createOriginCard(goTo);
    const marked = createMarked(generations.now);
    const text = createTextWindow(area, {
        read: engine.string,
        open: () => frame.open,
        generation: generations.now,
        marks: () => marked,
        arrived: () => field.update(),
        choose,
    });
    const field = createPlaceField({ length: () => text.pages.length, choose });

    /** The symbol under the mouse, shown while no symbol is selected. @type {bigint | null} */
    let pointed = null;

    const fetchFacts = latest(engine.symbol, (facts, generation, index) => {
        if (generation !== generations.now() || index !== (marked.chosen ?? pointed)) return;
        mark(outlineOf(facts));
        const symbol = text.pages.symbolAt(index);
        card.show({ symbol, words: meaningOf(symbol), index, generation, iterations: generations.iterations }, facts);
    });

    /** @param {string | undefined} module */
    const meaningOf = (module) => (module && legend.of(partsOf(module)[0])?.words) || '';

    /** @param {bigint | null} index of the symbol under the mouse */
    function point(index) {
        if (index === pointed) return;
        pointed = index;
        area.title = index === null ? '' : meaningOf(text.pages.symbolAt(index));
        if (marked.chosen !== null) return;
        if (index !== null) return fetchFacts(generations.now(), index);
        mark([]);
        card.clear();
    }

    area.addEventListener('pointermove', ({ pointerType, buttons, clientX, clientY }) => {
        if (pointerType === 'mouse' && buttons === 0) point(text.symbolUnder(clientX, clientY));
    });
    area.addEventListener('pointerleave', () => point(null));
    const descend = createDescent(engine, (index, generation) => generation === generations.now() && choose(index));

    function show() {
        if (!frame.open) return;
        generations.show();
        text.show();
    }

    /** @param {bigint} index */
    function choose(index) {
        const place = text.pages.bounded(index);
        marked.choose(place);
        text.reveal(place);
        show();
        text.fetchMissing();
        fetchFacts(generations.now(), place);
    }

    /** Selects a symbol of the last generation, or its ancestor in the shown generation. @param {AncestryLink[]} chain */
    function select(chain) {
        const link = chain[generations.now()];
        if (frame.open && link) choose(BigInt(link.index));
    }

    function forget() {
        pointed = null;
        marked.forget();
        mark([]);
        card.clear();
    }

    /**
     * Shows another generation. The related symbol is selected there; without a selection the window keeps its relative
     * position.
     * @param {number} to
     * @param {bigint} [index] the symbol to select there
     */
    function goTo(to, index) {
        const from = generations.now();
        const next = generations.bounded(to);
        if (next === from && index === undefined) return;
        const { part } = text;
        generations.set(next);
        if (next !== from) {
            text.pages.changeGeneration();
            const had = marked.changeGeneration();
            if (index === undefined && had !== null) return descend(from, had, next);
        }
        if (index !== undefined) return choose(index);
        mark([]);
        // Scrolling needs the length of the other generation.
        text.pages.measure().then((known) => (known ? text.goToPart(part) : show()));
        show();
        text.fetchMissing();
    }

    createCopying(area, { read: engine.string, generation: generations.now, open: () => frame.open });
    listenToKeys(area, text, (by) => choose(marked.chosen === null ? text.first : marked.chosen + by));
    forget();

    return {
        get open() {
            return frame.open;
        },

        close: () => frame.set(false),

        /** @param {State} state @param {State | null} before */
        show(state, before) {
            const grown = generations.iterations !== state.iterations;
            generations.setIterations(state.iterations);
            if (before && (grown || WRITTEN_BY.some((name) => state[name] !== before[name]))) forget();
            show();
        },

        /** The definition has changed: loads the string again. @param {import('../protocol.js').Report} report */
        report({ ok, stochastic, memoised }) {
            // Deriving a random string takes extra time: let the drawing come first.
            if (!ok || (stochastic && memoised === null)) return;
            text.pages.redefine();
            text.fetchMissing();
        },

        /** Highlights a symbol of the last generation, or its ancestor in the shown generation; an empty chain highlights none. @param {AncestryLink[]} chain */
        light(chain) {
            if (!marked.light(chain)) return;
            if (frame.open && marked.lit !== null) text.reveal(marked.lit);
            show();
        },

        /** Selects a symbol in the open string. @param {AncestryLink[]} chain */
        choose: select,

        /** Opens the last generation at a symbol. @param {bigint} index */
        readAt(index) {
            frame.set(true);
            goTo(generations.iterations, index);
        },

        /** Opens the string at a symbol. @param {AncestryLink[]} chain */
        read(chain) {
            if (chain.length === 0) return;
            frame.set(true);
            select(chain);
        },
    };
}

/**
 * Finds a symbol's first descendant, or its ancestor, in another generation.
 * @param {import('../engine.js').Engine} engine
 * @param {(index: bigint, generation: number) => void} found
 */
function createDescent(engine, found) {
    const fetchDescendant = latest(engine.descendant, (start, _from, _index, to) => {
        if (start !== null) found(BigInt(start), to);
    });

    return (/** @type {number} */ from, /** @type {bigint} */ index, /** @type {number} */ to) => {
        if (to > from) return fetchDescendant(from, index, to);
        engine.symbol(from, index).then(
            ({ ancestry }) => {
                const ancestor = ancestry[to];
                if (ancestor) found(BigInt(ancestor.index), to);
            },
            () => {},
        );
    };
}

/** The marked symbols, by their positions in the shown generation. @param {() => number} generation */
function createMarked(generation) {
    /** The symbol that the reader has selected. @type {bigint | null} */
    let chosen = null;
    /** The symbol under the pointer in the drawing, or its ancestor in the shown generation. @type {bigint | null} */
    let lit = null;
    /** @type {AncestryLink[]} */
    let chain = [];

    function relight() {
        const link = chain[generation()];
        lit = link ? BigInt(link.index) : null;
    }

    return {
        get chosen() {
            return chosen;
        },
        get lit() {
            return lit;
        },

        /** @param {bigint} index */
        choose(index) {
            chosen = index;
        },

        /** @param {AncestryLink[]} next @returns {boolean} whether the highlight has changed */
        light(next) {
            const before = lit;
            chain = next;
            relight();
            return lit !== before;
        },

        /** Another generation is shown. @returns {bigint | null} the former selection */
        changeGeneration() {
            const had = chosen;
            chosen = null;
            relight();
            return had;
        },

        forget() {
            chosen = null;
            chain = [];
            relight();
        },
    };
}

/**
 * Keys that scroll through the text or select the next or previous symbol.
 * @param {HTMLElement} area
 * @param {ReturnType<typeof createTextWindow>} text
 * @param {(by: bigint) => void} step selects a symbol this many places farther
 */
function listenToKeys(area, text, step) {
    area.addEventListener('keydown', (event) => {
        if (event.ctrlKey || event.metaKey || event.altKey || text.pages.length === null) return;
        const pixels = text.scrollOf(event);
        const sideways = { ArrowLeft: -1n, ArrowRight: 1n }[event.key];
        if (pixels !== undefined) text.scroll(pixels);
        else if (sideways !== undefined) step(sideways);
        else if (event.key === 'Home') text.goToPart(0);
        else if (event.key === 'End') text.goToPart(1);
        else return;
        event.preventDefault();
    });
}
