// For pages and bundlers: the wasm lies beside this module.
import init from './lsystem.js';

await init({ module_or_path: new URL('./lsystem_bg.wasm', import.meta.url) });

export * from './library.js';
