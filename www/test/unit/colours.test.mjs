import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';

const css = (/** @type {string} */ name) => readFileSync(new URL(`../../css/${name}.css`, import.meta.url), 'utf8');

/** Relative luminance (WCAG 2.2). @param {string} hex */
function luminance(hex) {
    const digits = hex.length === 4 ? hex.replaceAll(/[0-9a-f]/g, '$&$&') : hex;
    const [r = 0, g = 0, b = 0] = [1, 3, 5].map((at) => {
        const value = Number.parseInt(digits.slice(at, at + 2), 16) / 255;
        return value <= 0.04045 ? value / 12.92 : ((value + 0.055) / 1.055) ** 2.4;
    });
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

/** @param {string} a @param {string} b */
function contrast(a, b) {
    const [light = 0, dark = 0] = [luminance(a), luminance(b)].sort((x, y) => y - x);
    return (light + 0.05) / (dark + 0.05);
}

/** The colours of a style sheet: those of the light theme, and those of the dark one. @param {string} sheet */
function themes(sheet) {
    const pairs = [...sheet.matchAll(/(--[\w-]+): light-dark\((#[0-9a-f]{3,6}), (#[0-9a-f]{3,6})\);/g)];
    return [2, 3].map(
        (at) => /** @type {Record<string, string>} */ (Object.fromEntries(pairs.map((pair) => [pair[1], pair[at]]))),
    );
}

// Accessibility checkers skip the layers with coloured text, because these are hidden from assistive technology.
test('coloured text has enough contrast in both themes, and more with high contrast', () => {
    const [light, dark] = themes(css('base'));
    const [moreLight, moreDark] = themes(css('contrast'));
    assert.ok(light && dark && moreLight && moreDark && '--paper' in light && '--paper' in moreLight);
    for (const [colours, least] of /** @type {const} */ ([
        [light, 4.5],
        [dark, 4.5],
        [{ ...light, ...moreLight }, 7],
        [{ ...dark, ...moreDark }, 7],
    ])) {
        const tints = Object.keys(colours).filter((name) => /^--tint-/.test(name) && !name.endsWith('-wash'));
        assert.ok(tints.length >= 8);
        for (const tint of [...tints, '--ink', '--ink-faint']) {
            for (const ground of ['--paper-raised', '--error-wash', '--doubt-wash']) {
                const ratio = contrast(String(colours[tint]), String(colours[ground]));
                // Marked places are underlined as well, and pass by.
                const wanted = ground === '--paper-raised' ? least : 4;
                assert.ok(
                    ratio >= wanted,
                    `${tint} ${colours[tint]} on ${ground} ${colours[ground]}: ${ratio.toFixed(2)}`,
                );
            }
        }
        assert.ok(contrast(String(colours['--tint-name']), String(colours['--tint-context-wash'])) >= 4.5);
    }
});
