/** Code that shows a film in another page. Pure functions. */

/** @param {string} value */
const attribute = (value) =>
    value
        .replaceAll('&', '&amp;')
        .replaceAll('<', '&lt;')
        .replaceAll('>', '&gt;')
        .replaceAll('"', '&quot;')
        .replaceAll('\n', '&#10;');

/**
 * @param {Readonly<import('../state/state.js').State>} state
 * @param {string} link of the state, with its `#`
 * @param {string} film the film's text
 * @param {string} page the address of film.html
 * @param {number} width in CSS pixels
 * @param {number} height in CSS pixels
 */
export function filmCode(state, link, film, page, width, height) {
    return `<iframe src="${attribute(`${page}${link}&film=${guarded(film)}`)}" title="${attribute(`Film: ${state.title || state.name || 'L-system'}`)}" width="${width}" height="${height}" style="border: 0; max-width: 100%" loading="lazy" allowfullscreen></iframe>`;
}

/** Escapes what a link may not contain; the signs of films stay. @param {string} film */
export const guarded = (film) => encodeURIComponent(film).replace(/%(3B|3D|3A|2C|2F|2B)/g, decodeURIComponent);

/** The text of the film in a link; empty if there is none. @param {string} hash */
export function filmIn(hash) {
    const part =
        hash
            .replace(/^#/, '')
            .split('&')
            .findLast((each) => each.startsWith('film=')) ?? '';
    try {
        return decodeURIComponent(part.slice('film='.length));
    } catch {
        return '';
    }
}
