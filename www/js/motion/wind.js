/** The wind: branches sway around the still plant, in the frame of the still plant. The state does not change. */

import { createAnimation } from './animation.js';
import { button } from '../base/dom.js';
import { definitionOf } from '../state/state.js';
import { say } from '../base/words.js';
import { marked } from '../base/numerals.js';

/** The strength in degrees where the system has none, as in films: crates/lsystem-film/src/preset.rs. */
const LIGHT_WIND = 3;
/** The time of a wave, and the time in which the wind rises, in milliseconds. */
const WAVE_MS = 5000;
const RISE_MS = 1500;

const SWAYS = say`Let the branches sway in the wind`;
/** Why a drawing has no wind. */
export const STANDS = say`Only branches sway, and this drawing has none.`;

/** The strength of the wind, in degrees. @param {Readonly<import('../state/state.js').Definition>} definition */
export const strengthOf = ({ sway: [own] }) => own || LIGHT_WIND;

/**
 * @param {import('../state/store.js').Store} store
 * @param {import('../engine/engine.js').Engine} engine
 * @param {import('./animation.js').Page} page
 */
export function createWind(store, engine, page) {
    const toggle = button('wind');
    /** The phase in degrees, and the part of the strength. */
    let phase = 0;
    let risen = 0;

    /** @param {number} time */
    function tick(time) {
        risen = Math.min(1, risen + time / RISE_MS);
        request((phase + (360 * time) / WAVE_MS) % 360);
        return true;
    }

    /** @param {number} next */
    function request(next) {
        phase = next;
        const definition = definitionOf(store.state);
        animation.draw({ ...definition, sway: [risen * strengthOf(definition), phase] });
    }

    const animation = createAnimation(toggle, store, engine, page, {
        start() {
            phase = ((store.state.sway[1] % 360) + 360) % 360;
            risen = 0;
        },
        tick,
        part: () => phase / 360,
        words: () => say`wind of ${marked(String(Number(strengthOf(store.state).toFixed(1))))}°`,
        seek: (part) => request(part * 360),
    });
    const { drawn, stop, forget } = animation;

    return {
        get moves() {
            return animation.moves;
        },
        /** A picture has come. */
        drawn: () => drawn(),
        /** The state has changed: the wind rises anew, around the new plant. */
        edited() {
            risen = 0;
            animation.edited();
        },
        /** @param {import('../protocol.js').Report} report */
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
