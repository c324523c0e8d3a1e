/** The tabs of the controls. On a phone, the selected tab also folds the controls, as the handle above them does. */

import { button } from '../base/dom.js';

/** The section that is open at first. */
const FIRST = 'rules';

export function tabs() {
    const narrow = matchMedia('(max-width: 47.99rem)');
    const all = /** @type {HTMLButtonElement[]} */ ([...document.querySelectorAll('[data-tab]')]);
    const sections = /** @type {HTMLElement[]} */ ([...document.querySelectorAll('[data-section]')]);
    let open = FIRST;

    function show() {
        for (const section of sections) {
            section.hidden = section.dataset.section !== open;
            section.setAttribute('role', 'tabpanel');
        }
        for (const tab of all) {
            const chosen = tab.dataset.tab === open;
            tab.setAttribute('aria-selected', String(chosen));
            tab.tabIndex = chosen ? 0 : -1;
        }
    }

    const isFolded = () => document.body.classList.contains('folded');

    /** @param {boolean} folded */
    function fold(folded) {
        document.body.classList.toggle('folded', folded);
        button('fold').setAttribute('aria-expanded', String(!folded));
    }

    /** @param {string} name */
    function choose(name) {
        if (narrow.matches) fold(open === name && !isFolded());
        open = name;
        show();
    }

    button('fold').addEventListener('click', () => fold(!isFolded()));
    for (const tab of all) {
        tab.addEventListener('click', () => choose(String(tab.dataset.tab)));
        tab.addEventListener('keydown', (event) => {
            const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
            if (!step) return;
            event.preventDefault();
            const next = all.at((all.indexOf(tab) + step) % all.length);
            fold(false);
            if (next && next !== tab) {
                next.click();
                next.focus();
            }
        });
    }
    narrow.addEventListener('change', () => {
        fold(false);
        show();
    });
    show();

    return {
        /** Opens a tab, and unfolds the controls. @param {string} name */
        open(name) {
            fold(false);
            open = name;
            show();
        },
    };
}
