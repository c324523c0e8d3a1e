/** Options of an embedded drawing: keys in its address beside the keys of the system. Pure functions. */

/** @typedef {'angle' | 'n' | 'rules' | 'string' | 'play' | 'steps'} Control */

/** @type {readonly Control[]} */
export const CONTROLS = ['angle', 'n', 'rules', 'string', 'play', 'steps'];

/** Longer values are not read, in characters. */
const LONGEST = 1000;

/**
 * `host` is the origin of the host page, which gets messages from the start.
 * @typedef {{controls: Control[], theme: 'light' | 'dark' | null, host: string | null}} Options
 */

/** @param {string} hash with or without its `#` @returns {Options} */
export function readOptions(hash) {
    return {
        controls: readControls(valueOf(hash, 'controls')),
        theme: readTheme(valueOf(hash, 'theme')),
        host: originOf(valueOf(hash, 'host')),
    };
}

/** @param {unknown} theme */
export const readTheme = (theme) => (theme === 'light' || theme === 'dark' ? theme : null);

/** The known controls in a list, in the order of CONTROLS. @param {string} list separated by commas or blanks @returns {Control[]} */
export function readControls(list) {
    const asked = list.toLowerCase().split(/[\s,]+/);
    // Steps need a larger page, so they are asked for by name.
    return CONTROLS.filter((control) => asked.includes(control) || (control !== 'steps' && asked.includes('all')));
}

/** The last value of a key. @param {string} hash @param {string} key */
function valueOf(hash, key) {
    const part =
        hash
            .replace(/^#/, '')
            .split('&')
            .findLast((each) => each.startsWith(`${key}=`)) ?? '';
    try {
        return decodeURIComponent(part.slice(key.length + 1, LONGEST));
    } catch {
        return '';
    }
}

/** @param {string} text */
function originOf(text) {
    if (!/^https?:/.test(text)) return null;
    return URL.canParse(text) ? new URL(text).origin : null;
}
