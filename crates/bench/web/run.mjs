// Measures in headless Chromium and writes the results as JSON: node run.mjs GENERATED_SCRIPT WASM RESULTS

import { readFile, writeFile } from 'node:fs/promises';
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
  const scripts = [script, peer, new URL('measure.js', import.meta.url)];
  await page.evaluate((await Promise.all(scripts.map((path) => readFile(path, 'utf8')))).join('\n;\n'));
  const bytes = (await readFile(wasm)).toString('base64');
  const rows = await page.evaluate((base64) => globalThis.measure(base64), bytes);
  await writeFile(results, JSON.stringify(rows));
} finally {
  await browser.close();
}
