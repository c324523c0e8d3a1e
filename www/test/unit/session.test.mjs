import assert from 'node:assert/strict';
import { test } from 'node:test';
import { createSession } from '../../js/state/session.js';
import { joined } from '../../js/state/rows.js';
import { MOST_SESSIONS, openSession, readSessions, sessionOf, tidySessions } from '../../js/state/sessions.js';
import { clean } from '../../js/state/state.js';
import { createStorage } from '../../js/state/storage.js';
import { dice, randomState } from './random.mjs';

test('a visit is restored with its state and Reset', () => {
    const roll = dice(5);
    for (let round = 0; round < 50; round++) {
        const [state, origin] = [randomState(roll), randomState(roll)];
        assert.deepEqual(openSession({ ...sessionOf('a', state, origin), time: round }), { state, origin });
    }
});

test('the newest visits are kept, each once', () => {
    /** @type {import('../../js/state/sessions.js').Session[]} */
    let list = [];
    for (let visit = 0; visit < 20; visit++) {
        for (const angle of [visit, visit + 0.5])
            list = keepSession(list, `visit ${visit}`, clean({ angle }), visit + angle / 1000);
    }
    assert.equal(list.length, MOST_SESSIONS);
    assert.deepEqual(list.map(({ link }) => link).slice(0, 2), ['#v=1&angle=19.5', '#v=1&angle=18.5']);
    const again = keepSession(list, 'another', clean({ angle: 18.5 }), 20);
    assert.deepEqual(again.map(({ id }) => id).slice(0, 3), ['another', 'visit 19', 'visit 17']);
});

test('visits with long texts leave room in the storage', () => {
    /** @type {import('../../js/state/sessions.js').Session[]} */
    let list = [];
    for (let visit = 0; visit < 6; visit++) {
        const state = clean({ axiom: `F%&[+]${'F-'.repeat(450_000)}`, angle: visit });
        list = keepSession(list, `visit ${visit}`, state, visit);
        assert.deepEqual(openSession(/** @type {any} */ (list[0]))?.state, state);
        assert.ok(JSON.stringify(list).length < 4_500_000);
    }
    assert.ok(list.length > 1);
});

test('visits are read from any stored value', () => {
    for (const value of [
        undefined,
        null,
        7,
        'text',
        {},
        [null],
        [{}],
        [{ id: 'a', time: 'now', link: '#', origin: '#' }],
    ])
        assert.deepEqual(readSessions(value), []);
    assert.equal(openSession({ id: 'a', time: 0, link: 'no link', origin: '' }), null);
});

/** A list with a visit changed. @param {import('../../js/state/sessions.js').Session[]} list @param {string} id @param {import('../../js/state/state.js').State} state @param {number} time */
const keepSession = (list, id, state, time) =>
    tidySessions(joined([...list, { ...sessionOf(id, state, clean({})), time }], () => 0));

/** A storage that holds `room` characters. @param {number} room @returns {Storage} */
function area(room = Infinity) {
    /** @type {Map<string, string>} */
    const map = new Map();
    return /** @type {any} */ ({
        get length() {
            return map.size;
        },
        key: (/** @type {number} */ at) => [...map.keys()][at] ?? null,
        getItem: (/** @type {string} */ key) => map.get(key) ?? null,
        removeItem: (/** @type {string} */ key) => map.delete(key),
        setItem: (/** @type {string} */ key, /** @type {string} */ value) => {
            if (value.length > room) throw new DOMException('full', 'QuotaExceededError');
            map.set(key, value);
        },
    });
}

test('refused, full or damaged storage is no error', () => {
    for (const refused of [
        () => {
            throw new DOMException('refused', 'SecurityError');
        },
        () => /** @type {any} */ (null),
    ]) {
        const storage = createStorage(refused);
        assert.equal(storage.available, false);
        assert.equal(storage.write('a', 1), false);
        assert.equal(storage.read('a'), undefined);
        assert.equal(createSession(storage, storage).start('', null), null);
    }
    const small = createStorage(() => area(4));
    assert.ok(small.available);
    assert.equal(small.write('a', 'long text'), false);
    assert.equal(small.write('a', 7), true);
    assert.equal(small.read('a'), 7);
    const scribbled = area();
    scribbled.setItem('l-systems:a', '{"not": ');
    assert.equal(createStorage(() => scribbled).read('a'), undefined);
});

test('states that stopped the drawing are remembered until they are drawn', () => {
    const storage = createStorage(() => area());
    const tab = createStorage(() => area());
    const [bad, good] = [clean({ axiom: 'FHANG' }), clean({ axiom: 'F' })];
    const viewed = { ...good, view: { x: 0, y: 0, zoom: 1e20 } };
    const first = createSession(storage, tab);
    assert.ok(!first.isSuspect(bad));
    first.suspect(bad, true, false);
    first.suspect(viewed, true, true);
    const next = createSession(storage, tab);
    for (const session of [first, next]) {
        assert.ok(session.isSuspect(bad));
        assert.ok(session.isSuspect({ ...bad, view: { x: 0, y: 0, zoom: 2 } }));
        assert.ok(session.isSuspect(viewed));
        assert.ok(!session.isSuspect(good));
    }
    next.suspect(bad, false, false);
    next.suspect(viewed, false, true);
    assert.ok(!createSession(storage, tab).isSuspect(bad));
    assert.ok(!createSession(storage, tab).isSuspect(viewed));
    storage.write('suspects', [7, null, 'x'.repeat(100), { a: 1 }]);
    assert.ok(!createSession(storage, tab).isSuspect(bad));
});

test('a link typed after a change is what a quick reload shows', (t) => {
    const page = /** @type {any} */ (globalThis);
    t.after(() => ['location', 'window', 'addEventListener'].forEach((name) => delete page[name]));
    // The timer never ends, because the reload is quicker.
    Object.assign(page, { location: { hash: '#v=1&axiom=F' }, window: { setTimeout: () => 1 }, addEventListener() {} });
    const storage = createStorage(() => area());
    const tab = createStorage(() => area());
    const [typed, linked] = [clean({ axiom: 'F', rules: 'F -> FF' }), clean({ axiom: 'A' })];
    let change = () => {};
    const store = {
        state: clean({ axiom: 'F' }),
        origin: clean({ axiom: 'F' }),
        subscribe: (/** @type {() => void} */ call) => void (change = call),
        open: (/** @type {any} */ state) => void (store.state = state),
    };
    const session = createSession(storage, tab);
    session.follow(/** @type {any} */ (store));
    store.state = typed;
    change();
    page.location.hash = '#v=1&axiom=A';
    session.visit(linked);
    assert.equal(createSession(storage, tab).start(page.location.hash, linked)?.state.axiom ?? 'A', 'A');
    // The former text is not lost.
    const [before] = createSession(storage, tab).others();
    assert.ok(before);
    assert.equal(openSession(before)?.state.rules, 'F -> FF');
});
