/**
 * The page's worker: keeps one Playground between edits and draws. The build puts the generated glue, which defines
 * `wasm_bindgen`, in front of it in one classic script, because a classic worker also starts from a blob.
 *
 * It keeps only the newest `define` and `view` it has seen, works in steps of at most 8 ms, and returns to its event
 * loop between steps, so that newer input supersedes older. What it is at may finish first while it is quick, so that
 * there are pictures on the way of a long drag.
 */

import { createDrawing, lookAt } from './drawing.js';
import { createFiles } from './files.js';
import { STEP_MS, page } from './page.js';
import { createMate, createSharing } from './sharing.js';
import { createThumbs } from './thumbs.js';
import { createWork } from './work.js';

/** @typedef {import('../js/protocol.js').Asked} Asked */
/** @template {Asked} [T=Asked] @typedef {import('../js/protocol.js').Question<T>} Question */
/** @typedef {import('./page.js').Inbox} Inbox */

/** Receives the page's messages, and works between them. */
(() => {
    const canvas = new OffscreenCanvas(1, 1);
    const channel = new MessageChannel();
    /** @type {Inbox} */
    const inbox = { define: null, view: null, questions: [] };
    /** @type {Question<'thumb'>[]} */
    const thumbs = [];
    /** Does the next of what there is to do; null until the wasm is there. @type {(() => void) | null} */
    let work = null;
    /** Has these mates from now on. @type {(ports: MessagePort[]) => void} */
    let meet = () => {};
    let awake = false;
    let dead = false;

    page.onmessage = ({ data }) => {
        // That this is answered shows that the worker comes back to its event loop.
        if (data.type === 'ping') return page.postMessage({ type: 'pong' });
        if (data.type === 'init') return guard(() => start(data));
        if (data.type === 'mates') return guard(() => meet(data.ports));
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
    function start({ wasm, master }) {
        const instance = wasm_bindgen.initSync({ module: wasm });
        const memory = () => instance.memory.buffer.byteLength;
        const playground = new wasm_bindgen.Playground(canvas);
        if (master) {
            work = createMate({ master, playground, wake, lookAt: (sight) => lookAt(playground, sight), memory, stepMs: STEP_MS });
        } else {
            const drawing = createDrawing({ playground, canvas, inbox });
            const sharing = createSharing({ canvas, playground, guard, wake, shown: drawing.shown, memory });
            const files = createFiles({ playground, guard, wake, tellAt: drawing.tellAt });
            work = createWork({ playground, inbox, drawing, sharing, files, thumbs: createThumbs({ playground, waiting: thumbs, tellAt: drawing.tellAt }), wake });
            meet = sharing.meet;
        }
        page.postMessage({ type: 'ready' });
        wake();
    }

    /** Goes to work after the messages that are already waiting. */
    function wake() {
        if (awake || dead || work === null) return;
        awake = true;
        channel.port2.postMessage(null);
    }

    /**
     * After a trap the instance is in a doubtful state: say so and do nothing more. The page starts a fresh worker.
     * @param {() => void} action
     */
    function guard(action) {
        if (dead) return;
        try {
            action();
        } catch (error) {
            dead = true;
            page.postMessage({ type: 'fatal', message: String(error instanceof Error ? error.message : error) });
        }
    }

    // Before the wasm is there: the script is.
    page.postMessage({ type: 'hello' });
})();
