/** The string view: scrolls through any generation, however long it is, and tells where a symbol comes from. */

import { button, html, input, make, setText } from '../dom.js';
import { latest } from '../latest.js';
import { grouped, shortText } from '../numerals.js';
import { REACH, countText, lastTop, placeText, portion, ratio, readPlace, rowsOf, scrolled, within } from './places.js';
import { rowsView } from './rows.js';
import { birth, birthOf, descent, modulesOf, origin, visible } from './words.js';

/** @typedef {import('../protocol.js').Link} Link */
/** @typedef {import('./places.js').Top} Top */

/** Rows that are asked for above and below those in sight, so that scrolling finds them there. */
const SPARE = 40n;
/** The fields of the state that decide the string. @type {(keyof import('../state.js').State)[]} */
const WRITTEN_BY = ['axiom', 'rules', 'seed', 'dialect', 'overrides'];
const UNTRACED = 'This derivation is too long to be remembered, so where the symbol comes from is not known.';

/**
 * @param {import('../engine.js').Engine} engine
 * @param {{mark: (outline: number[][]) => void, opened: () => void}} page `mark` marks a part of the drawing
 */
export function createReader(engine, { mark, opened }) {
    const frame = html('reader');
    const toggle = button('open-reader');
    const area = html('reader-text');
    const bar = html('reader-bar');
    const thumb = html('reader-thumb');
    const goTo = input('reader-goto');
    const slider = input('reader-step');
    const rows = rowsView(area);

    let open = false;
    let iterations = 0;
    /** The generation that is shown, null for the last. @type {number | null} */
    let step = null;
    /** How many symbols can be reached, null while unknown; and all digits of how many there are. @type {bigint | null} */
    let length = null;
    let digits = '';
    /** @type {Top} */
    let top = { row: 0n, offset: 0 };
    /** The first symbol in sight, which stays there when rows become longer or shorter. */
    let first = 0n;
    /** What is at hand of the string. */
    let page = { generation: -1, start: 0n, symbols: /** @type {string[]} */ ([]) };
    /** Positions in the generation that is shown. @type {bigint | null} */
    let chosen = null;
    /** @type {bigint | null} */
    let lit = null;
    /** Who the lit symbol descends from, to light its ancestor in an earlier generation. @type {Link[]} */
    let litChain = [];
    let stale = true;
    /** Whether the next page is of another definition than the last. */
    let renewed = true;
    let why = '';
    /** Whether a place was asked for before the length was known. */
    let wished = false;

    const generation = () => Math.min(step ?? iterations, iterations);
    const scale = () => ({ rows: rowsOf(length ?? 0n, rows.columns), rowHeight: rows.rowHeight, height: rows.height });

    const fetchPage = latest(
        (/** @type {number} */ wanted, /** @type {bigint} */ start, /** @type {number} */ count) => engine.string(wanted, start, count),
        (answer, wanted, start, count) => {
            if (wanted !== generation()) return;
            stale = false;
            digits = answer.length ?? '';
            length = answer.length === null ? null : within(BigInt(answer.length), 0n, REACH);
            why = answer.text === null ? 'This generation is too long to be derived.' : '';
            const another = page.generation !== wanted || renewed;
            renewed = false;
            page = { generation: wanted, start, symbols: modulesOf(answer.text ?? '', answer.apart) };
            const before = BigInt(rows.columns);
            // Modules with their arguments may need more room than those before.
            const changed = rows.fit(page.symbols, another);
            if (changed) top = { row: (top.row * before) / BigInt(rows.columns), offset: 0 };
            if (length !== null) top = scrolled(top, 0, scale());
            if (changed && chosen !== null) reveal(chosen);
            show();
            // Rows may have become longer, or more, while it was on its way.
            if (answer.text !== null && (changed || page.symbols.length >= count)) need();
            if (wished) go();
        },
    );
    const fetchFacts = latest(
        (/** @type {number} */ wanted, /** @type {bigint} */ index) => engine.symbol(wanted, index),
        (answer, wanted, index) => {
            if (wanted !== generation() || index !== chosen) return;
            // What draws nothing is marked where the turtle is.
            const outline = answer.part?.outline ?? [];
            mark(outline.length > 0 || !answer.stroke ? outline : [answer.stroke.fittedFrom]);
            showPath(answer.ancestry, answer.part, answer.stroke);
        },
    );
    const fetchDescendant = latest(
        (/** @type {number} */ from, /** @type {bigint} */ index, /** @type {number} */ to) => engine.descendant(from, index, to),
        (start, _from, _index, to) => {
            if (to !== generation() || start === null) return;
            choose(BigInt(start));
        },
    );

    /** Asks for what is in sight, unless it is at hand. */
    function need() {
        if (!open || rows.height === 0) return;
        const columns = BigInt(rows.columns);
        const count = BigInt(Math.ceil(rows.height / rows.rowHeight) + 1);
        const from = top.row * columns;
        const to = from + count * columns;
        const end = length === null || to < length ? to : length;
        const held = !stale && page.generation === generation() && page.start <= from && page.start + BigInt(page.symbols.length) >= end;
        if (held) return;
        const start = top.row > SPARE ? (top.row - SPARE) * columns : 0n;
        fetchPage(generation(), start, Number((count + 2n * SPARE) * columns));
    }

    function show() {
        if (!open) return;
        rows.show({ top, page: page.generation === generation() ? page : { ...page, symbols: [] }, length: length ?? 0n, chosen, lit });
        first = top.row * BigInt(rows.columns);
        const { row } = lastTop(scale());
        const part = ratio(top.row, row);
        const inSight = Number(within((BigInt(Math.ceil(rows.height / rows.rowHeight)) * 1000n) / (scale().rows || 1n), 0n, 1000n)) / 1000;
        bar.hidden = inSight >= 1 && row === 0n && top.row === 0n;
        bar.setAttribute('aria-valuenow', (part * 100).toFixed(1));
        bar.style.setProperty('--part', String(part));
        bar.style.setProperty('--size', String(inSight));
        showWhere();
    }

    function showWhere() {
        const now = generation();
        setText(html('reader-generation'), `n = ${now}`);
        slider.max = String(iterations);
        slider.value = String(now);
        slider.style.setProperty('--at', String(iterations === 0 ? 0 : now / iterations));
        slider.setAttribute('aria-valuetext', `generation ${now} of ${iterations}`);
        button('reader-back').disabled = now === 0;
        button('reader-on').disabled = now === iterations;
        if (length === null) return setText(html('reader-where'), why || '…');
        if (length === 0n) return setText(html('reader-where'), 'There are no symbols.');
        const last = within(first + BigInt(Math.ceil(rows.height / rows.rowHeight)) * BigInt(rows.columns), 0n, length);
        const beyond = length === REACH ? ', of which the first 3.4 × 10³⁸ can be read' : '';
        setText(html('reader-where'), `${placeText(first + 1n, 20)} to ${placeText(last)} of ${shortText(digits)}${beyond}`);
        html('reader-where').title = `From ${grouped(String(first + 1n))} to ${grouped(String(last))} of ${grouped(digits)} symbols`;
    }

    /** @param {Top} next */
    function stand(next) {
        top = next;
        show();
        need();
    }

    /** @param {number} pixels */
    const scroll = (pixels) => length !== null && stand(scrolled(top, pixels, scale()));

    /** Brings a symbol into sight, and into the middle where it was far. @param {bigint} index */
    function reveal(index) {
        const row = index / BigInt(rows.columns);
        const fitting = BigInt(Math.max(1, Math.floor(rows.height / rows.rowHeight)));
        if (row > top.row && row < top.row + fitting - 1n) return;
        if (row === top.row && top.offset === 0) return;
        const to = row - fitting / 2n;
        stand(scrolled({ row: to < 0n ? 0n : to, offset: 0 }, 0, scale()));
    }

    /** @param {bigint} index */
    function choose(index) {
        if (length === null) {
            // Not known yet how long the string is: the core's answer will put it right.
            length = REACH;
        }
        chosen = within(index, 0n, length > 0n ? length - 1n : 0n);
        reveal(chosen);
        show();
        need();
        fetchFacts(generation(), chosen);
    }

    function forget() {
        chosen = null;
        lit = null;
        litChain = [];
        mark([]);
        html('reader-path').replaceChildren(make('p', { class: 'note' }, 'Choose a symbol to see where it comes from.'));
    }

    /** @param {Link[]} chain @param {import('../protocol.js').Part | null} part @param {import('../protocol.js').Stroke | null} stroke */
    function showPath(chain, part, stroke) {
        const symbol = chosen === null ? undefined : page.symbols[Number(chosen - page.start)];
        const path = html('reader-path');
        if (chain.length === 0) {
            path.replaceChildren(make('p', { class: 'path-head' }, make('kbd', {}, visible(symbol ?? '?')), `symbol ${placeText((chosen ?? 0n) + 1n)}`), make('p', { class: 'note' }, UNTRACED));
            return;
        }
        const own = /** @type {Link} */ (chain.at(-1));
        const links = descent(chain).map((link) => {
            const here = make('button', { type: 'button', class: 'link' }, make('kbd', {}, visible(link.symbol)), make('span', {}, birth(link)));
            here.addEventListener('click', () => turn(link.generation, BigInt(link.index)));
            return make('li', link.generation === own.generation && link.index === own.index ? { class: 'own' } : {}, here);
        });
        path.replaceChildren(
            make('p', { class: 'path-head' }, make('kbd', {}, visible(own.symbol)), make('span', {}, own.symbol.length === 1 ? origin(chain) : birthOf(chain))),
            make('p', { class: 'note' }, drawnText(part, stroke)),
            make('ol', { class: 'links', 'aria-label': 'Where it comes from, back to the axiom' }, ...links),
        );
    }

    /** What a symbol has become in the drawing, in words. @param {import('../protocol.js').Part | null} part @param {import('../protocol.js').Stroke | null} stroke */
    function drawnText(part, stroke) {
        if (!part) return '';
        const [from, to] = part.segments.map(BigInt);
        const count = /** @type {bigint} */ (to) - /** @type {bigint} */ (from);
        const now = generation();
        const grown = now === iterations ? '' : `${countText(BigInt(part.symbols[1]) - BigInt(part.symbols[0]))} symbols at n = ${iterations}: `;
        if (count === 0n) return `${grown}draws no segment itself${stroke ? ', marked where the turtle is' : ''}.`.replace(/^./, (letter) => letter.toUpperCase());
        const place = count === 1n ? `segment ${placeText(/** @type {bigint} */ (from) + 1n)}` : `${countText(count)} segments`;
        return `${grown}${place}, marked in the drawing.`.replace(/^./, (letter) => letter.toUpperCase());
    }

    /**
     * Shows another generation. What was chosen is chosen there too; without anything chosen the place stays in
     * proportion.
     * @param {number} to
     * @param {bigint} [index] what to choose there
     */
    function turn(to, index) {
        const from = generation();
        const next = Math.min(iterations, Math.max(0, to));
        if (next === from && index === undefined) return;
        step = next === iterations ? null : next;
        const part = ratio(top.row, lastTop(scale()).row);
        if (next !== from) {
            stale = true;
            length = null;
            page = { ...page, generation: -1 };
            const had = chosen;
            chosen = null;
            lit = litAt(next);
            if (index === undefined && had !== null) return descend(from, had, next);
        }
        if (index !== undefined) return choose(index);
        mark([]);
        // How long the other one is has to be known first.
        engine.string(next, 0n, 1).then(
            (answer) => {
                if (generation() !== next || answer.length === null) return show();
                digits = answer.length;
                length = within(BigInt(answer.length), 0n, REACH);
                stand({ row: portion(lastTop(scale()).row, part), offset: 0 });
            },
            () => {},
        );
        show();
        need();
    }

    /** Chooses in another generation what descends from a symbol, or what that descends from. @param {number} from @param {bigint} index @param {number} to */
    function descend(from, index, to) {
        if (to > from) return fetchDescendant(from, index, to);
        engine.symbol(from, index).then(
            ({ ancestry }) => {
                const ancestor = ancestry[to];
                if (generation() === to && ancestor) choose(BigInt(ancestor.index));
            },
            () => {},
        );
    }

    /** @param {number} now */
    const litAt = (now) => {
        const link = litChain[now];
        return link ? BigInt(link.index) : null;
    };

    /** @param {boolean} next */
    function setOpen(next) {
        if (open === next) return;
        open = next;
        frame.hidden = !open;
        toggle.setAttribute('aria-expanded', String(open));
        document.body.classList.toggle('reading', open);
        if (open) {
            stale = true;
            opened();
            rows.measure();
            rows.fit(page.symbols, true);
            show();
            need();
        } else {
            wished = false;
            forget();
        }
    }

    toggle.addEventListener('click', () => {
        setOpen(!open);
        if (open) area.focus({ preventScroll: true });
    });
    button('close-reader').addEventListener('click', () => {
        setOpen(false);
        toggle.focus();
    });
    button('reader-back').addEventListener('click', () => turn(generation() - 1));
    button('reader-on').addEventListener('click', () => turn(generation() + 1));
    slider.addEventListener('input', () => turn(Number(slider.value)));
    frame.addEventListener('keydown', (event) => {
        if (event.key === 'Escape') button('close-reader').click();
    });

    /** Goes to the place that was typed, as soon as the length is known. */
    function go() {
        wished = length === null;
        if (length === null) return;
        const place = readPlace(goTo.value, length);
        goTo.toggleAttribute('data-wrong', place === null);
        if (place !== null) choose(place);
    }

    goTo.addEventListener('keydown', (event) => event.key === 'Enter' && go());
    goTo.addEventListener('input', () => goTo.toggleAttribute('data-wrong', goTo.value.trim() !== '' && readPlace(goTo.value, length ?? REACH) === null));

    rows.gestures({
        scroll,
        click: (index) => length !== null && index < length && choose(index),
    });
    area.addEventListener('keydown', (event) => {
        if (event.ctrlKey || event.metaKey || event.altKey || length === null) return;
        const by = { ArrowDown: rows.rowHeight, ArrowUp: -rows.rowHeight, PageDown: rows.height - rows.rowHeight, PageUp: rows.rowHeight - rows.height, ' ': (rows.height - rows.rowHeight) * (event.shiftKey ? -1 : 1) }[event.key];
        const sideways = { ArrowLeft: -1n, ArrowRight: 1n }[event.key];
        if (by !== undefined) scroll(by);
        else if (sideways !== undefined) choose(chosen === null ? first : within(chosen + sideways, 0n, length));
        else if (event.key === 'Home') stand({ row: 0n, offset: 0 });
        else if (event.key === 'End') stand(lastTop(scale()));
        else return;
        event.preventDefault();
    });

    bar.addEventListener('pointerdown', (event) => {
        if (event.button !== 0) return;
        event.preventDefault();
        bar.setPointerCapture(event.pointerId);
        const grip = thumb.getBoundingClientRect();
        const inside = event.clientY >= grip.top && event.clientY <= grip.bottom ? event.clientY - grip.top : grip.height / 2;
        const move = (/** @type {PointerEvent} */ { clientY }) => {
            const box = bar.getBoundingClientRect();
            const way = Math.max(1, box.height - grip.height);
            const part = Math.min(1, Math.max(0, (clientY - box.top - inside) / way));
            const last = lastTop(scale());
            stand(part >= 1 ? last : { row: portion(last.row, part), offset: 0 });
        };
        move(event);
        bar.addEventListener('pointermove', move);
        const stop = () => bar.removeEventListener('pointermove', move);
        bar.addEventListener('pointerup', stop, { once: true });
        bar.addEventListener('pointercancel', stop, { once: true });
    });

    new ResizeObserver(() => {
        if (!open) return;
        const before = rows.columns;
        rows.measure();
        rows.fit(page.symbols, true);
        if (rows.columns !== before) top = { row: first / BigInt(rows.columns), offset: 0 };
        if (length !== null) top = scrolled(top, 0, scale());
        show();
        need();
    }).observe(area);
    forget();

    return {
        get open() {
            return open;
        },

        close: () => setOpen(false),

        /** @param {import('../state.js').State} state @param {import('../state.js').State | null} before */
        show(state, before) {
            const grown = iterations !== state.iterations;
            iterations = state.iterations;
            if (step !== null && step >= iterations) step = null;
            if (before && (grown || WRITTEN_BY.some((field) => state[field] !== before[field]))) forget();
            if (open) show();
        },

        /** A new definition was taken: what is at hand is of the former. @param {import('../protocol.js').Report} report */
        report({ ok, stochastic, memoised }) {
            // A random string is derived once more: let the drawing come first.
            if (!ok || (stochastic && memoised === null)) return;
            stale = true;
            renewed = true;
            need();
        },

        /** Lights a symbol of the last generation, or the one it descends from; an empty chain lights none. @param {Link[]} chain */
        light(chain) {
            litChain = chain;
            const next = litAt(generation());
            if (next === lit) return;
            lit = next;
            if (!open) return;
            if (lit !== null) reveal(lit);
            show();
        },

        /** @param {Link[]} chain */
        choose(chain) {
            const link = chain[generation()];
            if (open && link) choose(BigInt(link.index));
        },
    };
}
