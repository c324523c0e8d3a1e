/**
 * "Is this exercise unambiguous?": searches for systems that draw the exercise's target, and marks them as answers of
 * students are marked.
 */

import { button, html, setText } from '../base/dom.js';
import { wholeOf } from '../exercise/open.js';
import { blackOnWhite, pictureOf } from '../find/examples.js';
import { inked, levelOf } from '../find/ink.js';
import { candidateCard, workWords } from '../find/results.js';
import { createSearch } from '../find/search.js';
import { ASKS, DRAWS } from '../late-tables.js';
import { Cancelled } from '../engine/tool.js';
import { classTool } from './tool.js';
import { counted, reasonOf, say } from '../base/words.js';

/** @typedef {import('../state/state.js').Definition} Definition */
/** @typedef {import('../protocol.js').Exercise} Exercise */
/** @typedef {import('../protocol.js').AboutExercise} AboutExercise */
/** @typedef {import('../protocol.js').Candidate} Candidate */
/** @typedef {import('../protocol.js').FindQuestion} FindQuestion */

/** The letters that draw in a system. @param {Pick<Definition, 'dialect' | 'overrides'>} definition */
export function drawsOf({ dialect, overrides }) {
    const draws = new Set(DRAWS[dialect]);
    for (const [, symbol = '', actions = ''] of overrides.matchAll(/^\s*(\S)\s*:(.*)$/gm)) {
        if (/\bdraw\b/.test(actions)) draws.add(symbol);
        else draws.delete(symbol);
    }
    return [...draws].join('');
}

/** What a student knows of the system, as a question. @param {Exercise} exercise @returns {FindQuestion} */
export function questionOf({ target, axiom, angle, n, turtle }) {
    return {
        axiom: axiom === 'free' ? null : target.axiom,
        angle: angle === 'free' ? null : target.angle,
        n: n === 'free' ? null : target.iterations,
        heading: turtle === 'free' ? null : target.heading,
        draws: turtle === 'free' ? null : drawsOf(target),
    };
}

/** The lines of rules, by predecessor, without spaces. @param {string} rules */
const linesOf = (rules) =>
    rules
        .split('\n')
        .map((line) => line.replace(/\s/g, ''))
        .filter(Boolean);
/** @param {string} line */
const predecessorOf = (line) => line.split(/->|→|=>/)[0] ?? '';

/** A candidate as the answer of a student: its rules beside the given ones. @param {Definition} candidate @param {Pick<AboutExercise, 'fixed' | 'free'>} about @returns {Definition} */
export function answerOf(candidate, about) {
    const given = new Set(linesOf(about.fixed.rules).map(predecessorOf));
    const own = candidate.rules.split('\n').filter((line) => !given.has(predecessorOf(line.replace(/\s/g, ''))));
    const whole = wholeOf(about, { ...candidate, rules: own.join('\n') });
    return { ...whole, rules: whole.rules.trimEnd() };
}

/** What makes two answers the same. @param {Definition} answer */
const keyOf = ({ axiom, rules, angle, iterations }) =>
    JSON.stringify([axiom.replace(/\s/g, ''), linesOf(rules).sort(), angle, iterations]);

/** @param {number} count of other answers */
const othersWords = (count) =>
    counted(count, '{} other system also solves this exercise.', '{} other systems also solve this exercise.');

/** @param {number} count of shorter answers among them */
const shorterWords = (count) =>
    count === 0
        ? say`None of them is shorter than yours.`
        : counted(count, '{} of them is shorter than yours.', '{} of them are shorter than yours.');

/**
 * @param {import('../engine/engine.js').Engine} engine
 * @param {import('./tool.js').CourseTool} tool
 * @param {() => Exercise} exercise
 */
export function createOthers(engine, tool, exercise) {
    const [ask, halt] = [button('maker-unique'), button('maker-unique-stop')];
    const cards = html('maker-unique-cards');
    const search = createSearch();
    /** @type {AbortController | null} */
    let running = null;

    function stop() {
        running?.abort();
        running = null;
        ask.hidden = false;
        halt.hidden = true;
    }

    function forget() {
        stop();
        tell('');
        cards.replaceChildren();
    }

    ask.addEventListener('click', async () => {
        forget();
        const own = (running = new AbortController());
        ask.hidden = true;
        halt.hidden = false;
        halt.focus();
        try {
            await look(engine, tool, cards, search, exercise(), own.signal);
        } catch (error) {
            if (!(error instanceof Cancelled)) tell(say`The search failed: ${reasonOf(error)}`);
        }
        if (running === own) stop();
    });
    halt.addEventListener('click', () => {
        forget();
        tell(say`Stopped.`);
        ask.focus();
    });

    return { forget };
}

const tell = (/** @type {string} */ words) => setText(html('maker-unique-words'), words);

/**
 * @param {import('../engine/engine.js').Engine} engine
 * @param {import('./tool.js').CourseTool} tool
 * @param {HTMLElement} cards
 * @param {ReturnType<typeof createSearch>} search
 * @param {Exercise} made
 * @param {AbortSignal} signal
 */
async function look(engine, tool, cards, search, made, signal) {
    const { target } = made;
    if (!ASKS[made.asks].isSearched) return tell(say`Only exercises that ask for the picture are searched.`);
    if (target.dialect === 'axes' || (target.rightAngle !== null && target.rightAngle !== target.angle))
        return tell(say`Systems in space and with two angles are not searched.`);
    const x = await classTool.call('write', { exercise: made });
    const about = await tool.call('open', { text: x });
    const picture = await pictureOf(engine, target);
    const crop = { left: 0, top: 0, right: picture.width, bottom: picture.height };
    const source = inked(picture, { crop, level: levelOf(picture, crop), isDark: true });
    const own = answerOf(target, about);
    const { symbols: ownSymbols } = (await tool.call('mark', { text: x, student: own }, { signal })).mark;
    tell(say`Searching…`);
    const report = await search.begin(source, questionOf(made), signal, (so) => tell(`${workWords(so, false)}…`), {
        thorough: true,
    });
    /** Other answers that are solved, by what they are. @type {Map<string, {candidate: Candidate, symbols: number}>} */
    const answers = new Map();
    for (const candidate of report.candidates) {
        const student = answerOf(candidate.definition, about);
        if (!candidate.isFound || keyOf(student) === keyOf(own) || answers.has(keyOf(student))) continue;
        const { mark } = await tool.call('mark', { text: x, student }, { signal });
        if (mark.isSolved)
            answers.set(keyOf(student), {
                candidate: { ...candidate, definition: student },
                symbols: mark.symbols,
            });
    }
    const all = [...answers.values()].sort((a, b) => a.symbols - b.symbols);
    const shorter = all.filter(({ symbols }) => symbols < ownSymbols).length;
    const searched = say`Searched: ${workWords(report, false)}: ${report.searched}.`;
    tell(
        all.length === 0
            ? say`No other answer was found. That does not prove that there is none. ${searched}`
            : `${othersWords(all.length)} ${shorterWords(shorter)} ${searched}`,
    );
    cards.replaceChildren(
        ...all.map(({ candidate, symbols }) =>
            candidateCard(
                { ...candidate, symbols },
                {
                    engine,
                    restyle: blackOnWhite,
                    told:
                        symbols < ownSymbols
                            ? counted(symbols, '{} symbol, shorter', '{} symbols, shorter')
                            : counted(symbols, '{} symbol', '{} symbols'),
                },
            ),
        ),
    );
}
