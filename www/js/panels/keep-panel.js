/** The title, links, files, and opening them again. */

import { toast } from '../announce.js';
import { listProblems, placesIn } from '../controls/editor.js';
import { copyText } from '../copy.js';
import { button, byId, html, icon, input, make, setValue } from '../dom.js';
import { download, fileName } from '../download.js';
import { LARGEST_FILE, isFavouritesFile } from '../favourites.js';
import { definitionOf } from '../state.js';
import { FORMATS } from '../tables.js';

/** @typedef {import('../engine.js').Engine} Engine */

/** Larger files with a system in JSON are not read, in bytes: its texts have at most 1 MiB, which may be escaped. */
const LARGEST_JSON = 4 << 20;
/** Nor are larger pictures that carry a system. */
const LARGEST_PICTURE = 64 << 20;

/**
 * @param {import('../store.js').Store} store
 * @param {Engine} engine
 * @param {{address: () => Promise<string>, select: () => void, favourites: (text: string) => void, canvas: () => import('../protocol.js').Canvas}} page
 *   `select` shows the link for the reader to copy, `favourites` takes a file of them
 */
export function keepPanel(store, engine, page) {
    const title = input('title');
    const showTitle = () => setValue(title, store.state.title || store.state.name);
    // The name of a file it came from is no name for what has been given another.
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
        if (format === 'png') {
            const { width, height } = page.canvas();
            const wanted = Number(byId('png-size', HTMLSelectElement).value);
            const factor = wanted === 0 ? 1 : wanted / Math.max(width, height);
            const blob = await engine.png(Math.round(width * factor), Math.round(height * factor), definitionOf(store.state));
            return download(blob, `${name}.png`);
        }
        const { blob, diagnostics } = await engine.export(format);
        if (!blob) {
            const first = diagnostics[0];
            return toast(first ? `Not saved: ${[first.message, first.hint].filter(Boolean).join(' ')}` : 'Not saved: there is nothing to save.');
        }
        const { ending, mime } = FORMATS[format];
        const [, form] = format.split('-');
        download(new Blob([blob], { type: mime }), `${name}${form ? `_${form}` : ''}.${ending}`);
        // A compact picture may ask much of who shows it.
        if (diagnostics[0]) toast([diagnostics[0].message, diagnostics[0].hint].filter(Boolean).join(' '));
    }

    /** @param {File} file */
    async function openFile(file) {
        const problems = html('file-problems');
        problems.replaceChildren();
        const json = /\.json$/i.test(file.name);
        if (file.size > (json ? LARGEST_JSON : LARGEST_PICTURE)) return toast(`This file is too large: ${json ? 'a system has at most 4 MB' : 'a picture with its system has at most 64 MB'}.`);
        try {
            if (json && file.size <= LARGEST_FILE) {
                const text = await file.text();
                if (isFavouritesFile(text)) return page.favourites(text);
            }
            // The worker reads it, so that the page stays free.
            const { definition, diagnostics, text } = await engine.read(file);
            listProblems(problems, diagnostics, text ?? undefined);
            if (!definition) {
                const mistake = diagnostics.find(({ severity }) => severity === 'error');
                const words = [text !== null && mistake && `${placesIn(text)(mistake.start)}: `, mistake?.message ?? 'it holds no system'];
                return toast(`${file.name} could not be read. ${words.filter(Boolean).join('')}`);
            }
            const name = definition.name || file.name.replace(/\.(json|svg|png)$/i, '');
            store.open({ ...definition, name });
            toast(`Opened ${file.name}${diagnostics.length > 0 ? ', with remarks: see Save' : ''}`);
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
