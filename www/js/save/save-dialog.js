/**
 * The save dialog: what a file is for, its format and options, a preview, and the size. The file is made in the
 * background while the reader chooses.
 */

import styles from '../../css/saving.css';
import { announce, toast } from '../base/announce.js';
import { listProblems } from '../controls/editor.js';
import { button, byId, closes, html, make, setText } from '../base/dom.js';
import { download, fileName } from '../base/download.js';
import { addElements } from '../base/late.js';
import { FORMATS } from '../late-tables.js';
import { said, say } from '../base/words.js';
import { pixelSize, posterSides, posterValues, rowOf, savedName, sizeWords, valuesFor } from './choices.js';
import { optionFields } from './fields.js';
import { createMaking } from './making.js';
import { createPreview } from './preview.js';
import markup from './save-dialog.html';

/** @typedef {import('./choices.js').Purpose} Purpose */
/** @typedef {import('../protocol.js').Format} Format */
/** @typedef {import('./making.js').Made} Made */

/** The longer side of the preview's picture, in pixels. */
const PREVIEW = 900;
/** The file is made when the choices have not changed for this time, in milliseconds. */
const PAUSE = 200;

/** Whether a file of this format holds the strokes of the drawing one by one. @param {Format} name */
const isStrokes = (name) => FORMATS[name].content === 'strokes';

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
 * The dialog and its choices.
 * @typedef {object} SaveDialog
 * @property {import('../state/store.js').Store} store
 * @property {() => import('../protocol.js').Canvas} canvas
 * @property {HTMLDialogElement} dialog
 * @property {HTMLButtonElement} save
 * @property {HTMLButtonElement} stop
 * @property {HTMLProgressElement} bar
 * @property {ReturnType<typeof import('./choices.js').rememberedChoices>['choices']} choices
 * @property {ReturnType<typeof import('./choices.js').rememberedChoices>['groups']} groups
 * @property {() => void} remember
 * @property {ReturnType<typeof createPreview>} preview
 * @property {ReturnType<typeof createMaking>} making
 * @property {ReturnType<typeof optionFields>} fields
 * @property {number} timer
 * @property {boolean} isOwnChoice Whether the reader has chosen a format while the dialog is open
 * @property {boolean} isSaving Whether the reader waits for the file
 * @property {Map<Purpose, {name: Format, why: string}>} advised By purpose, the format that is taken for this drawing in place of the remembered one, and why
 */

/**
 * @param {object} page
 * @param {import('../state/store.js').Store} page.store
 * @param {ReturnType<typeof import('./choices.js').rememberedChoices>} page.remembered
 * @param {ReturnType<typeof import('./exports.js').createExports>} page.exports
 * @param {ReturnType<typeof import('./save-file.js').createSaveFile>} page.files
 * @param {() => import('../protocol.js').Canvas} page.canvas
 */
export function createSaveDialog({ store, remembered, exports, files, canvas }) {
    addElements(markup, [styles]);

    const { choices, groups, remember } = remembered;
    /** The picture of the drawing, made once while the dialog is open. @type {Promise<Blob> | null} */
    let picture = null;

    const making = createMaking(files.make, (made) => changed(self, made));
    const fields = optionFields({ canvas, choose: (name, value) => chooseValue(self, name, value) });
    /** @type {SaveDialog} */
    const self = {
        store,
        canvas,
        dialog: byId('save-dialog', HTMLDialogElement),
        save: button('save-now'),
        stop: button('save-stop'),
        bar: byId('save-bar', HTMLProgressElement),
        choices,
        groups,
        remember,
        preview: createPreview(html('save-preview'), {
            shown: () => (picture ??= files.small(PREVIEW)),
            fitted: files.fitted,
        }),
        making,
        fields,
        timer: 0,
        isOwnChoice: false,
        isSaving: false,
        advised: new Map(),
    };

    const purposes = groups.map(({ purpose, label }) =>
        tile('save-purpose', purpose, () => choosePurpose(self, purpose), make('span', {}, said(label))),
    );
    html('save-purposes').replaceChildren(...purposes);

    self.save.addEventListener('click', () => saveNow(self));
    self.stop.addEventListener('click', () => {
        making.cancel();
        setSaving(self, false);
        setText(html('save-size'), say`Cancelled`);
        self.save.focus();
    });
    closes(self.dialog, 'close-save');
    button('save-cancel').addEventListener('click', () => self.dialog.close());
    self.dialog.addEventListener('close', () => {
        clearTimeout(self.timer);
        making.cancel();
        setSaving(self, false);
        self.preview.forget();
        picture = null;
        exports.leave();
    });

    return {
        open() {
            if (self.dialog.open) return;
            self.isOwnChoice = false;
            advise(self);
            showRows(self);
            self.dialog.showModal();
            const chosen = self.dialog.querySelector('input[name=save-purpose]:checked');
            if (chosen instanceof HTMLElement) chosen.focus();
        },
    };
}

/** @param {SaveDialog} self */
function chosenRow({ advised, choices, groups }) {
    const advice = advised.get(choices.purpose);
    const formats = { ...choices.formats, ...(advice ? { [choices.purpose]: advice.name } : {}) };
    return rowOf({ ...choices, formats }, groups);
}

/** The chosen format. @param {SaveDialog} self */
const format = (self) => chosenRow(self).name;

/** What is wanted. @param {SaveDialog} self */
function wanted(self) {
    const name = format(self);
    const values = valuesFor(name, self.choices);
    return { format: name, values: isPoster(self) ? { ...values, ...posterValues(self.choices.poster) } : values };
}

/** @param {SaveDialog} self */
const isPoster = (self) => self.choices.purpose === 'print' && format(self) === 'png';

/** A radio button as a tile. @param {string} group @param {string} value @param {() => void} choose @param {...(Node | string)} words */
function tile(group, value, choose, ...words) {
    const radio = make('input', { type: 'radio', name: group, value, class: 'unseen' });
    radio.addEventListener('change', choose);
    return make('label', { class: 'save-tile' }, radio, ...words);
}

/** @param {SaveDialog} self */
function showRows(self) {
    const { rows } = self.groups.find(({ purpose }) => purpose === self.choices.purpose) ?? { rows: [] };
    const chosen = chosenRow(self);
    html('save-formats').replaceChildren(
        ...rows.map(({ name, label, help }) =>
            tile(
                'save-format',
                name,
                () => chooseFormat(self, name),
                make('span', { class: 'save-label' }, said(label)),
                make('span', { class: 'save-help' }, said(help)),
            ),
        ),
    );
    for (const radio of self.dialog.querySelectorAll('input[type=radio]')) {
        if (radio instanceof HTMLInputElement)
            radio.checked = radio.value === (radio.name === 'save-purpose' ? self.choices.purpose : chosen.name);
    }
    showOptions(self);
}

/** @param {SaveDialog} self */
function showOptions(self) {
    const name = format(self);
    const names = FORMATS[name].options;
    const own = isPoster(self) ? names.filter((each) => each !== 'size' && each !== 'dpi') : names;
    html('save-options').replaceChildren(
        ...(isPoster(self) ? self.fields.poster(self.choices.poster, (changed) => choosePoster(self, changed)) : []),
        ...self.fields.of(own, self.choices.values),
    );
    setText(html('save-advice'), self.advised.get(self.choices.purpose)?.why ?? '');
    html('save-options-set').hidden = names.length === 0;
    setText(html('save-name'), savedName(fileName(self.store.state), name));
    refresh(self, 0);
}

/** @param {SaveDialog} self @param {Purpose} purpose */
function choosePurpose(self, purpose) {
    self.choices.purpose = purpose;
    self.remember();
    showRows(self);
}

/** @param {SaveDialog} self @param {Format} name */
function chooseFormat(self, name) {
    self.choices.formats[self.choices.purpose] = name;
    self.advised.delete(self.choices.purpose);
    self.isOwnChoice = true;
    self.remember();
    showOptions(self);
}

/** @param {SaveDialog} self @param {Partial<import('./choices.js').Poster>} changed */
function choosePoster(self, changed) {
    Object.assign(self.choices.poster, changed);
    self.remember();
    refresh(self, PAUSE);
}

/** Takes a picture of pixels where strokes lose what the drawing shows. @param {SaveDialog} self */
function advise(self) {
    self.advised.clear();
    if (
        self.store.state.ink === 'density' &&
        isStrokes(rowOf({ ...self.choices, purpose: 'screen' }, self.groups).name)
    )
        self.advised.set('screen', {
            name: 'png',
            why: say`PNG, because files of strokes lose the glow of additive ink.`,
        });
}

/**
 * Tells which formats can hold a drawing that has too many segments for a file of strokes, and takes one.
 * @param {SaveDialog} self
 * @param {Format} name
 * @param {Made} made
 */
function adviseAfter(self, name, { diagnostics }) {
    if (!isStrokes(name) || diagnostics.some(({ field }) => field !== 'numbers' && field !== 'file')) return '';
    if (self.choices.purpose !== 'screen') return say`Under Screen, PNG holds every drawing, and Compact SVG most.`;
    const why = say`PNG holds every drawing, and Compact SVG most.`;
    if (self.isOwnChoice) return why;
    self.advised.set('screen', {
        name: 'png',
        why: `${say`PNG, because ${said(FORMATS.svg.label)} would be too large.`} ${why}`,
    });
    showRows(self);
    return null;
}

/** @param {SaveDialog} self @param {string} name @param {import('./choices.js').Value} value */
function chooseValue(self, name, value) {
    self.choices.values[name] = value;
    self.remember();
    refresh(self, PAUSE);
}

/** Makes the file anew, after a pause. @param {SaveDialog} self @param {number} pause */
function refresh(self, pause) {
    clearTimeout(self.timer);
    self.making.cancel();
    setSaving(self, false);
    listProblems(html('save-problems'), []);
    setText(html('save-size'), '');
    self.timer = window.setTimeout(() => {
        const what = wanted(self);
        // A large picture takes long, so it is made when it is saved.
        if (FORMATS[what.format].content === 'pixels') {
            setText(
                html('save-size'),
                say`${pixelSize(what.values['size'], self.canvas()).replace('x', ' × ')} pixels`,
            );
            if (isPoster(self)) return self.preview.showPoster(posterSides(self.choices.poster));
            return void self.preview.show(what.format, what.values, null);
        }
        self.making.show(what);
    }, pause);
}

/** @param {SaveDialog} self @param {Made} made */
function changed(self, made) {
    const name = format(self);
    const { state, size, diagnostics, reason } = made;
    if (state === 'making')
        setText(html('save-size'), size > 0 ? say`${sizeWords(size)} so far` : say`Making the file…`);
    else if (state === 'made') setText(html('save-size'), sizeWords(size));
    else if (state === 'large') setText(html('save-size'), say`More than ${sizeWords(size)}`);
    else setText(html('save-size'), '');
    if (state !== 'making') {
        if (state === 'failed') {
            const advice = adviseAfter(self, name, made);
            if (advice === null) return;
            setText(html('save-advice'), advice);
        }
        const told = state === 'failed' && diagnostics.length === 0 ? [notMade(reason)] : diagnostics;
        listProblems(html('save-problems'), told);
        if (told[0]) announce(told[0].message);
    }
    if (state !== 'cancelled') self.preview.show(name, self.choices.values, made);
}

/** @param {SaveDialog} self @param {boolean} saving */
function setSaving(self, saving) {
    self.isSaving = saving;
    self.bar.hidden = !saving;
    self.stop.hidden = !saving;
    self.save.disabled = saving;
    self.dialog.setAttribute('aria-busy', String(saving));
}

/** @param {SaveDialog} self */
async function saveNow(self) {
    const what = wanted(self);
    if (self.isSaving) return;
    clearTimeout(self.timer);
    setSaving(self, true);
    const { state, blob, diagnostics } = await self.making.whole(what);
    if (!self.isSaving || state === 'cancelled') return;
    setSaving(self, false);
    if (!blob) return;
    download(blob, savedName(fileName(self.store.state), what.format));
    if (!self.dialog.open) return;
    self.dialog.close();
    // A remark about the file, such as that it opens slowly.
    const [remark] = diagnostics;
    toast(remark ? [remark.message, remark.hint].filter(Boolean).join(' ') : say`Saved, ${sizeWords(blob.size)}`);
}
