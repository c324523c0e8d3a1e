/**
 * Runs the end-to-end tests, or the named files of this folder: `node test/e2e/run.mjs [--thorough] [FILES]`, where
 * `--thorough` tries all variants. LSYSTEM_URL is the address of the page, CHROMIUM the browser. Prints every test, what failed, the slowest tests, and the sum of all.
 * LSYSTEM_TIMES names a file for the seconds of each test.
 */

import { writeFileSync } from 'node:fs';
import { readdir } from 'node:fs/promises';
import { basename, join } from 'node:path';
import { run } from 'node:test';
import { spec } from 'node:test/reporters';
import { fileURLToPath } from 'node:url';

/** Tests wait more than they work, but more browsers at once would compete for few cores. */
const FILES_AT_ONCE = 2;
/** The files that take longest. They begin first, so that no core is idle at the end. */
const LONGEST = ['access', 'shares', 'exercises', 'page', 'find', 'embed', 'docs', 'svg', 'watchdog'].map(
    (name) => `${name}.test.mjs`,
);
/** A file that has not ended after this time hangs: it is ended, and named. In milliseconds. */
const DEADLINE = 900_000;
/** How many of the slowest tests are told. */
const TOLD = 10;

const folder = fileURLToPath(new URL('.', import.meta.url));
const words = process.argv.slice(2);
if (words.includes('--thorough')) process.env.LSYSTEM_THOROUGH = 'yes';
const named = words.filter((word) => word !== '--thorough').map((name) => basename(name));
const all = (await readdir(folder)).filter((name) => name.endsWith('.test.mjs'));
const unknown = named.filter((name) => !all.includes(name));
if (unknown.length > 0) throw new Error(`no such files: ${unknown.join(', ')}`);
const rank = (/** @type {string} */ name) => [...LONGEST, name].indexOf(name);
const chosen = (named.length > 0 ? named : all).sort((a, b) => rank(a) - rank(b));

const begun = performance.now();
/** @type {{seconds: number, name: string}[]} */
const times = [];
let failures = 0;
/** @param {{name: string, file?: string, details: {duration_ms: number}}} event */
const ended = ({ name, file = '', details }) =>
    times.push({ seconds: details.duration_ms / 1000, name: `${basename(file)}: ${name}` });

const events = run({ files: chosen.map((name) => join(folder, name)), concurrency: FILES_AT_ONCE, timeout: DEADLINE });
events.on('test:pass', ended);
events.on('test:fail', (event) => {
    failures += 1;
    ended(event);
});
// After the report of all tests.
process.once('beforeExit', () => {
    times.sort((a, b) => b.seconds - a.seconds);
    const sum = times.reduce((total, { seconds }) => total + seconds, 0);
    console.log(`\nThe slowest of ${times.length} tests:`);
    for (const { seconds, name } of times.slice(0, TOLD)) console.log(`${seconds.toFixed(1).padStart(6)} s  ${name}`);
    if (process.env.LSYSTEM_TIMES)
        writeFileSync(process.env.LSYSTEM_TIMES, times.map(({ seconds, name }) => `${seconds} ${name}\n`).join(''));
    console.log(
        `${failures} failed. ${sum.toFixed(0)} s of tests in ${((performance.now() - begun) / 1000).toFixed(0)} s.`,
    );
    process.exitCode = failures > 0 || times.length === 0 ? 1 : 0;
});
events.compose(new spec()).pipe(process.stdout);
