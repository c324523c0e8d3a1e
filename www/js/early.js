// A classic script that runs first, so that the page is never painted in the wrong theme or language.
/** @param {string} name */
function kept(name) {
    try {
        return localStorage.getItem(name);
    } catch {
        // Some frames refuse storage; use the system's choice.
        return null;
    }
}
function begin() {
    const theme = kept('theme');
    if (theme === 'light' || theme === 'dark') document.documentElement.dataset.theme = theme;
    // Words that may be in another language are unseen until they are (js/base/words.js).
    const language = new URLSearchParams(location.search).get('lang') ?? kept('language') ?? navigator.language;
    if (!language.startsWith('en')) document.documentElement.dataset.words = 'awaited';
}
// Of a page from a disk, the storage is not read before the browser has noted the page (js/base/settled.js).
if (location.protocol === 'file:' && navigator.locks) void navigator.locks.query().then(begin, begin);
else begin();
