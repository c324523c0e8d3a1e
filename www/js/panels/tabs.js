/**
 * The sections of the controls. Beside the drawing, rules and growth are always open, and the tabs switch between the
 * other sections. On a phone the tabs switch between all sections.
 */

/** Sections that are always open beside the drawing. */
const ALWAYS = ['rules', 'grow'];
const FIRST_BESIDE = 'turtle';

export function tabs() {
    const narrow = matchMedia('(max-width: 47.99rem)');
    const all = /** @type {HTMLButtonElement[]} */ ([...document.querySelectorAll('[data-tab]')]);
    const sections = /** @type {HTMLElement[]} */ ([...document.querySelectorAll('[data-section]')]);
    let onPhone = 'grow';
    let beside = FIRST_BESIDE;

    function show() {
        const chosen = narrow.matches ? onPhone : beside;
        for (const section of sections) {
            const name = String(section.dataset.section);
            const tabbed = narrow.matches || !ALWAYS.includes(name);
            section.hidden = tabbed && name !== chosen;
            if (tabbed) section.setAttribute('role', 'tabpanel');
            else section.removeAttribute('role');
        }
        for (const tab of all) {
            const name = String(tab.dataset.tab);
            tab.hidden = !narrow.matches && ALWAYS.includes(name);
            tab.setAttribute('aria-selected', String(name === chosen));
            tab.tabIndex = name === chosen ? 0 : -1;
        }
    }

    /** @param {string} name */
    function choose(name) {
        if (narrow.matches) {
            document.body.classList.toggle('folded', onPhone === name && !document.body.classList.contains('folded'));
            onPhone = name;
        } else {
            beside = name;
        }
        show();
    }

    for (const tab of all) {
        tab.addEventListener('click', () => choose(String(tab.dataset.tab)));
        tab.addEventListener('keydown', (event) => {
            const shown = all.filter((each) => !each.hidden);
            const step = { ArrowRight: 1, ArrowLeft: -1 }[event.key];
            if (!step) return;
            event.preventDefault();
            const next = shown.at((shown.indexOf(tab) + step) % shown.length);
            document.body.classList.remove('folded');
            if (next && next !== tab) {
                next.click();
                next.focus();
            }
        });
    }
    narrow.addEventListener('change', () => {
        document.body.classList.remove('folded');
        show();
    });
    show();
}
