/** Opens a file: a system as JSON, in a picture or in a foreign notation, or favourites. */

import { toast } from './announce.js';
import { listProblems, placesIn } from './controls/editor.js';
import { html } from './dom.js';
import { FORMAT, LARGEST_FILE } from './favourites.js';
import { isPicture } from './find/files.js';

/** Larger JSON files are not read, in bytes: a system's texts have at most 1 MiB, and more when escaped. */
const LARGEST_JSON = 4 << 20;
/** Larger pictures are not read, in bytes. */
const LARGEST_PICTURE = 64 << 20;

/** @param {import('./dialogs.js').Page} page */
export function createFileOpening({ store, engine, part, open }) {
    return {
        /** @param {File} file */
        async open(file) {
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
                    if (text.includes(FORMAT) && (await (await part('favourites'))?.take(text))) return;
                }
                // The worker reads the file, so that the page stays responsive.
                const { definition, diagnostics, text } = await engine.read(file);
                if (text !== null && (await (await part('import'))?.offer(text))) return;
                listProblems(problems, diagnostics, text ?? undefined);
                if (!definition) {
                    if (isPicture(file))
                        return toast(`${file.name} has no system inside.`, {
                            action: { label: 'Find its rules', act: () => void open('find', file) },
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
        },
    };
}
