/**
 * Brings the catalogues up to date: adds what they lack, as null, and removes what no one says any more. Run it as
 * `node test/words/update.mjs`; a folder in `lang/` is a language, and a new one begins with an empty `words.json`.
 */

import { readFileSync, readdirSync, writeFileSync } from 'node:fs';
import { collect } from './collect.mjs';

const root = new URL('../../lang/', import.meta.url);
const texts = [...collect().keys()].sort();
for (const language of readdirSync(root)) {
    const file = new URL(`${language}/words.json`, root);
    const old = JSON.parse(readFileSync(file, 'utf8'));
    const now = Object.fromEntries(texts.map((text) => [text, Object.hasOwn(old, text) ? old[text] : null]));
    writeFileSync(file, `${JSON.stringify(now, null, 2)}\n`);
    const missing = Object.values(now).filter((entry) => entry === null).length;
    const unused = Object.keys(old).filter((text) => !Object.hasOwn(now, text)).length;
    process.stdout.write(`${language}: ${texts.length} texts, ${missing} to translate, ${unused} removed\n`);
}
