/** The loaded page of a generation's string, and the string's length. The text window requests further pages. */

import { latest } from '../base/latest.js';
import { REACH, within } from './places.js';
import { modulesOf } from './words.js';
import { say } from '../base/words.js';

/** @typedef {import('../protocol.js').StringPage} StringPage */
/**
 * `another`: the page belongs to another string than the last; `readable`: the string can be read; `full`: more symbols
 * may follow.
 * @typedef {{another: boolean, readable: boolean, full: boolean}} Arrived
 */

/**
 * @param {(generation: number, start: bigint, count: number) => Promise<StringPage>} read
 * @param {() => number} generation the shown generation
 * @param {(page: Arrived) => void} arrived
 */
export function createPages(read, generation, arrived) {
    let page = { generation: -1, start: 0n, symbols: /** @type {string[]} */ ([]) };
    /** The number of symbols that can be reached, null while unknown, and the exact number of symbols. @type {bigint | null} */
    let length = null;
    let digits = '';
    /** Why the string cannot be read. */
    let reason = '';
    /** Whether the page must be loaded again, and whether the next page belongs to another definition. */
    let stale = true;
    let redefined = true;

    const fetch = latest(read, (answer, wanted, start, count) => {
        if (wanted !== generation()) return;
        const readable = answer.text !== null;
        const another = page.generation !== wanted || redefined;
        stale = false;
        redefined = false;
        reason = readable ? '' : say`This generation is too long to derive.`;
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
        get reason() {
            return reason;
        },

        /** The loaded page, empty if it belongs to another generation. */
        get page() {
            return page.generation === generation() ? page : { ...page, symbols: [] };
        },

        /** All loaded symbols, even of another generation. */
        get symbols() {
            return page.symbols;
        },

        /** @param {bigint} index @returns {string | undefined} */
        symbolAt: (index) => page.symbols[Number(index - page.start)],

        /** @param {bigint} from @param {bigint} to */
        holds: (from, to) =>
            !stale &&
            page.generation === generation() &&
            page.start <= from &&
            page.start + BigInt(page.symbols.length) >= (length === null || to < length ? to : length),

        /** @param {bigint} start @param {number} count */
        fetch: (start, count) => fetch(generation(), start, count),

        /** Drops the page, because another generation is shown. */
        changeGeneration() {
            stale = true;
            length = null;
            page = { ...page, generation: -1 };
        },

        /** The loaded page may be out of date. */
        markStale() {
            stale = true;
        },

        /** The definition has changed. */
        redefine() {
            stale = true;
            redefined = true;
        },

        /** The nearest existing symbol. While the length is unknown, any index is accepted and the next page corrects it. @param {bigint} index */
        bounded(index) {
            length ??= REACH;
            return within(index, 0n, length > 0n ? length - 1n : 0n);
        },

        /** Fetches the length of the string. @returns {Promise<boolean>} whether the length is known */
        async measure() {
            const wanted = generation();
            const answer = await read(wanted, 0n, 1).catch(() => null);
            if (!answer || wanted !== generation() || answer.length === null) return false;
            setLength(answer.length);
            return true;
        },
    };
}
