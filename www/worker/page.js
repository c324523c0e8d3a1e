/** The page as seen from the worker. */

/** @typedef {import('../js/protocol.js').ViewMessage} ViewMessage */
/** @typedef {import('../js/protocol.js').Asked} Asked */
/** @template {Asked} [T=Asked] @typedef {import('../js/protocol.js').Question<T>} Question */
/** Unhandled messages from the page: the newest definition and view, and the questions, answered in turn. @typedef {{define: import('../js/protocol.js').Define | null, view: ViewMessage | null, questions: Exclude<Question, Question<'thumb'>>[]}} Inbox */

/** The page. @type {import('../js/protocol.js').Channel<import('../js/protocol.js').FromWorker, import('../js/protocol.js').ToWorker>} */
export const page = self;
