/** The list of numbers that have no track yet: choosing one adds a track. */

import { make } from '../base/dom.js';
import { said, say } from '../base/words.js';

/** @typedef {import('../protocol.js').FilmScript} FilmScript */
/** @typedef {import('../protocol.js').FilmSubject} FilmSubject */

/** The numbers of a view and of a camera that the page has not changed, and the part that is drawn at the end. */
const USUAL = { view: [0, 0, 1], camera: [25, 12, 1], drawn: [1] };

/**
 * @param {import('../state/store.js').Store} store
 * @param {{readonly space: boolean}} stage whether the drawing is in space
 * @param {{add: (subject: string, value: number[]) => void}} on
 */
export function createAdder(store, stage, { add }) {
    /** @type {FilmSubject[]} */
    let subjects = [];
    const element = make('select', { id: 'film-add', 'aria-label': say`Add a track` });

    /** The present value of a subject. @param {string} subject */
    function valueOf(subject) {
        const { view, camera } = store.state;
        if (subject === 'view' && view)
            return [view.x, view.y, view.zoom, ...(view.fx || view.fy ? [view.fx ?? 0, view.fy ?? 0] : [])];
        if (subject === 'camera' && camera)
            return [camera.azimuth, camera.elevation, camera.zoom, camera.x, camera.y, camera.z];
        if (Object.hasOwn(USUAL, subject)) return USUAL[/** @type {keyof typeof USUAL} */ (subject)];
        return subjects.find(({ name }) => name === subject)?.value ?? [0];
    }

    element.addEventListener('change', () => {
        if (element.value !== '') add(element.value, valueOf(element.value));
    });

    return {
        element,
        /** @param {FilmScript} script @param {FilmSubject[]} all */
        show(script, all) {
            subjects = all;
            const used = new Set(script.tracks.map(({ subject }) => subject));
            const options = subjects
                .filter(({ name, value }) => !used.has(name) && value !== null)
                .map(({ name, label }) => make('option', { value: name }, `${said(label)} (${name})`));
            const others = (stage.space ? [['camera', say`Camera`]] : [['view', say`View`]])
                .concat([['drawn', say`Part drawn`]])
                .filter(([name]) => !used.has(String(name)));
            element.replaceChildren(
                make('option', { value: '' }, say`Add a track…`),
                ...others.map(([name, words]) => make('option', { value: String(name) }, String(words))),
                ...options,
            );
        },
    };
}
