/** The share dialog: the link, its QR code, and embed code for other pages. */

import { addressOf } from '../base/files.js';
import styles from '../../css/share.css';
import { copies } from '../base/copy.js';
import { download, fileName } from '../base/download.js';
import { button, byId, closes, html, input, isTouch, setChoice, setText, setValue } from '../base/dom.js';
import { addElements } from '../base/late.js';
import { LONGEST } from '../state/link.js';
import { bestLink, shortestLink } from '../state/packed.js';
import { qrFile, showQrPicture } from './qr.js';
import { SIZES, elementCode, frameAddress, frameCode, markdownCode, readSide, sizeName, stable } from './share-code.js';
import markup from './share.html';
import { createShareAs } from './share-as.js';
import { createPreview } from './share-preview.js';
import { createShareScorm } from './share-scorm.js';
import { reasonOf, say } from '../base/words.js';

/** Some programs cut longer links, in characters. */
const LONG = 2000;

/**
 * The dialog and its choices.
 * @typedef {object} Sharing
 * @property {import('../state/store.js').Store} store
 * @property {import('../engine/engine.js').Engine} engine
 * @property {HTMLDialogElement} dialog
 * @property {HTMLInputElement} link
 * @property {HTMLTextAreaElement} code
 * @property {HTMLInputElement} withView
 * @property {HTMLElement} status
 * @property {SVGSVGElement[]} pictures
 * @property {HTMLDetailsElement} part
 * @property {HTMLSelectElement} size
 * @property {HTMLSelectElement} theme
 * @property {HTMLInputElement[]} sides
 * @property {ReturnType<typeof createPreview>} preview
 * @property {HTMLInputElement[]} choices
 * @property {boolean} onDisk
 * @property {Uint8Array | null} modules The modules of the shown QR code
 * @property {number} turn The number of the last refresh; links are made asynchronously, and older ones are dropped
 * @property {ReturnType<typeof createShareAs>} as
 */

/** @param {import('./dialogs.js').Page} page */
export function createShare(page) {
    const { store, engine } = page;
    addElements(markup, [styles]);
    const dialog = byId('share-dialog', HTMLDialogElement);

    const send = button('share-send');

    const large = byId('qr-large', HTMLDialogElement);

    const choices = [...dialog.querySelectorAll('.embed-choices input')].filter(
        (element) => element instanceof HTMLInputElement,
    );

    const as = createShareAs(page, (words, isAlert) => tell(self, words, isAlert));
    /** @type {Sharing} */
    const self = {
        store,
        engine,
        dialog,
        link: input('share-link'),
        code: byId('embed-code', HTMLTextAreaElement),
        withView: input('share-view'),
        status: html('share-status'),
        pictures: [byId('qr', SVGSVGElement), byId('qr-full', SVGSVGElement)],
        part: byId('share-embed', HTMLDetailsElement),
        size: byId('embed-size', HTMLSelectElement),
        theme: byId('embed-theme', HTMLSelectElement),
        sides: [input('embed-width'), input('embed-height')],
        preview: createPreview(),
        choices,
        onDisk: location.protocol === 'file:',
        modules: null,
        turn: 0,
        as,
    };

    createShareScorm();
    copies(button('copy-share'), self.link, say`Link`, (words, isAlert) => tell(self, words, isAlert));
    copies(button('copy-code'), self.code, say`Code`, (words, isAlert) => tell(self, words, isAlert));
    for (const choice of [self.withView, self.theme, ...choices])
        choice.addEventListener('change', () => refresh(self));
    self.size.addEventListener('change', () => chooseSize(self));

    for (const field of self.sides) {
        field.addEventListener('input', () => readSide(field.value) !== null && refresh(self));
        // Afterwards the field shows the side that the code has.
        field.addEventListener('change', () => {
            const { width, height } = embedding(self);
            setValue(field, String(field === self.sides[0] ? width : height));
            refresh(self);
        });
    }
    self.part.addEventListener('toggle', () => {
        if (self.part.open) self.part.scrollIntoView({ block: 'nearest' });
        refresh(self);
    });
    dialog.addEventListener('close', self.preview.hide);
    button('qr-frame').addEventListener('click', () => large.showModal());
    closes(large, 'close-qr');
    store.subscribe(() => dialog.open && refresh(self));
    button('save-qr').addEventListener('click', () => {
        if (self.modules)
            download(new Blob([qrFile(self.modules)], { type: 'image/svg+xml' }), `${fileName(store.state)}_qr.svg`);
    });
    send.hidden = typeof navigator.share !== 'function';
    send.addEventListener('click', () => sendLink(self));

    closes(dialog, 'close-share');

    return { open: () => open(self) };
}

/** The state to share. @param {Sharing} self */
const shared = (self) => (self.withView.checked ? self.store.state : { ...self.store.state, view: null });

/** @param {Sharing} self */
async function refresh(self) {
    const own = ++self.turn;
    const state = shared(self);
    html('share-view-row').hidden = self.store.state.view === null;
    const [best, shortest] = await Promise.all([bestLink(state), shortestLink(state)]);
    if (own !== self.turn) return;
    self.link.value = addressOf(best);
    setText(html('share-link-note'), linkNote(self, self.link.value));
    showCode(self, state, best);
    self.as.refresh();
    await showQr(self, addressOf(shortest), own);
}

/** @param {Sharing} self @param {string} href */
function linkNote(self, href) {
    if (self.onDisk) return say`This page was opened from a disk, so the link works on this computer only.`;
    if (href.length > LONGEST)
        return say`The link has ${href.length} characters, more than browsers open. Send a file or picture from Save, which holds the same.`;
    if (href.length > LONG)
        return say`The link has ${href.length} characters, and some programs cut links of this length. A file or picture from Save holds the same.`;
    return say`The link contains the whole drawing. Nothing is stored on a server.`;
}

/** The checked form of the code: `frame`, `element` or `markdown`. @param {Sharing} self */
const form = (self) => self.choices.find(({ name, checked }) => name === 'form' && checked)?.value ?? 'frame';

/** @param {Sharing} self @returns {import('./share-code.js').Embedding} */
function embedding(self) {
    const [width = 0, height = 0] = self.sides.map((field, at) => readSide(field.value) ?? SIZES.medium?.[at] ?? 0);
    return {
        controls: self.choices.filter(({ name, checked }) => name === 'controls' && checked).map(({ value }) => value),
        theme: self.theme.value,
        width,
        height,
    };
}

/** @param {Sharing} self @param {import('../state/state.js').State} state @param {string} best */
function showCode(self, state, best) {
    const chosen = embedding(self);
    // The page may be a single file under any name, so these addresses are relative to its folder.
    const page = stable('embed.html');
    const codes = {
        frame: () => frameCode(state, best, page, chosen),
        element: () => elementCode(state, stable('l-system.js'), chosen),
        markdown: () => markdownCode(state, addressOf(best)),
    };
    const wanted = /** @type {keyof typeof codes} */ (form(self));
    self.code.value = codes[wanted]();
    setText(html('embed-note'), embedNote(self, wanted));
    setChoice(self.size, sizeName(chosen.width, chosen.height));
    const framed = wanted !== 'markdown';
    html('embed-options').hidden = !framed;
    html('embed-shown').hidden = !framed || self.onDisk;
    if (self.part.open && framed && !self.onDisk && self.dialog.open)
        self.preview.show(frameAddress(best, addressOf('embed.html'), chosen), chosen);
    else self.preview.hide();
}

/** @param {Sharing} self @param {string} wanted */
function embedNote(self, wanted) {
    if (wanted === 'markdown') return say`Markdown cannot embed drawings: this is a link with the title.`;
    if (self.onDisk)
        return say`This page was opened from a disk. Put it on a web server to get code that works in other pages.`;
    return wanted === 'element'
        ? say`For pages that may run scripts. Scripts can change the drawing and hear of changes.`
        : say`For any page, including Moodle: paste this code into the HTML source.`;
}

/** @param {Sharing} self @param {string} href @param {number} own */
async function showQr(self, href, own) {
    let words = '';
    /** @type {Uint8Array | null} */
    let made = null;
    try {
        made = self.onDisk ? null : await self.engine.qr(href);
        words = made
            ? isTouch()
                ? say`Scan it with a phone to open the drawing. Tap it to enlarge it.`
                : say`Scan it with a phone to open the drawing. Click it to enlarge it.`
            : self.onDisk
              ? say`This page was opened from a disk, so phones cannot reach it.`
              : say`This link is too long for a QR code that can be read.`;
    } catch (error) {
        words = say`The QR code could not be made (${reasonOf(error)}).`;
    }
    if (own !== self.turn) return;
    self.modules = made;
    html('qr-frame').hidden = made === null;
    button('save-qr').hidden = made === null;
    setText(html('qr-note'), words);
    if (!made) return;
    for (const picture of self.pictures) showQrPicture(picture, made);
}

/** @param {Sharing} self @param {string} words @param {boolean} isAlert */
function tell(self, words, isAlert) {
    setText(self.status, words);
    self.status.classList.toggle('alert', isAlert);
}

/** @param {Sharing} self */
function chooseSize(self) {
    self.sides.forEach((field, at) => setValue(field, String(SIZES[self.size.value]?.[at] ?? field.value)));
    if (self.size.value === 'custom') self.sides[0]?.focus();
    else refresh(self);
}

/** @param {Sharing} self */
async function sendLink(self) {
    try {
        await navigator.share({
            title: self.store.state.title || self.store.state.name || 'L-system',
            url: self.link.value,
        });
    } catch (error) {
        if (error instanceof Error && error.name === 'AbortError') return;
        tell(self, say`This browser could not send the link. Copy the link instead.`, true);
    }
}

/** @param {Sharing} self */
function open(self) {
    self.withView.checked = true;
    tell(self, '', false);
    self.dialog.showModal();
    button('copy-share').focus();
    return refresh(self);
}
