/** The string view: scrolls through a generation of any length and shows the origin of a symbol. */

import { html } from '../base/dom.js';
import { latest } from '../base/latest.js';
import { createToggled } from '../base/toggled.js';
import { createCopying } from './copying.js';
import { createGenerations } from './generations.js';
import { createOriginCard } from './origin-card.js';
import { outlineOf } from '../controls/trace.js';
import { createPlaceField } from './place-field.js';
import { createTextWindow } from './text-window.js';
import { partsOf } from './words.js';

/** @typedef {import('../protocol.js').AncestryLink} AncestryLink */
/** @typedef {import('../state/state.js').State} State */

/** The fields of the state that determine the string. @type {(keyof State)[]} */
const WRITTEN_BY = ['axiom', 'rules', 'seed', 'dialect', 'overrides'];

/**
 * The string view and what is marked in it.
 * @typedef {object} Reader
 * @property {(outline: number[][]) => void} mark
 * @property {ReturnType<typeof import('../controls/legend.js').createLegend>} legend
 * @property {HTMLElement} area
 * @property {ReturnType<typeof createToggled>} frame
 * @property {ReturnType<typeof createGenerations>} generations
 * @property {ReturnType<typeof createOriginCard>} card
 * @property {ReturnType<typeof createMarked>} marked
 * @property {ReturnType<typeof createTextWindow>} text
 * @property {bigint | null} pointed The symbol under the mouse, shown while no symbol is selected
 * @property {(generation: number, index: bigint) => void} fetchFacts
 * @property {ReturnType<typeof createDescent>} descend
 */

/**
 * @param {import('../engine/engine.js').Engine} engine
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
            forget(self);
        }
    });
    frame.onOpener(() => html('reader-text').focus({ preventScroll: true }));
    const generations = createGenerations((to) => goTo(self, to));
    const card = createOriginCard((to, index) => goTo(self, to, index));
    const marked = createMarked(generations.now);
    const text = createTextWindow(area, {
        read: engine.string,
        open: () => frame.open,
        generation: generations.now,
        marks: () => marked,
        arrived: () => field.update(),
        choose: (index) => choose(self, index),
    });
    const field = createPlaceField({ length: () => text.pages.length, choose: (index) => choose(self, index) });

    const fetchFacts = latest(engine.symbol, (facts, generation, index) => {
        if (generation !== generations.now() || index !== (marked.chosen ?? self.pointed)) return;
        mark(outlineOf(facts));
        const symbol = text.pages.symbolAt(index);
        card.show(
            { symbol, words: meaningOf(self, symbol), index, generation, iterations: generations.iterations },
            facts,
        );
    });

    const descend = createDescent(
        engine,
        (index, generation) => generation === generations.now() && choose(self, index),
    );
    /** @type {Reader} */
    const self = { mark, legend, area, frame, generations, card, marked, text, pointed: null, fetchFacts, descend };

    listen(self, engine);
    forget(self);

    return {
        get open() {
            return frame.open;
        },

        close: () => frame.set(false),

        /** @param {State} state @param {State | null} before */
        show: (state, before) => showState(self, state, before),

        /** The definition has changed: loads the string again. @param {import('../protocol.js').Report} report */
        report: (report) => reload(self, report),

        /** Highlights a symbol of the last generation, or its ancestor in the shown generation; an empty chain highlights none. @param {AncestryLink[]} chain */
        light(chain) {
            if (!marked.light(chain)) return;
            if (frame.open && marked.lit !== null) text.reveal(marked.lit);
            show(self);
        },

        /** Selects a symbol in the open string. @param {AncestryLink[]} chain */
        choose: (/** @type {AncestryLink[]} */ chain) => select(self, chain),

        /** Opens the last generation at a symbol. @param {bigint} index */
        readAt(index) {
            frame.set(true);
            goTo(self, generations.iterations, index);
        },

        /** Opens the string at a symbol. @param {AncestryLink[]} chain */
        read: (chain) => openAt(self, chain),
    };
}

/** @param {Reader} self @param {import('../engine/engine.js').Engine} engine */
function listen(self, engine) {
    const { area, frame, generations, marked, text } = self;
    area.addEventListener('pointermove', ({ pointerType, buttons, clientX, clientY }) => {
        if (pointerType === 'mouse' && buttons === 0) point(self, text.symbolUnder(clientX, clientY));
    });
    area.addEventListener('pointerleave', () => point(self, null));
    createCopying(area, { read: engine.string, generation: generations.now, open: () => frame.open });
    listenToKeys(area, text, (by) => choose(self, marked.chosen === null ? text.first : marked.chosen + by));
}

/** @param {Reader} self @param {string | undefined} module */
const meaningOf = (self, module) => (module && self.legend.of(partsOf(module)[0])?.words) || '';

/** @param {Reader} self @param {bigint | null} index of the symbol under the mouse */
function point(self, index) {
    if (index === self.pointed) return;
    self.pointed = index;
    self.area.title = index === null ? '' : meaningOf(self, self.text.pages.symbolAt(index));
    if (self.marked.chosen !== null) return;
    if (index !== null) return self.fetchFacts(self.generations.now(), index);
    self.mark([]);
    self.card.clear();
}

/** @param {Reader} self */
function show(self) {
    if (!self.frame.open) return;
    self.generations.show();
    self.text.show();
}

/** @param {Reader} self @param {bigint} index */
function choose(self, index) {
    const place = self.text.pages.bounded(index);
    self.marked.choose(place);
    self.text.reveal(place);
    show(self);
    self.text.fetchMissing();
    self.fetchFacts(self.generations.now(), place);
}

/**
 * Selects a symbol of the last generation, or its ancestor in the shown generation.
 * @param {Reader} self
 * @param {AncestryLink[]} chain
 */
function select(self, chain) {
    const link = chain[self.generations.now()];
    if (self.frame.open && link) choose(self, BigInt(link.index));
}

/** @param {Reader} self */
function forget(self) {
    self.pointed = null;
    self.marked.forget();
    self.mark([]);
    self.card.clear();
}

/**
 * Shows another generation. The related symbol is selected there; without a selection the window keeps its relative
 * position.
 * @param {Reader} self
 * @param {number} to
 * @param {bigint} [index] the symbol to select there
 */
function goTo(self, to, index) {
    const from = self.generations.now();
    const next = self.generations.bounded(to);
    if (next === from && index === undefined) return;
    const { part } = self.text;
    self.generations.set(next);
    if (next !== from) {
        self.text.pages.changeGeneration();
        const had = self.marked.changeGeneration();
        if (index === undefined && had !== null) return self.descend(from, had, next);
    }
    if (index !== undefined) return choose(self, index);
    self.mark([]);
    // Scrolling needs the length of the other generation.
    self.text.pages.measure().then((known) => (known ? self.text.goToPart(part) : show(self)));
    show(self);
    self.text.fetchMissing();
}

/** @param {Reader} self @param {State} state @param {State | null} before */
function showState(self, state, before) {
    const grown = self.generations.iterations !== state.iterations;
    self.generations.setIterations(state.iterations);
    if (before && (grown || WRITTEN_BY.some((name) => state[name] !== before[name]))) forget(self);
    show(self);
}

/** @param {Reader} self @param {import('../protocol.js').Report} report */
function reload(self, { ok, stochastic, memoised }) {
    // Deriving a random string takes extra time: let the drawing come first.
    if (!ok || (stochastic && memoised === null)) return;
    self.text.pages.redefine();
    self.text.fetchMissing();
}

/** @param {Reader} self @param {AncestryLink[]} chain */
function openAt(self, chain) {
    if (chain.length === 0) return;
    self.frame.set(true);
    select(self, chain);
}

/**
 * Finds a symbol's first descendant, or its ancestor, in another generation.
 * @param {import('../engine/engine.js').Engine} engine
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
