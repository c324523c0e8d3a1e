/** Colour schemes: palettes with backgrounds. */

/** @typedef {import('./state.js').State} State */
/** @typedef {{name: string, palette: string[], background: string, holds?: boolean}} Scheme `holds` repeats the last colour for deeper levels and later generations */

import { DEFAULTS, same } from './state.js';
import { say } from '../base/words.js';

/** @type {readonly Scheme[]} */
export const SCHEMES = [
    { name: say`Fern`, palette: [...DEFAULTS.palette], background: DEFAULTS.background },
    {
        name: say`Night garden`,
        palette: ['#9fd3a4', '#d3dc8c', '#f0c36d', '#ee9b78', '#d88ab0'],
        background: '#101512',
    },
    { name: say`Sepia`, palette: ['#4b3524', '#7a573a', '#a67c52', '#6b4a2f', '#8d6e4f'], background: '#f4ead6' },
    { name: say`Cyanotype`, palette: ['#eef4f5', '#cfe2ea', '#a5c8dc', '#dfeaf0', '#8fb6d0'], background: '#163a5f' },
    { name: say`Autumn`, palette: ['#4a3328', '#8a3b21', '#c4622d', '#dd9a33', '#a8a13b'], background: '#fbf6ea' },
    { name: say`Blossom`, palette: ['#4a3b3f', '#7d4a5a', '#b9577a', '#dc86a2', '#eab6c4'], background: '#fdf6f4' },
    {
        name: say`Night sky`,
        palette: ['#2e3a6e', '#4a5aa8', '#7f8fdc', '#b9a8f0', '#f3d9f7', '#fff6d8'],
        background: '#0a0d1f',
        holds: true,
    },
    {
        name: say`Practical`,
        palette: ['#462100', '#3e4100', '#366000', '#2e8000', '#26a000', '#1ea000', '#16a000', '#0ea000', '#06a000'],
        background: '#ffffff',
        holds: true,
    },
    {
        name: say`Embers`,
        palette: ['#2a0a0a', '#6b1414', '#b3311c', '#ea6a2b', '#ffb347', '#ffe9a8'],
        background: '#120707',
        holds: true,
    },
    { name: say`Ink`, palette: ['#16181a'], background: '#ffffff' },
    { name: say`Chalk`, palette: ['#f1efe6'], background: '#25302b' },
];

/** The theme's colour scheme for systems without own colours. @param {'light' | 'dark'} theme @returns {Scheme} */
export function themeScheme(theme) {
    return /** @type {Scheme} */ (SCHEMES[theme === 'dark' ? 1 : 0]);
}

/** The fields that a scheme changes. @param {Scheme} scheme @returns {Pick<State, 'palette' | 'background' | 'paletteHolds'>} */
export function schemePatch({ palette, background, holds = false }) {
    return { palette: [...palette], background, paletteHolds: holds };
}

/** @param {Pick<State, 'palette' | 'background'>} state @param {Pick<State, 'palette' | 'background'>} scheme */
export function hasScheme(state, scheme) {
    return same(state.palette, scheme.palette) && same(state.background, scheme.background);
}

/**
 * Gives a definition with the default colours the theme's colours.
 * @param {import('./state.js').Definition} definition @param {'light' | 'dark'} theme
 */
export function withThemeScheme(definition, theme) {
    const { palette, background } = hasScheme(definition, themeScheme('light')) ? themeScheme(theme) : definition;
    return { ...definition, palette: [...palette], background };
}

/**
 * Whether a background is so dark that marks on it must be light.
 * @param {string} colour `#rrggbb`
 */
export function isDark(colour) {
    const [r, g, b] = [1, 3, 5].map((at) => (parseInt(colour.slice(at, at + 2), 16) / 255) ** 2.2);
    return (
        0.2126 * /** @type {number} */ (r) + 0.7152 * /** @type {number} */ (g) + 0.0722 * /** @type {number} */ (b) <
        0.3
    );
}
