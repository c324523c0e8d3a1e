/** Opens a new system, made by chance: the first ones are ready on the site, later ones are made here. */

import { toast } from '../base/announce.js';
import { html } from '../base/dom.js';
import { jsonOf } from '../base/files.js';
import { createTool } from '../engine/tool.js';
import { reasonOf, say } from '../base/words.js';

/** @param {import('./dialogs.js').Page} page */
export function createSurprise({ store, engine }) {
    /** @type {ReturnType<typeof createTool<import('../protocol.js').InventCalls>>} */
    const tool = createTool('invent');
    /** Systems that were not opened yet. @type {Promise<import('../protocol.js').InventCalls['surprise']['answer'][]> | undefined} */
    let ready;
    /** The number of the last call; a system that comes late is dropped. */
    let last = 0;

    return {
        async open() {
            const own = ++last;
            html('surprise').ariaBusy = 'true';
            try {
                ready ??= jsonOf('surprises.json').catch(() => []);
                const systems = await ready;
                const [kept] = systems.splice(Math.random() * systems.length, 1);
                const made = kept ?? (await tool.call('surprise', { seed: await engine.seed() }));
                if (own === last) store.open(made);
            } catch (error) {
                toast(say`No new system: ${reasonOf(error)}`);
            }
            if (own === last) html('surprise').ariaBusy = null;
        },
    };
}
