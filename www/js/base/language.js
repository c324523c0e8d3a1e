/** The choice of the page's language. */

import { byId, make } from './dom.js';
import { isWhole } from './files.js';
import { LANGUAGES } from '../languages.js';
import { language } from './words.js';

/** Fills the list of languages. A choice opens the page again, with the same system in its address. */
export function languageChoice() {
    const choice = byId('language', HTMLSelectElement);
    // A page in a single file has no other languages beside it.
    if (isWhole()) return choice.remove();
    const options = Object.entries(LANGUAGES).map(([value, name]) => make('option', { value, lang: value }, name));
    choice.replaceChildren(...options);
    choice.value = language;
    choice.addEventListener('change', () => {
        const address = new URL(location.href);
        address.searchParams.delete('lang');
        try {
            localStorage.setItem('language', choice.value);
        } catch {
            // Without storage, the address names the language.
            address.searchParams.set('lang', choice.value);
        }
        history.replaceState(history.state, '', address);
        location.reload();
    });
}
