/** A text area for programs: line numbers, indentation, colours of comments, texts and words, and the line of an error. */

import { isTouch, make } from '../base/dom.js';
import { say } from '../base/words.js';

/** @typedef {import('./runner.js').Language} Language */

const STEP = '    ';
/** Comments, texts, numbers and words of both languages. @type {Readonly<Record<Language, RegExp>>} */
const PARTS = {
    python: /(#[^\n]*)|("""[^]*?"""|'''[^]*?'''|"(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*')|(\b(?:def|return|for|in|if|elif|else|while|import|from|and|or|not|is|None|True|False|pass|break|continue|lambda|class|global|with|as|try|except|raise|yield|del)\b)|(\b\d[\w.]*)/g,
    javascript:
        /(\/\/[^\n]*|\/\*[^]*?\*\/)|("(?:[^"\\\n]|\\.)*"|'(?:[^'\\\n]|\\.)*'|`(?:[^`\\]|\\.)*`)|(\b(?:function|return|for|of|in|if|else|while|do|const|let|var|null|undefined|true|false|break|continue|new|class|switch|case|default|throw|try|catch|typeof)\b)|(\b\d[\w.]*)/g,
};
const NAMES = ['comment', 'text', 'word', 'number'];
/** Longer texts have no colours, in characters. */
const MOST_COLOURED = 50_000;
/** What the keys for phones write; the first two move the line. */
const KEYS = ['⇥', '⇤', '[', ']', ':', '(', ')', '{', '}', '=', '"', '+', '-', '.', ','];

/**
 * @param {HTMLElement} place
 * @param {(text: string) => void} changed
 */
export function createEditor(place, changed) {
    const numbers = make('div', { class: 'numbers', 'aria-hidden': 'true' });
    const colours = make('pre', { class: 'colours', 'aria-hidden': 'true' });
    const area = make('textarea', {
        id: 'code',
        class: 'code',
        spellcheck: 'false',
        autocapitalize: 'off',
        autocomplete: 'off',
        autocorrect: 'off',
        wrap: 'off',
        'aria-label': say`Program`,
        'aria-describedby': 'code-keys',
    });
    const note = make(
        'p',
        { id: 'code-keys', class: 'unseen' },
        say`Tab indents. Escape and then Tab leaves the program.`,
    );
    const keys = make('div', { class: 'code-keys', hidden: !isTouch() });
    place.append(make('div', { class: 'lines' }, numbers, make('div', { class: 'sheet' }, colours, area)), keys, note);
    /** @type {Language} */
    let language = 'python';
    let [wrong, leaves] = [/** @type {number | null} */ (null), false];

    /** Writes at the caret, so that the browser's undo knows it. @param {string} text */
    function write(text) {
        area.focus();
        const done = text === '' ? document.execCommand('delete') : document.execCommand('insertText', false, text);
        if (done) return;
        area.setRangeText(text, area.selectionStart, area.selectionEnd, 'end');
        area.dispatchEvent(new Event('input'));
    }

    /** The beginning of the caret's line, and its indentation. */
    function line() {
        const start = area.value.lastIndexOf('\n', area.selectionStart - 1) + 1;
        const before = area.value.slice(start, area.selectionStart);
        return { start, before, indent: /^[ \t]*/.exec(area.value.slice(start))?.[0] ?? '' };
    }

    /** Indents the chosen lines, or moves them back. @param {boolean} isBack */
    function indent(isBack) {
        if (area.selectionStart === area.selectionEnd && !isBack) return write(STEP);
        const { start } = line();
        const end = area.selectionEnd;
        const text = area.value.slice(start, end);
        const moved = isBack ? text.replace(/^( {1,4}|\t)/gm, '') : text.replace(/^(?=.)/gm, STEP);
        if (moved === text) {
            const rest = /^( {1,4}|\t)/.exec(area.value.slice(start))?.[0].length ?? 0;
            if (!isBack || rest === 0) return;
            area.setSelectionRange(start, start + rest);
            return write('');
        }
        area.setSelectionRange(start, end);
        write(moved);
        area.setSelectionRange(text.includes('\n') ? start : start + moved.length, start + moved.length);
    }

    area.addEventListener('keydown', (event) => {
        const { key, shiftKey, ctrlKey, metaKey, altKey } = event;
        if (key === 'Escape') leaves = true;
        else if (key === 'Tab' && !leaves && !ctrlKey && !metaKey && !altKey) {
            event.preventDefault();
            indent(shiftKey);
        } else if (key === 'Enter' && !ctrlKey && !metaKey && !event.isComposing) {
            event.preventDefault();
            const { before, indent: own } = line();
            const deeper = /[:{[(]\s*$/.test(before) ? STEP : '';
            write(`\n${own.slice(0, before.length)}${deeper}`);
        } else if (key === 'Backspace' && area.selectionStart === area.selectionEnd && /^ +$/.test(line().before)) {
            const { before } = line();
            const back = before.length % STEP.length || STEP.length;
            event.preventDefault();
            area.setSelectionRange(area.selectionStart - back, area.selectionStart);
            write('');
        }
        if (key !== 'Escape' && key !== 'Tab' && key !== 'Shift') leaves = false;
    });
    area.addEventListener('blur', () => (leaves = false));
    area.addEventListener('scroll', () => (colours.style.transform = `translateX(${-area.scrollLeft}px)`));
    area.addEventListener('input', () => {
        wrong = null;
        show();
        changed(area.value);
    });
    keys.append(
        ...KEYS.map((key) => {
            const names = /** @type {Record<string, string>} */ ({ '⇥': say`Indent`, '⇤': say`Less indent` });
            const element = make(
                'button',
                { class: 'symbol-key', 'aria-label': names[key] ?? key, tabindex: '-1' },
                key,
            );
            // The text keeps the focus, so the keyboard stays.
            element.addEventListener('pointerdown', (event) => event.preventDefault());
            element.addEventListener('click', () =>
                key === '⇥' ? indent(false) : key === '⇤' ? indent(true) : write(key),
            );
            return element;
        }),
    );

    function show() {
        const text = area.value;
        const count = text.split('\n').length;
        area.rows = Math.max(count, 1) + 1;
        numbers.replaceChildren(
            ...Array.from({ length: count }, (_, at) =>
                make('span', at + 1 === wrong ? { class: 'wrong' } : {}, String(at + 1)),
            ),
        );
        /** @type {(Node | string)[]} */
        const parts = [];
        let at = 0;
        for (const match of text.length > MOST_COLOURED ? [] : text.matchAll(PARTS[language])) {
            parts.push(text.slice(at, match.index));
            const kind = NAMES[match.slice(1).findIndex((part) => part !== undefined)] ?? '';
            parts.push(make('span', { class: `code-${kind}` }, match[0]));
            at = match.index + match[0].length;
        }
        colours.replaceChildren(...parts, text.slice(at), '\n');
        place.style.setProperty('--wrong', wrong === null ? '-9' : String(wrong - 1));
    }

    return {
        get text() {
            return area.value;
        },
        /** Shows another program. @param {string} text @param {Language} as */
        open(text, as) {
            language = as;
            area.value = text;
            wrong = null;
            show();
        },
        /** Marks the line of an error; null for none. @param {number | null} at */
        mark(at) {
            wrong = at;
            show();
        },
        /** Writes at the end. @param {string} text */
        append(text) {
            const gap =
                area.value.trim() === ''
                    ? ''
                    : area.value.endsWith('\n\n')
                      ? ''
                      : area.value.endsWith('\n')
                        ? '\n'
                        : '\n\n';
            area.focus();
            area.setSelectionRange(area.value.trim() === '' ? 0 : area.value.length, area.value.length);
            write(gap + text);
        },
    };
}
