/** The systems of the gallery, which a search of a picture tries before all others. */

import { jsonOf } from '../base/files.js';
import { clean, definitionOf } from '../state/state.js';

/** The systems with their titles; none if the gallery does not load. @returns {Promise<import('../protocol.js').NamedSystem[]>} */
export async function namedSystems() {
    try {
        /** @type {import('../dialogs/shelves.js').Entry[]} */
        const entries = await jsonOf('gallery.json');
        // Pictures of systems in space depend on the camera.
        return entries.filter(({ solid }) => !solid).map(({ path, definition }) => namedSystem(path, definition));
    } catch {
        return [];
    }
}

/** @param {string} path @param {import('../state/state.js').Definition} system */
function namedSystem(path, system) {
    const definition = definitionOf(clean(system));
    return { name: definition.title || definition.name || path.replace(/\.json$/, ''), definition };
}
