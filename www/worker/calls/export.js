/** Calls for files, but for pictures of pixels. */

import { paced } from '../paced.js';

/** @type {import('../tool.js').CallTable} */
export const calls = {
    file: (asked, tell) => wasm_bindgen.make_file(asked, paced(tell)),
};
