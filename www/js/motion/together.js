/** Sound by length: all branches at their own times, on the playback bar in place of the segments. */

import { say } from '../base/words.js';

/** Notes are handed to the sound card this long before they sound, and this often, in seconds. */
const [AHEAD, EVERY] = [0.2, 0.03];

/** @typedef {import('../protocol.js').Tune} Tune */
/** @typedef {import('../protocol.js').Note} Note */

/** A time as minutes and seconds. @param {number} seconds */
export const timeText = (seconds) => `${Math.floor(seconds / 60)}:${String(Math.floor(seconds % 60)).padStart(2, '0')}`;

/** The notes that sound at a time in steps. @param {readonly Note[]} notes @param {number} at */
export const soundingAt = (notes, at) => notes.filter(({ start, length }) => start <= at && at < start + length);

/**
 * The tune that sounds.
 * @typedef {object} Tuning
 * @property {() => number} now
 * @property {(note: Note, at: number, seconds: number) => void} play
 * @property {() => void} hush
 * @property {(show: import('./playback.js').Show | null) => void} present
 * @property {(places: number[][]) => void} mark
 * @property {Tune | null} tune By start
 * @property {number} passed The steps that have sounded, when playback does not run
 * @property {number | null} began When the tune began, or would have begun, on the sound card; null while it does not run
 * @property {number} next The next note to hand on
 * @property {number} timer
 * @property {import('./playback.js').Show} show
 */

/**
 * @param {object} page
 * @param {() => number} page.now seconds of the sound card
 * @param {(note: Note, at: number, seconds: number) => void} page.play
 * @param {() => void} page.hush
 * @param {(show: import('./playback.js').Show | null) => void} page.present
 * @param {(places: number[][]) => void} page.mark marks the places of the notes that sound
 */
export function createTogether({ now, play, hush, present, mark }) {
    /** @type {import('./playback.js').Show} */
    const show = {
        get playing() {
            return self.began !== null;
        },
        get part() {
            return self.tune && self.tune.length > 0 ? Math.min(1, steps(self) / self.tune.length) : 1;
        },
        get words() {
            const step = self.tune?.step ?? 0;
            return say`${timeText(steps(self) * step)} of ${timeText((self.tune?.length ?? 0) * step)} min`;
        },
        toggle() {
            if (self.began === null) run(self);
            else pause(self, steps(self));
        },
        seek(part) {
            pause(self, part * (self.tune?.length ?? 0));
        },
        stop: () => leave(self),
        left: () => leave(self, false),
    };
    /** @type {Tuning} */
    const self = { now, play, hush, present, mark, tune: null, passed: 0, began: null, next: 0, timer: 0, show };

    return {
        /** Plays a tune from its beginning. @param {Tune} heard */
        begin(heard) {
            leave(self, false);
            self.tune = { ...heard, notes: [...heard.notes].sort((one, other) => one.start - other.start) };
            run(self);
        },
        leave: () => leave(self),
    };
}

/** @param {Tuning} self */
const steps = (self) =>
    self.tune && self.began !== null ? Math.max(0, (self.now() - self.began) / self.tune.step) : self.passed;

/** @param {Tuning} self */
function tick(self) {
    if (!self.tune || self.began === null) return;
    const { notes, length, step } = self.tune;
    const until = (self.now() + AHEAD - self.began) / step;
    for (; self.next < notes.length; self.next++) {
        const note = /** @type {Note} */ (notes[self.next]);
        if (note.start > until) break;
        self.play(note, self.began + note.start * step, note.length * step);
    }
    if (steps(self) >= length) pause(self, length);
    else shown(self);
}

/** @param {Tuning} self */
function shown(self) {
    const at = steps(self);
    self.mark(soundingAt(self.tune?.notes ?? [], at).map(({ fitted }) => fitted));
    self.present(self.show);
}

/** @param {Tuning} self */
function run(self) {
    if (!self.tune) return;
    if (self.passed >= self.tune.length) self.passed = 0;
    const from = self.passed;
    self.began = self.now() + EVERY - from * self.tune.step;
    // A note that has begun already is not heard again.
    self.next = self.tune.notes.findIndex(({ start }) => start >= from);
    if (self.next < 0) self.next = self.tune.notes.length;
    self.timer = window.setInterval(() => tick(self), 1000 * EVERY);
    tick(self);
}

/** @param {Tuning} self @param {number} at steps */
function pause(self, at) {
    clearInterval(self.timer);
    if (self.tune && at < self.tune.length) self.hush();
    self.passed = at;
    self.began = null;
    shown(self);
}

/** Ends, with the segments on the bar unless something else is there already. @param {Tuning} self */
function leave(self, isLast = true) {
    if (!self.tune) return;
    clearInterval(self.timer);
    self.hush();
    [self.tune, self.began, self.passed] = [null, null, 0];
    self.mark([]);
    if (isLast) self.present(null);
}
