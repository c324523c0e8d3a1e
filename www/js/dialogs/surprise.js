/** Opens a new system, made by chance. */

import { toast } from '../base/announce.js';
import { createTool } from '../engine/tool.js';
import { reasonOf, say } from '../base/words.js';

/** @param {import('./dialogs.js').Page} page */
export function createSurprise({ store, engine }) {
    /** @type {ReturnType<typeof createTool<import('../protocol.js').InventCalls>>} */
    const tool = createTool('invent');
    /** The number of the last call; a system that comes late is dropped. */
    let last = 0;

    return {
        async open() {
            const own = ++last;
            try {
                const seed = await engine.seed();
                const made = await tool.call('surprise', { seed });
                if (own === last) store.open(made);
            } catch (error) {
                toast(say`No new system: ${reasonOf(error)}`);
            }
        },
    };
}
