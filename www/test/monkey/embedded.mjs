/** A page of another site with an embedded drawing, as a frame or as an element, and the monkey's actions there. */

import { createServer } from 'node:http';
import { COMMON, Fault } from './actions.mjs';
import { click } from './hands.mjs';
import { within } from './rest.mjs';
import { SYSTEMS, axiomText, hash, numberText, pick, rulesText, whole } from './texts.mjs';

/** @typedef {import('./actions.mjs').Action} Action */
/** @typedef {import('playwright-core').Page} Page */

const STYLE =
    'body { min-height: 3000px } iframe, l-system { display: block; width: 700px; max-width: 100%; height: 460px; border: 0; aspect-ratio: auto }';
const WEED = 'v=1&title=Weed&axiom=F&rules=F%20-%3E%20F%5B+F%5DF%5B-F%5DF&n=4&angle=25';

/** The same functions for both forms: `say` sends a message, `ask` returns the state of the drawing. */
const FRAME_SCRIPT = `
    var asked = new Map(), lastId = 0, drawing = document.querySelector('iframe');
    addEventListener('message', ({ data }) => { if (data && data.lsystem === 'state') { asked.get(data.id)?.(data); asked.delete(data.id); } });
    var say = (message) => drawing.contentWindow.postMessage(message, '*');
    var ask = () => new Promise((resolve) => { asked.set(++lastId, resolve); say({ lsystem: 'get', id: lastId }); });`;
const ELEMENT_SCRIPT = `
    var drawing = document.querySelector('l-system');
    var say = (message) => { const kind = message && message.lsystem;
        if (kind === 'set') drawing.set(message.values); else if (kind === 'open') drawing.open(String(message.link));
        else if (['reset', 'play', 'pause'].includes(kind)) drawing[kind](); else drawing.shadowRoot.querySelector('iframe').contentWindow.postMessage(message, '*'); };
    var ask = () => drawing.get();`;

/** @param {string} address of the playground @param {boolean} element @param {string} controls */
function hostPage(address, element, controls) {
    const body = element
        ? `<script src="${address}l-system.js"></script><l-system link="#${WEED.replaceAll('&', '&amp;')}" controls="${controls}" loading="eager"></l-system><script>${ELEMENT_SCRIPT}</script>`
        : `<iframe title="A drawing" src="${address}embed.html#${WEED.replaceAll('&', '&amp;')}&amp;controls=${controls}"></iframe><script>${FRAME_SCRIPT}</script>`;
    return `<!doctype html><html lang="en"><title>Host</title><link rel="icon" href="data:,"><style>${STYLE}</style><body>${body}</body></html>`;
}

/**
 * Serves the host's pages, under another host name than the playground's.
 * @param {string} address of the playground
 * @returns {Promise<{address: (element: boolean, controls: string) => string, close: () => void}>}
 */
export async function serveHost(address) {
    const server = createServer((request, response) => {
        const { pathname, searchParams } = new URL(String(request.url), 'http://localhost');
        response.writeHead(200, { 'content-type': 'text/html; charset=utf-8' });
        response.end(hostPage(address, pathname === '/element', searchParams.get('controls') ?? ''));
    });
    await new Promise((resolve) => server.listen(0, '127.0.0.1', () => resolve(null)));
    const port = /** @type {import('node:net').AddressInfo} */ (server.address()).port;
    return {
        address: (element, controls) =>
            `http://localhost:${port}/${element ? 'element' : 'frame'}?controls=${controls}`,
        close: () => server.close(),
    };
}

/** The state of the drawing, within the time limit. @param {Page} page @returns {Promise<{link: string, values: Record<string, unknown>}>} */
export async function ask(page) {
    const state = await within(
        page.evaluate(() => /** @type {any} */ (window).ask()),
        10_000,
        'an embedded drawing answers its host',
    );
    if (typeof state?.link !== 'string' || typeof state.values !== 'object')
        throw new Fault(`an embedded drawing answers ${JSON.stringify(state).slice(0, 100)}`);
    return state;
}

/** @param {Page} page @param {unknown} message */
const say = (page, message) => page.evaluate((words) => void (/** @type {any} */ (window).say(words)), message);

/** Invalid messages. @type {readonly unknown[]} */
const JUNK = [
    null,
    7,
    'set',
    [],
    {},
    { lsystem: 7 },
    { lsystem: '__proto__' },
    { lsystem: 'toString' },
    { lsystem: { toString: 7 } },
    { lsystem: 'controls', controls: { toString: 7 } },
    { lsystem: 'set' },
    { lsystem: 'set', values: 7 },
    { lsystem: 'set', values: { n: 'x', __proto__: 1, constructor: 2 } },
    { lsystem: 'open' },
    { lsystem: 'open', link: 7 },
    { lsystem: 'controls', controls: { a: 1 } },
    { lsystem: 'get', id: { deep: [1] } },
    { lsystem: 'hello' },
];
const CONTROLS = ['', 'all', 'n', 'angle,rules', 'string play', 'nothing', 'rules'];

/** @type {readonly Action[]} */
export const EMBEDDED = [
    ...COMMON,
    { kind: 'message of junk', weight: 4, act: ({ page }, roll) => say(page, pick(roll, JUNK)) },
    {
        kind: 'message: set',
        weight: 8,
        async act({ page }, roll) {
            const values = pick(roll, [
                () => ({ n: whole(roll, 9), angle: roll() * 180 }),
                () => ({ axiom: axiomText(roll), rules: rulesText(roll) }),
                () => ({ n: numberText(roll), seed: numberText(roll), width: numberText(roll) }),
                () => ({ ...pick(roll, SYSTEMS), rules: pick(roll, SYSTEMS).rules }),
                () => ({ palette: ['#ff0000', '#0000ff'], colour: 'level', bg: '#eeeeee' }),
            ])();
            await say(page, { lsystem: 'set', values });
            return JSON.stringify(values).slice(0, 100);
        },
    },
    {
        kind: 'message: open',
        weight: 6,
        async act({ page }, roll) {
            const link = hash(roll);
            await say(page, { lsystem: 'open', link });
            return link.slice(0, 100);
        },
    },
    {
        kind: 'other message',
        weight: 5,
        async act({ page }, roll) {
            const message = pick(roll, [
                { lsystem: 'reset' },
                { lsystem: 'play' },
                { lsystem: 'pause' },
                { lsystem: 'controls', controls: pick(roll, CONTROLS) },
            ]);
            await say(page, message);
            return JSON.stringify(message);
        },
    },
    {
        kind: 'flood of messages',
        weight: 2,
        act: ({ page }, roll) =>
            page.evaluate(
                (first) => {
                    for (let at = 0; at < 300; at++)
                        /** @type {any} */ (window).say({
                            lsystem: 'set',
                            values: { angle: first + at / 10, n: at % 5 },
                        });
                },
                whole(roll, 90),
            ),
    },
    {
        kind: 'attribute',
        weight: 5,
        async act({ page }, roll) {
            const [name, value] = pick(
                roll,
                /** @type {const} */ ([
                    ['angle', '30'],
                    ['n', '3'],
                    ['n', 'x'],
                    ['rules', 'F -> F+F'],
                    ['controls', 'all'],
                    ['theme', 'dark'],
                    ['theme', ''],
                    ['link', '#v=1&axiom=F&rules=F%20-%3E%20F-F&n=3&angle=30'],
                    ['loading', 'eager'],
                    ['palette', '#ff0000,#00ff00'],
                ]),
            );
            const done = await page.evaluate(
                ([key, text]) => {
                    const element = document.querySelector('l-system');
                    if (text === '') element?.removeAttribute(String(key));
                    else element?.setAttribute(String(key), String(text));
                    return element !== null;
                },
                [name, value],
            );
            return done ? `${name}=${value}` : 'the drawing is in a frame';
        },
    },
    {
        kind: 'taken out and put back',
        weight: 2,
        act: ({ page }) =>
            page.evaluate(() => {
                const drawing = document.querySelector('l-system, iframe');
                if (!drawing) return;
                const next = drawing.nextSibling;
                drawing.remove();
                document.body.insertBefore(drawing, next);
            }),
    },
    {
        kind: 'scroll',
        weight: 3,
        act: ({ page }, roll) => page.evaluate((y) => window.scrollTo(0, y), pick(roll, [0, 0, 200, 1500, 3000])),
    },
    {
        kind: 'size',
        weight: 3,
        async act({ page }, roll) {
            const [width, height] = pick(
                roll,
                /** @type {const} */ ([
                    [1280, 800],
                    [390, 844],
                    [700, 500],
                ]),
            );
            await page.setViewportSize({ width, height });
            return `${width} x ${height}`;
        },
    },
    { kind: 'out to the playground', weight: 1, act: (place) => click(place, '#open') },
];
