/** What the core knows and the page shows: written by `cargo xtask tables`, not by hand. */

/** What symbols do, by the name of the dialect in files: what it is called, and what it does in words. */
export const DIALECTS = Object.freeze({
    'abop': { label: 'Algorithmic Beauty of Plants', help: 'F and G draw, f and g move; + and − turn, | turns round, [ and ] branch; ! thins and # thickens the stroke, \' and ; step through the colours. { and } fill the polygon whose corners F, f and . mark. In space & and ^ pitch down and up, \\ and / roll left and right, and $ rolls upright. Other symbols do nothing.' },
    'every-letter': { label: 'Every letter draws', help: 'Every symbol draws one step, except + and −, which turn, and [ and ], which branch.' },
    'practical': { label: 'Practical: F and G draw', help: 'F and G draw; + turns left and − turns right, each by its own angle; in space > and < pitch down and up, & and ^ roll left and right; [ and ] branch. Other symbols do nothing.' },
    'lowercase': { label: 'Lower-case letters draw', help: 'Every lower-case letter draws; + turns left and takes the second colour, − turns right and takes the third; [ and ] branch.' },
    'axes': { label: 'Turns about axes', help: 'F draws; > and < turn left and right, v and ^ pitch up and down, + and − roll left and right: turns about the z, x and y axes of a turtle that goes along its y; [ and ] branch. Other symbols do nothing.' },
});
