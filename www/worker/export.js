/** The worker that makes files. The build joins it with the generated glue. */

import { serve } from './tool.js';

/** The time between two signs of life, in milliseconds. */
const SIGN = 300;

serve((module) => wasm_bindgen.initSync({ module }), {
    /** Makes a file in one call, so that the worker cannot hear meanwhile: the page ends the worker to cancel. */
    file(asked, tell) {
        let last = performance.now();
        return wasm_bindgen.make_file(asked, (/** @type {Uint8Array<ArrayBuffer> | undefined} */ piece) => {
            const now = performance.now();
            if (!piece && now - last < SIGN) return;
            last = now;
            tell(piece);
        });
    },
});
