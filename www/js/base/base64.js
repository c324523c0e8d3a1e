/** Bytes as texts: base64url (RFC 4648) without padding. */

/** @param {Uint8Array} bytes */
export function toBase64(bytes) {
    let text = '';
    for (let at = 0; at < bytes.length; at += 8192) text += String.fromCharCode(...bytes.subarray(at, at + 8192));
    return btoa(text).replaceAll('+', '-').replaceAll('/', '_').replaceAll('=', '');
}

/** @param {string} text @returns {Uint8Array<ArrayBuffer>} */
export function fromBase64(text) {
    if (!/^[\w-]*$/.test(text)) throw new SyntaxError('not base64url');
    const letters = atob(text.replaceAll('-', '+').replaceAll('_', '/'));
    const bytes = new Uint8Array(letters.length);
    // A wasm has megabytes: `Uint8Array.from` takes ten times as long.
    for (let at = 0; at < bytes.length; at++) bytes[at] = letters.charCodeAt(at);
    return bytes;
}
