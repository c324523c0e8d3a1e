/** The choices for a whole film: its length, its rate, its size, its loop and its pace. */

import { make, setChoice, setValue } from '../base/dom.js';
import { say } from '../base/words.js';
import { choice, numberOption } from './fields.js';
import { EASINGS, ENDINGS, SIZES, stretched } from './script.js';

/** @typedef {import('../protocol.js').FilmScript} FilmScript */
/** @typedef {import('../protocol.js').FilmTrack} FilmTrack */

/** The frames a second of a film whose rate is no number. */
const RATE = 25;

/** @param {{change: (values: Partial<FilmScript>) => void}} on */
export function createOptions({ change }) {
    /** @type {FilmScript | null} */
    let script = null;
    const seconds = numberOption('film-seconds', say`Seconds`, { min: '0.1', max: '3600', step: '0.5' });
    const rate = numberOption('film-rate', say`Frames a second`, { min: '1', max: '60', step: '1' });
    const size = choice('film-size', [...SIZES, ['own', say`Other size`]], say`Size`);
    const sides = ['width', 'height'].map((name) =>
        make('input', {
            id: `film-${name}`,
            class: 'number',
            type: 'number',
            min: '16',
            max: '4096',
            'aria-label': name === 'width' ? say`Width in pixels` : say`Height in pixels`,
        }),
    );
    const own = make(
        'span',
        { class: 'film-option film-own' },
        /** @type {HTMLElement} */ (sides[0]),
        '×',
        /** @type {HTMLElement} */ (sides[1]),
    );
    const ending = choice('film-loop', ENDINGS, say`Loop`);
    const pace = choice('film-pace', EASINGS, say`Pace`);

    const follow = make('input', { id: 'film-follow', type: 'checkbox' });
    const following = make('label', { class: 'check' }, follow, say`Follow the drawing`);
    following.title = say`Fit every frame to its drawing, instead of the frame of the end`;

    follow.addEventListener('change', () => change({ fixed: !follow.checked }));
    seconds.field.addEventListener('change', () => {
        if (script && seconds.field.valueAsNumber > 0) change(stretched(script, seconds.field.valueAsNumber));
    });
    rate.field.addEventListener('change', () => change({ rate: Math.round(rate.field.valueAsNumber) || RATE }));
    size.select.addEventListener('change', () => {
        own.hidden = size.select.value !== 'own';
        const [width, height] = size.select.value.split('x').map(Number);
        if (width && height) change({ width, height });
    });
    for (const field of sides) {
        field.addEventListener('change', () => {
            const [width = NaN, height = NaN] = sides.map((side) => Math.round(side.valueAsNumber));
            if (width && height) change({ width, height });
        });
    }
    ending.select.addEventListener('change', () => change({ ending: ending.select.value }));
    pace.select.addEventListener('change', () => change(paced(script, pace.select.value)));

    return {
        element: make(
            'div',
            { class: 'film-fields' },
            seconds.row,
            rate.row,
            size.row,
            own,
            ending.row,
            pace.row,
            following,
        ),
        /** @param {FilmScript} next */
        show(next) {
            script = next;
            const { width, height } = next;
            if (document.activeElement !== seconds.field) setValue(seconds.field, String(next.seconds));
            if (document.activeElement !== rate.field) setValue(rate.field, String(next.rate));
            const known = SIZES.some(([name]) => name === `${width}x${height}`);
            setChoice(size.select, known && size.select.value !== 'own' ? `${width}x${height}` : 'own');
            own.hidden = size.select.value !== 'own';
            sides.forEach(
                (field, at) => document.activeElement !== field && setValue(field, String(at === 0 ? width : height)),
            );
            setChoice(ending.select, next.ending);
            setChoice(pace.select, next.easing);
            follow.checked = !next.fixed;
        },
    };
}

/** A film with another pace, which keys with the former pace take too. @param {FilmScript | null} script @param {string} easing */
function paced(script, easing) {
    const tracks = script?.tracks ?? [];
    const keysOf = (/** @type {FilmTrack} */ { keys }) =>
        keys.map((key) => (key.easing === script?.easing ? { ...key, easing } : key));
    return { easing, tracks: tracks.map((track) => ({ ...track, keys: keysOf(track) })) };
}
