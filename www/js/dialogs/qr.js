/** QR codes as pictures. */

/** The width of the light border that QR readers need, in modules. */
const QUIET = 4;

/**
 * An SVG path of the dark modules, and the side of its square with the border, in modules.
 * @param {Uint8Array} modules row by row, 1 for dark
 */
export function qrPicture(modules) {
    const size = Math.sqrt(modules.length);
    let path = '';
    for (let y = 0; y < size; y++) {
        for (let x = 0, run = 0; x < size; x += run || 1) {
            run = 0;
            while (x + run < size && modules[y * size + x + run]) run += 1;
            if (run > 0) path += `M${x + QUIET} ${y + QUIET}h${run}v1h-${run}z`;
        }
    }
    return { path, side: size + 2 * QUIET };
}

/** A QR code as an SVG file, with a white background. @param {Uint8Array} modules */
export function qrFile(modules) {
    const { path, side } = qrPicture(modules);
    return `<svg xmlns="http://www.w3.org/2000/svg" width="${side * 8}" height="${side * 8}" viewBox="0 0 ${side} ${side}" shape-rendering="crispEdges"><path fill="#fff" d="M0 0h${side}v${side}H0z"/><path d="${path}"/></svg>\n`;
}

/** Shows a QR code in an SVG element with a path. @param {SVGSVGElement} picture @param {Uint8Array} modules */
export function showQrPicture(picture, modules) {
    const { path, side } = qrPicture(modules);
    picture.setAttribute('viewBox', `0 0 ${side} ${side}`);
    picture.querySelector('path')?.setAttribute('d', path);
}
