/** The buttons of the usual films. The core makes their tracks: crates/lsystem-film/src/preset.rs. */

import { make } from '../base/dom.js';
import { STANDS, strengthOf } from '../motion/wind.js';
import { say } from '../base/words.js';

/** @typedef {import('../protocol.js').FilmPreset} FilmPreset */
/** @typedef {import('../state/state.js').View} View */

/** Why a drawing has no turntable. */
const FLAT = say`A turntable needs a drawing in space.`;
/** @type {[FilmPreset['kind'], string][]} */
const KINDS = [
    ['growth', say`Growth`],
    ['turtle', say`Turtle’s way`],
    ['turntable', say`Turntable`],
    ['sway', say`Sway`],
    ['dive', say`Dive`],
];

/**
 * @param {import('../state/store.js').Store} store
 * @param {{readonly space: boolean, readonly branches: boolean, camera: () => import('../view/camera.js').Camera}} stage whether the drawing is in space and has branches, and its camera
 * @param {{dive: (view: View | null) => void, use: (preset: FilmPreset) => void}} on `dive` shows a dive to a view about a segment, or to the segment in the middle
 */
export function createPresets(store, stage, { dive, use }) {
    const buttons = KINDS.map(([kind, words]) => ({
        kind,
        button: make('button', { class: 'button', 'data-preset': kind }, words),
    }));

    const flat = make('p', { class: 'note' }, FLAT);

    /** The place of a dive: what the page shows if it is zoomed in and not about a segment. */
    function placeToDive() {
        const { view, camera } = store.state;
        if (stage.space && camera && camera.zoom > 2)
            return [camera.azimuth, camera.elevation, camera.zoom, camera.x, camera.y, camera.z];
        if (!stage.space && view && view.zoom > 2 && !view.at)
            return [view.x, view.y, view.zoom, view.fx ?? 0, view.fy ?? 0];
        return null;
    }

    /** @param {FilmPreset['kind']} kind @returns {FilmPreset | null} `null` for a dive to a segment */
    function presetOf(kind) {
        if (kind === 'growth') return { kind, n: store.state.iterations };
        if (kind === 'turtle') return { kind };
        if (kind === 'turntable') return { kind, azimuth: stage.camera().azimuth };
        if (kind === 'sway') return { kind, strength: strengthOf(store.state) };
        const place = placeToDive();
        return place && { kind, place, space: stage.space };
    }

    for (const { kind, button } of buttons) {
        button.addEventListener('click', () => {
            const preset = presetOf(kind);
            if (preset) return use(preset);
            const { view } = store.state;
            dive(!stage.space && view?.at ? view : null);
        });
    }

    return {
        element: make(
            'div',
            { class: 'row', role: 'group', 'aria-label': say`Presets` },
            ...buttons.map(({ button }) => button),
            flat,
        ),
        /** Shows which presets the drawing can have. */
        show() {
            for (const { kind, button } of buttons) {
                const why =
                    kind === 'turntable' && !stage.space ? FLAT : kind === 'sway' && !stage.branches ? STANDS : '';
                button.disabled = why !== '';
                button.title = why;
            }
            flat.hidden = stage.space;
        },
    };
}
