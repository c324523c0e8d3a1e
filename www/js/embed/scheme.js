/** The colour scheme of an embedded drawing: the theme that is asked for, or else the host page's. */

/** @typedef {'light' | 'dark'} Theme */

/**
 * The scheme of an element with this CSS `color-scheme`. A host page that declares none is light, also for readers whose
 * system is dark.
 * @param {string} declared
 * @param {boolean} systemDark
 * @returns {Theme}
 */
export function schemeOf(declared, systemDark) {
    const words = declared.toLowerCase().split(/\s+/);
    return words.includes('dark') && (systemDark || !words.includes('light')) ? 'dark' : 'light';
}

/** The `color-scheme` of an element; without one in CSS, the one of the page's meta element. @param {Element} element */
export function declaredScheme(element) {
    const declared = getComputedStyle(element).colorScheme;
    if (declared !== '' && declared !== 'normal') return declared;
    return element.ownerDocument.querySelector('meta[name="color-scheme" i]')?.getAttribute('content') ?? '';
}

/** Whether the reader's system is dark. */
export const systemIsDark = () => matchMedia('(prefers-color-scheme: dark)');

/**
 * The theme of this page without a choice. A page on its own has the system's theme. A frame can see the scheme of a
 * host from the same origin only; other hosts name a theme, as the element does.
 * @returns {Theme}
 */
export function surroundingTheme() {
    if (parent === window) return schemeOf('light dark', systemIsDark().matches);
    return frameElement ? schemeOf(declaredScheme(frameElement), systemIsDark().matches) : 'light';
}
