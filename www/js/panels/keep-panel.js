/** Links, files, and opening them again. */

import { announce, toast } from '../announce.js';
import { listProblems } from '../controls/editor.js';
import { button, byId, html, input, make } from '../dom.js';
import { definitionOf } from '../state.js';

/** @typedef {import('../engine.js').Engine} Engine */

/** Larger files are no L-systems, in bytes. */
const LARGEST_FILE = 64 << 20;

/** @type {Record<string, string>} */
const MIME = { svg: 'image/svg+xml', csv: 'text/csv', txt: 'text/plain', json: 'application/json' };

/**
 * @param {import('../store.js').Store} store
 * @param {Engine} engine
 * @param {{address: () => Promise<string>, canvas: () => import('../engine.js').Canvas}} page
 */
export function keepPanel(store, engine, page) {
    for (const id of ['share', 'copy-link']) button(id).addEventListener('click', async () => copyLink(await page.address()));

    for (const save of document.querySelectorAll('[data-save]')) {
        save.addEventListener('click', async () => {
            if (!(save instanceof HTMLButtonElement)) return;
            save.disabled = true;
            try {
                await saveAs(String(save.dataset.save));
            } catch (error) {
                toast(`Not saved: ${error instanceof Error ? error.message : error}.`);
            } finally {
                save.disabled = false;
            }
        });
    }

    /** @param {string} format */
    async function saveAs(format) {
        const name = fileName(store.state);
        if (format === 'png') {
            const { width, height } = page.canvas();
            const wanted = Number(byId('png-size', HTMLSelectElement).value);
            const factor = wanted === 0 ? 1 : wanted / Math.max(width, height);
            const blob = await engine.png(Math.round(width * factor), Math.round(height * factor), definitionOf(store.state));
            if (!blob) throw new Error('the browser could not make the picture');
            return download(blob, `${name}.png`);
        }
        const { text, diagnostics } = await engine.export(/** @type {'svg'} */ (format));
        if (text === null) {
            const first = diagnostics[0];
            return toast(first ? `Not saved: ${[first.message, first.hint].filter(Boolean).join(' ')}` : 'Not saved: there is nothing to save.');
        }
        const [ending = format, form] = format.split('-');
        download(new Blob([text], { type: MIME[ending] ?? 'text/plain' }), `${name}${form ? `_${form}` : ''}.${ending}`);
        // A compact picture may ask much of who shows it.
        if (diagnostics[0]) toast([diagnostics[0].message, diagnostics[0].hint].filter(Boolean).join(' '));
    }

    /** @param {File} file */
    async function openFile(file) {
        const problems = html('file-problems');
        problems.replaceChildren();
        if (file.size > LARGEST_FILE) return toast('This file is too large to be an L-system.');
        try {
            const { definition, diagnostics } = await engine.read(await file.arrayBuffer());
            listProblems(problems, diagnostics);
            if (!definition) return toast(`${file.name} could not be read: ${diagnostics[0]?.message ?? 'it holds no system'}`);
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

/** @param {string} address */
async function copyLink(address) {
    try {
        await navigator.clipboard.writeText(address);
        toast('Link copied');
    } catch {
        // Some frames refuse the clipboard; the address bar holds the same link.
        toast('The clipboard is not available here: copy the address of this page instead.');
    }
}

/** @param {Blob} blob @param {string} name */
function download(blob, name) {
    const url = URL.createObjectURL(blob);
    const anchor = make('a', { href: url, download: name });
    anchor.click();
    // The download has its own hold on the blob by then.
    setTimeout(() => URL.revokeObjectURL(url), 60_000);
    announce(`Saved ${name}`);
}

/** @param {import('../state.js').State} state */
function fileName({ name, title, iterations }) {
    const base = (name || title).normalize('NFKD').replace(/[^\w.-]+/g, '_').replace(/^[_.]+|_+$/g, '').slice(0, 60) || 'l-system';
    return `${base}_n${iterations}`;
}
