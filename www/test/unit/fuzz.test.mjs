/** Random untrusted input never throws and gives valid values. */

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { deflateSync } from 'node:zlib';
import { CONTROLS, readControls, readOptions } from '../../js/embed/options.js';
import { fieldsOf, valuesOf } from '../../js/embed/values.js';
import { LONGEST_NAME, MOST_FAVOURITES, favourite, readFavourites, renamed } from '../../js/favourites/favourites.js';
import { isFavouritesFile, readFile, writeFile } from '../../js/favourites/file.js';
import { readLink, writeLink } from '../../js/state/link.js';
import { plain, readNumber } from '../../js/base/numerals.js';
import { bestLink, openLink, shortestLink } from '../../js/state/packed.js';
import { createSession } from '../../js/state/session.js';
import { MOST_SESSIONS, openSession, readSessions, sessionOf, tidySessions } from '../../js/state/sessions.js';
import { DEFAULTS, clean } from '../../js/state/state.js';
import { createStorage } from '../../js/state/storage.js';
import { damaged, junk, junkLink, junkObject, junkText, pick, whole } from './junk.mjs';
import { dice, randomState } from './random.mjs';

/** @typedef {import('./junk.mjs').Roll} Roll */

const ROUNDS = Number(process.env.LSYSTEM_CASES ?? 200);

/** The maximum JSON size of a state: the longest texts with six characters per character, and the rest. */
const LARGEST_STATE = 700_000;

/**
 * A test of many random cases. Each case has its own seed, so that a failure can be repeated.
 * @param {string} name
 * @param {(roll: Roll) => Promise<void> | void} check
 * @param {number} [rounds]
 */
const fuzz = (name, check, rounds = ROUNDS) =>
    test(name, async (context) => {
        for (let round = 0; round < rounds; round++) {
            try {
                await check(dice(round * 7919 + name.length));
            } catch (error) {
                throw new Error(`case ${round}`, { cause: error });
            }
        }
        context.diagnostic(`${rounds} cases`);
    });

/** @param {import('../../js/state/link.js').Link | null} link */
function isValid(link) {
    if (!link) return;
    assert.deepEqual(clean(link.state), link.state);
    assert.ok(JSON.stringify(link.state).length < LARGEST_STATE);
    assert.ok(link.problems.join('').length < 5000);
}

fuzz('links: a read state is valid, and its link reads back the same', async (roll) => {
    const link = await openLink(junkLink(roll));
    isValid(link);
    if (!link) return;
    for (const hash of [await bestLink(link.state), await shortestLink(link.state)]) {
        assert.deepEqual(await openLink(hash), { state: link.state, problems: [] });
    }
});

fuzz('links: a state and its parts are the same after writing and reading', async (roll) => {
    const state = randomState(roll);
    const part = clean(Object.fromEntries(Object.entries(state).filter(() => roll() < 0.5)));
    assert.deepEqual(readLink(writeLink(part)), { state: part, problems: [] });
    assert.deepEqual(await openLink(await shortestLink(part)), { state: part, problems: [] });
});

fuzz(
    'links: no bomb is unpacked beyond what a state needs',
    async (roll) => {
        const size = (1 + whole(roll, 24)) << 20;
        const text = pick(roll, ['F', '&', 'axiom=F&', 'notes=%20', `${junkText(roll)}x`]);
        const code = deflateSync(Buffer.from(text.repeat(Math.ceil(size / text.length)))).toString('base64url');
        const before = process.memoryUsage().rss;
        const link = await openLink(`#v=1&z=${code}`);
        isValid(link);
        assert.match(String(link?.problems), /more than any drawing needs|longer than/);
        assert.deepEqual(link?.state, DEFAULTS);
        assert.ok(process.memoryUsage().rss - before < 256 << 20);
    },
    Math.ceil(ROUNDS / 100),
);

fuzz('states: cleaning twice equals cleaning once', (roll) => {
    const state = clean(roll() < 0.5 ? junkObject(roll) : { ...randomState(roll), ...junkObject(roll) });
    assert.deepEqual(clean(state), state);
    assert.deepEqual(Object.keys(state), Object.keys(DEFAULTS));
});

fuzz('sessions: a damaged list gives valid visits, up to the maximum', (roll) => {
    const list = [{ ...sessionOf('a', randomState(roll), randomState(roll)), time: 1 }];
    const given = pick(roll, [
        () => junk(roll),
        () => list.map((one) => ({ ...one, ...junkObject(roll) })),
        () => Array(whole(roll, 40)).fill(list[0]),
    ])();
    const read = readSessions(given);
    assert.ok(read.length <= MOST_SESSIONS);
    for (const one of read) {
        const opened = openSession(one);
        if (opened) assert.deepEqual([clean(opened.state), clean(opened.origin)], [opened.state, opened.origin]);
    }
    assert.ok(tidySessions([{ ...sessionOf('b', clean({}), clean({})), time: 2 }, ...read]).length <= MOST_SESSIONS);
});

fuzz('storage: any stored value starts a visit with a valid state or none', (roll) => {
    const state = randomState(roll);
    const sessions = JSON.stringify([{ ...sessionOf('a', state, state), time: 1 }]);
    const entry = (/** @type {string} */ whole) =>
        pick(roll, [() => whole, () => damaged(roll, whole), () => json(junk(roll)), () => junkText(roll)])();
    const kept = new Map([
        ['l-systems:sessions', entry(sessions)],
        ['l-systems:tab', entry('{"id":"a","hash":""}')],
        ['l-systems:suspects', entry('["a"]')],
    ]);
    const area = /** @type {any} */ ({
        length: kept.size,
        getItem: (/** @type {string} */ key) => kept.get(key) ?? null,
        setItem: () => {},
        removeItem: () => {},
    });
    const storage = createStorage(() => area);
    const session = createSession(
        storage,
        createStorage(() => area),
    );
    const begun = session.start(pick(roll, ['', '#v=1', writeLink(state)]), roll() < 0.5 ? null : state);
    if (begun) assert.deepEqual([clean(begun.state), clean(begun.origin)], [begun.state, begun.origin]);
    session.others().map(openSession);
    readFavourites(storage.read('sessions'));
});

fuzz('favourites: a damaged file gives valid favourites, or an error above a limit', async (roll) => {
    const list = Array.from({ length: whole(roll, 6) }, (_, at) =>
        favourite(junkText(roll), at % 2 ? randomState(roll) : clean({ axiom: junkText(roll) })),
    );
    const file = writeFile(list);
    const text = pick(roll, [
        () => damaged(roll, file),
        () => json({ favourites: junk(roll) }),
        () =>
            json({
                format: 'l-systems favourites',
                favourites: Array.from({ length: whole(roll, 20) }, () => ({
                    name: junk(roll, 1),
                    link: pick(roll, [junkLink(roll), junk(roll, 1)]),
                })),
            }),
    ])();
    isFavouritesFile(text);
    const read = await readFile(list, text);
    for (const { name, link } of read?.list ?? []) {
        assert.ok(name.length <= LONGEST_NAME);
        assert.deepEqual(readLink(link)?.problems, []);
    }
    const stored = readFavourites(junk(roll));
    assert.ok(stored.length <= MOST_FAVOURITES);
    for (const one of stored) renamed(one, junkText(roll));
});

fuzz('messages: values of any kind give valid fields', (roll) => {
    const values = pick(roll, [
        () => junk(roll),
        () => junkObject(roll),
        () => ({ ...valuesOf(randomState(roll)), ...junkObject(roll, 2) }),
        () =>
            Object.fromEntries(
                Object.entries(valuesOf(randomState(roll))).map(([key, value]) => [
                    key,
                    roll() < 0.5 ? String(value) : value,
                ]),
            ),
    ])();
    const { fields, problems } = fieldsOf(values);
    const state = clean({ ...DEFAULTS, ...fields });
    for (const [field, value] of Object.entries(fields))
        assert.deepEqual(state[/** @type {keyof typeof state} */ (field)], value);
    assert.ok(problems.every((words) => words.length < 200));
});

fuzz('options: any address gives known controls, a theme or null, and an origin or null', (roll) => {
    const hash = pick(roll, [
        () => junkLink(roll),
        () => `#v=1&controls=${junkText(roll)}&theme=${junkText(roll)}&host=${junkText(roll)}`,
        () => damaged(roll, '#v=1&controls=all&theme=dark&host=https%3A%2F%2Fexample.org%3A8080'),
    ])();
    const { controls, theme, host } = readOptions(hash);
    assert.ok(controls.every((one) => CONTROLS.includes(one)));
    assert.ok([null, 'light', 'dark'].includes(theme));
    if (host !== null) assert.equal(new URL(host).origin, host);
    assert.ok(readControls(junkText(roll)).length <= CONTROLS.length);
});

fuzz('numbers: a written number reads back the same, and other text gives null', (roll) => {
    const value = (roll() - 0.5) * 10 ** (whole(roll, 60) - 30);
    assert.equal(readNumber(plain(value)), Number(value.toPrecision(12)));
    const read = readNumber(
        pick(roll, [() => junkText(roll), () => damaged(roll, plain(value)), () => `${plain(value)} °`])(),
    );
    assert.ok(read === null || typeof read === 'number');
    assert.ok(!Number.isNaN(read));
});

/** A value as JSON, if possible. @param {any} value @returns {string} */
function json(value) {
    return JSON.stringify(value, (_, each) => (typeof each === 'bigint' ? String(each) : each)) ?? '';
}
