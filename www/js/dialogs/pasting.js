/** What is pasted outside of dialogs: systems of other programs, and pictures whose rules are searched. */

import { toast } from '../base/announce.js';
import { pictureIn } from '../find/files.js';
import { say } from '../base/words.js';

/** Shorter pasted text is no whole system, and longer text is not read, in characters. */
const SHORTEST = 8;
const LONGEST = 1 << 20;

/** Whether a text is looked into for systems of other programs. @param {string} text */
export const mayBeSystem = (text) => text.length >= SHORTEST && text.length <= LONGEST;

/** @param {ReturnType<typeof import('./dialogs.js').createDialogs>} dialogs */
export function followPasting(dialogs) {
    document.addEventListener('paste', async (event) => {
        if (event.defaultPrevented || document.querySelector('dialog[open]')) return;
        const text = event.clipboardData?.getData('text/plain') ?? '';
        const picture = pictureIn(event.clipboardData);
        // Office programs add a picture to the text that they copy.
        if (picture && !text) {
            event.preventDefault();
            return void dialogs.open('find', picture);
        }
        const { target } = event;
        const isField = target instanceof HTMLTextAreaElement || target instanceof HTMLInputElement;
        if (text.length > LONGEST && !isField) return toast(say`The pasted text was not read: it has more than 1 MB.`);
        if (!mayBeSystem(text) || (isField && !['axiom', 'rules'].includes(target.id))) return;
        const root = document.documentElement;
        if (isField) root.toggleAttribute('data-pasted', true);
        const importing = await dialogs.part('import');
        if (!isField) return void (await importing?.paste(text));
        if (!(await importing?.offerPasted(text))) root.toggleAttribute('data-pasted', false);
    });
}
