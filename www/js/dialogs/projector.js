/** For a projector: the drawing, or what the mathematics says, fills the screen, in type for the last row of a room. */

import styles from '../../css/projector.css';
import { announce } from '../base/announce.js';
import { button, byId, html } from '../base/dom.js';
import { nameKeys } from '../base/keys.js';
import { setLayer } from '../base/layers.js';
import { addElements } from '../base/late.js';
import markup from './projector.html';
import { say } from '../base/words.js';

/** Tools, keys and the pointer are hidden after this time without a movement of the pointer, in milliseconds. */
const IDLE = 6000;
/** Keys that mean the drawing, wherever the focus is. */
const KEYS = /^(Arrow(Left|Right|Up|Down)|[-+=0])$/;
/** Elements that have no use of their own for these keys. */
const INDIFFERENT = 'body, button, a, #projector-page';

export function createProjector() {
    addElements(markup, [styles], html('stage'));
    nameKeys(html('stage'));
    const root = document.documentElement;
    const drawing = html('drawing');
    const mathematics = createMathematics(drawing);
    let timer = 0;

    const isOn = () => root.classList.contains('projecting');

    /** Shows tools, keys and the pointer for a while. */
    function stir() {
        clearTimeout(timer);
        root.classList.remove('idle');
        if (isOn()) timer = window.setTimeout(() => root.classList.add('idle'), IDLE);
    }

    /** @param {boolean} on */
    function set(on) {
        root.classList.toggle('projecting', on);
        html('projector-bar').hidden = !on;
        button('project').setAttribute('aria-pressed', String(on));
        setLayer(end, on);
        stir();
    }

    function begin() {
        set(true);
        if (!document.querySelector('dialog[open]')) drawing.focus();
        announce(say`The drawing fills the screen. Escape ends this.`);
        // Where a browser or the page around has no full screen, the window is filled.
        root.requestFullscreen?.().catch(() => {});
    }

    function end() {
        if (!isOn()) return;
        mathematics.leave();
        set(false);
        if (document.fullscreenElement) document.exitFullscreen().catch(() => {});
    }

    // The browser's own Escape ends the full screen without a key on the page.
    document.addEventListener('fullscreenchange', () => document.fullscreenElement || end());
    addEventListener('pointermove', stir, { passive: true });
    addEventListener('keydown', (event) => {
        if (event.key === 'Tab') stir();
        if (!isOn() || !KEYS.test(event.key) || document.querySelector('dialog[open]')) return;
        if (!(event.target instanceof Element) || !event.target.matches(INDIFFERENT)) return;
        event.preventDefault();
        drawing.dispatchEvent(new KeyboardEvent(event.type, event));
    });
    button('projector-end').addEventListener('click', end);

    return {
        /** Fills the screen, or ends that. @param {'mathematics'} [what] shows this in place of the drawing */
        open(what) {
            if (what === undefined && isOn()) return end();
            if (!isOn()) begin();
            if (what) mathematics.show();
        },
    };
}

/** The mathematics in place of the drawing. @param {HTMLElement} drawing */
function createMathematics(drawing) {
    const page = html('projector-page');
    const mathematics = byId('mathematics', HTMLDetailsElement);
    /** Where the mathematics stands in the panel. */
    const place = document.createComment('mathematics');

    /** @param {boolean} on */
    function set(on) {
        page.hidden = !on;
        button('projector-mathematics').setAttribute('aria-pressed', String(on));
        setLayer(leave, on);
        (on ? page : drawing).focus();
    }

    function show() {
        if (!page.hidden) return;
        mathematics.replaceWith(place);
        page.append(mathematics);
        mathematics.open = true;
        set(true);
    }

    function leave() {
        if (page.hidden) return;
        place.replaceWith(mathematics);
        set(false);
    }

    button('projector-mathematics').addEventListener('click', () => (page.hidden ? show() : leave()));
    return { show, leave };
}
