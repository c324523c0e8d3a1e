/**
 * The file of the program lsys, if it serves this page: the page follows the file, and saves into it. The program writes
 * an element into the page that names the file; crates/lsys/src/view/server.rs answers the requests.
 */

import styles from '../css/served.css';
import { toast } from './announce.js';
import { button, html, setText } from './dom.js';
import { addElements } from './late.js';
import { readLink, writePlain } from './link.js';
import markup from './served.html';
import { sameSystem } from './state.js';
import { say } from './words.js';

/** What the file is, in words. */
const SIGNS = {
    'not connected': say`not connected`,
    conflict: say`conflict`,
    'has an error': say`has an error`,
    'not saved': say`not saved`,
    saved: say`saved`,
};

/** @typedef {import('./state.js').State} State */
/**
 * The file as the program sees it: equal bytes have equal versions, `link` is null for a file with errors, and `refusal`
 * says why the file is not written.
 * @typedef {{version: string, link: string | null, problems: string, refusal: string}} FileState
 */

/** How long the program waits for a change before it answers, in seconds. */
const WAIT = 25;
/** The pause before a program that does not answer is asked again, in milliseconds. */
const PAUSE = 2000;

/**
 * @param {HTMLMetaElement} element names the file, its version and its link
 * @param {{store: import('./store.js').Store, tab: import('./storage.js').SafeStorage}} page `tab` is the storage of this tab
 */
export function createServed(element, { store, tab }) {
    const name = element.content;
    /** What the page knows of the file. @type {FileState} */
    let file = {
        version: element.dataset['version'] ?? '',
        link: element.dataset['link'] || null,
        problems: '',
        refusal: '',
    };
    /** The system that the file had when it last had one. */
    let saved = systemIn(file);
    /** Whether the file was changed elsewhere while the page had changes of its own. */
    let conflict = false;
    /** Whether the program answers. */
    let answers = true;
    /** @type {Promise<void>} */
    let saving = Promise.resolve();

    addElements(markup, [styles], html('panel'));
    html('tabs').before(html('served'));
    const save = button('served-save');
    setText(html('served-name'), name);
    setText(save, say`Save`);
    save.title = say`Save to ${name} (Ctrl+S)`;
    save.setAttribute('aria-label', say`Save to ${name}`);

    /** Whether the page has changes that are not in the file. */
    const isChanged = () => !saved || !sameSystem(store.state, saved);

    /** @returns {[sign: keyof typeof SIGNS, words: string]} */
    function words() {
        if (!answers) return ['not connected', say`The program lsys has ended. Start it again to save into ${name}.`];
        if (conflict) return ['conflict', say`${name} was changed elsewhere, and here as well.`];
        if (file.link === null) return ['has an error', file.problems];
        return [isChanged() ? 'not saved' : 'saved', file.refusal && isChanged() ? file.refusal : ''];
    }

    function show() {
        const [sign, note] = words();
        setText(html('served-sign'), SIGNS[sign]);
        setText(html('served-words'), note);
        html('served-note').hidden = note === '';
        html('served-note').classList.toggle('placed', answers && !conflict && file.link === null);
        const asks = answers && (conflict || (file.link === null && file.refusal === ''));
        button('served-take').hidden = !conflict || file.link === null;
        button('served-replace').hidden = !asks;
        save.disabled = !answers || !isChanged() || asks || file.refusal !== '';
        html('served').dataset['sign'] = sign;
    }

    /** Opens the system of the file, where the reader is looking. Undo brings back what was here. */
    function open() {
        conflict = false;
        saved = systemIn(file) ?? saved;
        if (saved && isChanged()) store.open({ ...saved, view: store.state.view, camera: store.state.camera });
        show();
    }

    /** Takes notice of the file. @param {FileState} next */
    function learn(next) {
        const isNew = next.version !== file.version;
        const hadChanges = isChanged();
        file = next;
        tab.write('served', file.version);
        const system = systemIn(file);
        if (!isNew || !system) return show();
        // The same change here and there is none of two.
        if (hadChanges && !sameSystem(store.state, system)) conflict = true;
        else open();
        show();
    }

    /** Saves over the version of the file that the page knows. */
    async function write() {
        const { state } = store;
        try {
            const response = await fetch('file', {
                method: 'PUT',
                headers: { 'If-Match': `"${file.version}"` },
                body: writePlain({ ...state, view: null, camera: null }),
            });
            // The file has been changed since.
            if (response.status === 412) return learn(await response.json());
            if (!response.ok) return toast(say`Not saved: ${await response.text()}`, { stay: true });
            file = await response.json();
            saved = systemIn(file);
            conflict = false;
            tab.write('served', file.version);
            toast(say`Saved to ${name}`);
        } catch {
            answers = false;
        }
        show();
    }

    function act() {
        store.settle();
        saving = saving.then(write);
    }

    save.addEventListener('click', act);
    button('served-replace').addEventListener('click', act);
    button('served-take').addEventListener('click', open);
    // Before the page's own key, which opens the dialog of files.
    addEventListener(
        'keydown',
        (event) => {
            const isSave = (event.ctrlKey || event.metaKey) && !event.altKey && !event.shiftKey && event.key === 's';
            if (!isSave || document.querySelector('dialog[open]')) return;
            event.preventDefault();
            event.stopImmediatePropagation();
            if (!save.disabled) act();
        },
        { capture: true },
    );
    store.subscribe(show);
    begin();
    void follow();

    /** Sets what was opened against the file: a reload keeps the reader's changes, an old address gives way. */
    function begin() {
        const known = tab.read('served');
        if (known === undefined) open();
        else conflict = known !== file.version && isChanged() && file.link !== null;
        tab.write('served', file.version);
        show();
        html('drawing').focus();
    }

    /** Asks for changes of the file as long as the page is open. */
    async function follow() {
        for (;;) {
            try {
                const headers = { 'If-None-Match': `"${answers ? file.version : ''}"`, Prefer: `wait=${WAIT}` };
                const response = await fetch('file', { headers });
                if (!response.ok) throw new Error(String(response.status));
                const next = await response.json();
                await saving;
                answers = true;
                learn(next);
            } catch {
                answers = false;
                show();
                await new Promise((resolve) => setTimeout(resolve, PAUSE));
            }
        }
    }
}

/** @param {FileState} file @returns {State | null} */
function systemIn({ link }) {
    return link === null ? null : (readLink(link)?.state ?? null);
}
