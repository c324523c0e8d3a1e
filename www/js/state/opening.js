/** The system that a first visit shows, and the system that New starts from. */

import { clean } from './state.js';
import { said, say } from '../base/words.js';

const TITLE = 'A plant by one rule';

/** A system's title in the reader's language; the opening plant has no file, from which translators get it. @param {{title: string}} system */
export const titleOf = ({ title }) => (title === TITLE ? say`A plant by one rule` : said(title));

/** The same plant by day and by night: trunk, branches and leaves by branch level. */
const COLOURS = {
    light: {
        palette: ['#5a4632', '#4c6334', '#2b7a3c', '#3f9147', '#6aa84f', '#9bbb5c'],
        background: '#fbfaf5',
    },
    dark: {
        palette: ['#8d7358', '#63905a', '#4aa667', '#58b274', '#86c88a', '#bfdd9f'],
        background: '#101512',
    },
};

/** @param {'light' | 'dark'} theme */
export function opening(theme) {
    return clean({
        name: 'plant',
        title: TITLE,
        source: 'After Prusinkiewicz and Lindenmayer, The Algorithmic Beauty of Plants (1990), figure 1.24 b',
        axiom: 'F',
        rules: 'F -> F[+F]F[-F][F]',
        iterations: 5,
        angle: 22,
        // Narrower than a segment is long, so that a single segment is a line too.
        width: 0.45,
        widthFactor: 0.8,
        minWidth: 0.8,
        colourBy: 'level',
        paletteHolds: true,
        ...COLOURS[theme],
    });
}

/** A single line without rules, in the look of the opening plant. @param {'light' | 'dark'} theme */
export function blank(theme) {
    return clean({
        ...opening(theme),
        name: '',
        title: '',
        source: '',
        rules: '',
        iterations: 4,
        angle: 60,
        auto: true,
    });
}
