// For script tags: `lsystem.ready` is a promise of the module's functions, which then are `lsystem.expand` and so on.
globalThis.lsystem = {
    ready: import(new URL('./index.js', document.currentScript.src).href).then((module) =>
        Object.assign(globalThis.lsystem, module),
    ),
};
