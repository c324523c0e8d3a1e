/** Whether the drawing is visible: its tab is shown, and the drawing is scrolled into view. */

/** A drawing this near the view counts as visible, if the browser tells the frame. */
const MARGIN = '200px';

/**
 * @param {Element} element
 * @param {(seen: boolean) => void} changed
 */
export function watchVisibility(element, changed) {
    let near = false;
    let seen = false;
    function tell() {
        const now = near && document.visibilityState === 'visible';
        if (now !== seen) changed((seen = now));
    }
    new IntersectionObserver(
        (entries) => {
            near = entries.at(-1)?.isIntersecting ?? near;
            tell();
        },
        { rootMargin: MARGIN },
    ).observe(element);
    document.addEventListener('visibilitychange', tell);
}
