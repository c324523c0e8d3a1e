/** What a first visit shows, at once. */

import { clean } from './state.js';

export const OPENING = clean({
    name: 'bush',
    title: 'A bush by two rules',
    source: 'Prusinkiewicz and Lindenmayer, The Algorithmic Beauty of Plants, figure 1.24 f',
    axiom: 'X',
    rules: 'X -> F-[[X]+X]+F[+FX]-X\nF -> FF',
    iterations: 7,
    angle: 22.5,
    heading: 82,
    colourBy: 'level',
});
