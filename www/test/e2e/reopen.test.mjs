import assert from 'node:assert/strict';
import { after, test } from 'node:test';
import { IS_THOROUGH } from '../effort.mjs';
import { close, withModules, withPage } from './browser.mjs';

after(close);

/** One in so many systems is tried. */
const EVERY = IS_THOROUGH ? 1 : 4;

test('every system of the gallery reads back from its saved files', () =>
    withPage({ before: withModules }, async (page) => {
        const { checked, wrong } = await page.evaluate(async (every) => {
            const worker = new Worker('worker.js');
            const [wasm, rest] = await Promise.all(
                ['lsystem.wasm', 'lsystem-rest.wasm'].map((name) => WebAssembly.compileStreaming(fetch(name))),
            );
            const { createExports } = await import(new URL('js/save/exports.js', document.baseURI).href);
            const { make } = createExports();
            const { clean, definitionOf, same } = await import(new URL('js/state/state.js', document.baseURI).href);
            let id = 0;
            /** The answer to a request. @param {object} request @param {string} type @param {(message: any) => boolean} [last] @returns {Promise<any>} */
            const ask = (request, type, last = () => true) =>
                new Promise((resolve, reject) => {
                    worker.onmessage = ({ data }) => {
                        if (data.type === 'fatal') reject(new Error(data.message));
                        else if (data.type === type && last(data)) resolve(data);
                    };
                    worker.postMessage({ ...request, id: ++id });
                });
            await ask({ type: 'init', wasm }, 'ready');
            worker.postMessage({ type: 'rest', wasm: rest });
            worker.postMessage({
                type: 'view',
                id: ++id,
                width: 64,
                height: 64,
                ratio: 1,
                view: { x: 0, y: 0, zoom: 1 },
                upto: null,
            });
            const all = await (await fetch('gallery.json')).json();
            const entries = all.filter((/** @type {unknown} */ _, /** @type {number} */ at) => at % every === 0);
            /** @type {string[]} */
            const wrong = [];
            for (const entry of entries) {
                // Files are the same for any number of iterations, and small drawings are written quickly.
                const definition = definitionOf(
                    clean({ ...entry.definition, iterations: Math.min(3, entry.definition.iterations) }),
                );
                await ask(
                    { type: 'define', definition, upto: null },
                    'report',
                    ({ report }) => report.memoised !== null || !report.ok,
                );
                const files = [];
                for (const format of ['json', 'svg', 'svg-compact', 'png']) {
                    const { blob } = await make({
                        definition,
                        format,
                        options: format === 'png' ? { size: '64x64' } : {},
                        camera: null,
                    });
                    files.push({ format, bytes: blob === null ? new ArrayBuffer(0) : await blob.arrayBuffer() });
                }
                for (const { format, bytes } of files) {
                    const read = (await ask({ type: 'read', file: new Blob([bytes]) }, 'read')).definition;
                    const back = read && clean(read);
                    if (!back || !Object.keys(definition).every((field) => same(back[field], definition[field])))
                        wrong.push(`${entry.path} as ${format}`);
                }
            }
            worker.terminate();
            return { checked: entries.length, wrong };
        }, EVERY);
        assert.ok(checked * EVERY > 80, `${checked} systems`);
        assert.deepEqual(wrong, []);
    }));
