/** Sound by length: all branches at their own times, on the playback bar in place of the segments. */

import { say } from '../words.js';

/** Notes are handed to the sound card this long before they sound, and this often, in seconds. */
const [AHEAD, EVERY] = [0.2, 0.03];

/** @typedef {import('../protocol.js').Tune} Tune */
/** @typedef {import('../protocol.js').Note} Note */

/** A time as minutes and seconds. @param {number} seconds */
export const timeText = (seconds) => `${Math.floor(seconds / 60)}:${String(Math.floor(seconds % 60)).padStart(2, '0')}`;

/** The notes that sound at a time in steps. @param {readonly Note[]} notes @param {number} at */
export const soundingAt = (notes, at) => notes.filter(({ start, length }) => start <= at && at < start + length);

/**
 * @param {object} page
 * @param {() => number} page.now seconds of the sound card
 * @param {(note: Note, at: number, seconds: number) => void} page.play
 * @param {() => void} page.hush
 * @param {(show: import('../playback.js').Show | null) => void} page.present
 * @param {(places: number[][]) => void} page.mark marks the places of the notes that sound
 */
export function createTogether({ now, play, hush, present, mark }) {
    /** By start. @type {Tune | null} */
    let tune = null;
    /** The steps that have sounded, when playback does not run. */
    let passed = 0;
    /** When the tune began, or would have begun, on the sound card; null while it does not run. @type {number | null} */
    let began = null;
    /** The next note to hand on. */
    let next = 0;
    let timer = 0;

    const steps = () => (tune && began !== null ? Math.max(0, (now() - began) / tune.step) : passed);

    function tick() {
        if (!tune || began === null) return;
        const { notes, length, step } = tune;
        const until = (now() + AHEAD - began) / step;
        for (; next < notes.length; next++) {
            const note = /** @type {Note} */ (notes[next]);
            if (note.start > until) break;
            play(note, began + note.start * step, note.length * step);
        }
        if (steps() >= length) pause(length);
        else shown();
    }

    function shown() {
        const at = steps();
        mark(soundingAt(tune?.notes ?? [], at).map(({ fitted }) => fitted));
        present(show);
    }

    function run() {
        if (!tune) return;
        if (passed >= tune.length) passed = 0;
        const from = passed;
        began = now() + EVERY - from * tune.step;
        // A note that has begun already is not heard again.
        next = tune.notes.findIndex(({ start }) => start >= from);
        if (next < 0) next = tune.notes.length;
        timer = window.setInterval(tick, 1000 * EVERY);
        tick();
    }

    /** @param {number} at steps */
    function pause(at) {
        clearInterval(timer);
        if (tune && at < tune.length) hush();
        passed = at;
        began = null;
        shown();
    }

    /** @type {import('../playback.js').Show} */
    const show = {
        get playing() {
            return began !== null;
        },
        get part() {
            return tune && tune.length > 0 ? Math.min(1, steps() / tune.length) : 1;
        },
        get words() {
            const step = tune?.step ?? 0;
            return say`${timeText(steps() * step)} of ${timeText((tune?.length ?? 0) * step)} min`;
        },
        toggle() {
            if (began === null) run();
            else pause(steps());
        },
        seek(part) {
            pause(part * (tune?.length ?? 0));
        },
        stop: leave,
        left: () => leave(false),
    };

    /** Ends, with the segments on the bar unless something else is there already. */
    function leave(isLast = true) {
        if (!tune) return;
        clearInterval(timer);
        hush();
        [tune, began, passed] = [null, null, 0];
        mark([]);
        if (isLast) present(null);
    }

    return {
        /** Plays a tune from its beginning. @param {Tune} heard */
        begin(heard) {
            leave(false);
            tune = { ...heard, notes: [...heard.notes].sort((one, other) => one.start - other.start) };
            run();
        },
        leave: () => leave(),
    };
}
