/** On touch screens, a row of keys for the symbols that a soft keyboard hides, while a text of the notation is edited. */

import { byId, html, make } from '../base/dom.js';
import { say } from '../base/words.js';

/** What the keys write. */
const KEYS = ['F', 'X', 'L', '+', '-', '[', ']', '->', '(', ')', '|', '&', '^', '!', "'"];

/** @param {string[]} ids the text areas */
export function symbolKeys(ids) {
    const row = html('symbol-keys');
    const areas = ids.map((id) => byId(id, HTMLTextAreaElement));
    const touch = matchMedia('(pointer: coarse)');
    const current = () => areas.find((area) => area === document.activeElement);

    row.append(
        ...KEYS.map((key) => {
            const element = make(
                'button',
                { class: 'symbol-key', 'aria-label': key === '->' ? say`Arrow` : key, tabindex: '-1' },
                key === '->' ? '→' : key,
            );
            // The text keeps the focus, so the keyboard stays.
            element.addEventListener('pointerdown', (event) => event.preventDefault());
            element.addEventListener('click', () => {
                const area = current();
                if (!area) return;
                const text = key === '->' ? ' -> ' : key;
                area.setRangeText(text, area.selectionStart, area.selectionEnd, 'end');
                area.dispatchEvent(new Event('input', { bubbles: true }));
            });
            return element;
        }),
    );

    /** Puts the row above the keyboard, which covers the lower part of the page, or else above the tabs there. */
    function place() {
        row.hidden = !touch.matches || !current();
        const { height = innerHeight, offsetTop = 0 } = visualViewport ?? {};
        const tabs = document.getElementById('tabs')?.getBoundingClientRect();
        const taken = tabs && tabs.bottom >= innerHeight - 1 ? innerHeight - tabs.top : 0;
        row.style.bottom = `${Math.max(taken, innerHeight - height - offsetTop)}px`;
    }

    for (const area of areas) {
        area.addEventListener('focus', place);
        area.addEventListener('blur', place);
    }
    visualViewport?.addEventListener('resize', place);
    visualViewport?.addEventListener('scroll', place);
    place();
}
