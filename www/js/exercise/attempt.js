/**
 * The state of a package as a text: the answers of a student as links, one on each line, so that `lsys mark` reads the
 * state itself. In place of the exercise a link has its check sum (`k`), and `mark` is `solved` or a percentage.
 */

/** The step of one's own plant, which has no exercise. */
export const OWN = 'own';
/** The first line of a state. */
const HEAD = /^l-system 1 at=(\d{1,3})$/;
const LINE = /^#v=1&k=([\da-f]{8}|own)&mark=(solved|\d{1,3})(?:&(.+))?$/;

/** `fields` are those of the answer's link; empty if they are not kept. @typedef {{key: string, mark: 'solved' | number, fields: string}} Part */
/** `at` is the shown step; the parts stand in the order in which they were first touched. @typedef {{at: number, parts: Part[]}} Attempt */

/** The CRC-32 of an exercise as it stands in links, in 8 digits: short enough for an answer of 255 characters. @param {string} text */
export function keyOf(text) {
    let sum = ~0;
    for (const character of text) {
        sum ^= character.charCodeAt(0);
        for (let bit = 0; bit < 8; bit++) sum = (sum >>> 1) ^ (sum & 1 ? 0xedb88320 : 0);
    }
    return (~sum >>> 0).toString(16).padStart(8, '0');
}

/** The fields of an answer's link: without the exercise. The name decides on the variant. @param {string} link */
export const fieldsIn = (link) =>
    link
        .replace(/^[^#]*#/, '')
        .split('&')
        .filter((field) => !/^(v|x|hand|away|fill|k|mark)=/.test(field))
        .join('&');

/** The link of an answer. @param {Part} part */
export const linkOf = ({ key, mark, fields }) => [`#v=1&k=${key}&mark=${mark}`, ...(fields ? [fields] : [])].join('&');

/**
 * Writes a state of at most `longest` characters. Where that is too short, the longest drafts are left out first, then
 * the longest solved answers; marks always stay. `dropped` are the keys of what was left out.
 * @param {Attempt} attempt
 * @param {number} longest
 */
export function writeAttempt({ at, parts }, longest) {
    /** @type {string[]} */
    const dropped = [];
    const text = () =>
        [
            `l-system 1 at=${at}`,
            ...parts.map((part) => linkOf(dropped.includes(part.key) ? { ...part, fields: '' } : part)),
        ].join('\n');
    const order = [...parts].sort(
        (a, b) => Number(a.mark === 'solved') - Number(b.mark === 'solved') || b.fields.length - a.fields.length,
    );
    for (const { key, fields } of order) {
        if (text().length <= longest) break;
        if (fields !== '') dropped.push(key);
    }
    return { text: text(), dropped };
}

/** Reads a state; null if the text is none. Damaged lines are left out. @param {string} text @returns {Attempt | null} */
export function readAttempt(text) {
    const [head = '', ...lines] = text.split(/\r?\n/);
    const at = HEAD.exec(head)?.[1];
    if (at === undefined) return null;
    /** @type {Map<string, Part>} */
    const parts = new Map();
    for (const line of lines) {
        const [, key = '', mark = '', fields = ''] = LINE.exec(line) ?? [];
        if (key) parts.set(key, { key, mark: mark === 'solved' ? mark : Math.min(100, Number(mark)), fields });
    }
    return { at: Number(at), parts: [...parts.values()] };
}

/**
 * What is known from two places: the answers of `newer`, and those that only `older` has. Solved stays solved.
 * @param {Attempt} newer
 * @param {Attempt} older
 * @returns {Attempt}
 */
export function merged(newer, older) {
    const of = (/** @type {Attempt} */ { parts }, /** @type {string} */ key) => parts.find((part) => part.key === key);
    /** @param {Part} part */
    const better = (part) => {
        const former = of(older, part.key);
        const isBetter =
            former && ((former.mark === 'solved' && part.mark !== 'solved') || (!part.fields && former.fields));
        return isBetter ? former : part;
    };
    return {
        at: newer.at,
        parts: [...newer.parts.map(better), ...older.parts.filter(({ key }) => !of(newer, key))],
    };
}
