/** Damaged and malicious links; `keeps` is the part of the state that survives. */

import { deflateSync } from 'node:zlib';

/** @typedef {{name: string, hash: string, keeps?: object}} Hostile */

/** @param {string | Uint8Array} bytes @param {number} [level] */
const pack = (bytes, level = 9) => deflateSync(bytes, { level }).toString('base64url');

const WHOLE = 'axiom=X&rules=X -> F[+X]F[-X]+X\nF -> FF&n=5&angle=25.7&palette=010203,040506&view=0.1,0.2,3';
const PACKED = pack(WHOLE);

/** Property names of object prototypes, and other special names. */
const WORDS = [
    '__proto__',
    'constructor',
    'prototype',
    'hasOwnProperty',
    'toString',
    'valueOf',
    'undefined',
    'null',
    'NaN',
    'true',
];

const HUGE = [
    '1e999',
    '-1e999',
    '9'.repeat(41),
    `${'1'.repeat(400_000)}x`,
    `1e${'9'.repeat(400_000)}`,
    `.${'0'.repeat(400_000)}1`,
    '-'.repeat(400_000),
];

const NO_NUMBERS = [
    '',
    ' ',
    'abc',
    '0x10',
    '1_000',
    '1e',
    'e5',
    '--5',
    '1 2',
    '٣',
    '½',
    '1,5',
    'Infinity',
    '-Infinity',
    '[1]',
    '{"valueOf":1}',
    '1;alert(1)',
    '0b11',
    '1n',
];

/** Invalid UTF-8 and percent escapes. */
const JUNK = [
    '%',
    '%2',
    '%zz',
    '%E0%A4%A',
    '%C0%AF',
    '%ED%A0%80',
    '%F4%90%80%80',
    '%80',
    '%FF%FE',
    '%u0041',
    'F%',
    `${'%'.repeat(300_000)}`,
    `${'%F0%9F'.repeat(60_000)}`,
];

/** @param {string} name @param {string} hash @param {object} [keeps] @returns {Hostile} */
const link = (name, hash, keeps = {}) => ({ name, hash, keeps });

/** Each of them is told to the reader. @type {Hostile[]} */
export const DAMAGED = [
    ...['n', 'angle', 'right', 'heading', 'step', 'seed', 'width', 'thin'].map((key) =>
        link(`${key} is no number`, `#v=1&axiom=F&${key}=x`, { axiom: 'F' }),
    ),
    ...NO_NUMBERS.map((value) => link(`angle=${value}`, `#v=1&axiom=F&angle=${value}`, { axiom: 'F' })),
    ...HUGE.map((value) => link(`n=${value}`, `#v=1&axiom=F&n=${value}`, { axiom: 'F' })),
    ...JUNK.map((value) => link(`rules=${value}`, `#v=1&axiom=F&rules=${value}`, { axiom: 'F' })),
    ...WORDS.flatMap((word) => [
        link(`turtle=${word}`, `#v=1&axiom=F&turtle=${word}&__proto__=1`, { axiom: 'F' }),
        link(`colour=${word}`, `#v=1&colour=${word}&constructor=x`),
        link(`bg=${word}`, `#bg=${word}`),
    ]),
    link('n beyond its bounds', '#v=1&n=1001', { iterations: 1000 }),
    link('n below its bounds', '#v=1&n=-1', { iterations: 0 }),
    link('n no whole number', '#v=1&n=3.5', { iterations: 4 }),
    link('seed beyond its bounds', '#v=1&seed=4294967296', { seed: 4294967295 }),
    link('seed of 10^308', '#v=1&seed=1e308', { seed: 4294967295 }),
    link('step of nothing', '#v=1&step=0', { step: 1e-9 }),
    link('start of one', '#v=1&start=1'),
    link('start of three', '#v=1&start=1,2,3'),
    link('start of many', `#v=1&start=${'1,'.repeat(200_000)}`),
    link('view of two', '#v=1&view=1,2'),
    link('view of four', '#v=1&view=1,2,3,x'),
    link('view of many', `#v=1&view=${'1,'.repeat(200_000)}`),
    link('view beyond numbers', '#v=1&view=1e308,-1e308,1e308', { view: { x: 1e6, y: -1e6, zoom: 1e25 } }),
    link('view of infinity', '#v=1&view=1e309,0,1'),
    link('view without room', '#v=1&view=0,0,0', { view: { x: 0, y: 0, zoom: 0.01 } }),
    link('palette of commas', '#v=1&palette=,,,,'),
    link('palette of nothing', '#v=1&palette='),
    link('palette of many', `#v=1&palette=${'ffffff,'.repeat(60_000)}000000`, { palette: Array(256).fill('#ffffff') }),
    link('palette with a name', '#v=1&palette=ff0000,red'),
    link('background as a rule', '#v=1&bg=fff;background:url(//x.test)'),
    link('background as a short form', '#v=1&bg=fff'),
    link('background as an expression', '#v=1&bg=${alert(1)}'),
    link('an axiom too long', `#v=1&axiom=${'F'.repeat(1_400_000)}`, { axiom: 'F'.repeat(1 << 20) }),
    link('rules too long', `#v=1&rules=${'%F0%9F%8C%BF'.repeat(40_000)}`, { rules: '🌿'.repeat(25_000) }),
    link('a title too long', `#v=1&title=${'T'.repeat(201)}`, { title: 'T'.repeat(200) }),
    link('half a surrogate pair', '#v=1&axiom=F\ud800F&title=\udc00', { axiom: 'F\ufffdF', title: '\ufffd' }),
    link('longer than any link', `#v=1&axiom=${'F'.repeat(2_100_000)}`),
    link('longer than any link, in parts', `#v=1${'&axiom=F'.repeat(300_000)}`),
    link('many fields, each damaged', `#v=1${'&axiom=%'.repeat(60_000)}`),
    link('many versions', `#v=2${'&v=2'.repeat(100_000)}`),
    link('another version', '#v=99&axiom=F', { axiom: 'F' }),
    link('a negative version', '#v=-1'),
    link('a version in words', '#v=one'),
    link('a version without a number', '#v='),
    link('packed: nothing', '#v=1&z='),
    link('packed: no base64url', '#v=1&z=====&n=3', { iterations: 3 }),
    link('packed: base64', `#v=1&z=${PACKED}+/`),
    link('packed: percent junk', '#v=1&z=%zz&n=3', { iterations: 3 }),
    link('packed: one character', '#v=1&z=e'),
    link('packed: not compressed at all', `#v=1&z=${Buffer.from(WHOLE).toString('base64url')}`),
    link('packed: a picture', `#v=1&z=${Buffer.from('\x89PNG\r\n\x1a\n').toString('base64url')}`),
    link('packed: not UTF-8', `#v=1&z=${pack(Uint8Array.of(0x61, 0x3d, 0xff, 0xfe))}`),
    link('packed: percent junk inside', `#v=1&z=${pack('axiom=F&rules=%zz%')}`, { axiom: 'F' }),
    link('packed: huge numbers inside', `#v=1&z=${pack('axiom=F&n=1e999&angle=-1e999')}`, { axiom: 'F' }),
    link('packed: prototype names inside', `#v=1&z=${pack('__proto__=1&turtle=__proto__&colour=constructor')}`),
    link('packed: a bomb of letters', `#v=1&z=${pack(Buffer.alloc(300 << 20, 'F'))}`),
    link('packed: a bomb of an axiom', `#v=1&z=${pack(`axiom=${'F'.repeat(100 << 20)}`)}`),
    link('packed: a bomb of separators', `#v=1&z=${pack('&'.repeat(100 << 20))}`),
    link('packed: a bomb of fields', `#v=1&z=${pack('axiom=F&'.repeat(10 << 20))}`),
    link('packed: just beyond the limit', `#v=1&z=${pack(`notes=${'N'.repeat((4 << 20) + 1024)}`)}`),
    link('packed: many small fields', `#v=1&z=${pack('n=x&'.repeat(120 << 10))}`),
    link('packed: a text too long', `#v=1&z=${pack(`axiom=${'F'.repeat(1_100_000)}`)}`, { axiom: 'F'.repeat(1 << 20) }),
    link('packed: a number too long', `#v=1&z=${pack(`n=${'1'.repeat(500_000)}x`)}`),
    ...Array.from({ length: 12 }, (_, at) =>
        link(`packed: cut after ${at}/12`, `#v=1&z=${PACKED.slice(0, Math.floor((PACKED.length * at) / 12))}`),
    ),
    ...Array.from({ length: 12 }, (_, at) => {
        const place = 3 + Math.floor(((PACKED.length - 6) * at) / 12);
        const other = PACKED[place] === 'A' ? 'Q' : 'A';
        return link(
            `packed: changed at ${place}`,
            `#v=1&z=${PACKED.slice(0, place)}${other}${PACKED.slice(place + 1)}`,
        );
    }),
];

/** Texts that would run if interpreted as markup or code. */
export const SCRIPTS = [
    '<script>alert(1)</script>',
    '<img src=x onerror=alert(1)>',
    '"><svg onload=alert(1)>',
    'javascript:alert(1)',
    '${alert(1)}',
    '{{constructor.constructor("alert(1)")()}}',
    "');alert(1);//",
    '</textarea><script>alert(1)</script>',
    '</title><script>alert(1)</script>',
    '\u202ealert\u2066',
    '\0\u0001\u001b[31m',
];
