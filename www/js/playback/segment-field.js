/** The field of playback that says how many segments are drawn, and in which their number is typed. */

import { input, setValue } from '../dom.js';
import { grouped } from '../numerals.js';
import { placeText, readPlace, within } from '../reading/places.js';

/**
 * @param {object} playback
 * @param {() => bigint | null} playback.total how many segments there are, null while unknown
 * @param {() => bigint} playback.shown how many are shown
 * @param {(segments: bigint) => void} playback.stand
 */
export function createSegmentField({ total, shown, stand }) {
    const field = input('play-place');

    /** The number that is typed: a place that is counted from 0, and so one less than the segments up to it. */
    function typed() {
        const all = total();
        if (all === null) return null;
        if (/^\s*0+\s*$/.test(field.value)) return 0n;
        const place = readPlace(field.value, all);
        return place === null ? null : place + 1n;
    }

    /** While it is not written in, a long number is shown shortened. */
    const write = () => setValue(field, grouped(String(shown())));

    function show() {
        field.disabled = !total();
        if (document.activeElement === field) return;
        setValue(field, total() === null ? '' : placeText(shown()));
        field.title = `${grouped(String(shown()))} segments are drawn. Write a number, 10^12, 50 %`;
        field.removeAttribute('data-wrong');
    }

    field.addEventListener('input', () => field.toggleAttribute('data-wrong', typed() === null));
    field.addEventListener('keydown', (event) => {
        const all = total();
        if (all === null) return;
        const by = { ArrowUp: 1n, ArrowDown: -1n }[event.key];
        if (by !== undefined) {
            event.preventDefault();
            stand(within(shown() + by * (event.shiftKey ? 10n : 1n), 0n, all));
            write();
        } else if (event.key === 'Enter') {
            const segments = typed();
            if (segments === null) return;
            stand(segments);
            write();
            field.select();
        }
    });
    field.addEventListener('focus', () => {
        write();
        field.select();
    });
    field.addEventListener('blur', () => {
        const segments = typed();
        if (segments !== null && segments !== shown()) stand(segments);
        show();
    });

    return { show };
}
