/**
 * The state of a package as a text: the answers of a student as links, one on each line, so that `lsys mark` reads the
 * state itself. In place of the exercise a link has its check sum (`k`), and `mark` is `solved` or a percentage.
 */

/** The step of one's own plant, which has no exercise. */
export const OWN = 'own';
/** The first line of a state. */
const HEAD = /^l-system 1 at=(\d{1,3})$/;
const LINE = /^#v=1&k=([\da-f]{8}|own)&mark=(solved|\d{1,3})(?:&t=([\da-z]{1,9}))?(?:&(.+))?$/;
/** The most parts that are read: other packages have other exercises, and this one at most 100. */
const MOST_PARTS = 500;

/**
 * The answer to the exercise `id`. `fields` are those of its link; empty if they are not kept. `time` is that of its last
 * change, in milliseconds.
 * @typedef {{id: string, time: number, mark: 'solved' | number, fields: string}} Part
 */
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
        .filter((field) => !/^(v|x|hand|away|fill|k|mark|t)=/.test(field))
        .join('&');

/** The link of an answer. @param {Pick<Part, 'id' | 'mark' | 'fields'>} part @param {number} [time] of its last change */
export const linkOf = ({ id, mark, fields }, time = 0) =>
    [`#v=1&k=${id}&mark=${mark}`, time > 0 && `t=${time.toString(36)}`, fields].filter(Boolean).join('&');

/** What weighs more stays, older or newer: solved stays solved, and a text stays. @param {{mark?: unknown, fields?: string}} part */
export const weightOf = ({ mark, fields }) => (mark === 'solved' ? 2 : 0) + (fields ? 1 : 0);

/**
 * Writes a state of at most `longest` characters. Where that is too short, the longest drafts are left out first, then
 * the longest solved answers; marks always stay. `dropped` are the ids of what was left out.
 * @param {Attempt} attempt
 * @param {number} longest
 */
export function writeAttempt({ at, parts }, longest) {
    const lines = new Map(parts.map((part) => [part.id, linkOf(part, part.time)]));
    const text = () => [`l-system 1 at=${at}`, ...lines.values()].join('\n');
    /** @type {string[]} */
    const dropped = [];
    let { length } = text();
    const order = [...parts].sort(
        (a, b) => Number(a.mark === 'solved') - Number(b.mark === 'solved') || b.fields.length - a.fields.length,
    );
    for (const part of order) {
        if (length <= longest) break;
        if (part.fields === '') continue;
        lines.set(part.id, linkOf({ ...part, fields: '' }, part.time));
        length -= part.fields.length + 1;
        dropped.push(part.id);
    }
    return { text: text(), dropped };
}

/** Reads a state; null if the text is none. Damaged lines are left out. @param {string} text @returns {Attempt | null} */
export function readAttempt(text) {
    const [head = '', ...lines] = text.split(/\r?\n/, 1 + MOST_PARTS);
    const at = HEAD.exec(head)?.[1];
    if (at === undefined) return null;
    /** @type {Map<string, Part>} */
    const parts = new Map();
    for (const line of lines) {
        const [, id = '', mark = '', time = '0', fields = ''] = LINE.exec(line) ?? [];
        if (id)
            parts.set(id, {
                id,
                time: parseInt(time, 36),
                mark: mark === 'solved' ? mark : Math.min(100, Number(mark)),
                fields,
            });
    }
    return { at: Number(at), parts: [...parts.values()] };
}
