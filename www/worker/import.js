/** The worker that reads the notations of other programs. The build joins it with the generated glue. */

import { serve } from './tool.js';

serve((module) => wasm_bindgen.initSync({ module }), {
    import: ({ text }) => wasm_bindgen.importSystems(text),
});
