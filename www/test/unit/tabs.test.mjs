/** Several tabs write what the page keeps in the browser: the last change of each row stays, and so does a deletion. */

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { readFavourites, tidyFavourites } from '../../js/favourites/favourites.js';
import { createRows, createSettings } from '../../js/state/rows.js';
import { createSession } from '../../js/state/session.js';
import { clean } from '../../js/state/state.js';
import { createStorage } from '../../js/state/storage.js';
import { createBrowser } from './browser-windows.mjs';
import { dice } from './random.mjs';

test('a change is newer than what it changes, also after the clock was put back', (t) => {
    let clock = 2000;
    const { now } = Date;
    t.after(() => (Date.now = now));
    Date.now = () => clock;
    const storage = createStorage(() => createBrowser().open().area);
    const settings = createSettings(storage, 's');
    settings.write({ a: 1 });
    clock = 1000;
    settings.write({ a: 2 });
    assert.equal(settings.read()['a'], 2);
});

test('1,000 runs of two or three tabs: each favourite is as its last change left it, and what is deleted stays so', (t) => {
    let clock = 1_800_000_000_000;
    const { now } = Date;
    t.after(() => (Date.now = now));
    Date.now = () => ++clock;
    let deleted = 0;
    for (let round = 0; round < 1000; round++) {
        const roll = dice(round * 7919);
        const browser = createBrowser();
        const open = () => {
            const place = browser.open();
            const storage = createStorage(() => place.area, 'l-systems:', place.page);
            /** @type {ReturnType<typeof createRows<import('../../js/favourites/favourites.js').Favourite & import('../../js/state/rows.js').Row>>} */
            const rows = createRows(storage, 'favourites', { read: readFavourites, tidy: tidyFavourites });
            return { rows, close: place.close };
        };
        const tabs = Array.from({ length: 2 + Math.floor(2 * roll()) }, open);
        /** The name of each favourite; null if it was deleted. @type {Map<string, string | null>} */
        const wanted = new Map();
        for (let step = 0; step < 40; step++) {
            const tab = tabs[Math.floor(roll() * tabs.length)] ?? tabs[0];
            const list = tab?.rows.list() ?? [];
            const one = list[Math.floor(roll() * list.length)];
            const chance = roll();
            if (chance < 0.4) browser.deliver(roll);
            else if (chance < 0.45) {
                tabs.splice(tabs.indexOf(/** @type {any} */ (tab)), 1)[0]?.close();
                tabs.push(open());
            } else if (!one || chance < 0.7) {
                const id = `${round}-${step}`;
                wanted.set(id, id);
                tab?.rows.put([{ id, name: id, link: '#v=1', made: clock }]);
            } else if (chance < 0.85) {
                wanted.set(one.id, `renamed ${step}`);
                const { time, ...rest } = one;
                tab?.rows.put([{ ...rest, name: `renamed ${step}` }]);
            } else {
                deleted += 1;
                wanted.set(one.id, null);
                tab?.rows.put([{ id: one.id, gone: true }]);
            }
        }
        browser.settle();
        const kept = [...wanted].filter(([, name]) => name !== null).sort();
        for (const { rows } of [...tabs, open()])
            assert.deepEqual(
                rows
                    .list()
                    .map(({ id, name }) => [id, name])
                    .sort(),
                kept,
                `run ${round}`,
            );
    }
    assert.ok(deleted > 1000);
});

test('in a full storage rows are replaced and deleted, or all stays as it was', () => {
    const { area } = createBrowser().open();
    const { setItem } = area;
    const size = () =>
        Array.from({ length: area.length }, (_, at) => area.key(at)?.length ?? 0).reduce((a, b) => a + b, 0);
    area.setItem = (key, value) => {
        if (size() + key.length > 200) throw new DOMException('full', 'QuotaExceededError');
        setItem(key, value);
    };
    /** @type {ReturnType<typeof createRows<any>>} */
    const rows = createRows(
        createStorage(() => area),
        's',
        { read: (/** @type {any} */ stored) => [stored].flat().filter((row) => row?.text) },
    );
    const names = () => rows.list().map((/** @type {any} */ { id, text }) => `${id} ${text.length}`);
    assert.ok(rows.put([{ id: 'a', text: 'a'.repeat(110) }]));
    assert.ok(rows.put([{ id: 'a', text: 'b'.repeat(120) }]));
    assert.deepEqual(
        [
            rows.put([
                { id: 'b', text: 'b' },
                { id: 'c', text: 'c'.repeat(99) },
            ]),
            names(),
        ],
        [false, ['a 120']],
    );
    assert.ok(rows.put([{ id: 'a', gone: true }]));
    assert.deepEqual(names(), []);
});

test('settings are kept one by one, and those from before there were rows are read', () => {
    const browser = createBrowser();
    const open = () => {
        const place = browser.open();
        return createStorage(() => place.area, 'l-systems:', place.page);
    };
    open().write('save', { purpose: 'print', values: { dpi: 300, fill: true } });
    browser.settle();
    const [first, second] = [createSettings(open(), 'save'), createSettings(open(), 'save')];
    const [one, other] = [first.read(), second.read()];
    assert.deepEqual(JSON.parse(JSON.stringify(one)), { purpose: 'print', values: { dpi: 300, fill: true } });
    for (const [settings, record] of /** @type {const} */ ([
        [first, one],
        [second, other],
    ])) {
        record['sheet'] = 'a3';
        settings.show(record);
    }
    one['sheet'] = 'a4';
    one['values'].dpi = 150;
    other['purpose'] = 'screen';
    first.write(one);
    second.write(other);
    browser.settle();
    for (const settings of [first, second, createSettings(open(), 'save')])
        assert.deepEqual(JSON.parse(JSON.stringify(settings.read())), {
            purpose: 'screen',
            sheet: 'a4',
            values: { dpi: 150, fill: true },
        });
});

test('settings are read from any stored value', () => {
    const storage = createStorage(() => createBrowser().open().area);
    for (const [value, read] of /** @type {[unknown, string][]} */ ([
        [7, '{}'],
        [null, '{}'],
        [[null, 7, { id: 7, value: 1 }, { id: 'a' }], '{}'],
        [
            [
                { id: 'a', value: 1 },
                { id: 'a.b', value: 2 },
            ],
            '{"a":{"b":2}}',
        ],
        [[{ id: '__proto__.b', value: 2, time: '5' }], '{"__proto__":{"b":2}}'],
        [
            [
                { id: 'a', value: 1, time: 1e300 },
                { id: 'a', value: 2, time: 1 },
            ],
            '{"a":2}',
        ],
    ])) {
        storage.write('s', value);
        assert.equal(JSON.stringify(createSettings(storage, 's').read()), read);
    }
});

test('a copy of a tab goes on with a visit of its own', (t) => {
    const page = /** @type {any} */ (globalThis);
    t.after(() => ['location', 'window', 'addEventListener'].forEach((name) => delete page[name]));
    /** @type {(() => void)[]} */
    const timers = [];
    Object.assign(page, {
        location: { hash: '' },
        window: { setTimeout: (/** @type {() => void} */ call) => timers.push(call) },
        addEventListener() {},
    });
    const browser = createBrowser();
    const [area, tab] = [browser.open().area, createBrowser().open().area];
    const open = () => {
        const store = {
            state: clean({ axiom: 'F' }),
            origin: clean({}),
            subscribe: (/** @type {() => void} */ call) => void (changed = call),
        };
        let changed = () => {};
        const session = createSession(
            createStorage(() => area),
            createStorage(() => tab),
        );
        session.start('', null);
        session.follow(/** @type {any} */ (store));
        return (/** @type {string} */ axiom) => {
            store.state = clean({ axiom });
            changed();
            for (const call of timers.splice(0)) call();
        };
    };
    const first = open();
    first('A');
    const copy = open();
    copy('B');
    first('C');
    first('D');
    copy('E');
    const links = createSession(
        createStorage(() => area),
        createStorage(() => createBrowser().open().area),
    ).others();
    assert.deepEqual(links.map(({ link }) => link).sort(), ['#v=1&axiom=D', '#v=1&axiom=E']);
});
