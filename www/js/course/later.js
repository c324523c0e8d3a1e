/**
 * Loads what the playground has for courses when it is first needed: at the first click on one of its buttons, or when
 * the part on growth is opened.
 */

import { toast } from '../announce.js';
import { button, html } from '../dom.js';

/** The tool for courses, once it is there. @typedef {() => Promise<import('./maker.js').CourseTool>} LaterTool */

/** The buttons of its dialogs. */
const BUTTONS = ['open-steps', 'make-exercise', 'check-program'];

/**
 * @param {import('../store.js').Store} store
 * @param {import('../engine.js').Engine} engine
 * @param {(index: bigint) => void} readAt opens the string at a symbol
 * @returns {LaterTool}
 */
export function createLater(store, engine, readAt) {
    /** @type {Promise<import('./maker.js').CourseTool> | null} */
    let loading = null;

    function load() {
        // A load that failed is tried again.
        loading ??= import('./dialogs.js').then(({ createCourse }) => createCourse(store, engine, readAt));
        loading.catch((error) => {
            loading = null;
            toast(`This part of the page could not be loaded (${error instanceof Error ? error.message : error}).`);
        });
        return loading;
    }

    for (const id of BUTTONS) {
        button(id).addEventListener('click', async () => {
            if (loading) return;
            await load().then(
                () => button(id).click(),
                () => {},
            );
        });
    }
    html('mathematics').addEventListener('toggle', () => void load().catch(() => {}));
    return load;
}
