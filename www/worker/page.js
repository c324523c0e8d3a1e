/** The page as the worker sees it, and what has come from it. */

/** @typedef {import('../js/protocol.js').Sight} Sight */
/** @typedef {import('../js/protocol.js').Asked} Asked */
/** @template {Asked} [T=Asked] @typedef {import('../js/protocol.js').Question<T>} Question */
/** What has come from the page and was not yet acted on: the newest state and view, and questions, answered in turn. @typedef {{define: import('../js/protocol.js').Define | null, view: Sight | null, questions: Exclude<Question, Question<'thumb'>>[]}} Inbox */
/** What a step of a playground gives. @typedef {{report: import('../js/protocol.js').Report | null, drawn: {complete: boolean, scale: number, moving: boolean, rough: boolean, slow: boolean} | null, idle: boolean}} Step */

/** How long a step takes at most, in milliseconds: between steps the worker hears what is new. */
export const STEP_MS = 8;

/** The page. @type {import('../js/protocol.js').Channel<import('../js/protocol.js').FromWorker, import('../js/protocol.js').ToWorker>} */
export const page = self;
