/** Whether the drawing can be seen: in a tab that is shown, and scrolled to. */

/** It is drawn a little before it is scrolled to, where the browser lets a frame know. */
const AHEAD = '200px';

/**
 * @param {Element} element
 * @param {(seen: boolean) => void} changed
 */
export function watchSight(element, changed) {
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
        { rootMargin: AHEAD },
    ).observe(element);
    document.addEventListener('visibilitychange', tell);
}
