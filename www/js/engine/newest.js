/** The newest state that the page wants to see: a system and how it is looked at. The engine sends it when the worker is free. */

import { same } from '../state.js';

/** @typedef {import('../protocol.js').Definition} Definition */
/** How the picture is to be shown; only the first `upto` segments unless it is null. @typedef {{canvas: import('../protocol.js').Canvas, view: import('../protocol.js').View, camera: import('../protocol.js').Camera | null, upto: bigint | null}} Look */
/** A system and how it is looked at. @typedef {{definition: Definition | null, look: Look | null}} Shown */

export function createNewest() {
    /** @type {Readonly<Shown>} */
    let state = { definition: null, look: null };
    /** @type {bigint | null} */
    let upto = null;
    /** Which parts of the state were not sent yet. */
    let unsent = { definition: false, look: false };

    /** @param {Look} look */
    function take(look) {
        state = { ...state, look };
        unsent.look = true;
    }

    return {
        /** A change makes a new object, so that states can be compared by identity. */
        get state() {
            return state;
        },
        /** How many segments are to be shown, even if nothing is looked at yet; null for all. */
        get upto() {
            return upto;
        },
        /** @returns {Readonly<typeof unsent>} */
        get unsent() {
            return unsent;
        },
        /** Whether any part was not sent yet. */
        get waits() {
            return unsent.definition || unsent.look;
        },

        /** @param {Definition} definition */
        define(definition) {
            state = { ...state, definition };
            unsent.definition = true;
        },

        /** @param {Omit<Look, 'upto'>} next @returns {boolean} whether it is another than before */
        look({ canvas, view, camera }) {
            const { look } = state;
            if (look && same(look.canvas, canvas) && same(look.view, view) && same(look.camera, camera)) return false;
            take({ canvas, view, camera, upto });
            return true;
        },

        /** Shows only the first segments; all of them with null. @param {bigint | null} segments @returns {boolean} whether the look is another */
        play(segments) {
            if (segments === upto) return false;
            upto = segments;
            if (!state.look) return false;
            take({ ...state.look, upto });
            return true;
        },

        /** Goes back to a former state; without a former look the newest stays. @param {Readonly<Shown>} former */
        replace({ definition, look }) {
            state = { definition, look: look ?? state.look };
            upto = look?.upto ?? null;
        },

        /** The state was sent. */
        send() {
            unsent = { definition: false, look: false };
        },

        /** There is a fresh worker, which was sent nothing. */
        unsend() {
            unsent = { definition: state.definition !== null, look: state.look !== null };
        },
    };
}
