// A classic script that runs first, so that the page is never painted in the wrong theme.
try {
    const kept = localStorage.getItem('theme');
    if (kept === 'light' || kept === 'dark') document.documentElement.dataset.theme = kept;
} catch {
    // Some frames refuse storage; use the system's theme.
}
