/** The systems that a search found, or the nearest ones, as cards with small pictures. */

import { html, make, setText } from '../base/dom.js';
import { theme } from '../base/theme.js';
import { emptyThumb, paintThumb } from '../dialogs/thumb.js';
import { SIDE as COMPARED, coloured } from '../base/differences.js';
import { counted, said, say } from '../base/words.js';
import { isSame, percent, verdict } from './merge.js';

/** @typedef {import('../protocol.js').Candidate} Candidate */
/** @typedef {import('../protocol.js').FindReport} FindReport */

/** The side of a picture, in CSS pixels. */
const SIDE = 168;
/** The most words of what was searched that are in sight. */
const MOST_WORDS = 38;
/** The margin of differences, in their pixels. */
const MARGIN = 5;

/**
 * A card of a candidate: its picture, its agreement and its rules, with a button that opens it.
 * @param {Candidate & {n?: number[]}} candidate
 * @param {{engine: import('../engine/engine.js').Engine, restyle: (definition: import('../state/state.js').Definition) => import('../state/state.js').Definition, open?: (candidate: Candidate) => void, told?: string, compared?: (definition: import('../state/state.js').Definition) => Promise<Uint8Array | null>}} page
 *   without `open` there is no button; `told` stands for the agreement; with `compared` the differences from the searched
 *   picture are shown in two colours, if there are any
 */
export function candidateCard(candidate, { engine, restyle, open, told, compared }) {
    const { definition, agreement, symbols, n = [] } = candidate;
    const styled = restyle(definition);
    const picture = emptyThumb();
    picture.style.background = styled.background;
    const { axiom, iterations, angle, overrides, heading } = definition;
    const facts = [
        say`axiom ${axiom}`,
        n.length > 1 ? say`n = ${Math.min(...n)} to ${Math.max(...n)}` : `n = ${iterations}`,
        `${angle}°`,
        heading === 90 ? '' : say`heading ${String(heading)}°`,
        overrides.replaceAll('\n', ', '),
        counted(symbols, '{} symbol', '{} symbols'),
    ];
    const card = make(
        'li',
        { class: 'card find-card' },
        make(
            'span',
            { class: 'card-picture' },
            picture,
            make(
                'span',
                { class: isSame(candidate) ? 'find-percent found' : 'find-percent' },
                told ?? percent(agreement),
            ),
        ),
        candidate.name === null
            ? ''
            : make('span', { class: 'find-name' }, say`${said(candidate.name)}, in the gallery`),
        make('pre', { class: 'find-rules' }, definition.rules),
        make('span', { class: 'card-kind' }, facts.filter(Boolean).join(' · ')),
    );
    if (open) {
        const act = make('button', { class: 'button find-open' }, say`Open`);
        act.addEventListener('click', () => open(candidate));
        card.append(act);
    }
    if (compared && told === undefined && !isSame(candidate)) {
        // Without the differences, the picture of the system stays.
        compared(definition)
            .then((codes) => {
                if (codes) picture.replaceWith(differencesOf(codes));
            })
            .catch(() => {});
    }
    // A picture that cannot be drawn leaves the rules.
    paintThumb(picture, engine, styled, SIDE, () => picture.isConnected).catch(() => {});
    return card;
}

/** A picture of differences. @param {Uint8Array} codes */
function differencesOf(codes) {
    const canvas = make('canvas', { class: 'find-differences', role: 'img', 'aria-label': say`The differences` });
    // The ink begins in the upper left corner. The same margin on the other sides puts it in the middle.
    let [right, bottom] = [0, 0];
    for (const [at, code] of codes.entries())
        if (code) [right, bottom] = [Math.max(right, at % COMPARED), Math.max(bottom, Math.floor(at / COMPARED))];
    [canvas.width, canvas.height] = [right + MARGIN, bottom + MARGIN];
    const pixels = coloured(codes, theme());
    canvas.getContext('2d')?.putImageData(new ImageData(pixels, COMPARED, COMPARED), 0, 0);
    return canvas;
}

/** The first words of what was searched; the rest unfolds. @param {string} text */
function showSearched(text) {
    const words = text.split(' ');
    const isLong = words.length > MOST_WORDS;
    setText(html('find-searched'), isLong ? `${words.slice(0, MOST_WORDS).join(' ')} …` : text);
    html('find-all').hidden = !isLong;
    setText(html('find-all-searched'), isLong ? text : '');
}

/** How much was searched. @param {FindReport} report @param {boolean} isString */
export const workWords = ({ work }, isString) =>
    isString
        ? counted(work, '{} symbol read', '{} symbols read')
        : counted(work, '{} system tried', '{} systems tried');

/** @param {Omit<Parameters<typeof candidateCard>[1], 'told'>} page */
export function createResults(page) {
    const list = html('find-cards');
    /** @type {Map<string, HTMLElement>} */
    let cards = new Map();

    return {
        /** @param {FindReport} report @param {{isString: boolean, isRunning: boolean}} how */
        show(report, { isString, isRunning }) {
            const old = cards;
            const told = isString ? { ...page, told: say`derives it` } : page;
            cards = new Map(
                report.candidates.map((candidate) => {
                    const key = JSON.stringify(candidate);
                    return [key, old.get(key) ?? candidateCard(candidate, told)];
                }),
            );
            const order = [...cards.values()];
            if (order.length !== list.children.length || order.some((card, at) => list.children[at] !== card))
                list.replaceChildren(...order);
            const isFound = report.candidates.some((candidate) => candidate.isFound);
            const so =
                isRunning && !isFound
                    ? report.candidates.length > 0
                        ? say`The nearest so far:`
                        : say`Searching…`
                    : verdict(report, isString);
            setText(html('find-verdict'), so);
            html('find-verdict').classList.toggle('found', report.candidates.some(isSame));
            html('find-legend').hidden = isString || report.candidates.every(isSame);
            showSearched(isRunning ? say`Searched so far: ${report.searched}.` : say`Searched: ${report.searched}.`);
            setText(
                html('find-advice'),
                isRunning || report.candidates.some(isSame)
                    ? ''
                    : isFound
                      ? report.isMore
                          ? say`Small parts differ, such as twigs. Search longer, or tell more of what is known.`
                          : say`Small parts differ, such as twigs.`
                      : report.isMore
                        ? say`Other systems may do. Search longer, or tell more of what is known.`
                        : say`This was all that this search can try. Other systems may do.`,
            );
        },

        clear() {
            cards = new Map();
            list.replaceChildren();
            for (const id of ['find-verdict', 'find-advice']) setText(html(id), '');
            showSearched('');
        },
    };
}
