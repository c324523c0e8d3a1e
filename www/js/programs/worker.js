/**
 * The script of the worker that runs a program. It is handed over as a text, so it uses nothing outside of itself.
 *
 * It hears first how to start, then what to run: given functions, the program, and calls. It answers with a message for
 * each call. What is expected is not known here, so a program cannot give it back.
 */

/** @typedef {{name: string, args: unknown[], quiet?: boolean}} Call `args` may have `{result: n}`: the result of call n */
/** @typedef {{type: string, message: string, line: number | null, of?: string}} Fault */
/**
 * What a call gave. `value` is JSON; null of nothing.
 * @typedef {{at: number, value?: string, nothing?: boolean, fault?: Fault, ms: number, changed: boolean, printed: string}} Given
 */
/** @typedef {{code: string, given: string, names: string[], calls: Call[]}} Run */

function work() {
    const scope = /** @type {any} */ (self);
    const [post, load, memory] = [scope.postMessage.bind(scope), scope.importScripts.bind(scope), WebAssembly.Memory];
    const { parse, stringify } = JSON;
    const now = performance.now.bind(performance);
    /** The most memory of an interpreter, in bytes. */
    const MEMORY = 512 << 20;
    /** The most of what a program prints, and of a result, in characters. */
    const [PRINTED, RESULT] = [65_536, 8_000_000];
    /** @param {string} text */
    const address = (text) => URL.createObjectURL(new Blob([text], { type: 'text/javascript' }));
    /** @type {((run: Run) => void) | null} */
    let run = null;

    /** @param {any} first */
    async function startPython({ files, module, snapshot, harness, lock }) {
        const grow = memory.prototype.grow;
        memory.prototype.grow = function (/** @type {number} */ pages) {
            if (this.buffer.byteLength + pages * 65_536 > MEMORY) throw new RangeError('memory');
            return grow.call(this, pages);
        };
        // The interpreter asks for its files as if from an address.
        scope.fetch = async () => new Response(files.library);
        scope.WebAssembly.instantiateStreaming = async (/** @type {unknown} */ _, /** @type {any} */ imports) => ({
            module,
            instance: await WebAssembly.instantiate(module, imports),
        });
        // Else it takes the worker for one that cannot import modules.
        scope.importScripts = undefined;
        const { default: createPyodideModule } = await import(address(files.core));
        const { loadPyodide } = await import(address(files.loader));
        const python = await loadPyodide({
            indexURL: 'https://python.invalid/',
            createPyodideModule,
            stdin: () => null,
            lockFileContents: stringify({ info: lock, packages: {} }),
            ...(snapshot ? { _loadSnapshot: snapshot } : { _makeSnapshot: true }),
        });
        if (!snapshot) post({ snapshot: python.makeMemorySnapshot() });
        const runs = python.runPython(harness);
        run = (asked) => runs(stringify(asked), (/** @type {string} */ text) => post(parse(text)));
        post({ started: true });
    }

    /** The line of an error in the program. @param {any} error @param {string} place */
    function faultOf(error, place) {
        const of = error instanceof Error;
        const found = of ? new RegExp(`${place}:(\\d+)`).exec(error.stack ?? '') : null;
        return {
            type: of ? error.name : 'thrown',
            message: of ? error.message : String(error),
            line: found ? Number(found[1]) : null,
        };
    }

    /** Makes a text of a syntax error's place, which only an uncaught error tells. @param {string} place */
    const uncaught = (place) =>
        new Promise((resolve) => {
            scope.onerror = (/** @type {string} */ message, /** @type {string} */ _, /** @type {number} */ line) => {
                resolve({ type: 'SyntaxError', message: message.replace(/^.*': |^Uncaught SyntaxError: /, ''), line });
                return true;
            };
            setTimeout(() => load(place));
        });

    /** @param {Run} asked */
    async function runScript({ code, given, names, calls }) {
        let printed = '';
        const print = (/** @type {unknown[]} */ ...words) => {
            printed += `${words.map((word) => (typeof word === 'string' ? word : (stringify(word) ?? String(word)))).join(' ')}\n`;
            if (printed.length > PRINTED) throw new RangeError('printed too much');
        };
        scope.console = { log: print, info: print, warn: print, error: print, debug: print };
        for (const name of [
            'postMessage',
            'onmessage',
            'fetch',
            'close',
            'importScripts',
            'Worker',
            'BroadcastChannel',
        ])
            scope[name] = undefined;
        load(address(given));
        const former = Object.fromEntries(names.map((name) => [name, scope[name]]));
        const place = address(code);
        const began = now();
        try {
            load(place);
        } catch (error) {
            const fault = error instanceof SyntaxError ? await uncaught(place) : faultOf(error, place);
            return post({ at: -1, fault, printed, ms: now() - began });
        }
        /** @type {Record<string, unknown>} */
        const found = {};
        scope.found = (/** @type {string} */ name, /** @type {unknown} */ value) => (found[name] = value);
        load(address(names.map((name) => `found("${name}",typeof ${name}=="function"?${name}:0);`).join('')));
        post({
            at: -1,
            own: names.filter((name) => found[name] && found[name] !== former[name]),
            printed,
            ms: now() - began,
        });
        /** @type {unknown[]} */
        const results = [];
        for (const [at, { name, args, quiet }] of calls.entries()) {
            printed = '';
            const given = args.map((/** @type {any} */ arg) =>
                Number.isInteger(arg?.result) ? results[arg.result] : parse(stringify(arg)),
            );
            const before = quiet ? '' : stringify(given);
            const start = now();
            try {
                const value = /** @type {Function} */ (found[name])(...given);
                const ms = now() - start;
                results[at] = value;
                const text = quiet
                    ? String(value?.length ?? 0)
                    : stringify(value, (_, one) =>
                          typeof one === 'number' && !Number.isFinite(one) ? String(one) : one,
                      );
                if (text?.length > RESULT) throw new RangeError('the result is too large');
                const changed = !quiet && stringify(given) !== before;
                post({
                    at,
                    value: text ?? 'null',
                    nothing: value === undefined || value === null,
                    ms,
                    changed,
                    printed,
                });
            } catch (error) {
                post({ at, fault: faultOf(error, place), ms: now() - start, changed: false, printed });
            }
        }
        post({ done: true });
    }

    scope.onmessage = async (/** @type {MessageEvent} */ { data }) => {
        if (data.run) return run?.(data.run);
        if (data.python) return startPython(data).catch((error) => post({ crash: String(error?.message ?? error) }));
        run = runScript;
        post({ started: true });
    };
}

/** The script as a text. */
export const WORKER = `(${work})();`;
