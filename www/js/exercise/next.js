/** The way on from a solved exercise: the next one of the published list. */

import { exercises } from '../course/published.js';
import { html } from '../base/dom.js';
import { isCarried } from '../base/files.js';
import { said } from '../base/words.js';

/** Shows the link to the exercise after this one, if the list has one. @param {string} text the exercise, as in its link */
export async function showNext(text) {
    const link = html('next-exercise');
    // The page around a frame has ways of its own. This page is a single file, which may fetch nothing.
    if (!link.hidden || parent !== window || !isCarried('exercises.json')) return;
    const list = await exercises();
    const at = list.findIndex(({ x }) => x === text);
    const next = at < 0 ? undefined : list[at + 1];
    if (!next) return;
    link.setAttribute('href', `#v=1&x=${next.x}`);
    link.title = said(next.title);
    link.hidden = false;
}
