/** The functions that an exercise asks for, from its text (docs/exercises.md), and the exercise in a link. */

import { fromBase64, toBase64 } from '../base/base64.js';
import { say } from '../base/words.js';
import { truth } from './given.js';
import { KNOWN, PLANTS, SETS } from './sets.js';

/** @typedef {import('./runner.js').Language} Language */
/** A call with what it must give. @typedef {{args: unknown[], expected: unknown}} Test */
/** @typedef {{name: string, params: string, says: string, tests: Test[]}} Wanted */
/** @typedef {{functions: Wanted[], languages: Language[], plants: string[], drawing: import('./sets.js').Drawing | null, problems: string[]}} Task */

/** The most functions, and tests of each. */
const [MOST, MOST_TESTS] = [40, 100];
/** The most steps of a table of tests: words grow fast. */
const MOST_STEPS = 6;
/** The functions as they must be. */
const TRUTH = truth();

/** A call as a text. @param {string} name @param {readonly unknown[]} args */
export const callOf = (name, args) =>
    `${name}(${args
        .map((arg) => JSON.stringify(arg))
        .join(', ')
        .replaceAll(',"', ', "')
        .replaceAll('":', '": ')})`;

/** The values of a call's text; null if they are none. @param {string} text @returns {unknown[] | null} */
function valuesOf(text) {
    try {
        return JSON.parse(`[${text}]`);
    } catch {
        return null;
    }
}

/** @param {string} name @returns {Wanted} */
const known = (name) => ({
    name,
    params: KNOWN[name]?.params ?? '',
    says: KNOWN[name]?.says ?? '',
    tests: (KNOWN[name]?.calls ?? []).map((args) => ({ args, expected: TRUTH[name]?.(...args) })),
});

/** Reads the text of an exercise. @param {string} text @returns {Task} */
export function readTask(text) {
    /** @type {Map<string, Wanted>} */
    const functions = new Map();
    /** @type {Task} */
    const task = { functions: [], languages: ['python', 'javascript'], plants: [], drawing: null, problems: [] };
    const wanted = (/** @type {string} */ name) => {
        if (!functions.has(name) && KNOWN[name] && functions.size < MOST) functions.set(name, known(name));
        return functions.get(name);
    };
    for (const [at, whole] of text.split('\n').entries()) {
        const line = whole.trim();
        const [, key, value = ''] = /^(set|languages):\s*(.*)$/.exec(line) ?? [];
        const [, name, params = '', says = ''] = /^([A-Za-z_]\w*)\(([\w, ]*)\):\s*(.*)$/.exec(line) ?? [];
        const [, called, values = '', gives] = /^([A-Za-z_]\w*)\((.*?)\)\s*(?:=\s*(.+))?$/.exec(line) ?? [];
        const [, of, plants = '', from, to] = /^(\w+) of ([\w, ]+) for n = (\d+)\.\.(\d+)$/.exec(line) ?? [];
        if (line === '' || line.startsWith('#')) continue;
        if (key === 'set' && SETS[value]) {
            const { functions: names, plants, drawing } = SETS[value];
            names.forEach(wanted);
            [task.plants, task.drawing] = [[...new Set([...task.plants, ...plants])], drawing];
        } else if (key === 'languages') {
            const own = task.languages.filter((language) => value.toLowerCase().includes(language));
            if (own.length > 0) task.languages = own;
        } else if (name) {
            if (functions.size < MOST) functions.set(name, { name, params, says, tests: [] });
        } else if (of && wanted(of)) {
            const tests = wanted(of)?.tests ?? [];
            for (const plant of plants.split(',').map((one) => PLANTS[one.trim()]))
                for (
                    let n = Number(from);
                    plant && n <= Math.min(Number(to), MOST_STEPS) && tests.length < MOST_TESTS;
                    n++
                ) {
                    const args = [plant.axiom, plant.rules, n];
                    tests.push({ args, expected: TRUTH[of]?.(...args) });
                }
        } else if (called && wanted(called)) {
            const [args, expected] = [valuesOf(values), gives === undefined ? null : valuesOf(gives)];
            const isTrue = gives === undefined && TRUTH[called];
            if (!args || (!isTrue && !expected)) task.problems.push(say`Line ${at + 1} is no call with its result.`);
            else if ((wanted(called)?.tests.length ?? 0) < MOST_TESTS)
                wanted(called)?.tests.push({ args, expected: expected ? expected[0] : TRUTH[called]?.(...args) });
        } else if (!wanted(line)) task.problems.push(say`Line ${at + 1} is not understood.`);
    }
    task.functions = [...functions.values()];
    if (task.functions.some(({ tests }) => tests.length === 0))
        task.problems.push(say`Each function needs an example of what it gives.`);
    return task;
}

/** @typedef {{title: string, task: string, hints: string[], asks: string, program: string}} Exercise */

const VEIL = new TextEncoder().encode('Lindenmayer 1968');
/** The most bytes of an exercise, and of an answer. */
const MOST_BYTES = 256 << 10;

/** @param {Uint8Array<ArrayBuffer>} bytes */
async function inflated(bytes) {
    const reader = new Blob([bytes]).stream().pipeThrough(new DecompressionStream('deflate')).getReader();
    /** @type {Uint8Array<ArrayBuffer>[]} */
    const pieces = [];
    for (let size = 0; ; ) {
        const { done, value } = await reader.read();
        if (done) return new Uint8Array(await new Blob(pieces).arrayBuffer());
        size += value.length;
        if (size > MOST_BYTES) throw new Error(say`it is too large`);
        pieces.push(value);
    }
}

/** The exercise in the value of `x` of a link. @param {string} x @returns {Promise<Exercise>} */
export async function readExercise(x) {
    const bytes = await inflated(fromBase64(x));
    bytes.forEach((byte, at) => (bytes[at] = byte ^ (VEIL[at % VEIL.length] ?? 0)));
    const value = JSON.parse(new TextDecoder().decode(bytes));
    const text = (/** @type {string} */ key) => (typeof value?.[key] === 'string' ? value[key] : '');
    const hints = Array.isArray(value?.hints)
        ? value.hints.filter((/** @type {unknown} */ hint) => typeof hint === 'string')
        : [];
    return { title: text('title'), task: text('task'), hints, asks: text('asks'), program: text('program') };
}

/** A program packed for a link. @param {Language} language @param {string} code */
export async function packed(language, code) {
    const stream = new Blob([`${language}\n${code}`]).stream().pipeThrough(new CompressionStream('deflate'));
    return toBase64(new Uint8Array(await new Response(stream).arrayBuffer()));
}

/** The program in a link; null if there is none. @param {string} hash @returns {Promise<{language: Language, code: string} | null>} */
export async function programIn(hash) {
    const found = /(?:^|[#&])code=([\w-]+)/.exec(hash)?.[1];
    if (!found) return null;
    const text = await inflated(fromBase64(found)).then(
        (bytes) => new TextDecoder().decode(bytes),
        () => '',
    );
    const [, language, code] = /^(python|javascript)\n([^]*)$/.exec(text) ?? [];
    return language && code !== undefined ? { language: /** @type {Language} */ (language), code } : null;
}
