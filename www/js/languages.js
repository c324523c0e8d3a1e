/** The languages in `lang/`, each by its own name: written by `cargo xtask tables`, not by hand. */
export const LANGUAGES = Object.freeze({ en: 'English', de: 'Deutsch', fr: 'Français' });
