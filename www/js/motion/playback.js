/** The playback bar: draws the picture segment by segment. */

import { button, html, input, reducedMotion, setText } from '../base/dom.js';
import { grouped, shortText } from '../base/numerals.js';
import { createClock } from './clock.js';
import { createPace } from './pace.js';
import { createSegmentField } from './segment-field.js';
import { REACH, REACH_TEXT, portion, ratio, within } from '../reading/places.js';
import { poseText } from '../reading/words.js';
import { createToggled } from '../base/toggled.js';
import { counted, say } from '../base/words.js';

/** What the bar plays in place of the segments; `left` is called when something else takes its place. @typedef {{readonly playing: boolean, readonly part: number, readonly words: string, toggle: () => void, seek: (part: number) => void, stop: () => void, left?: () => void}} Show */

/** The number of slider positions. */
const SLIDER_POSITIONS = 10_000;

/**
 * The bar and the segments that it shows.
 * @typedef {object} Playback
 * @property {import('../engine/engine.js').Engine} engine
 * @property {(pose: import('../view/marks.js').FittedPose | null) => void} turtle
 * @property {bigint | null} total The number of segments that can be played, null while unknown, and the exact number of segments
 * @property {string} digits
 * @property {bigint | null} upto The number of segments shown; null for the whole picture
 * @property {Show | null} other What the bar plays in place of the segments
 * @property {ReturnType<typeof createPace>} pace
 * @property {ReturnType<typeof createClock>} clock
 * @property {ReturnType<typeof createBar>} bar
 * @property {ReturnType<typeof createSegmentField>} field
 */

/**
 * @param {import('../engine/engine.js').Engine} engine
 * @param {{turtle: (pose: import('../view/marks.js').FittedPose | null) => void, offered?: () => boolean}} page
 */
export function createPlayback(engine, { turtle, offered = () => true }) {
    const pace = createPace(() => self.total);
    const clock = createClock({ perSecond: pace.perSecond, advance: (segments) => advance(self, segments) });
    const bar = createBar({
        play: () => toggle(self),
        changed: (open) => (open ? show(self) : close(self)),
        seek: (part) => seek(self, part),
    });
    const field = createSegmentField({
        total: () => self.total,
        shown: () => shown(self),
        seek: (next) => pauseAt(self, next),
    });
    /** @type {Playback} */
    const self = { engine, turtle, total: null, digits: '', upto: null, other: null, pace, clock, bar, field };

    html('drawing').addEventListener('keydown', (event) => {
        if (event.key !== ' ' || !offered() || event.ctrlKey || event.metaKey || event.altKey) return;
        event.preventDefault();
        if (event.repeat) return;
        bar.set(true);
        toggle(self);
    });

    return {
        /** The number of segments shown; null for all. */
        get upto() {
            return self.upto;
        },

        /** Plays or pauses. @param {boolean} on */
        setPlaying(on) {
            if (on === clock.running || (on && !offered())) return;
            if (on) bar.set(true);
            toggle(self);
        },

        close: () => bar.set(false),
        stop: () => stop(self),

        /** What the bar plays in place of the segments. */
        get presented() {
            return self.other;
        },

        /** Plays something else in place of the segments, or the segments again. @param {Show | null} next */
        present(next) {
            if (next !== self.other) self.other?.left?.();
            self.other = next;
            if (next) bar.set(true);
            show(self);
        },

        /** The drawing has changed: goes back to the whole picture. */
        forget() {
            self.total = null;
            self.digits = '';
            pace.forget();
            stop(self);
        },

        /** @param {import('../protocol.js').Report} report */
        report({ ok, segments, memoised }) {
            if (!ok || segments === null || memoised === null) return;
            self.digits = segments;
            self.total = within(BigInt(segments), 0n, REACH);
            show(self);
        },

        /** @param {import('../engine/engine.js').Drawn} picture */
        drawn({ pose, upto: drawn }) {
            if (self.upto === null || drawn === null) turtle(null);
            else if (pose) follow(self, pose);
        },
    };
}

/** @param {Playback} self */
const shown = (self) => self.upto ?? self.total ?? 0n;

/** @param {Playback} self */
function show(self) {
    if (!self.bar.open) return;
    html('playback').classList.toggle('other', self.other !== null);
    if (self.other) {
        setText(html('play-pose'), '');
        return self.bar.show({
            part: self.other.part,
            playing: self.other.playing,
            words: self.other.words,
            total: self.other.words,
            title: '',
        });
    }
    const title = self.digits
        ? self.total === REACH
            ? say`${grouped(self.digits)} segments, of which the first ${REACH_TEXT} can be played`
            : counted(Number(self.digits), '{1} segments', '{1} segments', grouped(self.digits))
        : '';
    const words = say`${shortText(String(shown(self)))} of ${self.digits ? shortText(self.digits) : '…'} segments`;
    self.bar.show({
        part: self.total ? ratio(shown(self), self.total) : null,
        playing: self.clock.running,
        words,
        total: self.digits ? say`of ${shortText(self.digits)}` : '',
        title,
    });
    self.field.show();
    self.pace.show();
    if (self.upto === null)
        setText(
            html('play-pose'),
            self.total === null ? '' : self.total === 0n ? say`Nothing is drawn.` : say`The whole drawing.`,
        );
}

/** @param {Playback} self @param {number} part of the whole, from 0 to 1 */
function seek(self, part) {
    if (self.other) self.other.seek(part);
    else if (self.total !== null) pauseAt(self, portion(self.total, part));
}

/**
 * Shows only the first segments; null or all show the whole picture.
 * @param {Playback} self
 * @param {bigint | null} next
 */
function showFirst(self, next) {
    self.upto = next === null || self.total === null || next >= self.total ? null : within(next, 0n, self.total);
    if (self.upto === null) self.turtle(null);
    self.engine.play(self.upto);
    const walk = { upto: self.upto, perSecond: self.clock.running ? self.pace.perSecond() : 0 };
    html('drawing').dispatchEvent(new CustomEvent('walk', { detail: walk }));
    show(self);
}

/** Pauses at a number of segments. @param {Playback} self @param {bigint | null} next */
function pauseAt(self, next) {
    self.clock.stop();
    showFirst(self, next);
}

/** @param {Playback} self */
function close(self) {
    self.other?.stop();
    stop(self);
}

/** Back to the whole picture. @param {Playback} self */
const stop = (self) => pauseAt(self, null);

/** @param {Playback} self @param {bigint} segments */
function advance(self, segments) {
    if (self.upto === null) return;
    const next = self.upto + segments;
    if (self.total !== null && next >= self.total) self.clock.stop();
    showFirst(self, next);
}

/** Plays or pauses. @param {Playback} self */
function toggle(self) {
    if (self.other) return self.other.toggle();
    if (self.clock.running) self.clock.stop();
    else if (self.total) {
        self.clock.start();
        showFirst(self, self.upto ?? 0n);
    }
    show(self);
}

/** Shows where the turtle is. @param {Playback} self @param {import('../protocol.js').Pose} pose */
function follow(self, pose) {
    self.turtle({ at: pose.fitted, heading: pose.heading });
    setText(html('play-pose'), poseText(pose));
}

/**
 * The bar itself: the play button, and the slider over the whole drawing.
 * @param {{play: () => void, changed: (open: boolean) => void, seek: (part: number) => void}} playback
 */
function createBar({ play, changed, seek }) {
    const bar = createToggled('playback', 'playing', changed);
    const player = button('play');
    const slider = input('play-slider');
    bar.onOpener(() => {
        // With reduced motion the reader starts.
        if (!reducedMotion()) play();
        player.focus({ preventScroll: true });
    });
    player.addEventListener('click', play);
    slider.addEventListener('input', () => seek(Number(slider.value) / SLIDER_POSITIONS));

    return {
        get open() {
            return bar.open;
        },
        set: bar.set,

        /** `part` is null while there is nothing to play; `words` tell the position. @param {{part: number | null, playing: boolean, words: string, total: string, title: string}} state */
        show({ part: known, playing, words, total, title }) {
            slider.disabled = known === null;
            player.disabled = slider.disabled;
            const part = known ?? 1;
            if (Number(slider.value) !== Math.floor(part * SLIDER_POSITIONS))
                slider.value = String(Math.floor(part * SLIDER_POSITIONS));
            slider.style.setProperty('--at', String(part));
            slider.setAttribute('aria-valuetext', words);
            setText(html('play-total'), total);
            html('play-total').title = title;
            player.setAttribute('aria-label', playing ? say`Pause` : say`Play`);
            player.classList.toggle('playing', playing);
            /** @type {SVGUseElement} */ (player.querySelector('use')).setAttribute(
                'href',
                playing ? '#i-pause' : '#i-play',
            );
        },
    };
}
