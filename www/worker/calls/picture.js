/** Calls for files of pixels. */

import { paced } from '../paced.js';

/** @type {import('../tool.js').CallTable} */
export const calls = {
    pixels: (asked, tell) => wasm_bindgen.make_picture(asked, paced(tell)),
};
