/** What is at hand of a generation's string: one page of it, and how long it is. The text window asks for more. */

import { latest } from '../latest.js';
import { REACH, within } from './places.js';
import { modulesOf } from './words.js';

/** @typedef {import('../protocol.js').StringPage} StringPage */
/**
 * What a fetched page tells: whether it is of another string than the last, whether the string can be read, and whether more
 * may follow.
 * @typedef {{another: boolean, readable: boolean, full: boolean}} Arrived
 */

/**
 * @param {(generation: number, start: bigint, count: number) => Promise<StringPage>} read
 * @param {() => number} generation that is shown
 * @param {(page: Arrived) => void} arrived
 */
export function createPages(read, generation, arrived) {
    let page = { generation: -1, start: 0n, symbols: /** @type {string[]} */ ([]) };
    /** How many symbols can be reached, null while unknown; and all digits of how many there are. @type {bigint | null} */
    let length = null;
    let digits = '';
    /** Why there is nothing to read. */
    let why = '';
    /** Whether the page is of a former definition, and the next is of another than the last. */
    let stale = true;
    let renewed = true;

    const fetch = latest(read, (answer, wanted, start, count) => {
        if (wanted !== generation()) return;
        const readable = answer.text !== null;
        const another = page.generation !== wanted || renewed;
        stale = false;
        renewed = false;
        why = readable ? '' : 'This generation is too long to be derived.';
        setLength(answer.length);
        page = { generation: wanted, start, symbols: modulesOf(answer.text ?? '', answer.apart) };
        arrived({ another, readable, full: page.symbols.length >= count });
    });

    /** @param {string | null} next */
    function setLength(next) {
        digits = next ?? '';
        length = next === null ? null : within(BigInt(next), 0n, REACH);
    }

    return {
        get length() {
            return length;
        },
        get digits() {
            return digits;
        },
        get why() {
            return why;
        },

        /** What is at hand of the generation that is shown. */
        get page() {
            return page.generation === generation() ? page : { ...page, symbols: [] };
        },

        /** All that is at hand, be it of another generation. */
        get symbols() {
            return page.symbols;
        },

        /** @param {bigint} index @returns {string | undefined} */
        symbolAt: (index) => page.symbols[Number(index - page.start)],

        /** @param {bigint} from @param {bigint} to */
        holds: (from, to) => !stale && page.generation === generation() && page.start <= from && page.start + BigInt(page.symbols.length) >= (length === null || to < length ? to : length),

        /** @param {bigint} start @param {number} count */
        fetch: (start, count) => fetch(generation(), start, count),

        /** Another generation is shown. */
        turn() {
            stale = true;
            length = null;
            page = { ...page, generation: -1 };
        },

        /** What is at hand may be of a former definition. */
        age() {
            stale = true;
        },

        /** There is another definition. */
        renew() {
            stale = true;
            renewed = true;
        },

        /** A symbol that there is. Where it is not known yet how long the string is, the next page puts it right. @param {bigint} index */
        bounded(index) {
            length ??= REACH;
            return within(index, 0n, length > 0n ? length - 1n : 0n);
        },

        /** Learns how long the string is before any of it is fetched. @returns {Promise<boolean>} whether that is known */
        async measure() {
            const wanted = generation();
            const answer = await read(wanted, 0n, 1).catch(() => null);
            if (!answer || wanted !== generation() || answer.length === null) return false;
            setLength(answer.length);
            return true;
        },
    };
}
