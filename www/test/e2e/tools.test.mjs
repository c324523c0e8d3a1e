/** Every tool works with the parts of the wasm that it loads, when it is the first one that is called and afterwards. */

import assert from 'node:assert/strict';
import { test } from 'node:test';
import vm from 'node:vm';
import { FORMATS, NOTATIONS } from '../../js/late-tables.js';
import PARTS from '../../js/tool-parts.json' with { type: 'json' };
import { ADDRESS } from './browser.mjs';

/** @param {string} name */
const bytesOf = async (name) => Buffer.from(await (await fetch(ADDRESS + name)).arrayBuffer());
const json = async (/** @type {string} */ name) => JSON.parse(String(await bytesOf(name)));

const SCRIPT = String(await bytesOf('tools.js'));
/** @type {Record<string, WebAssembly.Module>} */
const WASMS = {};
for (const part of Object.keys(PARTS)) WASMS[part] = new WebAssembly.Module(await bytesOf(`tools-${part}.wasm`));

/** Starts a tool's worker in a scope of its own. @param {string} tool @returns the answer to a call, after all its work, or what refuses it */
function hire(tool) {
    /** @type {(() => void)[]} */
    const tasks = [];
    /** @type {any[]} */
    let answers = [];
    let id = 0;
    /** @type {Record<string, any>} */
    const scope = {
        WebAssembly,
        TextDecoder,
        TextEncoder,
        Uint8Array,
        performance,
        setTimeout: (/** @type {() => void} */ task) => tasks.push(task),
        postMessage: (/** @type {any} */ answer) => answers.push(answer),
    };
    scope.self = scope;
    vm.runInNewContext(SCRIPT, scope);
    const tell = (/** @type {object} */ message) => {
        answers = [];
        scope.onmessage({ data: message });
        for (let task = tasks.shift(); task; task = tasks.shift()) task();
        const stopped = answers.find(({ type }) => type === 'fatal');
        assert.equal(stopped, undefined, `${tool}: ${JSON.stringify(message)}`);
        return answers.at(-1);
    };
    const parts = Object.entries(PARTS).filter(([part, tools]) => part !== 'first' && tools.includes(tool));
    tell({
        type: 'init',
        wasm: WASMS.first,
        parts: parts.map(([part]) => WASMS[part]),
        words: { language: 'en', words: {} },
    });
    return (/** @type {string} */ call, /** @type {object} */ asked) => {
        const answer = tell({ type: 'call', id: ++id, call, asked });
        if (answer.type === 'answer') assert.notEqual(answer.value, undefined, `${call} of ${tool}`);
        return answer;
    };
}

/** @type {import('../../js/protocol.js').Definition[]} */
const gallery = (await json('gallery.json')).map((/** @type {any} */ { definition }) => ({
    ...definition,
    iterations: 2,
}));
/** @type {{x: string}[]} */
const exercises = await json('exercises.json');
const [first, second] = /** @type {[any, any]} */ (gallery);
const x = exercises.at(-1)?.x;
const exercise = { title: 'A', task: 'B', hints: ['C'], target: first };
const film = { definition: first, view: null, camera: null, text: 'iterations: 1 -> 3' };
const drawing = '<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 9 9"><path d="M1 1L8 8" stroke="#000"/></svg>';
const svg = { bytes: new TextEncoder().encode(drawing) };
const picture = { grey: new Uint8Array(4096).map((_, at) => (at % 65 < 3 ? 0 : 255)), width: 64, height: 64 };
const question = { turns: 4, iterations: [1, 2] };
const file = { options: {}, view: null, camera: null, ratio: 1, upto: null };
const formats = Object.keys(FORMATS).filter(
    (format) => FORMATS[/** @type {import('../../js/protocol.js').Format} */ (format)].content,
);
const ofPixels = (/** @type {string} */ format) =>
    FORMATS[/** @type {import('../../js/protocol.js').Format} */ (format)].content === 'pixels';

/** What each tool is asked. @type {Record<string, [string, object][]>} */
const CALLS = {
    class: [
        ['variantsOf', { exercise, varied: ['mirrored', 'angle'] }],
        ['write', { exercise }],
        ['markClass', { exercise: x, text: '' }],
    ],
    course: [
        ['open', { text: x }],
        ['picture', { text: x, width: 64, height: 64, ratio: 1 }],
        ['mark', { text: x, student: second }],
        ['hint', { text: x, student: second }],
        ['answer', { text: x }],
        ['variantOf', { text: x, student: 'Ada' }],
    ],
    export: gallery.flatMap((definition) =>
        formats.map((format) => /** @type {[string, object]} */ (['file', { ...file, definition, format }])),
    ),
    film: [
        ['read', { text: film.text }],
        ['subjects', { definition: first }],
        ...gallery.map(
            (definition) =>
                /** @type {[string, object]} */ ([
                    'frame',
                    { film: { ...film, definition }, number: 1, width: 32, height: 32 },
                ]),
        ),
        ['gif', { film, script: { frames: 2, width: 32, height: 32 } }],
    ],
    find: [
        ['svg', svg],
        ['outline', svg],
        ['photograph', picture],
        ['begin', { source: { text: 'F+F--F+F' }, question, part: 0, parts: 1, named: [] }],
        ['search', { until: 200_000 }],
        ['begin', { source: picture, question, part: 0, parts: 1, named: [{ name: 'A', definition: first }] }],
        ['search', { until: 4096 }],
        ['compare', { definition: first }],
    ],
    import: [['import', { text: 'Axiom: F\nF -> F+F--F+F\nAngle: 60' }]],
    invent: [
        ['surprise', { seed: 1 }],
        ['breed', { parents: [first, second], seed: 2, count: 2 }],
        ['descent', { definitions: [first, second], side: 32 }],
    ],
    package: [
        [
            'package',
            { exercises: [x], title: 'A', standard: '1.2', steps: '', exercise: '', language: 'en', catalogue: '{}' },
        ],
    ],
    picture: gallery.map((definition) => [
        'pixels',
        { ...file, definition, format: 'png', options: { size: '64x64' } },
    ]),
    sound: [
        ['listen', { definition: first }],
        ['part', { from: 0, stride: 1, count: 9, options: {} }],
        ['tune', { options: {} }],
    ],
    study: [
        ...gallery.flatMap((definition) => [
            /** @type {[string, object]} */ (['check', { definition, output: 'F' }]),
            /** @type {[string, object]} */ (['growth', { definition }]),
            /** @type {[string, object]} */ (['rows', { definition, n: 2, start: '0', count: 9 }]),
            /** @type {[string, object]} */ (['single', { definition, steps: 3, rightmost: true }]),
            /** @type {[string, object]} */ (['trace', { definition, n: 2, count: 9 }]),
        ]),
    ],
    write: gallery.flatMap((definition) =>
        Object.keys(NOTATIONS).map(
            (notation) => /** @type {[string, object]} */ (['writeAs', { definition, notation }]),
        ),
    ),
};

for (const [tool, calls] of Object.entries(CALLS)) {
    test(`the tool ${tool} has what it calls`, () => {
        const own = calls.filter(
            ([, asked]) => tool !== 'export' || !('format' in asked && ofPixels(String(asked.format))),
        );
        // Each call first, and all after each other.
        const kinds = [...new Map(own.map((call) => [call[0], call])).values()];
        for (const [call, asked] of kinds) hire(tool)(call, asked);
        const ask = hire(tool);
        const answers = own.map(([call, asked]) => ask(call, asked));
        assert.ok(answers.some(({ type }) => type === 'answer') || tool === 'package', JSON.stringify(answers[0]));
    });
}

test('each tool has a test', async () => {
    assert.deepEqual(
        [...new Set(Object.values(PARTS).flat())].filter((tool) => !CALLS[tool]),
        [],
    );
});
