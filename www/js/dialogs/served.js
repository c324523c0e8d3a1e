/**
 * The file of the program lsys, if it serves this page: the page follows the file, and saves into it. The program writes
 * an element into the page that names the file; crates/lsys/src/view/server.rs answers the requests.
 */

import styles from '../../css/served.css';
import { toast } from '../base/announce.js';
import { button, html, setText } from '../base/dom.js';
import { addElements } from '../base/late.js';
import { readLink, writePlain } from '../state/link.js';
import markup from './served.html';
import { merged, sameSystem } from '../state/state.js';
import { say } from '../base/words.js';

/** What the file is, in words. */
const SIGNS = {
    'not connected': say`not connected`,
    conflict: say`conflict`,
    'has an error': say`has an error`,
    'not saved': say`not saved`,
    saved: say`saved`,
};

/** @typedef {import('../state/state.js').State} State */
/**
 * The file as the program sees it: equal bytes have equal versions, `link` is null for a file with errors, and `refusal`
 * says why the file is not written. `kept` names the copy that a save has left beside the file.
 * @typedef {{version: string, link: string | null, problems: string, refusal: string, kept: string}} FileState
 */

/** How long the program waits for a change before it answers, in seconds. */
const WAIT = 25;
/** The pause before a program that does not answer is asked again, in milliseconds. */
const PAUSE = 2000;

/**
 * The file and what is known of it.
 * @typedef {object} Following
 * @property {import('../state/store.js').Store} store
 * @property {import('../state/storage.js').SafeStorage} tab
 * @property {string} name
 * @property {FileState} file What the page knows of the file
 * @property {ReturnType<typeof systemIn>} saved The system that the file had when it last had one
 * @property {boolean} conflict Whether the file was changed elsewhere while the page had changes of its own
 * @property {string} loss What would be lost if the file was written anew, after an attempt to save that needs it
 * @property {boolean} answers Whether the program answers
 * @property {Promise<void>} saving
 * @property {HTMLButtonElement} save
 */

/**
 * @param {HTMLMetaElement} element names the file, its version and its link
 * @param {{store: import('../state/store.js').Store, tab: import('../state/storage.js').SafeStorage}} page `tab` is the storage of this tab
 */
export function createServed(element, { store, tab }) {
    /** @type {FileState} */
    const first = {
        version: element.dataset['version'] ?? '',
        link: element.dataset['link'] || null,
        problems: '',
        refusal: '',
        kept: '',
    };

    addElements(markup, [styles], html('panel'));
    html('tabs').before(html('served'));
    const save = button('served-save');
    /** @type {Following} */
    const self = {
        store,
        tab,
        name: element.content,
        file: first,
        saved: systemIn(first),
        conflict: false,
        loss: '',
        answers: true,
        saving: Promise.resolve(),
        save,
    };

    setText(html('served-name'), self.name);
    setText(save, say`Save`);
    save.title = say`Save to ${self.name} (Ctrl+S)`;
    save.setAttribute('aria-label', say`Save to ${self.name}`);

    save.addEventListener('click', () => act(self));
    button('served-replace').addEventListener('click', () => act(self));
    button('served-take').addEventListener('click', () => open(self));
    // Before the page's own key, which opens the dialog of files.
    addEventListener(
        'keydown',
        (event) => {
            const isSave = (event.ctrlKey || event.metaKey) && !event.altKey && !event.shiftKey && event.key === 's';
            if (!isSave || document.querySelector('dialog[open]')) return;
            event.preventDefault();
            event.stopImmediatePropagation();
            if (!save.disabled) act(self);
        },
        { capture: true },
    );
    store.subscribe(() => {
        self.loss = '';
        show(self);
    });
    begin(self);
    void follow(self);
}

/** Whether the page has changes that are not in the file. @param {Following} self */
const isChanged = (self) => !self.saved || !sameSystem(self.store.state, self.saved);

/** @param {Following} self @returns {[sign: keyof typeof SIGNS, words: string]} */
function words(self) {
    if (!self.answers)
        return ['not connected', say`The program lsys has ended. Start it again to save into ${self.name}.`];
    if (self.loss) return [self.file.link === null ? 'has an error' : 'not saved', self.loss];
    if (self.conflict) return ['conflict', say`${self.name} was changed elsewhere, and here as well.`];
    if (self.file.link === null) return ['has an error', self.file.problems];
    return [isChanged(self) ? 'not saved' : 'saved', self.file.refusal && isChanged(self) ? self.file.refusal : ''];
}

/** @param {Following} self */
function show(self) {
    const [sign, note] = words(self);
    setText(html('served-sign'), SIGNS[sign]);
    setText(html('served-words'), note);
    html('served-note').hidden = note === '';
    html('served-note').classList.toggle(
        'placed',
        self.answers && !self.loss && !self.conflict && self.file.link === null,
    );
    const asks =
        self.answers && (self.loss !== '' || self.conflict || (self.file.link === null && self.file.refusal === ''));
    button('served-take').hidden = !self.conflict || self.file.link === null;
    button('served-replace').hidden = !asks;
    self.save.disabled = !self.answers || !isChanged(self) || asks || self.file.refusal !== '';
    html('served').dataset['sign'] = sign;
}

/**
 * Opens the system of the file, where the reader is looking. Undo brings back what was here.
 * @param {Following} self
 */
function open(self) {
    self.conflict = false;
    self.saved = systemIn(self.file) ?? self.saved;
    if (self.saved && isChanged(self))
        self.store.open({ ...self.saved, view: self.store.state.view, camera: self.store.state.camera });
    show(self);
}

/** Takes notice of the file. @param {Following} self @param {FileState} next */
function learn(self, next) {
    const isNew = next.version !== self.file.version;
    if (isNew) self.loss = '';
    const hadChanges = isChanged(self);
    self.file = next;
    self.tab.write('served', self.file.version);
    const system = systemIn(self.file);
    if (!isNew || !system) return show(self);
    const { view, camera } = self.store.state;
    // Changes of different fields go together.
    const both =
        !hadChanges || sameSystem(self.store.state, system)
            ? system
            : self.saved && merged(self.saved, self.store.state, system);
    self.conflict = !both;
    if (both) self.saved = system;
    if (both && !sameSystem(self.store.state, both)) self.store.open({ ...both, view, camera });
    show(self);
}

/** Saves over the version of the file that the page knows; after asking, a whole new text. @param {Following} self */
async function write(self) {
    const { state } = self.store;
    try {
        const response = await fetch(self.loss ? 'file?whole' : 'file', {
            method: 'PUT',
            headers: { 'If-Match': `"${self.file.version}"` },
            body: writePlain({ ...state, view: null, camera: null }),
        });
        // The file has been changed since.
        if (response.status === 412) return learn(self, await response.json());
        if (response.status === 409) {
            self.loss = await response.text();
            return show(self);
        }
        if (!response.ok) return toast(say`Not saved: ${await response.text()}`, { stay: true });
        self.file = await response.json();
        self.saved = systemIn(self.file);
        self.conflict = false;
        self.loss = '';
        self.tab.write('served', self.file.version);
        toast(
            self.file.kept
                ? say`Saved to ${self.name}; the former file is ${self.file.kept}`
                : say`Saved to ${self.name}`,
        );
    } catch {
        self.answers = false;
    }
    show(self);
}

/** @param {Following} self */
function act(self) {
    self.store.settle();
    self.saving = self.saving.then(() => write(self));
}

/**
 * Sets what was opened against the file: a reload keeps the reader's changes, an old address gives way.
 * @param {Following} self
 */
function begin(self) {
    const known = self.tab.read('served');
    if (known === undefined) open(self);
    else self.conflict = known !== self.file.version && isChanged(self) && self.file.link !== null;
    self.tab.write('served', self.file.version);
    show(self);
    html('drawing').focus();
}

/** Asks for changes of the file as long as the page is open. @param {Following} self */
async function follow(self) {
    for (;;) {
        try {
            const headers = { 'If-None-Match': `"${self.answers ? self.file.version : ''}"`, Prefer: `wait=${WAIT}` };
            const response = await fetch(self.loss ? 'file?whole' : 'file', { headers });
            if (!response.ok) throw new Error(String(response.status));
            const next = await response.json();
            await self.saving;
            self.answers = true;
            learn(self, next);
        } catch {
            self.answers = false;
            show(self);
            await new Promise((resolve) => setTimeout(resolve, PAUSE));
        }
    }
}

/** @param {FileState} file @returns {State | null} */
function systemIn({ link }) {
    return link === null ? null : (readLink(link)?.state ?? null);
}
