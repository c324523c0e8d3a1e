/** The words of the core, in the language of the page. */

/** @param {import('../js/protocol.js').Catalogue | undefined} catalogue */
export function setWords(catalogue) {
    if (!catalogue || catalogue.language === 'en') return;
    const { words } = catalogue;
    const plurals = new Intl.PluralRules(catalogue.language);

    /** The translation of a text, or null. @param {string} text @param {number | null} number that decides about the form */
    function read(text, number) {
        const entry = Object.hasOwn(words, text) ? words[text] : null;
        if (entry === null || typeof entry !== 'object') return entry ?? null;
        return entry[plurals.select(number ?? 0)] ?? entry.other ?? null;
    }
    wasm_bindgen.setReader(read);
}
