/** Opens a file: a system as JSON, in a picture or in a foreign notation, or favourites. */

import { toast } from '../base/announce.js';
import { listProblems, placesIn } from '../controls/editor.js';
import { html } from '../base/dom.js';
import { FORMAT, LARGEST_FILE } from '../favourites/favourites.js';
import { isPicture } from '../find/files.js';
import { withShape } from './shape-line.js';
import { createTool } from '../engine/tool.js';
import { reasonOf, say } from '../base/words.js';

/** Larger JSON files are not read, in bytes: a system's texts have at most 1 MiB, and more when escaped. */
const LARGEST_JSON = 4 << 20;
/** Larger pictures are not read, in bytes. */
const LARGEST_PICTURE = 64 << 20;
/** Outlines are small. Larger SVGs are not read as shapes, in bytes. */
const LARGEST_OUTLINE = 1 << 20;

/** @param {import('./dialogs.js').Page} page */
export function createFileOpening({ store, engine, part, open }) {
    /** @type {ReturnType<typeof createTool<import('../protocol.js').FindCalls>>} */
    const tool = createTool('find');

    /** Adds the outline in a picture to the rules, as a shape to grow in. Returns whether there is one. @param {File} file */
    async function addOutline(file) {
        if (!/svg/i.test(`${file.type} ${file.name}`) || file.size > LARGEST_OUTLINE) return false;
        const shape = await tool.call('outline', { bytes: new Uint8Array(await file.arrayBuffer()) });
        if (shape === null) return false;
        const [rules, name] = withShape(store.state.rules, shape);
        store.change({ rules, shapes: true }, '');
        toast(say`${file.name} is the shape \`${name}\` now, 20 units in size: \`inside(${name}, x, y)\`.`, {
            action: { label: say`Find its rules`, act: () => void open('find', file) },
        });
        return true;
    }

    return {
        /** @param {File} file */
        async open(file) {
            const problems = html('file-problems');
            problems.replaceChildren();
            const json = /\.json$/i.test(file.name);
            if (file.size > (json ? LARGEST_JSON : LARGEST_PICTURE))
                return toast(
                    json
                        ? say`This file is too large. JSON files have at most 4 MB.`
                        : say`This file is too large. Pictures have at most 64 MB.`,
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
                    if (isPicture(file)) {
                        if (await addOutline(file)) return;
                        return toast(say`${file.name} has no system inside.`, {
                            action: { label: say`Find its rules`, act: () => void open('find', file) },
                        });
                    }
                    const mistake = diagnostics.find(({ severity }) => severity === 'error');
                    const words = [
                        text !== null && mistake && `${placesIn(text)(mistake.start)}: `,
                        mistake?.message ?? say`The file contains no system`,
                    ];
                    return toast(say`${file.name} could not be read. ${words.filter(Boolean).join('')}`);
                }
                const name = definition.name || file.name.replace(/\.(json|svg|png)$/i, '');
                store.open({ ...definition, name });
                toast(
                    diagnostics.length > 0
                        ? say`Opened ${file.name}, with warnings: see Save`
                        : say`Opened ${file.name}`,
                );
            } catch (error) {
                toast(say`${file.name} could not be read: ${reasonOf(error)}`);
            }
        },
    };
}
