/** The playback field that shows the number of drawn segments and accepts a new number. */

import { input, setValue } from '../base/dom.js';
import { grouped } from '../base/numerals.js';
import { placeText, readPlace, within } from '../reading/places.js';
import { counted } from '../base/words.js';

/**
 * @param {object} playback
 * @param {() => bigint | null} playback.total the number of segments, null while unknown
 * @param {() => bigint} playback.shown the number of segments shown
 * @param {(segments: bigint) => void} playback.seek
 */
export function createSegmentField({ total, shown, seek }) {
    const field = input('play-place');

    /** The typed number of segments. `readPlace` counts from 0, so its place is one less. */
    function typed() {
        const all = total();
        if (all === null) return null;
        if (/^\s*0+\s*$/.test(field.value)) return 0n;
        const place = readPlace(field.value, all);
        return place === null ? null : place + 1n;
    }

    /** Writes the exact number, to be edited; an unfocused field shows a shortened number. */
    const write = () => setValue(field, grouped(String(shown())));

    function show() {
        field.disabled = !total();
        if (document.activeElement === field) return;
        setValue(field, total() === null ? '' : placeText(shown()));
        field.title = counted(
            shown(),
            '{} segments are drawn. Type a number, 10^12, 50 %',
            '{} segments are drawn. Type a number, 10^12, 50 %',
        );
        field.removeAttribute('data-wrong');
    }

    field.addEventListener('input', () => field.toggleAttribute('data-wrong', typed() === null));
    field.addEventListener('keydown', (event) => {
        const all = total();
        if (all === null) return;
        const by = { ArrowUp: 1n, ArrowDown: -1n }[event.key];
        if (by !== undefined) {
            event.preventDefault();
            seek(within(shown() + by * (event.shiftKey ? 10n : 1n), 0n, all));
            write();
        } else if (event.key === 'Enter') {
            const segments = typed();
            if (segments === null) return;
            seek(segments);
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
        if (segments !== null && segments !== shown()) seek(segments);
        show();
    });

    return { show };
}
