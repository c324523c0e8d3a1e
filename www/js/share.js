/** The share dialog: the link, its QR code, and embed code for other pages. */

import { addressOf } from './files.js';
import styles from '../css/share.css';
import { copies, copyKeys } from './copy.js';
import { download, fileName } from './download.js';
import { button, byId, closes, html, input, isTouch, setChoice, setText, setValue } from './dom.js';
import { addElements } from './late.js';
import { LONGEST } from './link.js';
import { bestLink, shortestLink } from './packed.js';
import { qrFile, showQrPicture } from './qr.js';
import { SIZES, elementCode, frameAddress, frameCode, markdownCode, readSide, sizeName, stable } from './share-code.js';
import markup from './share.html';
import { createShareAs } from './share-as.js';
import { createPreview } from './share-preview.js';
import { createShareScorm } from './share-scorm.js';
import { say } from './words.js';

/** Some programs cut longer links, in characters. */
const LONG = 2000;

/** @param {import('./dialogs.js').Page} page */
export function createShare(page) {
    const { store, engine } = page;
    addElements(markup, [styles]);
    const dialog = byId('share-dialog', HTMLDialogElement);
    const link = input('share-link');
    const code = byId('embed-code', HTMLTextAreaElement);
    const withView = input('share-view');
    const status = html('share-status');
    const send = button('share-send');
    const pictures = [byId('qr', SVGSVGElement), byId('qr-full', SVGSVGElement)];
    const large = byId('qr-large', HTMLDialogElement);
    const part = byId('share-embed', HTMLDetailsElement);
    const size = byId('embed-size', HTMLSelectElement);
    const theme = byId('embed-theme', HTMLSelectElement);
    const sides = [input('embed-width'), input('embed-height')];
    const preview = createPreview();
    const choices = [...dialog.querySelectorAll('.embed-choices input')].filter(
        (element) => element instanceof HTMLInputElement,
    );
    const onDisk = location.protocol === 'file:';
    /** The modules of the shown QR code. @type {Uint8Array | null} */
    let modules = null;
    /** The number of the last refresh; links are made asynchronously, and older ones are dropped. */
    let turn = 0;

    /** The state to share. */
    const shared = () => (withView.checked ? store.state : { ...store.state, view: null });

    async function refresh() {
        const own = ++turn;
        const state = shared();
        html('share-view-row').hidden = store.state.view === null;
        const [best, shortest] = await Promise.all([bestLink(state), shortestLink(state)]);
        if (own !== turn) return;
        link.value = addressOf(best);
        setText(html('share-link-note'), linkNote(link.value));
        showCode(state, best);
        as.refresh();
        await showQr(addressOf(shortest), own);
    }

    /** @param {string} href */
    function linkNote(href) {
        if (onDisk) return say`This page was opened from a disk, so the link works on this computer only.`;
        if (href.length > LONGEST)
            return say`The link has ${href.length} characters, more than browsers open. Send a file or picture from Save, which holds the same.`;
        if (href.length > LONG)
            return say`The link has ${href.length} characters, and some programs cut links of this length. A file or picture from Save holds the same.`;
        return say`The link contains the whole drawing. Nothing is stored on a server.`;
    }

    /** The checked form of the code: `frame`, `element` or `markdown`. */
    const form = () => choices.find(({ name, checked }) => name === 'form' && checked)?.value ?? 'frame';

    /** @returns {import('./share-code.js').Embedding} */
    function embedding() {
        const [width = 0, height = 0] = sides.map((field, at) => readSide(field.value) ?? SIZES.medium?.[at] ?? 0);
        return {
            controls: choices.filter(({ name, checked }) => name === 'controls' && checked).map(({ value }) => value),
            theme: theme.value,
            width,
            height,
        };
    }

    /** @param {import('./state.js').State} state @param {string} best */
    function showCode(state, best) {
        const chosen = embedding();
        // The page may be a single file under any name, so these addresses are relative to its folder.
        const page = stable('embed.html');
        const codes = {
            frame: () => frameCode(state, best, page, chosen),
            element: () => elementCode(state, stable('l-system.js'), chosen),
            markdown: () => markdownCode(state, addressOf(best)),
        };
        const wanted = /** @type {keyof typeof codes} */ (form());
        code.value = codes[wanted]();
        setText(html('embed-note'), embedNote(wanted));
        setChoice(size, sizeName(chosen.width, chosen.height));
        const framed = wanted !== 'markdown';
        html('embed-options').hidden = !framed;
        html('embed-shown').hidden = !framed || onDisk;
        if (part.open && framed && !onDisk && dialog.open)
            preview.show(frameAddress(best, addressOf('embed.html'), chosen), chosen);
        else preview.hide();
    }

    /** @param {string} wanted */
    function embedNote(wanted) {
        if (wanted === 'markdown') return say`Markdown cannot embed drawings: this is a link with the title.`;
        if (onDisk)
            return say`This page was opened from a disk. Put it on a web server to get code that works in other pages.`;
        return wanted === 'element'
            ? say`For pages that may run scripts. Scripts can change the drawing and hear of changes.`
            : say`For any page, including Moodle: paste this code into the HTML source.`;
    }

    /** @param {string} href @param {number} own */
    async function showQr(href, own) {
        let words = '';
        /** @type {Uint8Array | null} */
        let made = null;
        try {
            made = onDisk ? null : await engine.qr(href);
            words = made
                ? isTouch()
                    ? say`Scan it with a phone to open the drawing. Tap it to enlarge it.`
                    : say`Scan it with a phone to open the drawing. Click it to enlarge it.`
                : onDisk
                  ? say`This page was opened from a disk, so phones cannot reach it.`
                  : say`This link is too long for a QR code that can be read.`;
        } catch (error) {
            words = say`The QR code could not be made (${String(error instanceof Error ? error.message : error)}).`;
        }
        if (own !== turn) return;
        modules = made;
        html('qr-frame').hidden = made === null;
        button('save-qr').hidden = made === null;
        setText(html('qr-note'), words);
        if (!made) return;
        for (const picture of pictures) showQrPicture(picture, made);
    }

    /** @param {string} words @param {boolean} isAlert */
    function tell(words, isAlert) {
        setText(status, words);
        status.classList.toggle('alert', isAlert);
    }

    const as = createShareAs(page, tell);
    createShareScorm();
    copies(button('copy-share'), link, say`Link`, tell);
    copies(button('copy-code'), code, say`Code`, tell);
    for (const choice of [withView, theme, ...choices]) choice.addEventListener('change', refresh);
    size.addEventListener('change', () => {
        sides.forEach((field, at) => setValue(field, String(SIZES[size.value]?.[at] ?? field.value)));
        if (size.value === 'custom') sides[0]?.focus();
        else refresh();
    });
    for (const field of sides) {
        field.addEventListener('input', () => readSide(field.value) !== null && refresh());
        // Afterwards the field shows the side that the code has.
        field.addEventListener('change', () => {
            const { width, height } = embedding();
            setValue(field, String(field === sides[0] ? width : height));
            refresh();
        });
    }
    part.addEventListener('toggle', () => {
        if (part.open) part.scrollIntoView({ block: 'nearest' });
        refresh();
    });
    dialog.addEventListener('close', preview.hide);
    button('qr-frame').addEventListener('click', () => large.showModal());
    closes(large, 'close-qr');
    store.subscribe(() => dialog.open && refresh());
    button('save-qr').addEventListener('click', () => {
        if (modules)
            download(new Blob([qrFile(modules)], { type: 'image/svg+xml' }), `${fileName(store.state)}_qr.svg`);
    });
    send.hidden = typeof navigator.share !== 'function';
    send.addEventListener('click', async () => {
        try {
            await navigator.share({ title: store.state.title || store.state.name || 'L-system', url: link.value });
        } catch (error) {
            if (error instanceof Error && error.name === 'AbortError') return;
            setText(status, say`This browser could not send the link. Copy the link instead.`);
            status.classList.add('alert');
        }
    });

    function open() {
        withView.checked = true;
        setText(status, '');
        status.classList.remove('alert');
        dialog.showModal();
        button('copy-share').focus();
        return refresh();
    }
    closes(dialog, 'close-share');

    return {
        open,

        /** Opens the dialog with the link selected, for the reader to copy. */
        async select() {
            await open();
            link.focus();
            link.select();
            setText(
                status,
                say`The browser refuses clipboard access. The link is selected: press ${copyKeys()} to copy.`,
            );
            status.classList.add('alert');
        },
    };
}
