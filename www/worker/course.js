/** The worker for exercises and comparisons. The build joins it with the generated glue. */

import { serve } from './tool.js';

serve((module) => wasm_bindgen.initSync({ module }), {
    check: ({ definition, output }) => wasm_bindgen.checkOutput(definition, output),
});
