/** The Save section: title, link, files, and opening files. */

import { toast } from '../announce.js';
import { listProblems, placesIn } from '../controls/editor.js';
import { copyText } from '../copy.js';
import { button, byId, html, icon, input, make, setValue } from '../dom.js';
import { download, fileName } from '../download.js';
import { LARGEST_FILE, isFavouritesFile } from '../favourites.js';
import { definitionOf } from '../state.js';
import { createExports } from '../save/exports.js';
import { FORMATS } from '../tables.js';

/** @typedef {import('../engine.js').Engine} Engine */

/** Larger JSON files are not read, in bytes: a system's texts have at most 1 MiB, and more when escaped. */
const LARGEST_JSON = 4 << 20;
/** Larger pictures are not read, in bytes. */
const LARGEST_PICTURE = 64 << 20;

/**
 * @param {import('../store.js').Store} store
 * @param {Engine} engine
 * @param {{address: () => Promise<string>, select: () => void, favourites: (text: string) => void, offer: (text: string) => Promise<boolean>, canvas: () => import('../protocol.js').Canvas}} page
 *   `select` shows the link for the reader to copy, `favourites` imports a file of favourites, `offer` opens the text of
 *   another program, if it is one
 */
export function savePanel(store, engine, page) {
    const exports = createExports();
    const title = input('title');
    const showTitle = () => setValue(title, store.state.title || store.state.name);
    // A new title replaces the name of the file.
    title.addEventListener('input', () => store.change({ title: title.value, name: '' }, 'title'));
    title.addEventListener('blur', () => store.settle());
    store.subscribe(showTitle);
    showTitle();

    button('copy-link').addEventListener('click', async () => {
        if (await copyText(await page.address())) toast('Link copied');
        else page.select();
    });

    for (const format of /** @type {import('../protocol.js').Format[]} */ (Object.keys(FORMATS))) {
        const { label, help, picture } = FORMATS[format];
        const save = make('button', { class: 'button', type: 'button', 'data-save': format, title: help }, icon('i-save'), label);
        if (picture) html('save-pictures').lastElementChild?.before(save);
        else html('save-data').append(save);
        save.addEventListener('click', async () => {
            save.disabled = true;
            try {
                await saveAs(format);
            } catch (error) {
                toast(`Not saved: ${error instanceof Error ? error.message : error}.`);
            } finally {
                save.disabled = false;
            }
        });
    }

    /** @param {import('../protocol.js').Format} format */
    async function saveAs(format) {
        const name = fileName(store.state);
        const bare = input('save-bare').checked;
        if (format === 'png') {
            const { width, height } = page.canvas();
            const wanted = Number(byId('png-size', HTMLSelectElement).value);
            const factor = wanted === 0 ? 1 : wanted / Math.max(width, height);
            const blob = await engine.png(Math.round(width * factor), Math.round(height * factor), bare ? null : definitionOf(store.state));
            return download(blob, `${name}.png`);
        }
        const { blob, diagnostics } = await exports.make({ definition: definitionOf(store.state), format, bare, camera: store.state.camera });
        if (!blob) {
            const first = diagnostics[0];
            return toast(first ? `Not saved: ${[first.message, first.hint].filter(Boolean).join(' ')}` : 'Not saved: the file could not be made.');
        }
        const { ending, mime } = FORMATS[format];
        const [, form] = format.split('-');
        download(new Blob([blob], { type: mime }), `${name}${form ? `_${form}` : ''}.${ending}`);
        // A compact SVG may open slowly.
        if (diagnostics[0]) toast([diagnostics[0].message, diagnostics[0].hint].filter(Boolean).join(' '));
    }

    /** @param {File} file */
    async function openFile(file) {
        const problems = html('file-problems');
        problems.replaceChildren();
        const json = /\.json$/i.test(file.name);
        if (file.size > (json ? LARGEST_JSON : LARGEST_PICTURE)) return toast(`This file is too large. ${json ? 'JSON files have at most 4 MB' : 'Pictures have at most 64 MB'}.`);
        try {
            if (json && file.size <= LARGEST_FILE) {
                const text = await file.text();
                if (isFavouritesFile(text)) return page.favourites(text);
            }
            // The worker reads the file, so that the page stays responsive.
            const { definition, diagnostics, text } = await engine.read(file);
            if (text !== null && (await page.offer(text))) return;
            listProblems(problems, diagnostics, text ?? undefined);
            if (!definition) {
                const mistake = diagnostics.find(({ severity }) => severity === 'error');
                const words = [text !== null && mistake && `${placesIn(text)(mistake.start)}: `, mistake?.message ?? 'The file contains no system'];
                return toast(`${file.name} could not be read. ${words.filter(Boolean).join('')}`);
            }
            const name = definition.name || file.name.replace(/\.(json|svg|png)$/i, '');
            store.open({ ...definition, name });
            toast(`Opened ${file.name}${diagnostics.length > 0 ? ', with warnings: see Save' : ''}`);
        } catch (error) {
            toast(`${file.name} could not be read: ${error instanceof Error ? error.message : error}`);
        }
    }

    const chooser = input('file');
    button('open-file').addEventListener('click', () => chooser.click());
    chooser.addEventListener('change', () => {
        const [file] = chooser.files ?? [];
        chooser.value = '';
        if (file) openFile(file);
    });

    /** @param {DragEvent} event */
    const hasFiles = (event) => event.dataTransfer?.types.includes('Files') ?? false;
    let over = 0;
    const showDrop = () => document.body.classList.toggle('dropping', over > 0);
    document.addEventListener('dragenter', (event) => {
        if (!hasFiles(event)) return;
        over += 1;
        showDrop();
    });
    document.addEventListener('dragleave', (event) => {
        if (!hasFiles(event)) return;
        over = Math.max(0, over - 1);
        showDrop();
    });
    document.addEventListener('dragover', (event) => {
        if (hasFiles(event)) event.preventDefault();
    });
    document.addEventListener('drop', (event) => {
        over = 0;
        showDrop();
        if (!hasFiles(event)) return;
        event.preventDefault();
        const file = event.dataTransfer?.files[0];
        if (file) openFile(file);
    });
}
