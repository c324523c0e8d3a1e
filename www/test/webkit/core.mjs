/**
 * The core of the page in WebKitGTK, the engine of Safari, over WebDriver: `xvfb-run node test/webkit/core.mjs`, with the
 * page's address as LSYSTEM_URL. Needs Debian's packages webkit2gtk-driver and xvfb, and is no part of the test.
 */

import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { setTimeout as pause } from 'node:timers/promises';

const ADDRESS = process.env.LSYSTEM_URL ?? 'http://127.0.0.1:8080/';
const PORT = 4460;
const KOCH = '#v=1&axiom=F&rules=F%20-%3E%20F+F--F+F&n=3&angle=60&heading=0';
const TREE = '#v=1&axiom=A&rules=A%20-%3E%20F%5B%26A%5D////%5B%26A%5D////%5B%26A%5D&n=5&angle=22.5';
/** How an element is named in answers (WebDriver, section 12). */
const ELEMENT = 'element-6066-11e4-a52e-4f735466cecf';
const LIMIT_MS = 30_000;

/** @param {string} method @param {string} path @param {object} [body] */
async function call(method, path, body) {
    const answer = await fetch(`http://127.0.0.1:${PORT}${path}`, {
        method,
        ...(body ? { body: JSON.stringify(body) } : {}),
    });
    const { value } = /** @type {{value: any}} */ (await answer.json());
    if (!answer.ok) throw new Error(`${path}: ${value?.message}`);
    return value;
}

/** A browser with one window. */
async function open() {
    for (let tries = 0; ; tries++) {
        try {
            const { sessionId } = await call('POST', '/session', { capabilities: {} });
            return browser(`/session/${sessionId}`);
        } catch (error) {
            if (tries === 20) throw error;
            await pause(250);
        }
    }
}

/** @param {string} session */
function browser(session) {
    const run = (/** @type {string} */ script, /** @type {unknown[]} */ ...args) =>
        call('POST', `${session}/execute/sync`, { script, args });
    const find = async (/** @type {string} */ selector) =>
        (await call('POST', `${session}/element`, { using: 'css selector', value: selector }))[ELEMENT];
    return {
        run,
        go: (/** @type {string} */ path) => call('POST', `${session}/url`, { url: ADDRESS + path }),
        close: () => call('DELETE', session),
        /** @param {string} selector */
        click: async (selector) => call('POST', `${session}/element/${await find(selector)}/click`, {}),
        /** @param {string} selector @param {string} text */
        async fill(selector, text) {
            await run('document.querySelector(arguments[0]).select()', selector);
            await call('POST', `${session}/element/${await find(selector)}/value`, { text });
        },
        /** Into the frame of an element, or back to the page for null. @param {string | null} expression */
        frame: async (expression) =>
            call('POST', `${session}/frame`, { id: expression && (await run(`return ${expression}`)) }),
        /** Waits until an expression is true in the page. @param {string} expression */
        async until(expression) {
            for (const end = Date.now() + LIMIT_MS; ; await pause(100)) {
                if (await run(`return Boolean(${expression})`)) return;
                assert.ok(Date.now() < end, `not so in ${LIMIT_MS} ms: ${expression}`);
            }
        },
    };
}

const captioned = (/** @type {string} */ words) =>
    `document.querySelector('#caption-text')?.textContent.includes('${words}')`;

/** @type {[string, (page: ReturnType<typeof browser>) => Promise<void>][]} */
const TESTS = [
    [
        'the first picture, and an edit',
        async (page) => {
            await page.go(KOCH);
            await page.until(captioned('64 segments'));
            await page.until(`document.querySelector('#stage.inked')`);
            await page.fill('#rules', 'F -> F+F');
            await page.until(captioned('8 segments'));
            await page.until(`location.hash.includes('F%20-%3E%20F+F&')`);
        },
    ],
    [
        'a drawing in space',
        async (page) => {
            await page.go(`?space${TREE}`);
            await page.until(`document.querySelector('#stage.inked.space')`);
        },
    ],
    [
        'a link to share',
        async (page) => {
            await page.go(`?share${KOCH}`);
            await page.until(`document.querySelector('#stage.inked')`);
            await page.click('#share');
            await page.until(`document.querySelector('#share-link')?.value.includes('F--F')`);
        },
    ],
    [
        'an embedded drawing',
        async (page) => {
            await page.go(`embed.html${KOCH}&controls=angle,n`);
            await page.until(captioned('64 segments'));
            await page.fill('#iterations', '2');
            await page.until(captioned('16 segments'));
        },
    ],
    [
        'an exercise in the lesson',
        async (page) => {
            await page.go('course.html#step-1');
            await page.until(`document.querySelector('.step.now l-system')?.shadowRoot?.querySelector('iframe')`);
            await page.frame(`document.querySelector('.step.now l-system').shadowRoot.querySelector('iframe')`);
            await page.until(`document.querySelector('#mark-percent')?.textContent`);
            await page.fill('#rules', 'F -> FF');
            await page.frame(null);
            await page.until(`/Done/.test(document.querySelector('#told').textContent)`);
        },
    ],
];

const driver = spawn('WebKitWebDriver', [`--port=${PORT}`], { stdio: 'ignore' });
let failures = 0;
try {
    const page = await open();
    for (const [name, test] of TESTS) {
        try {
            await test(page);
            console.log(`ok ${name}`);
        } catch (error) {
            failures += 1;
            console.log(`not ok ${name}: ${error instanceof Error ? error.message : error}`);
        }
    }
    await page.close();
} finally {
    driver.kill();
}
process.exitCode = failures > 0 ? 1 : 0;
