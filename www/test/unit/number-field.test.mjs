/** Number fields with random input. */

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { numberField, optionalField } from '../../js/controls/number-field.js';
import { damaged, junkText, pick, whole } from './junk.mjs';
import { dice } from './random.mjs';

const ROUNDS = Number(process.env.LSYSTEM_CASES ?? 200);

/** A fake input element for a number field. */
class Field {
    id = 'field';
    value = '';
    /** @type {Map<string, (event: any) => void>} */
    #listeners = new Map();
    /** @param {string} kind @param {(event: any) => void} listener */
    addEventListener(kind, listener) {
        this.#listeners.set(kind, listener);
    }
    /** @param {string} kind @param {object} [event] */
    does(kind, event = {}) {
        this.#listeners.get(kind)?.({ preventDefault: () => {}, ...event });
    }
    setAttribute() {}
    removeAttribute() {}
    toggleAttribute() {}
    setSelectionRange() {}
    select() {}
    after() {}
    closest() {
        return null;
    }
}

/** @type {{activeElement: unknown, createElement: () => object}} */
const page = {
    activeElement: null,
    createElement: () => ({ setAttribute() {}, append() {}, remove() {}, isConnected: false }),
};
Object.assign(globalThis, { document: page });

/** The ranges of the state's fields. */
const RANGES = [
    { low: 0, high: 1000, step: 1, whole: true },
    { low: 0, high: 2 ** 32 - 1, step: 1, whole: true },
    { low: -3600, high: 3600, step: 1 },
    { low: 1e-9, high: 1e9, step: 0.1 },
    { low: -10, high: 10, step: 0.5 },
];

/** @param {() => number} roll */
const text = (roll) =>
    pick(roll, [
        () => junkText(roll, 6),
        () => String((roll() - 0.5) * 10 ** whole(roll, 30)),
        () => damaged(roll, String(roll() * 1000), 2),
        () => pick(roll, ['', ' ', '1e999', '-1e999', '9'.repeat(400), '25,7', '−5', '5.', '60°', '-0']),
    ])();

test('a number field gives only numbers within its range, and shows the last number when it loses focus', (context) => {
    for (let round = 0; round < ROUNDS; round++) {
        const roll = dice(round * 7919);
        const [range, optional] = [pick(roll, RANGES), roll() < 0.4];
        const field = new Field();
        /** @type {(number | null)[]} */
        const given = [range.low];
        const how = {
            ...range,
            expected: 'a number',
            settle: () => {},
            change: (/** @type {number | null} */ value) => void given.push(value),
        };
        const element = /** @type {HTMLInputElement} */ (/** @type {unknown} */ (field));
        const write = optional ? optionalField(element, how) : numberField(element, how);
        write(range.low, 90);
        for (let times = 1 + whole(roll, 6); times > 0; times--) {
            page.activeElement = field;
            field.does('focus');
            field.value = text(roll);
            field.does('input');
            if (roll() < 0.4)
                field.does('keydown', {
                    key: pick(roll, ['ArrowUp', 'ArrowDown', 'Enter', 'x']),
                    shiftKey: roll() < 0.3,
                    altKey: roll() < 0.3,
                });
            page.activeElement = null;
            field.does('blur');
            const last = given.at(-1);
            for (const value of given) {
                if (value === null) assert.ok(optional);
                else
                    assert.ok(
                        value !== undefined &&
                            value >= range.low &&
                            value <= range.high &&
                            (!range.whole || optional || Number.isInteger(value)),
                        `case ${round}: ${value}`,
                    );
            }
            assert.equal(
                field.value === '' ? null : Number(field.value),
                last === null || last === undefined ? null : Number(last.toPrecision(12)),
                `case ${round}`,
            );
        }
    }
    context.diagnostic(`${ROUNDS} fields`);
});
