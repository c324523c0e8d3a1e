/** The state of a package, and the calls to a learning system, against a stand-in that follows the standards. */

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { fieldsIn, keyOf, linkOf, readAttempt, weightOf, writeAttempt } from '../../js/exercise/attempt.js';
import { clockTime, createScorm } from '../../js/exercise/scorm.js';
import { joined } from '../../js/state/rows.js';
import { createStandIn } from '../scorm-stand-in.mjs';

/** @typedef {import('../../js/exercise/attempt.js').Part} Part */

/** @param {string} id @param {Part['mark']} mark @param {number} length @param {number} [time] @returns {Part} */
const part = (id, mark, length, time = NOW) => ({ id, time, mark, fields: `rules=${'F'.repeat(length)}` });
const NOW = 1_800_000_000_000;
const KEYS = ['00000001', '00000002', '00000003', 'own'];

test('exercises are named by their check sums', () => {
    // Published examples of CRC-32.
    assert.equal(keyOf('123456789'), 'cbf43926');
    assert.equal(keyOf(''), '00000000');
});

test('a state is read as it was written', () => {
    const attempt = { at: 7, parts: [part('0000000a', 'solved', 9), part('0000000b', 93, 0), part('own', 0, 4)] };
    const { text, dropped } = writeAttempt(attempt, 4096);
    assert.deepEqual(readAttempt(text), attempt);
    assert.deepEqual(dropped, []);
    assert.deepEqual(readAttempt(text.replaceAll('\n', '\r\n')), attempt);
});

test('foreign and damaged states are no states, or lose the damaged lines only', () => {
    for (const text of ['', '{}', 'l-system 2 at=1', 'l-system 1 at=x', '#v=1&k=0000000a&mark=1', 'undefined'])
        assert.equal(readAttempt(text), null, text);
    const read = readAttempt('l-system 1 at=1\n#v=1&k=xyz&mark=1\n#v=1&k=0000000a&mark=999&n=3\n#v=1&k=0000');
    assert.deepEqual(read, { at: 1, parts: [{ id: '0000000a', time: 0, mark: 100, fields: 'n=3' }] });
});

test('a state that is too long loses the longest drafts first, and no mark', () => {
    const parts = [part(KEYS[0] ?? '', 'solved', 900), part(KEYS[1] ?? '', 50, 300), part(KEYS[2] ?? '', 20, 700)];
    const attempt = { at: 0, parts };
    assert.deepEqual(writeAttempt(attempt, 2080).dropped, []);
    assert.deepEqual(writeAttempt(attempt, 1530).dropped, [KEYS[2]]);
    assert.deepEqual(writeAttempt(attempt, 1130).dropped, [KEYS[2], KEYS[1]]);
    const { text, dropped } = writeAttempt(attempt, 200);
    assert.ok(text.length <= 200);
    assert.equal(dropped.length, 3);
    assert.deepEqual(
        readAttempt(text)?.parts.map(({ mark }) => mark),
        ['solved', 50, 20],
    );
});

test('marks of the most exercises fit into the shortest state', () => {
    const parts = Array.from({ length: 100 }, (_, at) => part(keyOf(String(at)), 'solved', 100));
    assert.ok(writeAttempt({ at: 99, parts }, 4096).text.length <= 4096);
});

test('of two versions the solved one stays, then the one with a text, then the newer one', () => {
    const [solved, cut] = [part('0000000a', 'solved', 3, 1), { ...part('0000000a', 'solved', 0, 9), fields: '' }];
    const drafts = [
        part('0000000a', 40, 5, 4),
        part('0000000a', 30, 5, 5),
        { ...part('0000000a', 50, 0, 8), fields: '' },
    ];
    for (const [versions, best] of /** @type {[Part[], Part | undefined][]} */ ([
        [[solved, ...drafts], solved],
        [[solved, cut], solved],
        [[cut, ...drafts], cut],
        [drafts, drafts[1]],
    ]))
        for (const order of [versions, [...versions].reverse()]) assert.deepEqual(joined(order, weightOf), [best]);
});

test('a state of very many lines is read and written in time that grows with their number', () => {
    const lines = Array.from({ length: 60_000 }, (_, at) => `#v=1&k=${keyOf(String(at))}&mark=7&n=3`);
    const read = readAttempt(['l-system 1 at=0', ...lines].join('\n'));
    assert.equal(read?.parts.length, 500);
    const parts = lines.map((_, at) => ({ id: String(at), time: 0, mark: 7, fields: 'n=3' }));
    assert.equal(writeAttempt({ at: 0, parts }, 4096).dropped.length, lines.length);
});

test('answers lose what the package knows', () => {
    const link = '#v=1&x=abc&rules=F%20-%3E%20FF&n=3&by=Ada&hand=0';
    // The name stays: it decides on the student's variant.
    assert.equal(fieldsIn(link), 'rules=F%20-%3E%20FF&n=3&by=Ada');
    assert.equal(linkOf({ id: '0000000a', mark: 12, fields: 'n=3' }), '#v=1&k=0000000a&mark=12&n=3');
});

test('times are those of the standard', () => {
    assert.equal(clockTime(0), '0000:00:00.00');
    assert.equal(clockTime(3725.29), '0001:02:05.29');
    assert.equal(clockTime(59.999), '0000:01:00.00');
    assert.equal(clockTime(4e9), '9999:06:40.00');
});

const LINK = '#v=1&k=0000000a&mark=solved&n=3';

/** @param {'1.2' | '2004'} standard @param {Partial<import('../scorm-stand-in.mjs').Faults>} [faults] */
function opened(standard, faults = {}) {
    const system = createStandIn(standard, faults);
    let time = 1000;
    // The API is two windows above the page.
    const top = /** @type {any} */ ({ [system.name]: system.api });
    top.parent = top;
    const from = { parent: { parent: top }, opener: null };
    const scorm = createScorm(standard, { from, now: () => time });
    return { system, scorm, wait: (/** @type {number} */ by) => (time += by) };
}

test('SCORM 1.2 gets status, score, time, state and answers', () => {
    const { system, scorm, wait } = opened('1.2');
    assert.equal(scorm.open(), null);
    assert.deepEqual(scorm.read(), {
        state: '',
        student: 'student-1',
        name: 'Muster, Anna',
        isGraded: true,
        isPassed: false,
    });
    assert.equal(scorm.tell({ part: null, isPassed: false, answers: [] }), null);
    assert.equal(system.kept['cmi.core.lesson_status'], 'incomplete');
    assert.equal(system.kept['cmi.core.score.raw'], '');
    wait(61_500);
    assert.ok(scorm.keeps('l-system 1 at=0'));
    assert.equal(scorm.tell({ part: 1, isPassed: true, answers: [{ id: 'e-1', link: LINK, isRight: true }] }), null);
    assert.equal(system.kept['cmi.core.lesson_status'], 'passed');
    assert.equal(system.kept['cmi.core.score.raw'], '100');
    assert.equal(system.kept['cmi.core.score.max'], '100');
    assert.equal(system.kept['cmi.core.session_time'], '0000:01:01.50');
    assert.equal(system.kept['cmi.core.exit'], 'suspend');
    assert.equal(system.kept['cmi.interactions.0.student_response'], LINK);
    assert.equal(system.kept['cmi.interactions.0.result'], 'correct');
    scorm.close();
    assert.equal(system.state, 'ended');
    assert.deepEqual(system.wrong, []);
});

test('SCORM 2004 gets completion and success apart, and a scaled score', () => {
    const { system, scorm, wait } = opened('2004');
    assert.equal(scorm.open(), null);
    wait(61_500);
    const answers = [{ id: 'e-1', link: LINK, isRight: false }];
    assert.equal(scorm.tell({ part: 1 / 3, isPassed: false, answers }), null);
    assert.equal(system.kept['cmi.completion_status'], 'incomplete');
    assert.equal(system.kept['cmi.success_status'], 'unknown');
    assert.equal(system.kept['cmi.score.raw'], '33');
    assert.equal(system.kept['cmi.score.scaled'], '0.3333');
    assert.equal(system.kept['cmi.session_time'], 'PT61.5S');
    assert.equal(system.kept['cmi.interactions.0.result'], 'incorrect');
    scorm.tell({ part: 1, isPassed: true, answers });
    assert.equal(system.kept['cmi.completion_status'], 'completed');
    assert.equal(system.kept['cmi.success_status'], 'passed');
    assert.deepEqual(system.wrong, []);
});

test('answers that are too long for an interaction stay out of it', () => {
    const { system, scorm } = opened('1.2');
    scorm.open();
    scorm.tell({ part: 0, isPassed: false, answers: [{ id: 'e-1', link: LINK.padEnd(256, 'F'), isRight: false }] });
    assert.equal(system.kept['cmi.interactions.0.student_response'], undefined);
    assert.equal(system.kept['cmi.interactions.0.result'], 'wrong');
    assert.deepEqual(system.wrong, []);
});

for (const standard of /** @type {const} */ (['1.2', '2004'])) {
    test(`faults of a learning system by SCORM ${standard} are sentences`, () => {
        const told = { part: 0, isPassed: false, answers: [] };
        const none = createScorm(standard, { from: { opener: null, parent: null } });
        assert.equal(none.open(), '');
        const silent = opened(standard, { isSilent: true });
        assert.equal(silent.scorm.open(), 'it gives no reason');
        const refusing = opened(standard, { refuses: 1 });
        refusing.scorm.open();
        assert.match(refusing.scorm.tell(told) ?? '', /General/i);
        assert.equal(refusing.scorm.tell(told), null, 'the second time it keeps them');
        const throwing = opened(standard, { throws: true });
        throwing.scorm.open();
        assert.equal(typeof throwing.scorm.tell(told), 'string');
        const short = opened(standard, { quota: 100 });
        short.scorm.open();
        assert.equal(short.scorm.keeps('x'.repeat(101)), false);
        assert.equal(short.scorm.keeps('x'.repeat(100)), true);
        const cutting = opened(standard, { cuts: 50 });
        cutting.scorm.open();
        assert.equal(cutting.scorm.keeps('x'.repeat(51)), false, 'cut without a word');
    });

    test(`a page that is reloaded alone goes on by SCORM ${standard}`, () => {
        const { system, scorm } = opened(standard);
        scorm.open();
        const anew = createScorm(standard, { from: { [system.name]: system.api, opener: null } });
        assert.equal(anew.open(), null);
        assert.equal(anew.tell({ part: null, isPassed: false, answers: [] }), null);
    });
}

test('what a learning system says is cut', () => {
    const said = 'x'.repeat(2_000_000);
    const answers = { Initialize: 'true', GetValue: said, SetValue: 'false', Commit: 'false', GetErrorString: said };
    const api = Object.fromEntries(
        Object.entries({ ...answers, GetLastError: '7' }).map(([name, value]) => [`LMS${name}`, () => value]),
    );
    const scorm = createScorm('1.2', { from: { API: api, opener: null } });
    assert.equal(scorm.open(), null);
    assert.equal(scorm.read().state.length, scorm.longest);
    assert.ok(scorm.read().student.length < 1000);
    assert.ok(String(scorm.tell({ part: 0, isPassed: false, answers: [] })).length < 1000);
});

test('a window of another origin hides no error and no learning system', () => {
    const system = createStandIn('1.2', {});
    const foreign = {
        get API() {
            throw new Error('another origin');
        },
    };
    const beside = { API: system.api };
    assert.equal(createScorm('1.2', { from: { parent: foreign, opener: null } }).open(), '');
    assert.equal(createScorm('1.2', { from: { parent: foreign, opener: beside } }).open(), null);
});
