/** Reports on their way to the parts of a page, and into its caption, description and announcements. */

import { announce } from '../base/announce.js';
import { html, setText, setWords } from '../base/dom.js';
import { isWrong } from '../engine/engine.js';
import { captionOf } from '../panels/growth-panel.js';
import { said, say } from '../base/words.js';

/** @typedef {import('../protocol.js').Report} Report */
/** @typedef {import('../protocol.js').Diagnostic} Diagnostic */
/** @typedef {{report: (report: Report, state: import('../state/state.js').State) => void}} Part */

const LAST = say`Showing the last valid drawing.`;

/** Tells that the newest state is not drawn. */
export const showLast = () => setText(html('caption-text'), LAST);

/**
 * @param {object} page
 * @param {import('../state/store.js').Store} page.store
 * @param {string} page.untitled what a system without a title is called
 * @param {{setBusy: (busy: boolean) => void}} page.stage
 * @param {readonly Part[]} page.drawn parts that also show the last valid drawing
 * @param {readonly Part[]} page.edited parts that show the newest state, valid or not
 * @param {(first: Diagnostic, all: Diagnostic[]) => string} page.mistaken shows errors, and returns what is announced
 * @param {(report: Report) => string | null} [page.valid] hears of a valid state, and returns why nothing is drawn
 * @returns {(report: Report, past: boolean) => void} `past`: the report is about the last valid state
 */
export function createReporter({ store, untitled, stage, drawn, edited, mistaken, valid = ({ empty }) => empty }) {
    return (report, past) => {
        const { state } = store;
        stage.setBusy(!isWrong(report) && report.memoised === null);
        for (const part of past ? drawn : [...edited, ...drawn]) part.report(report, state);
        if (past) return showLast();
        const mistakes = report.diagnostics.filter(({ severity }) => severity === 'error');
        const [first] = mistakes;
        if (first) return announce(mistaken(first, mistakes));
        const empty = valid(report);
        setWords(html('empty'), empty ?? '');
        html('empty').hidden = empty === null;
        setText(html('description'), report.description);
        setText(html('caption-text'), captionOf(state, report));
        html('drawing').setAttribute('aria-label', say`Drawing: ${said(state.title) || state.name || untitled}`);
        announce(empty ?? report.description);
    };
}
