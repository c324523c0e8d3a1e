/** Packages for learning systems, made of the site's pages. */

import { decimal } from '../base/numerals.js';
import { download } from '../base/download.js';
import { isWhole, jsonOf, responseOf } from '../base/files.js';
import { createTool } from '../engine/tool.js';
import { language, say, words } from '../base/words.js';

/** A page in one file has no other pages beside it. */
const ALONE = say`This page is a single file and has no package inside. Open the playground on a web server, or use the program: lsys scorm.`;

/** @type {ReturnType<typeof createTool<import('../protocol.js').PackageCalls>>} */
const tool = createTool('package', { isStraight: true });

/** A file name for a title. @param {string} title */
const nameOf = (title) =>
    title
        .normalize('NFKD')
        .replace(/[^\w.-]+/g, '_')
        .replace(/^[_.]+|_+$/g, '')
        .slice(0, 60);

/**
 * Saves a package. No exercises stand for the lesson. Returns the number of its bytes; throws a sentence, or an error
 * if a page or the tool does not load.
 * @param {{exercises: string[], title: string, standard: string}} asked `exercises` are values of `x` in links
 */
export async function savePackage(asked) {
    if (isWhole()) throw ALONE;
    const page = async (/** @type {string} */ name) => (await responseOf(name)).text();
    const names = ['package.html', 'exercise.html', 'program.html'];
    const [steps = '', exercise = '', program = ''] = await Promise.all(names.map(page));
    const more = language === 'en' ? {} : await jsonOf(`lang/${language}/programs.json`);
    const catalogue = JSON.stringify({ ...more, ...words });
    const made = await tool.call('package', { ...asked, steps, exercise, program, language, catalogue });
    tool.leave();
    const name = nameOf(asked.title) || (asked.exercises.length === 0 ? 'l-system_lesson' : 'l-system_exercises');
    download(new Blob([made], { type: 'application/zip' }), `${name}_scorm_${asked.standard}.zip`);
    return made.length;
}

/** The words for a saved package. @param {number} bytes */
export const savedWords = (bytes) =>
    say`Saved (${decimal(bytes / 1e6, 1)} MB). Upload the zip as it is, as a SCORM package.`;
