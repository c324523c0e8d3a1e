/** The parts of the page that its first picture does not need: what opens over it, saving, and what is kept. */

import { createGallery } from './gallery.js';
import { hasInk, houseInk } from './inks.js';
import { createMates, matesOn } from './mates.js';
import { bestLink } from './packed.js';
import { favouritesPanel } from './panels/favourites-panel.js';
import { keepPanel } from './panels/keep-panel.js';
import { createSeeds } from './seeds.js';
import { createShare } from './share.js';
import { createShortcuts } from './shortcuts.js';
import { theme } from './theme.js';

/**
 * @param {import('./store.js').Store} store
 * @param {import('./engine.js').Engine} engine
 * @param {{keeper: import('./storage.js').Keeper, session: ReturnType<typeof import('./session.js').createSession>, resolution: () => import('./engine.js').Canvas}} page
 */
export function createLater(store, engine, { keeper, session, resolution }) {
    const address = async () => new URL(await bestLink(store.state), location.href).href;
    const share = createShare(store, engine);
    const favourites = favouritesPanel(store, engine, { keeper, session });
    keepPanel(store, engine, { address, select: share.select, favourites: favourites.take, canvas: resolution });
    createGallery(engine, {
        pick: (definition) => store.open(definition),
        dress: (definition) => ({ ...definition, ...dressOf(definition) }),
        look: theme,
    });
    createSeeds(store, engine);
    createShortcuts();
    engine.share(createMates(matesOn(navigator)));
}

/**
 * The page's inks, for a system that says nothing of its look.
 * @param {import('./state.js').Definition} definition
 */
function dressOf(definition) {
    const { palette, background } = hasInk(definition, houseInk('light')) ? houseInk(theme()) : definition;
    return { palette: [...palette], background };
}
