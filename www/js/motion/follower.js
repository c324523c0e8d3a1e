/** Sound in drawing order: a note for the line that playback has just drawn. */

/** The most notes in a second; faster playback sounds every second line, every third, and so on. */
const RATE = 12;
/** The notes that are asked for at a time. */
const BLOCK = 128;
/** The longest note, and that of a line shown by hand, in seconds. */
const [LONGEST, BY_HAND] = [2, 0.4];

/** How many lines apart the notes are. @param {number} perSecond lines */
export const strideOf = (perSecond) => BigInt(Math.max(1, Math.ceil(perSecond / RATE)));

/** @typedef {import('../protocol.js').Note} Note */

/**
 * @param {object} sound
 * @param {(from: bigint, stride: bigint, count: number) => Promise<Note[]>} sound.ask
 * @param {(note: Note, seconds: number) => void} sound.play
 */
export function createFollower({ ask, play }) {
    /** By stride and number. @type {Map<string, Note[]>} */
    let blocks = new Map();
    /** The line that sounded last, as the page counts lines. @type {bigint | null} */
    let last = null;
    let lastStride = 1n;
    /** The number of the last question about a line by hand. */
    let question = 0;

    /** A block of notes, which comes later unless it is here. @param {bigint} stride @param {bigint} number @returns {Note[]} */
    function block(stride, number) {
        const key = `${stride} ${number}`;
        const known = blocks.get(key);
        if (known) return known;
        // Only those around the turtle are kept.
        for (const old of [...blocks.keys()].slice(0, -2)) blocks.delete(old);
        /** @type {Note[]} */
        const notes = [];
        blocks.set(key, notes);
        const own = blocks;
        ask(number * BigInt(BLOCK) * stride, stride, BLOCK).then(
            (came) => notes.push(...came),
            () => own.delete(key),
        );
        return notes;
    }

    return {
        /** Playback shows the first `upto` lines; null for all. `perSecond`: the lines drawn in a second; 0 if the reader moves by hand. @param {{upto: bigint | null, perSecond: number}} walk */
        async follow({ upto, perSecond }) {
            const own = ++question;
            if (upto === null || upto <= 0n) {
                last = null;
                return;
            }
            if (perSecond <= 0) {
                last = null;
                const [note] = await ask(upto - 1n, 1n, 1).catch(() => []);
                if (note && own === question) play(note, BY_HAND);
                return;
            }
            const stride = strideOf(perSecond);
            const index = (upto - 1n) / stride;
            if (index === last && stride === lastStride) return;
            [last, lastStride] = [index, stride];
            const [number, place] = [index / BigInt(BLOCK), Number(index % BigInt(BLOCK))];
            const note = block(stride, number)[place];
            if (place > BLOCK / 2) block(stride, number + 1n);
            if (note) play(note, Math.min(LONGEST, Number(stride) / perSecond));
        },

        /** The system or the choices have changed. */
        forget() {
            blocks = new Map();
            last = null;
            question++;
        },
    };
}
