/** Scripts of films as text, and values between keys. Pure functions. docs/films.md describes the text. */

import { say } from '../base/words.js';

/** @typedef {import('../protocol.js').FilmScript} FilmScript */
/** @typedef {import('../protocol.js').FilmTrack} FilmTrack */
/** @typedef {import('../protocol.js').FilmKey} FilmKey */

/** The names of paces and endings, with their words on the page. @type {readonly (readonly [string, string])[]} */
export const EASINGS = [
    ['linear', say`Linear`],
    ['smooth', say`Smooth`],
    ['in', say`Slow start`],
    ['out', say`Slow end`],
    ['hold', say`Hold`],
];
/** @type {readonly (readonly [string, string])[]} */
export const ENDINGS = [
    ['repeat', say`Repeat`],
    ['bounce', say`Back and forth`],
    ['once', say`Play once`],
];
/** @type {readonly (readonly [string, string])[]} */
export const SIZES = [
    ['640x360', '640 × 360'],
    ['1280x720', '1280 × 720'],
    ['1920x1080', '1920 × 1080'],
    ['720x720', '720 × 720'],
    ['1080x1080', '1080 × 1080'],
    ['1080x1920', '1080 × 1920'],
];

/** @param {number} value */
const numeral = (value) => String(Math.abs(value) < 1e21 ? value : value.toExponential()).replace('e+', 'e');
/** A time to a thousandth of a second. @param {number} seconds */
export const rounded = (seconds) => Math.round(seconds * 1000) / 1000;

/** The text of a script. @param {Omit<FilmScript, 'frames'>} script */
export function written({ seconds, rate, width, height, ending, easing, fixed, segment, tracks }) {
    const key = (/** @type {FilmKey} */ { time, value, easing: own }) =>
        `${numeral(time)}:${value.map(numeral).join('/')}${own === easing ? '' : `~${own}`}`;
    const parts = tracks.map(({ subject, keys }) => `${subject}=${keys.map(key).join()}`);
    return [
        '1',
        `${numeral(seconds)}s`,
        `${rate}fps`,
        `${width}x${height}`,
        ending,
        ...(easing === 'linear' ? [] : [`ease=${easing}`]),
        ...(fixed ? ['fixed'] : []),
        ...(segment ? [`@${segment}`] : []),
        ...parts,
    ].join(';');
}

/** A script with a track in place of the one of the same subject. @param {FilmScript} script @param {FilmTrack} track @returns {FilmScript} */
export function withTrack(script, track) {
    const others = script.tracks.filter(({ subject }) => subject !== track.subject);
    return { ...script, tracks: [...others, track] };
}

/** A script whose length is changed together with the times of its keys. @param {FilmScript} script @param {number} seconds @returns {FilmScript} */
export function stretched(script, seconds) {
    const factor = seconds / script.seconds;
    const longer = (/** @type {FilmKey} */ key) => ({ ...key, time: rounded(key.time * factor) });
    return { ...script, seconds, tracks: script.tracks.map((track) => ({ ...track, keys: track.keys.map(longer) })) };
}

/**
 * A track with a key moved in time, but not beyond its neighbours.
 * @param {FilmTrack} track
 * @param {number} at
 * @param {number} time
 * @param {number} seconds of the film
 * @returns {FilmTrack}
 */
export function moved(track, at, time, seconds) {
    const low = at > 0 ? (track.keys[at - 1]?.time ?? 0) + 0.001 : 0;
    const high = (track.keys[at + 1]?.time ?? seconds + 0.001) - 0.001;
    const keys = track.keys.map((key, index) =>
        index === at ? { ...key, time: rounded(Math.max(low, Math.min(high, time))) } : key,
    );
    return { ...track, keys };
}

/**
 * A track with a further key at a time, whose value lies between its neighbours'; the track itself if a key is there.
 * @param {FilmTrack} track
 * @param {number} time
 * @returns {FilmTrack}
 */
export function added(track, time) {
    const next = track.keys.findIndex((key) => key.time >= time);
    const [before, after] = next === -1 ? [track.keys.at(-1), undefined] : [track.keys[next - 1], track.keys[next]];
    if (!before && !after) return track;
    if (after && Math.abs(after.time - time) < 0.001) return track;
    const one = before ?? after;
    const part = before && after ? (time - before.time) / (after.time - before.time) : 0;
    const value =
        before && after && before.value.length === after.value.length
            ? before.value.map((from, at) => from + ((after.value[at] ?? from) - from) * part)
            : [...(one?.value ?? [])];
    // A thousandth of the range is as fine as a key needs to be.
    const short = value.map((number) => Number(number.toPrecision(6)));
    const keys = [
        ...track.keys,
        {
            time: rounded(time),
            value: track.subject === 'seed' ? short.map(Math.floor) : short,
            easing: one?.easing ?? 'linear',
        },
    ];
    return { ...track, keys: keys.sort((a, b) => a.time - b.time) };
}

/** The frame at a time of playing, in seconds since the start. @param {FilmScript} script @param {number} time */
export function frameAt({ frames, rate, ending }, time) {
    const frame = Math.max(0, Math.floor(time * rate));
    return ending === 'once' ? Math.min(frames - 1, frame) : frame % frames;
}

/** Numbers as typed, separated by blanks, commas or slashes; null if one is no number. @param {string} text */
export function numbersOf(text) {
    const numbers = text
        .trim()
        .split(/[\s,/]+/)
        .map((part) => (part === '' ? NaN : Number(part)));
    return numbers.every(Number.isFinite) ? numbers : null;
}
