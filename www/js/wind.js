/** The wind: branches sway around the still plant, in the frame of the still plant. The state does not change. */

import { createAnimation } from './animation.js';
import { button } from './dom.js';
import { definitionOf } from './state.js';
import { say } from './words.js';
import { marked } from './numerals.js';

/** The strength in degrees where the system has none, as in films: crates/lsystem-film/src/preset.rs. */
const LIGHT_WIND = 3;
/** The time of a wave, and the time in which the wind rises, in milliseconds. */
const WAVE_MS = 5000;
const RISE_MS = 1500;
/** Pictures are waited for up to this time, in milliseconds. */
const PATIENCE_MS = 4000;

const SWAYS = say`Let the branches sway in the wind`;
/** Why a drawing has no wind. */
export const STANDS = say`Only branches sway, and this drawing has none.`;

/** The strength of the wind, in degrees. @param {Readonly<import('./state.js').Definition>} definition */
export const strengthOf = ({ sway: [own] }) => own || LIGHT_WIND;

/**
 * @param {import('./store.js').Store} store
 * @param {import('./engine.js').Engine} engine
 * @param {{begins: () => void, present: (show: import('./playback.js').Show | null) => void}} page as of growth
 */
export function createWind(store, engine, { begins, present }) {
    const toggle = button('wind');
    /** The still plant, whose picture comes first: its frame is that of the wind. Null once the plant is shown. @type {import('./state.js').Definition | null} */
    let still = null;
    /** The time of the last frame. */
    let before = 0;
    /** When the last picture was requested; 0 when it is shown. */
    let asked = 0;
    /** The phase in degrees, and the part of the strength. */
    let phase = 0;
    let risen = 0;

    function isSettled() {
        if (still && engine.good.definition === still) {
            still = null;
            asked = 0;
        }
        return still === null;
    }

    /** @param {number} now */
    function tick(now) {
        const time = now - before;
        if (isSettled()) {
            if (asked && now - asked < PATIENCE_MS) return;
            risen = Math.min(1, risen + time / RISE_MS);
            request((phase + (360 * time) / WAVE_MS) % 360, now);
        }
        before = now;
    }

    /** @param {number} next @param {number} now */
    function request(next, now) {
        phase = next;
        asked = now;
        const definition = definitionOf(store.state);
        engine.define({ ...definition, sway: [risen * strengthOf(definition), phase], still: true });
        present(show);
    }

    /** Draws the still plant first. */
    function settle() {
        still = definitionOf(store.state);
        risen = 0;
        engine.define(still);
    }

    function start() {
        begins();
        animation.begin();
        phase = ((store.state.sway[1] % 360) + 360) % 360;
        settle();
        animation.resume();
        present(show);
    }

    const animation = createAnimation({
        toggle,
        start,
        tick,
        resumed: () => {
            before = performance.now();
        },
        forgotten: () => {
            still = null;
            present(null);
        },
        draw: () => engine.define(definitionOf(store.state)),
    });
    const { pause, stop, forget } = animation;

    /** @type {import('./playback.js').Show} */
    const show = {
        get playing() {
            return animation.playing;
        },
        get part() {
            return phase / 360;
        },
        get words() {
            return say`wind of ${marked(String(Number(strengthOf(store.state).toFixed(1))))}°`;
        },
        toggle() {
            if (animation.playing) pause();
            else animation.resume();
            present(show);
        },
        seek(part) {
            pause();
            if (isSettled()) request(part * 360, performance.now());
            present(show);
        },
        stop,
    };

    return {
        /** Whether the engine shows swaying branches instead of the store's state. */
        get blowing() {
            return animation.running && still === null;
        },
        /** A picture has come. */
        drawn() {
            asked = 0;
        },
        /** The state has changed, and the engine already draws it: the wind goes on around the new plant. */
        edited() {
            if (animation.running) settle();
        },
        /** @param {import('./protocol.js').Report} report */
        report({ ok, branches }) {
            if (!ok) return;
            toggle.disabled = !branches;
            toggle.title = branches ? SWAYS : STANDS;
            if (!branches) stop();
        },
        stop,
        forget,
    };
}
