/** The playback bar: draws the picture segment by segment. */

import { button, html, input, reducedMotion, setText } from './dom.js';
import { grouped, shortText } from './numerals.js';
import { createClock } from './playback/clock.js';
import { createPace } from './playback/pace.js';
import { createSegmentField } from './playback/segment-field.js';
import { REACH, REACH_TEXT, portion, ratio, within } from './reading/places.js';
import { poseText } from './reading/words.js';
import { createToggled } from './toggled.js';
import { counted, say } from './words.js';

/** What the bar plays in place of the segments; `left` is called when something else takes its place. @typedef {{readonly playing: boolean, readonly part: number, readonly words: string, toggle: () => void, seek: (part: number) => void, stop: () => void, left?: () => void}} Show */

/** The number of slider positions. */
const SLIDER_POSITIONS = 10_000;

/**
 * @param {import('./engine.js').Engine} engine
 * @param {{turtle: (pose: import('./marks.js').FittedPose | null) => void, offered?: () => boolean}} page
 */
export function createPlayback(engine, { turtle, offered = () => true }) {
    /** The number of segments that can be played, null while unknown, and the exact number of segments. @type {bigint | null} */
    let total = null;
    let digits = '';
    /** The number of segments shown; null for the whole picture. @type {bigint | null} */
    let upto = null;
    /** What the bar plays in place of the segments. @type {Show | null} */
    let other = null;
    const shown = () => upto ?? total ?? 0n;

    const pace = createPace(() => total);
    const clock = createClock({ perSecond: pace.perSecond, advance });
    const bar = createBar({ play: toggle, changed: (open) => (open ? show() : close()), seek });
    const field = createSegmentField({ total: () => total, shown, seek: pauseAt });

    function show() {
        if (!bar.open) return;
        html('playback').classList.toggle('other', other !== null);
        if (other) {
            setText(html('play-pose'), '');
            return bar.show({
                part: other.part,
                playing: other.playing,
                words: other.words,
                total: other.words,
                title: '',
            });
        }
        const title = digits
            ? total === REACH
                ? say`${grouped(digits)} segments, of which the first ${REACH_TEXT} can be played`
                : counted(Number(digits), '{1} segments', '{1} segments', grouped(digits))
            : '';
        const words = say`${shortText(String(shown()))} of ${digits ? shortText(digits) : '…'} segments`;
        bar.show({
            part: total ? ratio(shown(), total) : null,
            playing: clock.running,
            words,
            total: digits ? say`of ${shortText(digits)}` : '',
            title,
        });
        field.show();
        pace.show();
        if (upto === null)
            setText(
                html('play-pose'),
                total === null ? '' : total === 0n ? say`Nothing is drawn.` : say`The whole drawing.`,
            );
    }

    /** @param {number} part of the whole, from 0 to 1 */
    function seek(part) {
        if (other) other.seek(part);
        else if (total !== null) pauseAt(portion(total, part));
    }

    /** Shows only the first segments; null or all show the whole picture. @param {bigint | null} next */
    function showFirst(next) {
        upto = next === null || total === null || next >= total ? null : within(next, 0n, total);
        if (upto === null) turtle(null);
        engine.play(upto);
        const walk = { upto, perSecond: clock.running ? pace.perSecond() : 0 };
        html('drawing').dispatchEvent(new CustomEvent('walk', { detail: walk }));
        show();
    }

    /** Pauses at a number of segments. @param {bigint | null} next */
    function pauseAt(next) {
        clock.stop();
        showFirst(next);
    }

    function close() {
        other?.stop();
        stop();
    }

    /** Back to the whole picture. */
    const stop = () => pauseAt(null);

    /** @param {bigint} segments */
    function advance(segments) {
        if (upto === null) return;
        const next = upto + segments;
        if (total !== null && next >= total) clock.stop();
        showFirst(next);
    }

    /** Plays or pauses. */
    function toggle() {
        if (other) return other.toggle();
        if (clock.running) clock.stop();
        else if (total) {
            clock.start();
            showFirst(upto ?? 0n);
        }
        show();
    }

    /** Shows where the turtle is. @param {import('./protocol.js').Pose} pose */
    function follow(pose) {
        turtle({ at: pose.fitted, heading: pose.heading });
        setText(html('play-pose'), poseText(pose));
    }

    html('drawing').addEventListener('keydown', (event) => {
        if (event.key !== ' ' || !offered() || event.ctrlKey || event.metaKey || event.altKey) return;
        event.preventDefault();
        if (event.repeat) return;
        bar.set(true);
        toggle();
    });

    return {
        /** The number of segments shown; null for all. */
        get upto() {
            return upto;
        },

        /** Plays or pauses. @param {boolean} on */
        setPlaying(on) {
            if (on === clock.running || (on && !offered())) return;
            if (on) bar.set(true);
            toggle();
        },

        close: () => bar.set(false),
        stop,

        /** What the bar plays in place of the segments. */
        get presented() {
            return other;
        },

        /** Plays something else in place of the segments, or the segments again. @param {Show | null} next */
        present(next) {
            if (next !== other) other?.left?.();
            other = next;
            if (next) bar.set(true);
            show();
        },

        /** The drawing has changed: goes back to the whole picture. */
        forget() {
            total = null;
            digits = '';
            pace.forget();
            stop();
        },

        /** @param {import('./protocol.js').Report} report */
        report({ ok, segments, memoised }) {
            if (!ok || segments === null || memoised === null) return;
            digits = segments;
            total = within(BigInt(segments), 0n, REACH);
            show();
        },

        /** @param {import('./engine.js').Drawn} picture */
        drawn({ pose, upto: drawn }) {
            if (upto === null || drawn === null) turtle(null);
            else if (pose) follow(pose);
        },
    };
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
