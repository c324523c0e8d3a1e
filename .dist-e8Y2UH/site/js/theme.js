/** Light and dark: the system's choice until the reader makes one. */

import { button } from './dom.js';

const system = matchMedia('(prefers-color-scheme: dark)');

/** @returns {'light' | 'dark'} */
export function theme() {
    const chosen = document.documentElement.dataset.theme;
    return chosen === 'light' || chosen === 'dark' ? chosen : system.matches ? 'dark' : 'light';
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
            // Not kept, then; it holds until the page is closed.
        }
        show();
        changed(next);
    });
    system.addEventListener('change', () => {
        show();
        changed(theme());
    });
    show();
}
