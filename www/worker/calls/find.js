/** Calls for the search for rules. */

/** @typedef {import('../../js/protocol.js').FindReport} FindReport */

/** A step lasts about this long, in milliseconds: timers add a pause of 4 ms after each. */
const STEP_MS = 40;
/** The work between two looks at the clock: systems of a picture, or symbols of a string. */
const SHARE = { picture: 2048, string: 65_536 };
/** Reports are at least this far apart, in milliseconds. */
const BEAT = 250;

/** The present search; `work` is what it did so far. @type {{finder: wasm_bindgen.RuleFinder, share: number, isString: boolean, work: number, isMore: boolean} | null} */
let search = null;

/** @returns {FindReport} */
function report() {
    if (!search) throw new Error('No search has begun.');
    return { ...search.finder.report(), work: search.work, isMore: search.isMore };
}

/** @param {wasm_bindgen.GreyPicture} picture */
function taken(picture) {
    const { width, height, leftOut } = picture;
    const grey = picture.grey();
    picture.free();
    return { grey, width, height, leftOut };
}

/** @type {import('../tool.js').CallTable} */
export const calls = {
    begin({ source, question, part, parts, named }) {
        search?.finder.free();
        search = null;
        const isString = 'text' in source;
        const ofPicture = (
            /** @type {import('../../js/protocol.js').FindPicture} */ { grey, width, height, isStraight = false },
        ) => wasm_bindgen.RuleFinder.ofPicture(grey, { width, height, isStraight }, question, part, parts, named);
        const finder = isString ? wasm_bindgen.RuleFinder.ofString(source.text, question) : ofPicture(source);
        search = { finder, isString, share: isString ? SHARE.string : SHARE.picture, work: 0, isMore: true };
        return null;
    },
    compare: ({ definition }) => search?.finder.compared(definition) ?? null,
    svg: ({ bytes }) => taken(wasm_bindgen.GreyPicture.ofSvg(bytes)),
    photograph({ grey, width, height }) {
        const picture = wasm_bindgen.GreyPicture.ofPhotograph(grey, width, height);
        return picture ? taken(picture) : null;
    },
    outline: ({ bytes }) => wasm_bindgen.outlineOfSvg(bytes) ?? null,
    *search({ until }) {
        let last = performance.now();
        while (search?.isMore && search.work < until) {
            const end = performance.now() + STEP_MS;
            do {
                search.isMore = search.finder.step(search.share);
                // Systems that are like the picture are more work, so a step may try fewer.
                search.work = search.isString ? search.work + search.share : search.finder.tried();
            } while (search.isMore && search.work < until && performance.now() < end);
            const now = performance.now();
            if (now - last < BEAT) yield;
            else {
                last = now;
                yield report();
            }
        }
        return report();
    },
};
