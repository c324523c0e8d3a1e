/** The preview of an embedded drawing: the frame itself, scaled down where there is less room. */

import { html, make, setText } from '../base/dom.js';
import { say } from '../base/words.js';

export function createPreview() {
    const place = html('embed-preview');
    /** @type {HTMLIFrameElement | null} */
    let frame = null;
    let size = { width: 0, height: 0 };

    function fit() {
        if (!frame) return;
        const scale = Math.min(1, place.clientWidth / size.width);
        frame.style.width = `${size.width}px`;
        frame.style.height = `${size.height}px`;
        frame.style.transform = `scale(${scale})`;
        place.style.height = `${Math.ceil(size.height * scale)}px`;
        const [width, height] = [String(size.width), String(size.height)];
        setText(
            html('embed-preview-note'),
            scale < 1
                ? say`${width} × ${height} pixels, shown at ${Math.round(scale * 100)} %`
                : say`${width} × ${height} pixels`,
        );
    }
    new ResizeObserver(fit).observe(place);

    return {
        /** @param {string} address @param {{width: number, height: number}} chosen */
        show(address, chosen) {
            size = chosen;
            if (frame?.contentWindow) {
                // A new address would add to the page's history.
                if (frame.dataset.address !== address) frame.contentWindow.location.replace(address);
                frame.dataset.address = address;
            } else {
                frame = make('iframe', {
                    title: say`Preview of the embedded drawing`,
                    src: address,
                    'data-address': address,
                });
                place.replaceChildren(frame);
            }
            fit();
        },

        /** Stops the drawing. */
        hide() {
            frame?.remove();
            frame = null;
        },
    };
}
