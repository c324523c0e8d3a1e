/** Files of systems, made by the tool `export`. Its worker starts with the first file, and ends when it is not needed or a file is cancelled. */

import { createTool } from '../tool.js';

/** @typedef {import('../protocol.js').ExportCalls['file']['asked']} Asked */
/** `blob` is the file, or null if a limit was exceeded or the definition has errors. @typedef {{blob: Blob | null, diagnostics: import('../protocol.js').Diagnostic[]}} Exported */

export function createExports() {
    /** @type {ReturnType<typeof createTool<import('../protocol.js').ExportCalls>>} */
    const tool = createTool('export', { isStraight: true });

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
            const { complete, diagnostics } = await tool.call('file', asked, {
                ...(signal && { signal }),
                progress: take,
            });
            return { blob: complete ? new Blob(pieces) : null, diagnostics };
        },

        /** Ends the tool's worker, which keeps the memory of its largest file. */
        leave: tool.leave,
    };
}
