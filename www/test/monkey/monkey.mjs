/**
 * A monkey test: random actions on the page, in an order that a seed decides, with checks that nothing is lost, stuck
 * or broken. `node monkey.mjs [--seed S] [--minutes M] [--actions N] [--verbose]`.
 *
 * The test works in rounds. Each round has a fresh browser profile and its own seed, which decides whether the round
 * uses the desktop page, the phone page or an embedded drawing. A fault ends a round; `--seed S --actions N` repeats
 * the first N actions of the round with the seed S.
 */

import { parseArgs } from 'node:util';
import { chromium } from 'playwright-core';
import { dice } from '../unit/random.mjs';
import { serveHost } from './embedded.mjs';
import { Log } from './log.mjs';
import { playRound } from './round.mjs';

const { values } = parseArgs({
    options: {
        seed: { type: 'string' },
        minutes: { type: 'string', default: '1' },
        actions: { type: 'string' },
        verbose: { type: 'boolean', default: false },
    },
});
const seed = Number(values.seed ?? Math.floor(Math.random() * 1e6));
const end = Date.now() + Number(values.minutes) * 60_000;
if (!Number.isInteger(seed) || Number.isNaN(end)) throw new Error('--seed takes a whole number, --minutes a number');

/** The most actions of a round; short rounds make faults quick to repeat. */
const MOST_ACTIONS = 60;

const address = process.env.LSYSTEM_URL ?? 'http://127.0.0.1:8080/';
const browser = await chromium.launch({
    executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium-headless-shell',
    args: [
        '--headless',
        '--no-sandbox',
        '--disable-gpu',
        '--disable-quic',
        '--no-first-run',
        '--disable-background-networking',
        '--disable-component-update',
        '--disable-sync',
    ],
});
const host = await serveHost(address);
const log = new Log(values.verbose);
try {
    console.log(`seed ${seed}`);
    const actions = values.actions === undefined ? MOST_ACTIONS : Number(values.actions);
    for (let round = seed; ; round++) {
        await playRound(browser, {
            seed: round,
            actions,
            until: values.actions === undefined ? end : Infinity,
            address,
            host,
            log,
            dice,
        });
        if (values.actions !== undefined || Date.now() >= end) break;
    }
} finally {
    host.close();
    await browser.close();
}
log.report();
process.exitCode = log.faults.length > 0 ? 1 : 0;
