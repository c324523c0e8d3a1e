/** The rules of axe-core, in a page. */

import { readFile } from 'node:fs/promises';
import { createRequire } from 'node:module';

/** @typedef {import('playwright-core').Page} Page */

const source = await readFile(createRequire(import.meta.url).resolve('axe-core/axe.min.js'), 'utf8');

/** The rules about colours. All others depend on elements and layout. */
export const COLOURS = ['color-contrast', 'link-in-text-block'];

/**
 * The violations in a page, without its frames; while a dialog is open, in the dialog, because the page behind the dialog
 * cannot be used, and is looked at without a dialog.
 * @param {Page} page
 * @param {string[]} [rules] only these rules
 * @returns {Promise<{id: string, impact: string, words: string}[]>}
 */
export async function violations(page, rules) {
    // Loading the rules takes as long as using them.
    if (!(await page.evaluate(() => 'axe' in globalThis))) await page.evaluate(source);
    return page.evaluate(async (only) => {
        const { violations } = await /** @type {any} */ (globalThis).axe.run(
            [...document.querySelectorAll('dialog:modal')].at(-1) ?? document,
            {
                resultTypes: ['violations'],
                iframes: false,
                preload: false,
                // Of WCAG 2.2, and off unless asked for.
                ...(only ? { runOnly: only } : { rules: { 'target-size': { enabled: true } } }),
            },
        );
        return violations.flatMap((/** @type {any} */ { id, impact, nodes }) =>
            nodes.map((/** @type {any} */ node) => ({
                id,
                impact,
                words: `${id}: ${node.target.join(' ')} ${node.any[0]?.message ?? ''}`,
            })),
        );
    }, rules);
}
