/** The worker that makes files. The build joins it with the generated glue. */

import { serve } from './tool.js';

/** The length of a step, in milliseconds. */
const STEP_MS = 8;
/** A piece of this many bytes is sent at once. */
const PIECE = 1 << 20;

serve((module) => wasm_bindgen.initSync({ module }), {
    *file(asked) {
        const file = new wasm_bindgen.Export(asked);
        let trapped = true;
        try {
            for (let isDone = false; !isDone; ) {
                const end = performance.now() + STEP_MS;
                while (!isDone && file.waiting < PIECE && performance.now() < end) isDone = file.step();
                trapped = false;
                // The piece leaves the wasm at once, so that the wasm never holds a whole file.
                yield file.waiting > 0 ? file.take() : undefined;
                trapped = true;
            }
            const report = file.report();
            trapped = false;
            return report;
        } finally {
            // After a trap the file cannot be freed; the page ends this worker.
            if (!trapped) file.free();
        }
    },
});
