/** The page as seen from the worker. */

/** @typedef {import('../js/protocol.js').ViewMessage} ViewMessage */
/** @typedef {import('../js/protocol.js').Asked} Asked */
/** @template {Asked} [T=Asked] @typedef {import('../js/protocol.js').Question<T>} Question */
/** Unhandled messages from the page: the newest definition and view, and the questions, answered in turn. @typedef {{define: import('../js/protocol.js').Define | null, view: ViewMessage | null, questions: Exclude<Question, Question<'thumb'>>[]}} Inbox */
/** The result of one step of a playground. @typedef {{report: import('../js/protocol.js').Report | null, drawn: {complete: boolean, scale: number, moving: boolean, rough: boolean, slow: boolean, only: 'background' | 'ink' | null} | null, idle: boolean}} Step */

/** The length of a step, in milliseconds; between steps the worker receives messages. */
export const STEP_MS = 8;

/** The page. @type {import('../js/protocol.js').Channel<import('../js/protocol.js').FromWorker, import('../js/protocol.js').ToWorker>} */
export const page = self;
