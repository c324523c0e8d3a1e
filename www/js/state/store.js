/** The store: the only place where the state changes. */

import { EMPTY, record, redo, settle, undo } from './history.js';
import { FIELDS, clean, same, sameSystem } from './state.js';

/** @typedef {import('./state.js').State} State */
/** @typedef {ReturnType<typeof createStore>} Store */
/** @typedef {(state: Readonly<State>, before: Readonly<State>) => void} StateListener */

/** @param {State} initial @param {State} [from] what Reset returns to, if not the initial state */
export function createStore(initial, from = initial) {
    /** @type {Readonly<State>} */
    let state = clean(initial);
    /** What Reset returns to: the system as picked or opened. @type {Readonly<State>} */
    let origin = clean(from);
    let history = EMPTY;
    /** @type {StateListener[]} */
    const listeners = [];

    /** @param {Readonly<State>} next */
    function setState(next) {
        const before = state;
        state = next;
        for (const listener of listeners) listener(state, before);
    }

    /**
     * Changes some fields; undo reverts them. Quick changes with the same label become one undo step. So do all changes
     * of a drag, whose label starts with `drag `, until `settle` is called.
     * @param {Partial<State>} patch
     * @param {string} label
     */
    function change(patch, label) {
        const next = clean({ ...state, ...patch }, state);
        const changed = FIELDS.filter((field) => !same(state[field], next[field]));
        if (changed.length === 0) return;
        const values = Object.fromEntries(changed.map((field) => [field, next[field]]));
        history = record(history, state, values, label, Date.now());
        setState(next);
    }

    /** @param {Partial<Pick<State, 'view' | 'camera'>>} patch */
    function look(patch) {
        const next = clean({ ...state, ...patch }, state);
        if (!same(next.view, state.view) || !same(next.camera, state.camera)) setState(next);
    }

    /** Goes a step through the history; whether there is one. @param {ReturnType<typeof undo>} step */
    function go(step) {
        if (!step) return false;
        history = step.history;
        origin = step.origin ?? origin;
        setState({ ...state, ...step.patch });
        return true;
    }

    return {
        get state() {
            return state;
        },
        get origin() {
            return origin;
        },
        get canUndo() {
            return history.past.length > 0;
        },
        get canRedo() {
            return history.future.length > 0;
        },
        get canReset() {
            return !sameSystem(state, origin) || state.view !== origin.view || state.camera !== origin.camera;
        },

        /** @param {StateListener} listener called after every change */
        subscribe(listener) {
            listeners.push(listener);
        },

        change,

        reset: () => change({ ...origin }, ''),

        /** Sets the view, without an undo step. @param {import('./state.js').View | null} view */
        setView: (view) => look({ view }),

        /** Sets the camera of a drawing in space, without an undo step. @param {import('./state.js').Camera | null} camera */
        setCamera: (camera) => look({ camera }),

        /**
         * Opens another system as one undo step. Reset then returns to this system.
         * @param {object} values
         * @param {object} [from] what Reset returns to, if not these values
         */
        open(values, from = values) {
            const next = clean(values);
            const origins = { before: origin, after: clean(from) };
            history = record(settle(history), state, next, '', Date.now(), origins);
            origin = origins.after;
            setState(next);
        },

        /**
         * Changes fields of the state and of the state that Reset returns to, without an undo step.
         * @param {Partial<State>} patch
         */
        changeOrigin(patch) {
            origin = clean({ ...origin, ...patch }, origin);
            setState(clean({ ...state, ...patch }, state));
        },

        /** Ends a gesture: the next change is a new undo step. */
        settle() {
            history = settle(history);
        },

        /** @returns whether there was a step to undo */
        undo: () => go(undo(history)),

        redo: () => go(redo(history)),
    };
}
