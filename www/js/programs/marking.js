/** The page without its elements, in a frame of the dialog that marks a class: it runs one answer after another. */

import { say } from '../base/words.js';
import { faultWords } from './faults.js';
import { givenIn } from './given.js';
import { callsOf, judged, whyWrong } from './judge.js';
import { createRunner } from './runner.js';
import { programIn } from './tasks.js';

/**
 * Marks a program: whether it is right, and the first thing that is wrong in words.
 * @param {import('./tasks.js').Task} task
 * @param {ReturnType<typeof createRunner>} runner
 * @param {{language: import('./runner.js').Language, code: string}} program
 */
export async function markProgram({ functions }, runner, { language, code }) {
    const names = functions.map(({ name }) => name);
    const ran = await runner.run(language, { code, given: givenIn(language), names, calls: callsOf(functions) });
    const all = judged(functions, ran);
    const right = all.filter(({ isRight }) => isRight).length;
    const wrong = all.find((one) => one.wrong);
    const missing = all.filter(({ isOwn }) => !isOwn).map(({ name }) => name);
    const fault = ran.fault ?? wrong?.wrong?.given.fault;
    const why = fault ? faultWords(fault) : wrong?.wrong ? whyWrong(wrong.name, wrong.wrong) : '';
    const words = [
        ran.fault ? why : wrong ? `${wrong.wrong?.call}: ${why}` : '',
        missing.length > 0 && !ran.fault ? say`Not written: ${missing.join(', ')}.` : '',
    ];
    return {
        isSolved: right === all.length,
        agreement: right / all.length,
        words: words.filter(Boolean).join(' ') || say`${right} of ${all.length} functions are right.`,
    };
}

/** @param {import('./tasks.js').Task} task */
export function markClass(task) {
    const runner = createRunner(() => {});
    const tell = (/** @type {object | null} */ program) => parent.postMessage({ program }, location.origin);
    addEventListener('message', async ({ source, origin, data }) => {
        if (source !== parent || origin !== location.origin || typeof data?.answer !== 'string') return;
        const program = await programIn(data.answer);
        const nothing = { isSolved: false, agreement: 0, words: say`There is no program in this answer.`, code: '' };
        if (!program || !task.languages.includes(program.language)) return tell(nothing);
        const mark = await markProgram(task, runner, program).catch((error) => ({ ...nothing, words: String(error) }));
        tell({ ...mark, code: program.code });
    });
    tell(null);
}
