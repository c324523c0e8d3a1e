/**
 * A tool's worker: starts its wasm and answers the page's calls (js/engine/tool.js). A long call is either a generator: the
 * worker returns to its event loop after every step, and sends what the step yields to the page. Or it is straight: it
 * gets a function that sends progress to the page while the call runs.
 */

import { setWords } from './words.js';

/** @typedef {import('../js/protocol.js').ToTool} ToTool */
/** @typedef {import('../js/protocol.js').FromTool} FromTool */

/** The tool's page. @type {import('../js/protocol.js').Channel<FromTool, ToTool>} */
const page = self;

/** The answers to calls, by name; an answer may be a generator, whose result is the answer. @typedef {Record<string, (asked: any, tell: (value: any) => void) => any>} CallTable */

/** @param {CallTable} calls */
export function serve(calls) {
    /** Long calls that were not cancelled. @type {Set<number>} */
    const running = new Set();
    let dead = false;

    page.onmessage = ({ data }) => {
        if (dead) return;
        if (data.type === 'ping') page.postMessage({ type: 'pong' });
        else if (data.type === 'cancel') running.delete(data.id);
        else if (data.type === 'init')
            guard(0, () => {
                // Each part imports what the first one exports, and fills the places of its functions in the table.
                const imports = { '': /** @type {any} */ (wasm_bindgen.initSync({ module: data.wasm })) };
                for (const part of data.parts) new WebAssembly.Instance(part, imports);
                setWords(data.words);
                // From now on the page need not wait long to know that this worker is silent.
                page.postMessage({ type: 'pong' });
            });
        else
            guard(data.id, () =>
                answer(
                    data.id,
                    calls[data.call]?.(data.asked, (value) => tell(data.id, value)),
                ),
            );
    };

    /** @param {number} id @param {any} value */
    function answer(id, value) {
        if (typeof value?.next !== 'function') return page.postMessage({ type: 'answer', id, value });
        running.add(id);
        step(id, value);
    }

    /** @param {number} id @param {Generator} steps */
    function step(id, steps) {
        if (!running.has(id)) return void steps.return(undefined);
        const { done, value } = steps.next();
        if (done) {
            running.delete(id);
            return page.postMessage({ type: 'answer', id, value });
        }
        if (value !== undefined) tell(id, value);
        setTimeout(() => guard(id, () => step(id, steps)));
    }

    /** Sends progress; bytes are handed over without a copy. @param {number} id @param {any} value nothing for a sign of life */
    function tell(id, value) {
        page.postMessage({ type: 'progress', id, value }, value instanceof Uint8Array ? [value.buffer] : []);
    }

    /** After a trap the instance may be in an invalid state: the page starts a fresh worker. @param {number} id @param {() => void} action */
    function guard(id, action) {
        if (dead) return;
        try {
            action();
        } catch (error) {
            running.delete(id);
            dead = error instanceof WebAssembly.RuntimeError || error instanceof RangeError || id === 0;
            page.postMessage({
                type: dead ? 'fatal' : 'refused',
                id,
                reason: error instanceof Error ? error.message : error,
            });
        }
    }
}
