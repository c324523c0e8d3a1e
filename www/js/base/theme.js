/** The light and dark theme: the system's choice until the reader chooses. */

import { button } from './dom.js';

/** The system's choice. */
const system = () => matchMedia('(prefers-color-scheme: dark)');

/** @returns {'light' | 'dark'} */
export function theme() {
    const chosen = document.documentElement.dataset.theme;
    return chosen === 'light' || chosen === 'dark' ? chosen : system().matches ? 'dark' : 'light';
}

/** @param {(theme: 'light' | 'dark') => void} changed */
export function themeButton(changed) {
    const toggle = button('theme');
    const show = () => toggle.setAttribute('aria-pressed', String(theme() === 'dark'));
    /** @param {'light' | 'dark'} next */
    function take(next) {
        document.documentElement.dataset.theme = next;
        show();
        changed(next);
    }
    // Another window has chosen.
    addEventListener('storage', ({ key, newValue }) => {
        if (key === 'theme' && newValue !== theme() && (newValue === 'light' || newValue === 'dark')) take(newValue);
    });
    toggle.addEventListener('click', () => {
        const next = theme() === 'dark' ? 'light' : 'dark';
        try {
            localStorage.setItem('theme', next);
        } catch {
            // Without storage, the choice holds until the page is closed.
        }
        take(next);
    });
    system().addEventListener('change', () => {
        show();
        changed(theme());
    });
    show();
}
