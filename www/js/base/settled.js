/**
 * Modules that use the browser's storage wait for this one. On a busy machine, Chromium drops all that a page of a disk
 * stores if the page uses the storage before the browser has noted it, and any answer of the browser shows that it has.
 */
if (globalThis.location?.protocol === 'file:') await navigator.locks?.query().catch(() => {});
export {};
