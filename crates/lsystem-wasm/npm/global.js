// For script tags: `lsystem.ready` is a promise of the module's functions, which then are `lsystem.expand` and `lsystem.draw`.
globalThis.lsystem = {
    ready: import(new URL('./index.js', document.currentScript.src).href).then(({ draw, expand }) =>
        Object.assign(globalThis.lsystem, { draw, expand }),
    ),
};
