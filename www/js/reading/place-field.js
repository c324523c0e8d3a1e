/** The Go to field of the string view: accepts a position in the string. */

import { input } from '../base/dom.js';
import { REACH, readPlace } from './places.js';

/** @param {{length: () => bigint | null, choose: (place: bigint) => void}} reader `length` is null while unknown */
export function createPlaceField({ length, choose }) {
    const field = input('reader-goto');
    /** Whether a position was entered before the length was known. */
    let waits = false;

    /** Goes to the entered position once the length is known. */
    function go() {
        const all = length();
        waits = all === null;
        if (all === null) return;
        const place = readPlace(field.value, all);
        field.toggleAttribute('data-wrong', place === null);
        if (place !== null) choose(place);
    }

    field.addEventListener('keydown', (event) => event.key === 'Enter' && go());
    field.addEventListener('input', () =>
        field.toggleAttribute(
            'data-wrong',
            field.value.trim() !== '' && readPlace(field.value, length() ?? REACH) === null,
        ),
    );

    return {
        /** More of the string was loaded. */
        update() {
            if (waits) go();
        },
        forget() {
            waits = false;
        },
    };
}
