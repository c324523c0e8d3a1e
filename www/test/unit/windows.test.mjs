/** Several windows of a package write what this browser and a learning system keep: nothing solved is lost. */

import assert from 'node:assert/strict';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { createAnswers } from '../../js/exercise/answers.js';
import { createScorm } from '../../js/exercise/scorm.js';
import { createStorage } from '../../js/state/storage.js';
import { createStandIn } from '../scorm-stand-in.mjs';
import { createBrowser } from './browser-windows.mjs';
import { dice } from './random.mjs';

/** @typedef {Partial<import('../scorm-stand-in.mjs').Faults>} Faults */

/** Runs of each kind of learning system: 1,000 in all, or 8,000. */
const ROUNDS = process.env.LSYSTEM_CASES ? 1000 : 125;
const KEYS = ['00000001', '00000002', '00000003', 'own'];
const ASKED = KEYS.slice(0, 3);

/** A learning system: what it has, and windows with the copy of when they were opened. @param {'1.2' | '2004'} [standard] */
function createSystem(standard = '1.2') {
    const system = {
        /** @type {Record<string, string>} */
        data: {},
        /** Commits that have not arrived yet. @type {(() => void)[]} */
        late: [],
        /** @param {Faults} faults @param {boolean} isLate */
        open(faults, isLate) {
            const standIn = createStandIn(standard, { ...faults, kept: { ...system.data } });
            const { api } = standIn;
            for (const name of Object.keys(api).filter((name) => /Commit|Finish|Terminate/.test(name))) {
                const call = api[name];
                api[name] = (...given) => {
                    const answer = call?.(...given);
                    const data = { ...standIn.stored };
                    if (answer === 'true') system.late.push(() => (system.data = data));
                    if (!isLate || !name.endsWith('Commit')) system.arrive();
                    return answer;
                };
            }
            return api;
        },
        arrive() {
            for (const commit of system.late.splice(0)) commit();
        },
    };
    return system;
}

/** A window of the package. @param {Pick<ReturnType<typeof createBrowser>, 'open' | 'settle'>} browser @param {any} api none if the learning system comes later @param {Storage} [tab] @param {'1.2' | '2004'} [standard] @param {string[]} [keys] */
function openWindow(browser, api, tab = createBrowser().open().area, standard = '1.2', keys = KEYS) {
    const place = browser.open();
    const from = /** @type {any} */ ({ opener: null, API: api, API_1484_11: api });
    from.parent = from;
    const scorm = createScorm(standard, { from, now: () => 0 });
    let isSigned = false;
    let isHeard = false;
    const answers = createAnswers(
        {
            id: 'p',
            keys,
            scorm,
            storage: createStorage(() => place.area, 'l-system-', place.page),
            tab: createStorage(() => tab, 'l-system-'),
        },
        () => (isHeard = true),
    );
    function connect() {
        if (isSigned || scorm.open() !== null) return;
        isSigned = true;
        answers.signIn();
        answers.send();
    }
    connect();
    if (!isSigned) answers.begin();
    return {
        answers,
        get isHeard() {
            return isHeard;
        },
        /** @param {any} late */
        provide(late) {
            from.API ??= late;
            connect();
        },
        send: () => isSigned && answers.send(),
        close() {
            if (isSigned) answers.send();
            scorm.close();
            place.close();
        },
    };
}

/** The keys of what is solved. @param {readonly {id: string, mark: unknown}[]} parts */
const solvedIn = (parts) => parts.filter(({ mark }) => mark === 'solved').map(({ id }) => id);

/** @typedef {{faults?: (roll: () => number) => Faults, isLate?: boolean, comesLate?: boolean, forgets?: boolean}} Kind */
for (const [
    name,
    { faults = () => ({}), isLate = false, comesLate = false, forgets = false },
] of /** @type {[string, Kind][]} */ ([
    ['does what it should', {}],
    ['keeps what it is told late', { isLate: true }],
    ['is there late', { comesLate: true }],
    ['refuses', { faults: (roll) => ({ refuses: Math.floor(4 * roll()) }) }],
    ['throws in some windows', { faults: (roll) => ({ throws: roll() < 0.4 }) }],
    ['has room for little', { faults: (roll) => ({ quota: 120 + Math.floor(roll() * 300) }) }],
    ['cuts', { faults: (roll) => ({ cuts: Math.floor(roll() * 400) }) }],
    ['forgets between visits', { forgets: true }],
]))
    test(`${ROUNDS} runs of two or three windows lose nothing solved: the learning system ${name}`, (t) => {
        let clock = 1_800_000_000_000;
        const { now } = Date;
        t.after(() => (Date.now = now));
        // Not a mock, which would remember the stack of each call.
        Date.now = () => clock;
        let most = 0;
        for (let round = 0; round < ROUNDS; round++) {
            const roll = dice(round * 7919 + name.length);
            const [browser, system] = [createBrowser(), createSystem()];
            /** @type {ReturnType<typeof openWindow>[]} */
            let windows = [];
            const solved = new Set();
            const many = 2 + Math.floor(2 * roll());
            const close = (/** @type {ReturnType<typeof openWindow>} */ one) => {
                one.provide(system.open({}, false));
                one.close();
                windows = windows.filter((other) => other !== one);
            };
            for (let step = 0; step < 60; step++) {
                clock += Math.floor(2 * roll());
                const one = windows[Math.floor(roll() * windows.length)];
                const chance = roll();
                if (!one || (windows.length < many && chance < 0.3))
                    windows.push(openWindow(browser, comesLate ? undefined : system.open(faults(roll), isLate)));
                else if (chance < 0.45) browser.deliver(roll);
                else if (chance < 0.7) {
                    const key = KEYS[Math.floor(roll() * KEYS.length)] ?? '';
                    const isRight = key !== 'own' && roll() < 0.3;
                    one.answers.answer(key, isRight ? 'solved' : 7, `rules=${'F'.repeat(1 + 100 * roll())}${step}`);
                    if (isRight) solved.add(key);
                } else if (chance < 0.8) one.send();
                else if (chance < 0.85) one.provide(system.open(faults(roll), isLate));
                else if (chance < 0.9) system.arrive();
                else if (chance < 0.95) {
                    close(one);
                    if (forgets && windows.length === 0) system.data = {};
                } else one.answers.move(Math.floor(4 * roll()));
            }
            browser.settle();
            // All open windows agree, once they have been told.
            for (const one of windows) one.provide(system.open({}, false));
            browser.settle();
            for (const one of windows) one.send();
            for (const one of windows) {
                const known = [...solvedIn(one.answers.parts), ...solvedIn(one.answers.earlier)];
                for (const key of solved) assert.ok(known.includes(key), `run ${round}: ${key} is not in a window`);
            }
            for (const one of windows) close(one);
            system.arrive();
            const last = openWindow(browser, system.open({}, false));
            // What the learning system lacks, because it forgets or because a window that had not heard of it was the last
            // to write, is offered.
            last.answers.useEarlier();
            last.send();
            const now = solvedIn(last.answers.parts);
            for (const key of solved) assert.ok(now.includes(key), `run ${round}: ${key} is lost`);
            const score = last.answers.parts.some(({ id }) => ASKED.includes(id))
                ? String(Math.round((100 * now.length) / ASKED.length))
                : '';
            assert.equal(system.data['cmi.core.score.raw'] ?? '', score, `run ${round}`);
            most = Math.max(most, now.length);
        }
        assert.equal(most, ASKED.length, 'some runs solve all');
    });

/** By the moments of the document, what happens. @typedef {{open: () => ReturnType<typeof openWindow>, first: ReturnType<typeof openWindow>, browser: ReturnType<typeof createBrowser>}} Scene */
/** @type {Record<string, (scene: Scene) => void>} */
const MOMENTS = {
    opened: () => {},
    'an answer is not right': ({ first }) => {
        first.answers.answer('00000001', 7, 'n=1');
        first.send();
    },
    'one exercise is solved': ({ first }) => {
        first.answers.answer('00000001', 'solved', 'n=2');
        first.send();
    },
    'the other one is solved in a second window': ({ open, browser }) => {
        const second = open();
        second.answers.answer('00000002', 'solved', 'n=3');
        second.send();
        browser.settle();
    },
    'a solved exercise is changed': ({ first }) => {
        first.answers.answer('00000001', 7, 'n=4');
        first.send();
    },
    'opened again': ({ first, open }) => {
        first.close();
        open().close();
    },
};

for (const standard of /** @type {const} */ (['1.2', '2004']))
    test(`a learning system of SCORM ${standard} is told what the document says`, () => {
        const text = readFileSync(new URL('../../../docs/classroom.md', import.meta.url), 'utf8');
        const table = text.split('| moment |')[1]?.split('\n\n')[0] ?? '';
        const rows = table
            .split('\n')
            .slice(2)
            .map((line) => line.split('|').map((cell) => cell.trim()));
        assert.deepEqual(
            rows.map(([, moment]) => moment),
            Object.keys(MOMENTS),
        );
        const [browser, system] = [createBrowser(), createSystem(standard)];
        const open = () => openWindow(browser, system.open({}, false), undefined, standard, ASKED.slice(0, 2));
        const first = open();
        for (const [, moment = '', of12, of2004, score] of rows) {
            MOMENTS[moment]?.({ open, first, browser });
            const { data } = system;
            const of = (/** @type {string} */ name) => data[`cmi.${name}`];
            const is12 = standard === '1.2';
            const status = is12 ? of('core.lesson_status') : `${of('completion_status')}, ${of('success_status')}`;
            assert.equal(status, is12 ? of12 : of2004, moment);
            assert.equal(of(is12 ? 'core.score.raw' : 'score.raw') || 'none', score, moment);
        }
    });

test('windows that are closed before they hear of each other lose nothing, nor what was kept before', () => {
    const [browser, system] = [createBrowser(), createSystem()];
    const row = { id: '00000003', time: 5, mark: 'solved', fields: 'n=3', run: 0 };
    browser.stored.set('l-system-package p student-1', JSON.stringify([row]));
    const [first, second] = [0, 1].map(() => openWindow(browser, system.open({}, false)));
    first?.answers.answer('00000001', 'solved', 'n=1');
    second?.answers.answer('00000002', 'solved', 'n=2');
    second?.answers.answer('00000001', 7, 'n=4');
    first?.close();
    second?.close();
    browser.settle();
    const last = openWindow(browser, system.open({}, false));
    assert.deepEqual(solvedIn(last.answers.parts).sort(), ASKED);
    last.close();
    assert.equal(system.data['cmi.core.score.raw'], '100');
});

test('an open window tells a later one what the learning system does not', () => {
    const browser = createBrowser();
    const [first, second] = [0, 1].map((at) => {
        // Each window has a learning system that knows nothing.
        const one = openWindow(browser, createSystem().open({}, false));
        if (at === 0) {
            one.answers.answer('00000001', 'solved', 'n=1');
            one.send();
            browser.settle();
        }
        return one;
    });
    assert.deepEqual(solvedIn(second?.answers.earlier ?? []), ['00000001'], 'for all that is known it was given up');
    browser.settle();
    assert.ok(first?.isHeard, 'the first window hears of a new attempt');
    first?.send();
    browser.settle();
    assert.deepEqual(solvedIn(second?.answers.parts ?? []), ['00000001']);
    assert.deepEqual(second?.answers.earlier, [], 'nothing is left to offer');
});

test('a window reads what another one has written before it writes, also if it was not told', () => {
    const { area } = createBrowser().open();
    const page = /** @type {any} */ ({ addEventListener() {} });
    const browser = { open: () => ({ area, page, close() {} }), settle() {} };
    const system = createSystem();
    const [first, second] = [0, 1].map(() => openWindow(browser, system.open({}, false)));
    first?.answers.answer('00000001', 'solved', 'n=1');
    second?.answers.answer('00000002', 'solved', 'n=2');
    first?.send();
    second?.send();
    assert.equal(system.data['cmi.core.score.raw'], '67');
    assert.deepEqual(solvedIn(second?.answers.parts ?? []).sort(), ['00000001', '00000002']);
});

test('answers of nobody are those of the tab that made them, and of one name', () => {
    const browser = createBrowser();
    const tab = createBrowser().open().area;
    const system = (/** @type {string} */ student) =>
        createStandIn('1.2', { kept: { 'cmi.core.student_id': student } }).api;
    const nobody = openWindow(browser, undefined, tab);
    nobody.answers.answer('00000001', 'solved', 'n=1');
    nobody.close();
    browser.settle();
    for (const [student, own] of /** @type {[string, Storage | undefined][]} */ ([
        ['ada', undefined],
        ['', undefined],
    ])) {
        const other = openWindow(browser, system(student), own);
        other.answers.answer('00000002', 7, 'n=2');
        assert.deepEqual([other.answers.earlier, solvedIn(other.answers.parts)], [[], []], `offered to ${student}`);
        other.close();
    }
    const emmy = openWindow(browser, system('emmy'), tab);
    assert.deepEqual(solvedIn(emmy.answers.earlier), ['00000001']);
    emmy.close();
    browser.settle();
    const later = openWindow(browser, system('ada'), tab);
    assert.deepEqual(solvedIn(later.answers.earlier), [], 'another name in the same tab');
    later.close();
    const again = openWindow(browser, system('emmy'));
    again.answers.useEarlier();
    assert.deepEqual(solvedIn(again.answers.parts), ['00000001']);
});
