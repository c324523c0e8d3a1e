/** The playback bar: draws the picture segment by segment. */

import { button, html, input, setText } from './dom.js';
import { grouped, shortText } from './numerals.js';
import { createClock } from './playback/clock.js';
import { createPace } from './playback/pace.js';
import { createSegmentField } from './playback/segment-field.js';
import { REACH, portion, ratio, within } from './reading/places.js';
import { poseText } from './reading/words.js';

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
    const shown = () => upto ?? total ?? 0n;

    const pace = createPace(() => total);
    const clock = createClock({ perSecond: pace.perSecond, advance });
    const bar = createBar({ play: toggle, changed: (open) => (open ? show() : stop()), seek: (part) => total !== null && pauseAt(portion(total, part)) });
    const field = createSegmentField({ total: () => total, shown, seek: pauseAt });

    function show() {
        if (!bar.open) return;
        bar.show({ total, digits, shown: shown(), playing: clock.running });
        field.show();
        pace.show();
        if (upto === null) setText(html('play-pose'), total === null ? '' : total === 0n ? 'Nothing is drawn.' : 'The whole drawing.');
    }

    /** Shows only the first segments; null or all show the whole picture. @param {bigint | null} next */
    function seek(next) {
        upto = next === null || total === null || next >= total ? null : within(next, 0n, total);
        if (upto === null) turtle(null);
        engine.play(upto);
        show();
    }

    /** Pauses at a number of segments. @param {bigint | null} next */
    function pauseAt(next) {
        clock.stop();
        seek(next);
    }

    /** Back to the whole picture. */
    const stop = () => pauseAt(null);

    /** @param {bigint} segments */
    function advance(segments) {
        if (upto === null) return;
        const next = upto + segments;
        if (total !== null && next >= total) clock.stop();
        seek(next);
    }

    /** Plays or pauses. */
    function toggle() {
        if (clock.running) clock.stop();
        else if (total) {
            clock.start();
            seek(upto ?? 0n);
        }
        show();
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

        /** Shows a text in place of the turtle's pose, during growth. @param {string} words */
        tell(words) {
            setText(html('play-pose'), words);
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
            if (upto === null || drawn === null) return turtle(null);
            if (!pose) return;
            turtle({ at: pose.fitted, heading: pose.heading });
            setText(html('play-pose'), poseText(pose));
        },
    };
}

/**
 * The bar itself: opening and closing, the play button, and the slider over the whole drawing.
 * @param {{play: () => void, changed: (open: boolean) => void, seek: (part: number) => void}} playback
 */
function createBar({ play, changed, seek }) {
    const bar = html('playback');
    const toggle = button('open-playback');
    const player = button('play');
    const slider = input('play-slider');
    let open = false;

    /** @param {boolean} next */
    function set(next) {
        if (open === next) return;
        open = next;
        document.body.classList.toggle('playing', open);
        toggle.setAttribute('aria-expanded', String(open));
        bar.hidden = !open;
        changed(open);
    }

    toggle.addEventListener('click', () => {
        set(!open);
        if (!open) return;
        play();
        player.focus({ preventScroll: true });
    });
    button('close-playback').addEventListener('click', () => {
        set(false);
        toggle.focus();
    });
    player.addEventListener('click', play);
    bar.addEventListener('keydown', (event) => {
        if (event.key === 'Escape') button('close-playback').click();
    });
    slider.addEventListener('input', () => seek(Number(slider.value) / SLIDER_POSITIONS));

    return {
        get open() {
            return open;
        },
        set,

        /** @param {{total: bigint | null, digits: string, shown: bigint, playing: boolean}} state */
        show({ total, digits, shown, playing }) {
            slider.disabled = !total;
            player.disabled = slider.disabled;
            const part = total ? ratio(shown, total) : 1;
            if (Number(slider.value) !== Math.floor(part * SLIDER_POSITIONS)) slider.value = String(Math.floor(part * SLIDER_POSITIONS));
            slider.style.setProperty('--at', String(part));
            slider.setAttribute('aria-valuetext', `${shortText(String(shown))} of ${digits ? shortText(digits) : '…'} segments`);
            setText(html('play-total'), digits ? `of ${shortText(digits)}` : '');
            html('play-total').title = digits ? `${grouped(digits)} segments${total === REACH ? ', of which the first 3.4 × 10³⁸ can be played' : ''}` : '';
            player.setAttribute('aria-label', playing ? 'Pause' : 'Play');
            player.classList.toggle('playing', playing);
            /** @type {SVGUseElement} */ (player.querySelector('use')).setAttribute('href', playing ? '#i-pause' : '#i-play');
        },
    };
}
