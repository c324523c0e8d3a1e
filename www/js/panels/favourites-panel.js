/** The form in the Save section that adds the current state to favourites. */

import { toast } from '../base/announce.js';
import { button, byId, input } from '../base/dom.js';
import { MOST_FAVOURITES, favourite } from '../favourites/favourites.js';
import { FULL } from '../favourites/stored.js';
import { say } from '../base/words.js';

/** @param {import('../state/store.js').Store} store @param {ReturnType<typeof import('../favourites/stored.js').createStored>} stored */
export function favouritesPanel(store, stored) {
    const name = input('favourite-name');
    const form = byId('favourites-form', HTMLFormElement);
    button('quick-favourite').addEventListener('click', () => form.requestSubmit());

    form.addEventListener('submit', (event) => {
        event.preventDefault();
        const added = favourite(name.value, store.state);
        const former = stored.list();
        if (former.some((one) => one.name === added.name && one.link === added.link))
            return toast(say`“${added.name}” is already in favourites.`);
        if (former.length >= MOST_FAVOURITES)
            return toast(say`At most ${MOST_FAVOURITES} favourites: delete some first.`);
        if (!stored.put([added])) return toast(FULL);
        name.value = '';
        toast(say`Added “${added.name}” to favourites.`);
    });

    /** Shows the default name of a new favourite. */
    function showName() {
        name.placeholder = store.state.title || store.state.name || say`Untitled system`;
    }
    store.subscribe(showName);
    showName();
}
