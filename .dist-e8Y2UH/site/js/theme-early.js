// Classic and first, so that the page is never painted in the other theme.
try {
    const kept = localStorage.getItem('theme');
    if (kept === 'light' || kept === 'dark') document.documentElement.dataset.theme = kept;
} catch {
    // Storage is refused in some frames; the system's theme serves.
}
