/** Copying the string of a generation: the whole one, of which the view shows a part. */

import { toast } from '../base/announce.js';
import { copyText } from '../base/copy.js';
import { button } from '../base/dom.js';
import { grouped } from '../base/numerals.js';
import { modulesOf } from './words.js';
import { counted, say } from '../base/words.js';

/** Longer strings are for files, in symbols. */
const LONGEST = 1_000_000;
/** Symbols are read in parts of this length, so that the worker draws in between. */
const PAGE = 50_000;

/**
 * @param {HTMLElement} area the shown part
 * @param {{read: (generation: number, start: bigint, count: number) => Promise<import('../protocol.js').StringPage>, generation: () => number, open: () => boolean}} reader
 */
export function createCopying(area, { read, generation, open }) {
    async function copy() {
        try {
            const first = await read(generation(), 0n, 1);
            if (first.text === null || first.length === null) return toast(say`This string is too long to be copied.`);
            if (BigInt(first.length) > LONGEST)
                return toast(
                    say`A string of ${grouped(first.length)} symbols is too long to be copied: save it as a text.`,
                );
            /** @type {string[]} */
            const symbols = [];
            while (symbols.length < Number(first.length)) {
                const page = await read(generation(), BigInt(symbols.length), PAGE);
                const more = modulesOf(page.text ?? '', page.apart);
                if (more.length === 0) return toast(say`This string could not be read to its end.`);
                for (const symbol of more) symbols.push(symbol);
            }
            const text = symbols.join('');
            toast(
                (await copyText(text))
                    ? counted(BigInt(first.length), 'Copied {} symbols.', 'Copied {} symbols.')
                    : say`The browser refused to copy.`,
            );
        } catch {
            // The worker was replaced; the stage tells why.
        }
    }

    button('copy-string').addEventListener('click', copy);
    // The keys select and copy the string, not the page around it.
    addEventListener('keydown', (event) => {
        if (!open() || !(event.ctrlKey || event.metaKey) || event.altKey || event.key.toLowerCase() !== 'a') return;
        const { target } = event;
        if (target instanceof HTMLInputElement || target instanceof HTMLTextAreaElement) return;
        if (document.querySelector('dialog[open]')) return;
        event.preventDefault();
        getSelection()?.selectAllChildren(area);
    });
    area.addEventListener('copy', (event) => {
        event.preventDefault();
        void copy();
    });
}
