/** The speed of playback: its slider, and the button for the whole drawing in ten seconds. */

import { button, html, input, setText } from '../base/dom.js';
import { pace, paceText } from '../reading/places.js';

/** The number of slider positions. */
const SLIDER_POSITIONS = 1000;
/** Seconds for the whole drawing, unless the reader has chosen a speed. */
const WHOLE = 10;

/** @param {() => bigint | null} total the number of segments, null while unknown */
export function createPace(total) {
    const slider = input('play-speed');
    /** Segments per second; null for the whole drawing in ten seconds. @type {number | null} */
    let speed = null;

    const perSecond = () => speed ?? pace(total() ?? 1n, WHOLE);
    /** The slider's highest speed draws everything in one second; its lowest speed is one segment per second. */
    const fastest = () => Math.max(2, Number(total() ?? 1n));

    slider.addEventListener('input', () => {
        speed = fastest() ** (Number(slider.value) / SLIDER_POSITIONS);
        show();
    });
    button('play-ten').addEventListener('click', () => {
        speed = null;
        show();
    });

    function show() {
        const now = perSecond();
        slider.value = String(Math.round((SLIDER_POSITIONS * Math.log(now)) / Math.log(fastest())));
        slider.style.setProperty('--at', String(Number(slider.value) / SLIDER_POSITIONS));
        slider.setAttribute('aria-valuetext', paceText(now));
        setText(html('play-pace'), paceText(now));
        button('play-ten').setAttribute('aria-pressed', String(speed === null));
    }

    return {
        perSecond,
        show,
        forget() {
            speed = null;
        },
    };
}
