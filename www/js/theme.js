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
    toggle.addEventListener('click', () => {
        const next = theme() === 'dark' ? 'light' : 'dark';
        document.documentElement.dataset.theme = next;
        try {
            localStorage.setItem('theme', next);
        } catch {
            // Without storage, the choice holds until the page is closed.
        }
        show();
        changed(next);
    });
    system().addEventListener('change', () => {
        show();
        changed(theme());
    });
    show();
}
