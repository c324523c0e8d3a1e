/** The part of the share dialog with the system in the notations of other programs. */

import { copies } from '../base/copy.js';
import { button, byId, html, make, setText } from '../base/dom.js';
import { NOTATIONS } from '../late-tables.js';
import { createTool } from '../engine/tool.js';
import { said, say } from '../base/words.js';

/**
 * @param {import('./dialogs.js').Page} page
 * @param {(words: string, isAlert: boolean) => void} tell
 */
export function createShareAs({ store }, tell) {
    /** @type {ReturnType<typeof createTool<import('../protocol.js').WriteCalls>>} */
    const tool = createTool('write');
    const part = byId('share-as', HTMLDetailsElement);
    const notation = byId('as-notation', HTMLSelectElement);
    const text = byId('as-text', HTMLTextAreaElement);
    const note = html('as-note');
    /** The number of the last text; older ones are dropped. */
    let turn = 0;

    for (const [value, { label, help }] of Object.entries(NOTATIONS)) {
        notation.append(make('option', { value, title: said(help) }, said(label)));
    }

    async function refresh() {
        if (!part.open) return;
        const own = ++turn;
        setText(note, '');
        try {
            const answer = await tool.call('writeAs', { definition: store.state, notation: notation.value });
            if (own !== turn) return;
            text.value = answer.text ?? '';
            button('as-copy').disabled = answer.text === null;
            const notes = answer.notes.join(' ');
            setText(note, answer.text === null ? say`Not possible: ${notes}`.trim() : notes.trim());
        } catch {
            if (own === turn) setText(note, say`The writers of other notations did not load. Try again.`);
        }
    }

    part.addEventListener('toggle', refresh);
    notation.addEventListener('change', refresh);
    copies(button('as-copy'), text, say`Text`, tell);

    return { refresh };
}
