/** The playback bar: draws the picture again from the first segment on, at any number of them. */

import { button, calm, html, input, setText, setValue } from './dom.js';
import { grouped, shortText } from './numerals.js';
import { REACH, pace, paceText, placeText, portion, ratio, readPlace, within } from './reading/places.js';
import { poseText } from './reading/words.js';

/** Positions of the slider. */
const STOPS = 10_000;
const SPEEDS = 1000;
/** The whole drawing takes so many seconds, unless the reader chose a speed. */
const WHOLE = 10;
/** With less motion the picture goes on this often, in milliseconds. */
const CALM_MS = 500;
/** After a longer pause, such as a hidden page, playing goes on from where it was, in milliseconds. */
const GAP = 1000;

/**
 * @param {import('./engine.js').Engine} engine
 * @param {{turtle: (pose: import('./marks.js').Pose | null) => void, offered?: () => boolean}} page
 */
export function createPlayback(engine, { turtle, offered = () => true }) {
    const bar = html('playback');
    const toggle = button('open-playback');
    const play = button('play');
    const slider = input('play-slider');
    const field = input('play-place');
    const speedSlider = input('play-speed');

    let open = false;
    /** Segments that can be played, null while unknown, and all digits of how many there are. @type {bigint | null} */
    let total = null;
    let digits = '';
    /** How many are shown; null for the whole picture. @type {bigint | null} */
    let upto = null;
    /** What is more than a whole segment, while playing. */
    let rest = 0;
    /** Segments a second; null for the whole drawing in ten seconds. @type {number | null} */
    let speed = null;
    let playing = false;
    let frame = 0;
    let before = 0;

    const perSecond = () => speed ?? pace(total ?? 1n, WHOLE);
    /** The speeds of the slider go from one a second to everything in one second. */
    const fastest = () => Math.max(2, Number(total ?? 1n));

    function show() {
        toggle.setAttribute('aria-expanded', String(open));
        bar.hidden = !open;
        if (!open) return;
        const all = total ?? 0n;
        const place = upto ?? all;
        slider.disabled = total === null || total === 0n;
        field.disabled = slider.disabled;
        play.disabled = slider.disabled;
        const part = all > 0n ? ratio(place, all) : 1;
        if (Number(slider.value) !== Math.floor(part * STOPS)) slider.value = String(Math.floor(part * STOPS));
        slider.style.setProperty('--at', String(part));
        slider.setAttribute('aria-valuetext', `${shortText(String(place))} of ${digits ? shortText(digits) : '…'} segments`);
        if (document.activeElement !== field) {
            setValue(field, total === null ? '' : placeText(place));
            field.title = `${grouped(String(place))} segments are drawn. Write a number, 10^12, 50 %`;
            field.removeAttribute('data-wrong');
        }
        setText(html('play-total'), digits ? `of ${shortText(digits)}` : '');
        html('play-total').title = digits ? `${grouped(digits)} segments${total === REACH ? ', of which the first 3.4 × 10³⁸ can be played' : ''}` : '';
        play.setAttribute('aria-label', playing ? 'Pause' : 'Play');
        play.classList.toggle('playing', playing);
        /** @type {SVGUseElement} */ (play.querySelector('use')).setAttribute('href', playing ? '#i-pause' : '#i-play');
        const now = perSecond();
        speedSlider.value = String(Math.round((SPEEDS * Math.log(now)) / Math.log(fastest())));
        speedSlider.style.setProperty('--at', String(Number(speedSlider.value) / SPEEDS));
        speedSlider.setAttribute('aria-valuetext', paceText(now));
        setText(html('play-pace'), paceText(now));
        button('play-ten').setAttribute('aria-pressed', String(speed === null));
        if (upto === null) setText(html('play-pose'), total === null ? '' : all === 0n ? 'Nothing is drawn.' : 'The whole drawing.');
    }

    /** Shows the first so many segments; all of them are the whole picture. @param {bigint | null} next */
    function stand(next) {
        upto = next === null || total === null || next >= total ? null : within(next, 0n, total);
        if (upto === null) turtle(null);
        engine.play(upto);
        show();
    }

    function pause() {
        cancelAnimationFrame(frame);
        playing = false;
    }

    function start() {
        if (total === null || total === 0n) return;
        playing = true;
        rest = 0;
        before = performance.now();
        stand(upto ?? 0n);
        frame = requestAnimationFrame(tick);
    }

    /** @param {number} now */
    function tick(now) {
        frame = requestAnimationFrame(tick);
        const time = now - before;
        if (calm() && time < CALM_MS) return;
        before = now;
        if (time <= 0 || time > GAP + CALM_MS) return;
        const way = (perSecond() * time) / 1000 + rest;
        const whole = Math.floor(way);
        rest = way - whole;
        if (whole === 0 || upto === null) return;
        const next = upto + BigInt(whole);
        if (total !== null && next >= total) pause();
        stand(next);
    }

    function turn() {
        if (playing) pause();
        else start();
        show();
    }

    /** @param {boolean} next */
    function setOpen(next) {
        open = next;
        document.body.classList.toggle('playing', open);
        if (!open) {
            pause();
            stand(null);
        }
        show();
    }

    toggle.addEventListener('click', () => {
        setOpen(!open);
        if (open) {
            start();
            show();
            play.focus({ preventScroll: true });
        }
    });
    button('close-playback').addEventListener('click', () => {
        setOpen(false);
        toggle.focus();
    });
    play.addEventListener('click', turn);
    html('drawing').addEventListener('keydown', (event) => {
        if (event.key !== ' ' || !offered() || event.ctrlKey || event.metaKey || event.altKey) return;
        event.preventDefault();
        if (event.repeat) return;
        if (!open) setOpen(true);
        turn();
    });
    bar.addEventListener('keydown', (event) => {
        if (event.key === 'Escape') button('close-playback').click();
    });
    slider.addEventListener('input', () => {
        if (total === null) return;
        pause();
        stand(portion(total, Number(slider.value) / STOPS));
    });
    // A field's own value is the number of segments, where places are counted from 0.
    const readField = () => (total === null ? null : /^\s*0+\s*$/.test(field.value) ? 0n : addOne(readPlace(field.value, total)));
    const addOne = (/** @type {bigint | null} */ place) => (place === null ? null : place + 1n);
    field.addEventListener('input', () => {
        const place = readField();
        field.toggleAttribute('data-wrong', place === null);
    });
    field.addEventListener('keydown', (event) => {
        if (total === null) return;
        const by = { ArrowUp: 1n, ArrowDown: -1n }[event.key];
        if (by !== undefined) {
            event.preventDefault();
            pause();
            stand(within((upto ?? total) + by * (event.shiftKey ? 10n : 1n), 0n, total));
            setValue(field, grouped(String(upto ?? total)));
        } else if (event.key === 'Enter') {
            const place = readField();
            if (place === null) return;
            pause();
            stand(place);
            setValue(field, grouped(String(upto ?? total)));
            field.select();
        }
    });
    // While it is not written in, a long number is shown shortened.
    field.addEventListener('focus', () => {
        setValue(field, grouped(String(upto ?? total ?? 0n)));
        field.select();
    });
    field.addEventListener('blur', () => {
        const place = readField();
        if (place !== null && place !== (upto ?? total)) {
            pause();
            stand(place);
        }
        show();
    });
    speedSlider.addEventListener('input', () => {
        speed = fastest() ** (Number(speedSlider.value) / SPEEDS);
        show();
    });
    button('play-ten').addEventListener('click', () => {
        speed = null;
        show();
    });

    return {
        /** How many segments are shown; null for all. */
        get upto() {
            return upto;
        },

        /** Plays on, or pauses. @param {boolean} on */
        turn(on) {
            if (on === playing || (on && !offered())) return;
            if (on && !open) setOpen(true);
            turn();
        },

        close() {
            if (open) setOpen(false);
        },

        /** Says what is drawn while it is not counted. @param {string} words */
        tell(words) {
            setText(html('play-pose'), words);
        },

        /** Another drawing comes: back to the whole picture. */
        forget() {
            pause();
            total = null;
            digits = '';
            speed = null;
            stand(null);
        },

        /** @param {import('./protocol.js').Report} report */
        report({ ok, segments, memoised }) {
            if (!ok || segments === null || memoised === null) return;
            digits = segments;
            total = within(BigInt(segments), 0n, REACH);
            show();
        },

        /** @param {import('./engine.js').Drawn} picture */
        drawn({ pose, upto: shown }) {
            if (upto === null || shown === null) return turtle(null);
            if (!pose) return;
            turtle({ at: pose.fitted, heading: pose.heading });
            setText(html('play-pose'), poseText(pose));
        },
    };
}
