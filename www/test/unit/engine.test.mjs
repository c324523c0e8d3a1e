import assert from 'node:assert/strict';
import { mock, test } from 'node:test';
import { createFallback } from '../../js/engine/fallback.js';
import { createNewest } from '../../js/engine/newest.js';
import { createOutbox } from '../../js/engine/outbox.js';
import { DEFAULTS, definitionOf } from '../../js/state/state.js';
import { FITTED } from '../../js/view/view.js';

const LOOK = { canvas: { width: 8, height: 8, ratio: 1 }, view: FITTED, camera: null };
/** @param {number} angle */
const system = (angle) => ({ ...definitionOf(DEFAULTS), angle });

/** The engine's states with a fake worker that only receives messages. @param {(states: ReturnType<typeof statesOf>) => void} use */
function withStates(use) {
    const global = /** @type {any} */ (globalThis);
    global.window = globalThis;
    mock.timers.enable({ apis: ['setTimeout'] });
    try {
        use(statesOf());
    } finally {
        mock.timers.reset();
        delete global.window;
    }
}

function statesOf() {
    let id = 0;
    /** @type {(import('../../js/protocol.js').Define | import('../../js/protocol.js').ViewMessage)[]} */
    const posted = [];
    /** @type {[number | undefined, boolean][]} */
    const doubts = [];
    const newest = createNewest();
    const outbox = createOutbox(newest, {
        post: (message) => posted.push(message),
        ready: () => true,
        nextId: () => ++id,
        sent: () => {},
        settled: () => {},
    });
    const fallback = createFallback(newest, outbox, ({ definition }, doubtful) =>
        doubts.push([definition?.angle, doubtful]),
    );
    newest.look(LOOK);
    /** @param {number} angle */
    const define = (angle) => {
        newest.define(system(angle));
        outbox.send();
    };
    const angles = () => posted.flatMap((message) => (message.type === 'define' ? [message.definition.angle] : []));
    const at = () => {
        const lastOf = (/** @type {string} */ type) => posted.findLast((message) => message.type === type)?.id ?? 0;
        return /** @type {const} */ ({ type: 'at', define: lastOf('define'), view: lastOf('view'), question: 0 });
    };
    return { newest, outbox, fallback, define, angles, at, doubts };
}

test('two states are sent, then only the newest waits', () =>
    withStates(({ newest, outbox, define, angles, at }) => {
        for (const angle of [1, 2, 3, 4]) define(angle);
        assert.deepEqual(angles(), [1, 2]);
        assert.ok(newest.waits && outbox.owes);
        const { define: id, view: viewId } = at();
        outbox.reached({ id: id - 1, viewId });
        assert.deepEqual(angles(), [1, 2, 4]);
        outbox.ended({ id: at().define, viewId });
        assert.ok(!newest.waits && !outbox.owes);
    }));

test('the newest state is sent after a while without a picture', () =>
    withStates(({ define, angles }) => {
        for (const angle of [1, 2, 3]) define(angle);
        assert.deepEqual(angles(), [1, 2]);
        mock.timers.tick(250);
        assert.deepEqual(angles(), [1, 2, 3]);
    }));

test('a state that stops the worker is replaced by the last good state and not sent again', () =>
    withStates(({ newest, outbox, fallback, define, angles, at, doubts }) => {
        define(1);
        outbox.ended({ id: at().define, viewId: at().view });
        fallback.keep();
        define(2);
        assert.ok(!fallback.giveUp(), 'the worker has not taken it up');
        fallback.moved(at());
        assert.ok(fallback.giveUp());
        assert.ok(fallback.gaveUp);
        assert.equal(newest.state.definition?.angle, 1);
        assert.deepEqual(doubts, [
            [1, false],
            [2, true],
        ]);
        newest.unsend();
        outbox.forget();
        outbox.send();
        assert.deepEqual(angles(), [1, 2, 1]);
        fallback.defined();
        assert.ok(!fallback.gaveUp);
    }));

test('a fresh worker first gets the shown state if a newer state waits', () =>
    withStates(({ newest, outbox, fallback, define, angles, at }) => {
        define(1);
        outbox.ended({ id: at().define, viewId: at().view });
        fallback.keep();
        define(2);
        newest.unsend();
        outbox.forget();
        assert.ok(outbox.recall(fallback.good));
        outbox.send();
        assert.deepEqual(angles(), [1, 2, 1]);
        assert.ok(outbox.isRecalled(at().define));
        outbox.ended({ id: at().define, viewId: at().view });
        assert.deepEqual(angles(), [1, 2, 1, 2]);
    }));
