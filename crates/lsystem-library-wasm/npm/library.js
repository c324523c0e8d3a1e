// The module's functions. The module that imports the wasm, `index.js` or `node.js`, exports them.
import { System, check as problemsOf, read as readBytes } from './lsystem.js';

/** An error of a system or of a call, with all problems in `diagnostics`. */
export class LSystemError extends Error {
    constructor({ message, diagnostics }) {
        super(message);
        this.diagnostics = diagnostics;
    }

    get name() {
        return 'LSystemError';
    }
}

/** Replaces values that JSON drops or refuses by ones that are read, or that an error can name. */
function plain(_, value) {
    if (typeof value === 'bigint') return Number(value);
    if (typeof value === 'function' || typeof value === 'symbol') return String(value);
    if (typeof value === 'number' && !Number.isFinite(value)) return String(value);
    if (value instanceof Map) return Object.fromEntries(value);
    if (value && typeof value === 'object' && !Array.isArray(value) && Symbol.iterator in value) return [...value];
    return value;
}

const text = (system) => JSON.stringify(system, plain, 2) ?? 'null';

/** Calls the wasm, whose errors are objects. */
function attempt(call) {
    try {
        return call();
    } catch (thrown) {
        throw Array.isArray(thrown?.diagnostics) && !(thrown instanceof Error) ? new LSystemError(thrown) : thrown;
    }
}

/** Calls `use` with an opened system. A generation that is no number is refused as one that is not whole. */
function opened(system, n, use) {
    return attempt(() => {
        const handle = new System(text(system), n === undefined || typeof n === 'number' ? n : Number.NaN);
        try {
            return use(handle);
        } finally {
            handle.free();
        }
    });
}

export function expand(system, n) {
    return opened(system, n, (handle) => handle.expand());
}

export function count(system, n) {
    const [symbols, segments] = opened(system, n, (handle) => handle.count().map(BigInt));
    return { symbols, segments };
}

export function draw(system, n) {
    return opened(system, n, (handle) => {
        const drawn = handle.draw();
        const { dimension, segments, colours, levels } = drawn;
        drawn.free();
        return { dimension, segments, colours, levels };
    });
}

export function symbols(system, n) {
    return pages(
        opened(system, n, (handle) => handle.symbols()),
        (page, { apart }) => (apart ? page.split('\n').slice(0, -1) : page),
    );
}

export function segments(system, n) {
    return pages(
        opened(system, n, (handle) => handle.segments()),
        function* (page, { dimension }) {
            for (let i = 0; i < page.length; i += 8) {
                const [from, to] = [i, i + 3].map((start) => [...page.subarray(start, start + dimension)]);
                yield { from, to, colour: page[i + 6], level: page[i + 7] };
            }
        },
    );
}

/** The parts of all pages of a reader. The reader is freed at the end, or when the loop is left. */
function* pages(reader, parts) {
    try {
        for (let page = reader.page(); page.length > 0; page = reader.page()) yield* parts(page, reader);
    } finally {
        reader.free();
    }
}

export function file(system, format, { n, view, camera, ratio, ...others } = {}) {
    for (const [name, value] of Object.entries({ view, camera })) {
        if (value != null && typeof value !== 'object') {
            throw new LSystemError({ message: `${name} must be an object`, diagnostics: [] });
        }
    }
    const given = Object.entries(others).filter(([, value]) => value !== undefined);
    const values = Object.fromEntries(given.map(([name, value]) => [name, option(value)]));
    return opened(system, n, (handle) => handle.file(format, { values, view, camera, ratio }));
}

/** A size as a text; values of other types as texts, which are refused with what is expected. */
function option(value) {
    if (Array.isArray(value)) return value.join('x');
    return typeof value === 'boolean' || typeof value === 'number' ? value : String(value);
}

export const svg = (system, options) => file(system, 'svg', options);

export const png = (system, options) => file(system, 'png', options);

export function read(content) {
    return attempt(() => readBytes(bytes(content))).definition;
}

export function check(system) {
    const isFile = typeof system === 'string' || system instanceof ArrayBuffer || ArrayBuffer.isView(system);
    if (!isFile) return problemsOf(text(system));
    try {
        return readBytes(bytes(system)).problems;
    } catch (thrown) {
        if (!thrown?.diagnostics) throw thrown;
        return thrown.diagnostics;
    }
}

function bytes(content) {
    if (typeof content === 'string') return new TextEncoder().encode(content);
    if (ArrayBuffer.isView(content)) return new Uint8Array(content.buffer, content.byteOffset, content.byteLength);
    return new Uint8Array(content);
}
