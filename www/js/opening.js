/** The system that a first visit shows, and the system that New starts from. */

import { themeScheme } from './colour-schemes.js';
import { clean } from './state.js';

/** The same plant by day and by night: trunk, branches and leaves follow the colour symbol. */
const COLOURS = {
    light: {
        palette: ['#5a4632', '#585532', '#4c6334', '#3a6f38', '#2b7a3c', '#2f8741', '#4b9748', '#70a850', '#9bbb5c'],
        background: '#fbfaf5',
    },
    dark: {
        palette: ['#8d7358', '#7f8355', '#63905a', '#4d9d60', '#4aa667', '#58b274', '#74c186', '#97cd92', '#bfdd9f'],
        background: '#101512',
    },
};

/** @param {'light' | 'dark'} theme */
export function opening(theme) {
    return clean({
        name: 'twig',
        title: 'A twig by three rules',
        source: 'After Prusinkiewicz and Lindenmayer, The Algorithmic Beauty of Plants (1990), figure 1.24 f',
        // The trunk doubles its width as it doubles its length, whatever n is. The width is in the rules, so that other
        // rules typed over them draw plain lines.
        axiom: 'WX',
        rules: "X -> F'!-[[X]+X]+F![+FX]-X\nF -> FF\nW -> W##",
        width: 0.055,
        iterations: 8,
        angle: 22.5,
        ...COLOURS[theme],
    });
}

/** A single line, without productions. @param {'light' | 'dark'} theme */
export function blank(theme) {
    const { palette, background } = themeScheme(theme);
    return clean({ axiom: 'F', iterations: 4, angle: 60, palette: [...palette], background });
}
