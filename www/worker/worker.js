/**
 * The page's worker: keeps one Playground between edits and draws. The build joins this script with the generated glue,
 * which defines `wasm_bindgen`, in one classic script, because a classic worker can also start from a blob.
 *
 * The worker keeps only the newest `define` and `view`, works in steps of at most 8 ms, and returns to its event loop
 * between steps, so that newer input supersedes older. The current picture may finish for a while, so that a long drag
 * shows pictures on the way.
 */

import { createDrawing } from './drawing.js';
import { createReadFile } from './files.js';
import { page } from './page.js';
import { createMate, createSharing } from './sharing.js';
import { createThumbs } from './thumbs.js';
import { createWork } from './work.js';
import { setWords } from './words.js';

/** @typedef {import('../js/protocol.js').Asked} Asked */
/** @template {Asked} [T=Asked] @typedef {import('../js/protocol.js').Question<T>} Question */
/** @typedef {import('./page.js').Inbox} Inbox */

/** Receives the page's messages and works between them. */
(() => {
    const canvas = new OffscreenCanvas(1, 1);
    const channel = new MessageChannel();
    /** @type {Inbox} */
    const inbox = { define: null, view: null, questions: [] };
    /** @type {Question<'thumb'>[]} */
    const thumbs = [];
    /** Does the next task; null until the wasm has started. @type {(() => void) | null} */
    let work = null;
    /** Sets the mates. @type {(ports: MessagePort[]) => void} */
    let setMates = () => {};
    /** What the rest of the core imports: the exports of its first part. @type {WebAssembly.ModuleImports} */
    let core = {};
    /** Whether the rest has not come yet. */
    let isEarly = true;
    let awake = false;
    let dead = false;

    page.onmessage = ({ data }) => {
        // The answer shows that the worker returns to its event loop.
        if (data.type === 'ping') return page.postMessage({ type: 'pong' });
        if (data.type === 'init') return guard(() => start(data));
        // The rest fills the places of its functions in the table of the first part.
        if (data.type === 'rest') {
            return guard(() => {
                new WebAssembly.Instance(data.wasm, { '': core });
                isEarly = false;
            });
        }
        if (data.type === 'mates') return guard(() => setMates(data.ports));
        if (data.type === 'define') inbox.define = data;
        else if (data.type === 'view') inbox.view = data;
        else if (data.type === 'thumb') thumbs.push(data);
        else inbox.questions.push(data);
        wake();
    };
    channel.port1.onmessage = () => {
        awake = false;
        guard(() => work?.());
    };

    /** @param {import('../js/protocol.js').Init} init */
    function start({ wasm, words, master }) {
        const instance = wasm_bindgen.initSync({ module: wasm });
        core = /** @type {any} */ (instance);
        setWords(words);
        const memory = () => instance.memory.buffer.byteLength;
        const playground = new wasm_bindgen.Playground(canvas);
        if (master) {
            work = createMate({ master, playground, wake, memory });
        } else {
            const drawing = createDrawing({ playground, canvas, inbox });
            const sharing = createSharing({ canvas, playground, guard, wake, shown: drawing.shown, memory });
            const readFile = createReadFile({ guard, tellAt: drawing.tellAt });
            work = createWork({
                playground,
                inbox,
                drawing,
                sharing,
                readFile,
                thumbs: createThumbs({ playground, waiting: thumbs, tellAt: drawing.tellAt }),
                wake,
            });
            setMates = sharing.setMates;
        }
        page.postMessage({ type: 'ready' });
        wake();
    }

    /** Works after the messages that are already waiting. */
    function wake() {
        if (awake || dead || work === null) return;
        awake = true;
        channel.port2.postMessage(null);
    }

    /**
     * After a trap the instance may be in an invalid state: tells the page, which starts a fresh worker, and stops.
     * @param {() => void} action
     */
    function guard(action) {
        if (dead) return;
        try {
            action();
        } catch (error) {
            dead = true;
            const message = String(error instanceof Error ? error.message : error);
            page.postMessage({ type: 'fatal', message, isEarly });
        }
    }

    // The script runs, though the wasm has not started.
    page.postMessage({ type: 'hello' });
})();
