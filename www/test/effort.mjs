/** How much the tests in a browser try, as `crates/test-effort` says for Rust. `run.mjs` sets LSYSTEM_THOROUGH. */

/** Whether tests with a list of cases try all of them. */
export const IS_THOROUGH = process.env.LSYSTEM_THOROUGH !== undefined;

/**
 * The first variants of a test, which stand for the others, or all of them in a thorough test.
 * @template T
 * @param {readonly T[]} variants
 * @param {number} [usual] the usual number of variants
 */
export const some = (variants, usual = 1) => (IS_THOROUGH ? variants : variants.slice(0, usual));

/**
 * One in so many cases, always the same ones, or all of them in a thorough test.
 * @template T
 * @param {readonly T[]} cases
 * @param {number} every
 * @param {number} [from] the first case
 */
export const sampled = (cases, every, from = 0) =>
    IS_THOROUGH ? [...cases] : cases.filter((_, at) => at % every === from);
