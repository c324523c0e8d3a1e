// For Node.js, whose `fetch` does not read files.
import { readFileSync } from 'node:fs';
import { initSync } from './lsystem.js';

initSync({ module: readFileSync(new URL('./lsystem_bg.wasm', import.meta.url)) });

export * from './library.js';
