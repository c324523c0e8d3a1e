import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { LONGEST, readLink, writeLink } from '../../js/link.js';
import { DEFAULTS, clean } from '../../js/state.js';
import { dice, randomState } from './random.mjs';

const ROUNDS = Number(process.env.LSYSTEM_CASES ?? 500);

/** @param {string} hash */
const open = (hash) => {
    const link = readLink(hash);
    assert.ok(link, hash);
    return link;
};

test('a link gives back the state it was made from', () => {
    const roll = dice(1);
    for (let round = 0; round < ROUNDS; round++) {
        const state = randomState(roll);
        const link = open(writeLink(state));
        assert.deepEqual(link.state, state);
        assert.deepEqual(link.problems, []);
    }
});

test('the writer leaves readable what may stay, and nothing else', () => {
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

test('a hash that holds no system is none of ours', () => {
    for (const hash of ['', '#', '#drawing', '#a=b', '#&&&', '#=v']) assert.equal(readLink(hash), null, hash);
});

test('old links open as they did', () => {
    const golden = JSON.parse(readFileSync(new URL('./links.json', import.meta.url), 'utf8'));
    assert.ok(golden.length >= 12);
    for (const { hash, state } of golden) assert.deepEqual(open(hash).state, { ...DEFAULTS, ...state }, hash);
});

test('hostile links are read within bounds, as text and numbers only', () => {
    const hostile = [
        '#v=1&n=1e999&angle=NaN&seed=-1&step=Infinity&zoom=2',
        '#v=1&n=0x10&angle=--5&right=1,2&start=1&start=1,2,3',
        '#v=1&view=1,2&axiom=%E0%A4%A&rules=%',
        '#v=1&view=1e308,-1e308,1e308',
        '#v=1&palette=,,,,&bg=red&colour=__proto__&turtle=constructor',
        '#v=1&__proto__=1&constructor=2&toString=3&hasOwnProperty=4',
        `#v=1&palette=${'ffffff,'.repeat(5000)}000000`,
        `#v=1&rules=${'%F0%9F%8C%BF'.repeat(5000)}`,
        '#v=1&axiom=<script>alert(1)</script>&title=<img src=x onerror=alert(1)>',
        `#v=1&axiom=${'F'.repeat(50_000)}`,
        '#v=99&axiom=F',
    ];
    for (const hash of hostile) {
        const start = performance.now();
        const { state } = open(hash);
        assert.deepEqual(state, clean(state), hash.slice(0, 80));
        assert.ok(performance.now() - start < 200);
    }
    assert.equal(open(`#v=1&axiom=${'F'.repeat(LONGEST)}`).state.axiom, '');
    assert.equal(open(`#v=1&axiom=${'F'.repeat(LONGEST)}`).problems.length, 1);
    assert.ok(open('#v=99&axiom=F').problems[0]?.includes('another version'));
    assert.ok(open('#v=1&angle=x').problems[0]?.includes('angle'));
    assert.ok(open('#v=1&axiom=F&rules=%').problems[0]?.includes('rules'));
});

test('cut and scrambled links never fail', () => {
    const roll = dice(3);
    for (let round = 0; round < ROUNDS; round++) {
        const whole = writeLink(randomState(roll));
        const cut = whole.slice(0, Math.floor(roll() * whole.length));
        const at = Math.floor(roll() * whole.length);
        const scrambled = whole.slice(0, at) + String.fromCharCode(33 + Math.floor(roll() * 90)) + whole.slice(at + 1);
        for (const hash of [cut, scrambled]) {
            const link = readLink(hash);
            if (link) assert.deepEqual(link.state, clean(link.state));
        }
    }
});
