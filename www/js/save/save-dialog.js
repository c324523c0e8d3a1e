/**
 * The save dialog: what a file is for, its format and options, a preview, and the size. The file is made in the
 * background while the reader chooses.
 *
 * A purpose may have rows beside the formats of the table, for dialogs of their own: `custom` lists them, and Save
 * opens them. So the dialog for films appears under Film.
 */

import styles from '../../css/saving.css';
import { announce, toast } from '../announce.js';
import { listProblems } from '../controls/editor.js';
import { button, byId, closes, html, make, setText } from '../dom.js';
import { download, fileName } from '../download.js';
import { addElements } from '../late.js';
import { FORMATS } from '../late-tables.js';
import { said, say } from '../words.js';
import { pixelSize, posterSides, posterValues, rowOf, savedName, sizeWords, valuesFor } from './choices.js';
import { optionFields } from './fields.js';
import { createMaking } from './making.js';
import { createPreview } from './preview.js';
import markup from './save-dialog.html';

/** @typedef {import('./choices.js').Purpose} Purpose */
/** @typedef {import('./making.js').Made} Made */

/** The longer side of the preview's picture, in pixels. */
const PREVIEW = 900;
/** The file is made when the choices have not changed for this time, in milliseconds. */
const PAUSE = 200;

/** Whether a file of this format holds the strokes of the drawing one by one. @param {string} name */
const isStrokes = (name) =>
    name in FORMATS && FORMATS[/** @type {import('../protocol.js').Format} */ (name)].content === 'strokes';

/** A problem without a place. @param {string | null} reason @returns {import('../protocol.js').Diagnostic} */
const notMade = (reason) => ({
    field: 'file',
    severity: 'error',
    message: reason === null ? say`Not made: the file could not be made.` : say`Not made: ${reason}.`,
    hint: null,
    fix: null,
    start: 0,
    end: 0,
});

/**
 * @param {object} page
 * @param {import('../store.js').Store} page.store
 * @param {ReturnType<typeof import('./choices.js').rememberedChoices>} page.remembered
 * @param {ReturnType<typeof import('./exports.js').createExports>} page.exports
 * @param {ReturnType<typeof import('./save-file.js').createSaveFile>} page.files
 * @param {() => import('../protocol.js').Canvas} page.canvas
 * @param {readonly import('./choices.js').CustomRow[]} page.custom
 */
export function createSaveDialog({ store, remembered, exports, files, canvas, custom }) {
    addElements(markup, [styles]);
    const dialog = byId('save-dialog', HTMLDialogElement);
    const save = button('save-now');
    const stop = button('save-stop');
    const bar = byId('save-bar', HTMLProgressElement);
    const { choices, groups, remember } = remembered;
    /** The picture of the drawing, made once while the dialog is open. @type {Promise<Blob> | null} */
    let picture = null;
    const preview = createPreview(html('save-preview'), {
        shown: () => (picture ??= files.small(PREVIEW)),
        fitted: files.fitted,
    });
    const making = createMaking(files.make, changed);
    const fields = optionFields({ canvas, choose: chooseValue });
    let timer = 0;
    /** Whether the reader has chosen a format while the dialog is open. */
    let isOwnChoice = false;
    /** Whether the reader waits for the file. */
    let isSaving = false;

    /** By purpose, the format that is taken for this drawing in place of the remembered one, and why. @type {Map<Purpose, {name: string, why: string}>} */
    const advised = new Map();

    function chosenRow() {
        const advice = advised.get(choices.purpose);
        return rowOf(
            advice ? { ...choices, formats: { ...choices.formats, [choices.purpose]: advice.name } } : choices,
            groups,
        );
    }

    /** The chosen format; null for a custom row. */
    function format() {
        const { name } = chosenRow();
        return name in FORMATS ? /** @type {import('../protocol.js').Format} */ (name) : null;
    }

    /** What is wanted, if a format is chosen. */
    function wanted() {
        const name = format();
        if (!name) return null;
        const values = valuesFor(name, choices);
        return { format: name, values: isPoster() ? { ...values, ...posterValues(choices.poster) } : values };
    }

    const isPoster = () => choices.purpose === 'print' && format() === 'png';

    /** A radio button as a tile. @param {string} group @param {string} value @param {() => void} choose @param {...(Node | string)} words */
    function tile(group, value, choose, ...words) {
        const radio = make('input', { type: 'radio', name: group, value, class: 'unseen' });
        radio.addEventListener('change', choose);
        return make('label', { class: 'save-tile' }, radio, ...words);
    }

    const purposes = groups.map(({ purpose, label }) =>
        tile('save-purpose', purpose, () => choosePurpose(purpose), make('span', {}, said(label))),
    );
    html('save-purposes').replaceChildren(...purposes);

    function showRows() {
        const { rows } = groups.find(({ purpose }) => purpose === choices.purpose) ?? { rows: [] };
        const chosen = chosenRow();
        html('save-formats').replaceChildren(
            ...rows.map(({ name, label, help }) =>
                tile(
                    'save-format',
                    name,
                    () => chooseFormat(name),
                    make('span', { class: 'save-label' }, said(label)),
                    make('span', { class: 'save-help' }, said(help)),
                ),
            ),
        );
        for (const radio of dialog.querySelectorAll('input[type=radio]')) {
            if (radio instanceof HTMLInputElement)
                radio.checked = radio.value === (radio.name === 'save-purpose' ? choices.purpose : chosen.name);
        }
        showOptions();
    }

    function showOptions() {
        const name = format();
        const names = name ? FORMATS[name].options : [];
        const own = isPoster() ? names.filter((each) => each !== 'size' && each !== 'dpi') : names;
        html('save-options').replaceChildren(
            ...(isPoster() ? fields.poster(choices.poster, choosePoster) : []),
            ...(name ? fields.of(own, choices.values) : []),
        );
        setText(html('save-advice'), advised.get(choices.purpose)?.why ?? '');
        html('save-options-set').hidden = names.length === 0;
        const custom = customRow();
        setText(save, custom ? custom.action : say`Save`);
        setText(html('save-name'), name ? savedName(fileName(store.state), name) : '');
        refresh(0);
    }

    const customRow = () => custom.find(({ name }) => name === chosenRow().name);

    /** @param {Purpose} purpose */
    function choosePurpose(purpose) {
        choices.purpose = purpose;
        remember();
        showRows();
    }

    /** @param {string} name */
    function chooseFormat(name) {
        choices.formats[choices.purpose] = name;
        advised.delete(choices.purpose);
        isOwnChoice = true;
        remember();
        showOptions();
    }

    /** @param {Partial<import('./choices.js').Poster>} changed */
    function choosePoster(changed) {
        Object.assign(choices.poster, changed);
        remember();
        refresh(PAUSE);
    }

    /** Takes a picture of pixels where strokes lose what the drawing shows. */
    function advise() {
        advised.clear();
        if (store.state.ink === 'density' && isStrokes(rowOf({ ...choices, purpose: 'screen' }, groups).name))
            advised.set('screen', {
                name: 'png',
                why: say`PNG, because files of strokes lose the glow of additive ink.`,
            });
    }

    /** Tells which formats can hold a drawing that has too many segments for a file of strokes, and takes one. @param {string} name @param {Made} made */
    function adviseAfter(name, { diagnostics }) {
        if (!isStrokes(name) || diagnostics.some(({ field }) => field !== 'numbers' && field !== 'file')) return '';
        if (choices.purpose !== 'screen') return say`Under Screen, PNG holds every drawing, and Compact SVG most.`;
        const why = say`PNG holds every drawing, and Compact SVG most.`;
        if (isOwnChoice) return why;
        advised.set('screen', {
            name: 'png',
            why: `${say`PNG, because ${said(FORMATS.svg.label)} would be too large.`} ${why}`,
        });
        showRows();
        return null;
    }

    /** @param {string} name @param {import('./choices.js').Value} value */
    function chooseValue(name, value) {
        choices.values[name] = value;
        remember();
        refresh(PAUSE);
    }

    /** Makes the file anew, after a pause. @param {number} pause */
    function refresh(pause) {
        clearTimeout(timer);
        making.cancel();
        setSaving(false);
        listProblems(html('save-problems'), []);
        setText(html('save-size'), '');
        timer = window.setTimeout(() => {
            const what = wanted();
            if (!what) return preview.showDrawing();
            // A large picture takes long, so it is made when it is saved.
            if (FORMATS[what.format].content === 'pixels') {
                setText(html('save-size'), say`${pixelSize(what.values['size'], canvas()).replace('x', ' × ')} pixels`);
                if (isPoster()) return preview.showPoster(posterSides(choices.poster));
                return void preview.show(what.format, what.values, null);
            }
            making.show(what);
        }, pause);
    }

    /** @param {Made} made */
    function changed(made) {
        const name = format();
        if (!name) return;
        const { state, size, diagnostics, reason } = made;
        if (state === 'making')
            setText(html('save-size'), size > 0 ? say`${sizeWords(size)} so far` : say`Making the file…`);
        else if (state === 'made') setText(html('save-size'), sizeWords(size));
        else if (state === 'large') setText(html('save-size'), say`More than ${sizeWords(size)}`);
        else setText(html('save-size'), '');
        if (state !== 'making') {
            if (state === 'failed') {
                const advice = adviseAfter(name, made);
                if (advice === null) return;
                setText(html('save-advice'), advice);
            }
            const told = state === 'failed' && diagnostics.length === 0 ? [notMade(reason)] : diagnostics;
            listProblems(html('save-problems'), told);
            if (told[0]) announce(told[0].message);
        }
        if (state !== 'cancelled') preview.show(name, choices.values, made);
    }

    /** @param {boolean} saving */
    function setSaving(saving) {
        isSaving = saving;
        bar.hidden = !saving;
        stop.hidden = !saving;
        save.disabled = saving;
        dialog.setAttribute('aria-busy', String(saving));
    }

    async function saveNow() {
        const own = customRow();
        if (own) {
            dialog.close();
            return own.open();
        }
        const what = wanted();
        if (!what || isSaving) return;
        clearTimeout(timer);
        setSaving(true);
        const { state, blob, diagnostics } = await making.whole(what);
        if (!isSaving || state === 'cancelled') return;
        setSaving(false);
        if (!blob) return;
        download(blob, savedName(fileName(store.state), what.format));
        if (!dialog.open) return;
        dialog.close();
        // A remark about the file, such as that it opens slowly.
        const [remark] = diagnostics;
        toast(remark ? [remark.message, remark.hint].filter(Boolean).join(' ') : say`Saved, ${sizeWords(blob.size)}`);
    }

    save.addEventListener('click', saveNow);
    stop.addEventListener('click', () => {
        making.cancel();
        setSaving(false);
        setText(html('save-size'), say`Cancelled`);
        save.focus();
    });
    closes(dialog, 'close-save');
    button('save-cancel').addEventListener('click', () => dialog.close());
    dialog.addEventListener('close', () => {
        clearTimeout(timer);
        making.cancel();
        setSaving(false);
        preview.forget();
        picture = null;
        exports.leave();
    });

    return {
        open() {
            if (dialog.open) return;
            isOwnChoice = false;
            advise();
            showRows();
            dialog.showModal();
            const chosen = dialog.querySelector('input[name=save-purpose]:checked');
            if (chosen instanceof HTMLElement) chosen.focus();
        },
    };
}
