import assert from 'node:assert/strict';
import { test } from 'node:test';
import { filmCode, filmIn, guarded } from '../../js/film/embed-code.js';
import { workersOn } from '../../js/film/frames.js';
import { added, frameAt, moved, numbersOf, stretched, withTrack, written } from '../../js/film/script.js';
import { DEFAULTS } from '../../js/state/state.js';

/** @type {import('../../js/protocol.js').FilmScript} */
const SCRIPT = {
    seconds: 7,
    rate: 25,
    width: 1280,
    height: 720,
    ending: 'repeat',
    easing: 'linear',
    fixed: false,
    frames: 175,
    segment: '',
    tracks: [],
};

/** Growth to a generation within 6.3 seconds. @param {number} n */
const growth = (n) => ({
    subject: 'n',
    keys: [
        { time: 0, value: [0], easing: 'linear' },
        { time: 6.3, value: [n], easing: 'linear' },
    ],
});

/** The core writes the same text: crates/lsystem-film/src/text.rs. */
test('films are texts', () => {
    const dive = {
        subject: 'view',
        keys: [
            { time: 0.35, value: [0, 0, 1], easing: 'smooth' },
            { time: 6.3, value: [0.25, -0.5, 1e19, 1e-18, 0], easing: 'smooth' },
        ],
    };
    const tracks = [growth(40), dive];
    const text = written({ ...SCRIPT, tracks });
    assert.equal(
        text.replace('10000000000000000000', '1e19'),
        '1;7s;25fps;1280x720;repeat;n=0:0,6.3:40;view=0.35:0/0/1~smooth,6.3:0.25/-0.5/1e19/1e-18/0~smooth',
    );
    assert.match(written({ ...SCRIPT, fixed: true, segment: '12', tracks: [growth(7)] }), /;fixed;@12;n=/);
    const fixed = written({ ...SCRIPT, fixed: true, tracks: [growth(7)] });
    assert.equal(fixed, '1;7s;25fps;1280x720;repeat;fixed;n=0:0,6.3:7');
    assert.equal(withTrack({ ...SCRIPT, tracks }, growth(3)).tracks.length, 2);
});

test('keys keep their order', () => {
    const track = growth(40);
    assert.deepEqual(
        added(track, 3.15).keys.map(({ value }) => value),
        [[0], [20], [40]],
    );
    assert.equal(added(track, 6.3), track);
    assert.equal(moved(track, 0, 99, 7).keys[0]?.time, 6.299);
    assert.equal(moved(track, 1, -5, 7).keys[1]?.time, 0.001);
    assert.deepEqual(
        stretched({ ...SCRIPT, tracks: [track] }, 14).tracks[0]?.keys.map(({ time }) => time),
        [0, 12.6],
    );
    assert.deepEqual([numbersOf('1, 2 -3e5'), numbersOf('1 x'), numbersOf('')], [[1, 2, -3e5], null, null]);
});

test('frames follow the time', () => {
    assert.deepEqual(
        [0, 0.05, 6.99, 7, 7.05].map((time) => frameAt(SCRIPT, time)),
        [0, 1, 174, 0, 1],
    );
    assert.equal(frameAt({ ...SCRIPT, ending: 'once' }, 99), 174);
    assert.deepEqual(
        [{}, { hardwareConcurrency: 16 }, { hardwareConcurrency: 16, deviceMemory: 2 }].map(workersOn),
        [1, 4, 1],
    );
});

test('films travel in links', () => {
    const film = '1;n=0:0,2:7~in;rules.Länge=0:1/2';
    assert.equal(filmIn(`#v=1&axiom=F&film=${guarded(film)}`), film);
    assert.deepEqual(['', '#v=1', '#film=%', '#film='].map(filmIn), ['', '', '', '']);
    const code = filmCode(
        { ...DEFAULTS, title: 'A "film" & more' },
        '#v=1&axiom=F',
        film,
        'https://example.org/film.html',
        640,
        360,
    );
    assert.match(
        code,
        /^<iframe src="https:\/\/example\.org\/film\.html#v=1&amp;axiom=F&amp;film=1;n=0:0,2:7~in;rules\.L%C3%A4nge=0:1\/2" title="Film: A &quot;film&quot; &amp; more" width="640" height="360"/,
    );
});
