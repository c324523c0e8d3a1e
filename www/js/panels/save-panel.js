/** The Save section: title, link, files, and opening files. */

import { toast } from '../announce.js';
import { listProblems, placesIn } from '../controls/editor.js';
import { copyText } from '../copy.js';
import { button, byId, html, input, setValue } from '../dom.js';
import { FORMAT, LARGEST_FILE } from '../favourites.js';
import { isPicture } from '../find/files.js';
import { bestLink } from '../packed.js';

/** @typedef {import('../engine.js').Engine} Engine */

/** Larger JSON files are not read, in bytes: a system's texts have at most 1 MiB, and more when escaped. */
const LARGEST_JSON = 4 << 20;
/** Larger pictures are not read, in bytes. */
const LARGEST_PICTURE = 64 << 20;

/**
 * @param {import('../store.js').Store} store
 * @param {Engine} engine
 * @param {ReturnType<typeof import('../dialogs.js').createDialogs>} dialogs
 */
export function savePanel(store, engine, dialogs) {
    const title = input('title');
    const showTitle = () => setValue(title, store.state.title || store.state.name);
    // A new title replaces the name of the file.
    title.addEventListener('input', () => store.change({ title: title.value, name: '' }, 'title'));
    title.addEventListener('blur', () => store.settle());
    store.subscribe(showTitle);
    showTitle();

    button('copy-link').addEventListener('click', async () => {
        const address = new URL(await bestLink(store.state), location.href).href;
        if (await copyText(address)) toast('Link copied');
        else await (await dialogs.part('share'))?.select();
    });

    for (const format of /** @type {const} */ (['svg', 'png'])) {
        const save = byId('section-save', HTMLElement).querySelector(`[data-save=${format}]`);
        if (!(save instanceof HTMLButtonElement)) continue;
        save.addEventListener('click', async () => {
            save.disabled = true;
            await (await dialogs.part('save'))?.save(format);
            save.disabled = false;
        });
    }

    /** @param {File} file */
    async function openFile(file) {
        const problems = html('file-problems');
        problems.replaceChildren();
        const json = /\.json$/i.test(file.name);
        if (file.size > (json ? LARGEST_JSON : LARGEST_PICTURE))
            return toast(
                `This file is too large. ${json ? 'JSON files have at most 4 MB' : 'Pictures have at most 64 MB'}.`,
            );
        try {
            if (json && file.size <= LARGEST_FILE) {
                const text = await file.text();
                if (text.includes(FORMAT) && (await (await dialogs.part('favourites'))?.take(text))) return;
            }
            // The worker reads the file, so that the page stays responsive.
            const { definition, diagnostics, text } = await engine.read(file);
            if (text !== null && (await (await dialogs.part('import'))?.offer(text))) return;
            listProblems(problems, diagnostics, text ?? undefined);
            if (!definition) {
                if (isPicture(file))
                    return toast(`${file.name} has no system inside.`, {
                        action: { label: 'Find its rules', act: () => void dialogs.open('find', file) },
                    });
                const mistake = diagnostics.find(({ severity }) => severity === 'error');
                const words = [
                    text !== null && mistake && `${placesIn(text)(mistake.start)}: `,
                    mistake?.message ?? 'The file contains no system',
                ];
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
    // Dialogs with a drop of their own stop the event on its way up.
    const ended = () => {
        over = 0;
        showDrop();
    };
    document.addEventListener('drop', ended, true);
    document.addEventListener('drop', (event) => {
        if (!hasFiles(event)) return;
        event.preventDefault();
        const file = event.dataTransfer?.files[0];
        if (file) openFile(file);
    });
}
