/** Files of systems, made by the tools `export` and `picture`. Their workers start with the first file, and end when they are not needed or a file is cancelled. */

import { FORMATS } from '../late-tables.js';
import { createTool } from '../engine/tool.js';

/** @typedef {import('../protocol.js').ExportCalls['file']['asked']} Asked */
/** `blob` is the file, or null if a limit was exceeded or the definition has errors. @typedef {{blob: Blob | null, diagnostics: import('../protocol.js').Diagnostic[]}} Exported */

export function createExports() {
    /** @type {ReturnType<typeof createTool<import('../protocol.js').ExportCalls>>} */
    const files = createTool('export', { isStraight: true });
    /** @type {ReturnType<typeof createTool<import('../protocol.js').PictureCalls>>} */
    const pictures = createTool('picture', { isStraight: true });

    return {
        /**
         * @param {Asked} asked
         * @param {{signal?: AbortSignal, progress?: (size: number, piece: Blob) => void}} [options] the signal cancels the file; `progress` gets the size so far and the newest piece
         * @returns {Promise<Exported>}
         */
        async make(asked, { signal, progress } = {}) {
            /** Blobs may lie on the disk. @type {Blob[]} */
            const pieces = [];
            let size = 0;
            /** @param {Uint8Array<ArrayBuffer>} bytes */
            const take = (bytes) => {
                const piece = new Blob([bytes]);
                pieces.push(piece);
                size += piece.size;
                progress?.(size, piece);
            };
            const options = { ...(signal && { signal }), progress: take };
            const { complete, diagnostics } = await (FORMATS[asked.format].content === 'pixels'
                ? pictures.call('pixels', asked, options)
                : files.call('file', asked, options));
            return { blob: complete ? new Blob(pieces) : null, diagnostics };
        },

        /** Ends the tools' workers, which keep the memory of their largest files. */
        leave() {
            files.leave();
            pictures.leave();
        },
    };
}
