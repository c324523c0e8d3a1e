import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { setFlagsFromString } from 'node:v8';
import { runInNewContext } from 'node:vm';
import { readLink, writeLink } from '../../js/state/link.js';
import { LONG, bestLink, openLink, shortestLink } from '../../js/state/packed.js';
import { DEFAULTS, clean } from '../../js/state/state.js';
import { DAMAGED, SCRIPTS } from './hostile.mjs';
import { dice, randomState } from './random.mjs';

const ROUNDS = Number(process.env.LSYSTEM_CASES ?? 200);
/** The memory that a hostile link may use, in bytes. */
const MOST_MEGABYTES = 64;

/** @param {string} hash */
const open = (hash) => {
    const link = readLink(hash);
    assert.ok(link, hash.slice(0, 200));
    return link;
};

/** @param {string} hash @param {import('../../js/state/state.js').State} state */
async function gives(hash, state) {
    const link = await openLink(hash);
    assert.deepEqual(link?.problems, []);
    assert.deepEqual(link?.state, state);
}

test('a readable or compressed link reads back as the same state', async () => {
    const roll = dice(1);
    for (let round = 0; round < ROUNDS; round++) {
        const state = randomState(roll);
        await gives(writeLink(state), state);
        await gives(await shortestLink(state), state);
    }
});

test('long states are compressed, and the longest state can be opened', async () => {
    const short = clean({ axiom: 'F', rules: 'F -> F+F' });
    assert.equal(await bestLink(short), writeLink(short));
    const long = clean({ axiom: 'F', rules: 'F -> F[+F]F[-F]F & more, 100 % of it\n'.repeat(40) });
    const best = await bestLink(long);
    assert.match(best, /^#v=1&z=[\w-]+$/);
    assert.ok(best.length < LONG && LONG < writeLink(long).length);
    const roll = dice(4);
    const odd = (/** @type {number} */ most) =>
        Array.from({ length: most }, () => String.fromCharCode(0x4e00 + Math.floor(roll() * 0x5000))).join('');
    for (const letters of [odd, (/** @type {number} */ most) => '%'.repeat(most)]) {
        const longest = clean({
            title: letters(200),
            name: letters(200),
            source: letters(1000),
            notes: letters(10_000),
            axiom: letters(300_000),
            rules: letters(50_000),
            overrides: letters(20_000),
        });
        assert.equal(longest.rules.length, 50_000);
        await gives(await bestLink(longest), longest);
    }
});

test('without browser compression, links are readable, and compressed links are refused with a message', async () => {
    const { CompressionStream: compress, DecompressionStream: decompress } = globalThis;
    const long = clean({ axiom: 'F', rules: 'F -> F+F\n'.repeat(400) });
    const packed = await bestLink(long);
    try {
        Object.assign(globalThis, { CompressionStream: undefined, DecompressionStream: undefined });
        assert.equal(await bestLink(long), writeLink(long));
        const link = await openLink(`${packed}&n=7`);
        assert.match(String(link?.problems), /cannot read compressed links/);
        assert.deepEqual(link?.state, { ...DEFAULTS, iterations: 7 });
    } finally {
        Object.assign(globalThis, { CompressionStream: compress, DecompressionStream: decompress });
    }
});

test('the writer escapes only the necessary characters', () => {
    const roll = dice(2);
    for (let round = 0; round < ROUNDS; round++) {
        assert.match(writeLink(randomState(roll)), /^#v=1(&[a-z]+=([\w.~!*',;:@/=+-]|%[0-9A-F]{2})*)*$/);
    }
    assert.equal(writeLink(clean({ axiom: 'F+F-F', iterations: 4 })), '#v=1&axiom=F+F-F&n=4');
    assert.equal(writeLink(DEFAULTS), '#v=1');
});

test('plus is plus, not a space', () => {
    assert.equal(open('#v=1&axiom=F+F').state.axiom, 'F+F');
    assert.equal(open('#v=1&axiom=F%2BF').state.axiom, 'F+F');
    assert.equal(open('#v=1&axiom=F=F').state.axiom, 'F=F');
});

test('a hash without a system gives null', () => {
    for (const hash of ['', '#', '#drawing', '#a=b', '#&&&', '#=v']) assert.equal(readLink(hash), null, hash);
});

test('old links open unchanged', async () => {
    const golden = JSON.parse(readFileSync(new URL('./links.json', import.meta.url), 'utf8'));
    assert.ok(golden.length >= 40);
    for (const { hash, state } of golden) {
        const link = await openLink(hash);
        assert.deepEqual(link?.state, { ...DEFAULTS, ...state }, hash);
        assert.deepEqual(link?.problems, [], hash);
        // The link written today has the same state.
        await gives(await bestLink(link.state), link.state);
    }
});

test('hostile links give a message and their valid parts, in bounded time and memory', async (context) => {
    assert.ok(DAMAGED.length >= 100);
    setFlagsFromString('--expose-gc');
    const collect = /** @type {() => void} */ (runInNewContext('gc'));
    /** @type {{name: string, length: number, milliseconds: number, megabytes: number}[]} */
    const costs = [];
    for (const { name, hash, keeps } of DAMAGED) {
        collect();
        const before = memory();
        const start = process.cpuUsage();
        const link = await openLink(hash);
        const { user, system } = process.cpuUsage(start);
        const milliseconds = (user + system) / 1000;
        costs.push({
            name: name.slice(0, 40),
            length: hash.length,
            milliseconds,
            megabytes: Math.max(0, memory() - before) / 2 ** 20,
        });
        assert.ok(link && link.problems.length > 0, name);
        assert.ok(link.problems.join('').length < 5000, name);
        assert.deepEqual(link.state, { ...DEFAULTS, ...keeps }, name.slice(0, 80));
    }
    const by = (/** @type {'milliseconds' | 'megabytes'} */ cost) => costs.toSorted((a, b) => b[cost] - a[cost]);
    const [slowest, largest] = [by('milliseconds'), by('megabytes')];
    context.diagnostic(
        `${costs.length} hostile links; median ${slowest[costs.length >> 1]?.milliseconds.toFixed(2)} ms`,
    );
    for (const { name, length, milliseconds, megabytes } of new Set([...slowest.slice(0, 5), ...largest.slice(0, 5)])) {
        context.diagnostic(`${milliseconds.toFixed(1)} ms, ${megabytes.toFixed(1)} MB, ${length} characters: ${name}`);
    }
    assert.ok(Number(largest[0]?.megabytes) < MOST_MEGABYTES, largest[0]?.name);
});

test('texts in links stay text', async () => {
    for (const script of SCRIPTS) {
        for (const hash of [
            `#v=1&axiom=${encodeURIComponent(script)}&title=${encodeURIComponent(script)}`,
            await shortestLink(clean({ axiom: script, title: script })),
        ]) {
            await gives(hash, clean({ axiom: script, title: script }));
        }
    }
    assert.equal(/** @type {any} */ ({}).axiom, undefined);
});

test('cut and scrambled links never fail', async () => {
    const roll = dice(3);
    for (let round = 0; round < ROUNDS; round++) {
        const state = randomState(roll);
        const whole = roll() < 0.5 ? writeLink(state) : await shortestLink(state);
        const cut = whole.slice(0, Math.floor(roll() * whole.length));
        const at = Math.floor(roll() * whole.length);
        const scrambled = whole.slice(0, at) + String.fromCharCode(33 + Math.floor(roll() * 90)) + whole.slice(at + 1);
        for (const hash of [cut, scrambled]) {
            const link = await openLink(hash);
            if (link) assert.deepEqual(link.state, clean(link.state));
        }
    }
});

/** The memory in use, on and off the heap, in bytes. */
function memory() {
    const { heapUsed, external, arrayBuffers } = process.memoryUsage();
    return heapUsed + external + arrayBuffers;
}
