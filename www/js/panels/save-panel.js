/** The Save section: title, files, and opening files. */

import { button, byId, input, setValue } from '../base/dom.js';

/**
 * @param {import('../state/store.js').Store} store
 * @param {ReturnType<typeof import('../dialogs/dialogs.js').createDialogs>} dialogs
 */
export function savePanel(store, dialogs) {
    const title = input('title');
    const showTitle = () => setValue(title, store.state.title || store.state.name);
    // A new title replaces the name of the file.
    title.addEventListener('input', () => store.change({ title: title.value, name: '' }, 'title'));
    title.addEventListener('blur', () => store.settle());
    store.subscribe(showTitle);
    showTitle();

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
    const openFile = (file) => void dialogs.open('file', file);
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
