/** How fast playback goes: the slider of the speed, and the button for the whole drawing in ten seconds. */

import { button, html, input, setText } from '../dom.js';
import { pace, paceText } from '../reading/places.js';

/** Positions of the slider. */
const SPEEDS = 1000;
/** The whole drawing takes so many seconds, unless the reader chose a speed. */
const WHOLE = 10;

/** @param {() => bigint | null} total how many segments there are, null while unknown */
export function createPace(total) {
    const slider = input('play-speed');
    /** Segments a second; null for the whole drawing in ten seconds. @type {number | null} */
    let speed = null;

    const perSecond = () => speed ?? pace(total() ?? 1n, WHOLE);
    /** The speeds of the slider go from one a second to everything in one second. */
    const fastest = () => Math.max(2, Number(total() ?? 1n));

    slider.addEventListener('input', () => {
        speed = fastest() ** (Number(slider.value) / SPEEDS);
        show();
    });
    button('play-ten').addEventListener('click', () => {
        speed = null;
        show();
    });

    function show() {
        const now = perSecond();
        slider.value = String(Math.round((SPEEDS * Math.log(now)) / Math.log(fastest())));
        slider.style.setProperty('--at', String(Number(slider.value) / SPEEDS));
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
