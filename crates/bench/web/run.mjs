// Measures in headless Chromium: node run.mjs GENERATED_SCRIPT WASM RESULTS writes expansion and drawing as JSON,
// node run.mjs GENERATED_SCRIPT WASM pictures prints the times of pictures.

import { readFile, readdir, writeFile } from 'node:fs/promises';
import { createRequire } from 'node:module';
import { chromium } from 'playwright-core';

const [script, wasm, results] = process.argv.slice(2);
const peer = createRequire(import.meta.url).resolve('lindenmayer/dist/lindenmayer.browser.js');

const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM,
    args: ['--no-sandbox', '--disable-gpu', '--disable-quic', '--disable-background-networking', '--disable-sync'],
});
try {
    const page = await browser.newPage();
    page.on('console', (message) => console.error(message.text()));
    // As one text rather than as script elements: the generated script looks for its element's address.
    const scripts = [script, peer, ...['measure.js', 'pictures.js'].map((name) => new URL(name, import.meta.url))];
    await page.evaluate((await Promise.all(scripts.map((path) => readFile(path, 'utf8')))).join('\n;\n'));
    const bytes = (await readFile(wasm)).toString('base64');
    if (results === 'pictures') {
        const folder = new URL('../../../data_in/', import.meta.url);
        const names = (await readdir(folder, { recursive: true })).filter((name) => name.endsWith('.json')).sort();
        const files = Object.fromEntries(
            await Promise.all(names.map(async (name) => [name, await readFile(new URL(name, folder), 'utf8')])),
        );
        await page.exposeFunction('printLine', (line) => console.log(line));
        await page.evaluate(([base64, files]) => globalThis.pictures(base64, files), [bytes, JSON.stringify(files)]);
    } else {
        const rows = await page.evaluate((base64) => globalThis.measure(base64), bytes);
        await writeFile(results, JSON.stringify(rows));
    }
} finally {
    await browser.close();
}
