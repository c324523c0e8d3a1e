/** The preview of an embedded drawing: the frame itself, scaled down where there is less room. */

import { html, make, setText } from './dom.js';

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
        setText(
            html('embed-preview-note'),
            `${size.width} × ${size.height} pixels${scale < 1 ? `, shown at ${Math.round(scale * 100)} %` : ''}`,
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
                    title: 'Preview of the embedded drawing',
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
