/** Random states for tests; equal seeds give equal states. */

import { clean } from '../../js/state.js';
import { FIELDS } from '../../js/tables.js';

/** A small generator of random numbers in [0, 1) (mulberry32). @param {number} seed */
export function dice(seed) {
    let state = seed >>> 0;
    return () => {
        state = (state + 0x6d2b79f5) >>> 0;
        let t = Math.imul(state ^ (state >>> 15), state | 1);
        t ^= t + Math.imul(t ^ (t >>> 7), t | 61);
        return ((t ^ (t >>> 14)) >>> 0) / 2 ** 32;
    };
}

/** @param {import('../../js/state.js').FieldName} field */
function wordsOf(field) {
    const { [field]: found } = FIELDS;
    return found.kind === 'word' ? found.words : [];
}

/** @param {() => number} roll */
export function randomState(roll) {
    /** @template T @param {readonly T[]} choices */
    const pick = (choices) => /** @type {T} */ (choices[Math.floor(roll() * choices.length)]);
    const characters = [...'FGXYfgAB+-[]{}()<>|!#%&\\/^$\'",;:.=* \n\t?~`@→ε−🌿é'];
    const text = (/** @type {number} */ most) =>
        Array.from({ length: Math.floor(roll() * most) }, () => pick(characters)).join('');
    const number = () =>
        pick([0, 1, -1, 25.7, 22.5, 1 / 3, 1e-7, 123456.789, (roll() - 0.5) * 10 ** Math.floor(roll() * 12)]);
    const colour = () =>
        `#${Math.floor(roll() * 2 ** 24)
            .toString(16)
            .padStart(6, '0')}`;
    return clean({
        name: text(12),
        title: text(20),
        source: text(20),
        notes: text(20),
        axiom: text(12),
        rules: text(120),
        iterations: Math.floor(roll() * 1001),
        angle: number(),
        rightAngle: roll() < 0.5 ? null : number(),
        pitchDown: roll() < 0.5 ? null : number(),
        pitchUp: roll() < 0.5 ? null : number(),
        rollLeft: roll() < 0.5 ? null : number(),
        rollRight: roll() < 0.5 ? null : number(),
        tropism: [number(), number(), number()],
        elasticity: number(),
        lengthFactor: roll() * 10,
        angleVariation: roll() * 100,
        lengthVariation: roll() * 100,
        growth: roll(),
        paletteHolds: roll() < 0.5,
        turnColours: [Math.floor(roll() * 32), Math.floor(roll() * 32)],
        widthFactor: roll() * 10,
        heading: number(),
        step: Math.abs(number()),
        start: [number(), number()],
        dialect: pick(wordsOf('dialect')),
        overrides: text(30),
        seed: Math.floor(roll() * 2 ** 32),
        palette: Array.from({ length: 1 + Math.floor(roll() * 6) }, colour),
        colourBy: pick(wordsOf('colourBy')),
        background: colour(),
        width: Math.abs(number()),
        minWidth: Math.abs(number()),
        ink: pick(wordsOf('ink')),
        exposure: roll() * 20 - 10,
        camera:
            roll() < 0.5
                ? null
                : {
                      azimuth: number(),
                      elevation: number(),
                      zoom: 10 ** (roll() * 6 - 2),
                      x: number(),
                      y: number(),
                      z: number(),
                      perspective: roll() < 0.5,
                      fade: roll(),
                  },
        view:
            roll() < 0.5
                ? null
                : {
                      x: number(),
                      y: number(),
                      zoom: 10 ** (roll() * 26 - 2),
                      ...(roll() < 0.5 ? {} : { fx: roll() * 1e-17, fy: -roll() * 1e-17 }),
                  },
    });
}
