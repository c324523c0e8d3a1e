/** The field in which a place in the string is typed. The reader goes there. */

import { input } from '../dom.js';
import { REACH, readPlace } from './places.js';

/** @param {{length: () => bigint | null, choose: (place: bigint) => void}} reader `length` is null while unknown */
export function createPlaceField({ length, choose }) {
    const field = input('reader-goto');
    /** Whether a place was asked for before the length was known. */
    let waits = false;

    /** Goes to the place that was typed, as soon as the length is known. */
    function go() {
        const all = length();
        waits = all === null;
        if (all === null) return;
        const place = readPlace(field.value, all);
        field.toggleAttribute('data-wrong', place === null);
        if (place !== null) choose(place);
    }

    field.addEventListener('keydown', (event) => event.key === 'Enter' && go());
    field.addEventListener('input', () => field.toggleAttribute('data-wrong', field.value.trim() !== '' && readPlace(field.value, length() ?? REACH) === null));

    return {
        /** More of the string is known. */
        goOn() {
            if (waits) go();
        },
        forget() {
            waits = false;
        },
    };
}
