/** The part of the share dialog with packages of exercises for learning systems. */

import { exercises } from '../course/published.js';
import { savePackage, savedWords } from '../course/packaging.js';
import { button, byId, html, input, make, setText } from '../base/dom.js';
import { exerciseIn } from '../exercise/open.js';
import { showFailure } from '../base/failure.js';
import { said, say } from '../base/words.js';

export function createShareScorm() {
    const part = byId('share-scorm', HTMLDetailsElement);
    const list = html('scorm-list');
    const own = byId('scorm-own', HTMLTextAreaElement);
    const save = button('scorm-save');
    const note = html('scorm-note');

    const isLesson = () => input('scorm-lesson').checked;

    async function fill() {
        if (list.childElementCount > 0) return;
        const all = await exercises().catch(() => []);
        if (list.childElementCount > 0) return;
        list.append(
            ...all.map(({ title, x }) =>
                make(
                    'label',
                    { class: 'check' },
                    make('input', { type: 'checkbox', value: x }),
                    make('span', {}, said(title)),
                ),
            ),
        );
    }

    /** The exercises that are ticked, then those of the links. Throws a sentence about a line that is no link. */
    function chosen() {
        const ticked = [...list.querySelectorAll('input')].filter(({ checked }) => checked).map(({ value }) => value);
        const lines = own.value.split('\n').map((line) => line.trim());
        const linked = lines.filter(Boolean).map((line) => {
            const found = exerciseIn(line);
            if (found === null) throw say`This line is no link of an exercise: ${line.slice(0, 60)}`;
            return found;
        });
        if (ticked.length + linked.length === 0) throw say`Choose an exercise.`;
        return [...ticked, ...linked];
    }

    async function pack() {
        save.disabled = true;
        setText(note, say`Packing…`);
        try {
            const bytes = await savePackage({
                exercises: isLesson() ? [] : chosen(),
                title: input('scorm-title').value.trim(),
                standard: byId('scorm-standard', HTMLSelectElement).value,
            });
            setText(note, savedWords(bytes));
        } catch (error) {
            showFailure(note, error, pack);
        }
        save.disabled = false;
    }

    part.addEventListener('toggle', () => {
        if (!part.open) return;
        part.scrollIntoView({ block: 'nearest' });
        void fill();
    });
    part.addEventListener('change', () => {
        html('scorm-exercises').hidden = isLesson();
        setText(note, '');
    });
    save.addEventListener('click', pack);
}
