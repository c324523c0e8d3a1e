/** The newest state that the page wants to see: a definition and a look. The engine sends the state when the worker is free. */

import { same } from '../state/state.js';

/** @typedef {import('../protocol.js').Define['definition']} Definition */
/** How the picture is shown; only the first `upto` segments, or all if null. @typedef {{canvas: import('../protocol.js').Canvas, view: import('../protocol.js').View, camera: import('../protocol.js').Camera | null, upto: bigint | null}} Look */
/** A definition and its look. @typedef {{definition: Definition | null, look: Look | null}} Shown */

export function createNewest() {
    /** @type {Readonly<Shown>} */
    let state = { definition: null, look: null };
    /** @type {bigint | null} */
    let upto = null;
    /** Which parts of the state are not sent yet. */
    let unsent = { definition: false, look: false };

    /** @param {Look} look */
    function take(look) {
        state = { ...state, look };
        unsent.look = true;
    }

    return {
        /** Each change makes a new object, so that states can be compared by identity. */
        get state() {
            return state;
        },
        /** How many segments to show, even before the first look; null for all. */
        get upto() {
            return upto;
        },
        /** @returns {Readonly<typeof unsent>} */
        get unsent() {
            return unsent;
        },
        /** Whether any part is not sent yet. */
        get waits() {
            return unsent.definition || unsent.look;
        },

        /** @param {Definition} definition */
        define(definition) {
            state = { ...state, definition };
            unsent.definition = true;
        },

        /** @param {Omit<Look, 'upto'>} next @returns {boolean} whether the look has changed */
        look({ canvas, view, camera }) {
            const { look } = state;
            if (look && same(look.canvas, canvas) && same(look.view, view) && same(look.camera, camera)) return false;
            take({ canvas, view, camera, upto });
            return true;
        },

        /** Shows only the first segments, or all if null. @param {bigint | null} segments @returns {boolean} whether the look has changed */
        play(segments) {
            if (segments === upto) return false;
            upto = segments;
            if (!state.look) return false;
            take({ ...state.look, upto });
            return true;
        },

        /** Goes back to a former state; without a former look the newest look stays. @param {Readonly<Shown>} former */
        replace({ definition, look }) {
            state = { definition, look: look ?? state.look };
            upto = look?.upto ?? null;
        },

        /** The state was sent. */
        send() {
            unsent = { definition: false, look: false };
        },

        /** The worker was replaced; everything must be sent again. */
        unsend() {
            unsent = { definition: state.definition !== null, look: state.look !== null };
        },
    };
}
