/**
 * The cost of opening: compressed bytes, requests, the time to the first picture on this machine and at simulated 4G,
 * and ten drawings at once in a page of another site: `cargo xtask bench load`.
 */

import { execFileSync } from 'node:child_process';
import { readFile } from 'node:fs/promises';
import { createServer } from 'node:http';
import { promisify } from 'node:util';
import { brotliCompress, constants, gzip } from 'node:zlib';
import { chromium } from 'playwright-core';

const DIST = new URL('../../../dist/', import.meta.url);
const RUNS = 5;
/** The timeout for each step, also on a busy machine, in milliseconds. */
const PATIENCE = 120_000;
/** Chromium's 4G profile: bytes per second, latency in milliseconds. */
const MOBILE = { offline: false, latency: 60, downloadThroughput: 9e6 / 8, uploadThroughput: 1.5e6 / 8 };
const PLANT = 'v=1&axiom=X&rules=X%20-%3E%20F%5B+X%5DF%5B-X%5D+X%0AF%20-%3E%20FF&n=7&angle=20&controls=n,angle';
/** @type {Record<string, string>} */
const TYPES = {
    html: 'text/html; charset=utf-8',
    js: 'text/javascript; charset=utf-8',
    css: 'text/css; charset=utf-8',
    wasm: 'application/wasm',
    svg: 'image/svg+xml',
    json: 'application/json',
    webmanifest: 'application/manifest+json',
};
/** @type {Record<string, (bytes: Buffer) => Promise<Buffer>>} */
const PACKERS = {
    br: (bytes) => promisify(brotliCompress)(bytes, { params: { [constants.BROTLI_PARAM_QUALITY]: 11 } }),
    gzip: (bytes) => promisify(gzip)(bytes, { level: 9 }),
};

const launch = () =>
    chromium.launchServer({
        executablePath: process.env.CHROMIUM ?? '/usr/bin/chromium-headless-shell',
        args: [
            '--headless',
            '--no-sandbox',
            '--disable-gpu',
            '--disable-quic',
            '--disable-background-networking',
            '--disable-sync',
        ],
    });
/** @param {number[]} values */
const median = (values) => Math.round([...values].sort((a, b) => a - b)[values.length >> 1] ?? 0);

let packing = 'br';
/** The files as sent. @type {Map<string, Buffer>} */
const packed = new Map();
/** The sizes of the sent files, in bytes. @type {number[]} */
let sent = [];

/** @param {import('node:http').RequestListener} answer @returns {Promise<string>} */
async function serve(answer) {
    const server = createServer(answer).listen(0, '127.0.0.1');
    await new Promise((resolve) => server.once('listening', () => resolve(null)));
    const address = server.address();
    return String(typeof address === 'object' ? address?.port : address);
}

const site = `http://127.0.0.1:${await serve(async (request, response) => {
    const path = String(request.url)
        .replace(/[?#].*$/, '')
        .replace(/\/$/, '/index.html')
        .slice(1);
    const type = TYPES[String(path.split('.').pop())];
    try {
        const key = `${packing} ${path}`;
        const bytes =
            packed.get(key) ??
            (await (type ? PACKERS[packing]?.(await readFile(new URL(path, DIST))) : readFile(new URL(path, DIST))));
        packed.set(key, /** @type {Buffer} */ (bytes));
        sent.push(bytes?.length ?? 0);
        response.writeHead(200, {
            'content-type': type ?? 'image/png',
            ...(type ? { 'content-encoding': packing } : {}),
            'cache-control': 'max-age=600',
        });
        response.end(bytes);
    } catch {
        response.writeHead(404);
        response.end();
    }
})}/`;

/** Opens a page with an empty cache. Returns the time of its first picture in milliseconds, and the bytes sent until then. @param {import('playwright-core').Browser} browser @param {string} path @param {boolean} mobile */
async function firstPicture(browser, path, mobile) {
    const context = await browser.newContext({ viewport: { width: 1280, height: 800 } });
    const page = await context.newPage();
    if (mobile) await (await context.newCDPSession(page)).send('Network.emulateNetworkConditions', MOBILE);
    await page.addInitScript(() => {
        const look = () => {
            const all = /** @type {any} */ (window);
            if (document.querySelector('#stage.inked')) all.inked ??= performance.now();
        };
        new MutationObserver(look).observe(document, { subtree: true, attributes: true, childList: true });
    });
    sent = [];
    await page.goto(site + path);
    const inked = await page.waitForFunction(() => /** @type {any} */ (window).inked, null, { timeout: PATIENCE });
    const bytes = sent.reduce((a, b) => a + b, 0);
    const opened = { time: /** @type {number} */ (await inked.jsonValue()), bytes, requests: sent.length };
    await context.close();
    return opened;
}

const server = await launch();
const browser = await chromium.connect(server.wsEndpoint());
console.log(`opening, median of ${RUNS}; times are of the first picture`);
for (const path of ['', `embed.html#${PLANT}`, 'playground.html']) {
    /** @type {Record<string, number>} */
    const bytes = {};
    let requests = 0;
    // Brotli last, because hosts send Brotli and the times below use it. Opening also compresses the files.
    for (packing of Object.keys(PACKERS).reverse()) {
        const opened = await firstPicture(browser, path, false);
        bytes[packing] = opened.bytes;
        requests = opened.requests;
    }
    const times = { here: /** @type {number[]} */ ([]), mobile: /** @type {number[]} */ ([]) };
    for (let run = 0; run < RUNS; run++) {
        times.here.push((await firstPicture(browser, path, false)).time);
        times.mobile.push((await firstPicture(browser, path, true)).time);
    }
    console.log(
        `  ${(path.replace(/#.*/, '') || 'index.html').padEnd(16)} ${bytes.br} bytes by brotli, ${bytes.gzip} by gzip, ${requests} requests; here ${median(times.here)} ms, 4G ${median(times.mobile)} ms`,
    );
}
await browser.close();
await server.close();

/** The memory of the renderer processes, in megabytes. @param {number | undefined} root */
function memory(root) {
    const rows = execFileSync('ps', ['-eo', 'pid,ppid,rss,args', '--no-headers'], { encoding: 'utf8' })
        .trim()
        .split('\n')
        .map((line) => line.trim().split(/\s+/));
    const processes = new Set([String(root)]);
    for (let size = 0; size !== processes.size; ) {
        size = processes.size;
        for (const [pid, parent] of rows) if (pid && parent && processes.has(parent)) processes.add(pid);
    }
    return Math.round(
        rows
            .filter(([pid, , , ...words]) => pid && processes.has(pid) && words.includes('--type=renderer'))
            .reduce((sum, row) => sum + Number(row[2]) / 1024, 0),
    );
}

packing = 'br';
let body = '';
const host = `http://localhost:${await serve((_request, response) => {
    response.writeHead(200, { 'content-type': 'text/html; charset=utf-8' });
    response.end(`<!doctype html><style>iframe { width: 300px; height: 220px; border: 0 }</style><script>
        var ready = [];
        addEventListener('message', (event) => {
            if (event.data.lsystem === 'hello') event.source.postMessage({ lsystem: 'hello' }, '*');
            if (event.data.lsystem === 'ready') ready.push(performance.now());
        });
    </script>${body}`);
})}/`;
console.log(`drawings in another site's page, all in sight; median of ${RUNS}`);
for (const count of [0, 1, 10]) {
    body = Array.from(
        { length: count },
        (_, seed) => `<iframe src="${site}embed.html#${PLANT}&seed=${seed}"></iframe>`,
    ).join('');
    /** @type {number[]} */
    const times = [];
    let megabytes = 0;
    for (let run = 0; run < RUNS; run++) {
        const fresh = await launch();
        const connection = await chromium.connect(fresh.wsEndpoint());
        const page = await connection.newPage({ viewport: { width: 1300, height: 900 } });
        await page.goto(host);
        await page.waitForFunction((wanted) => /** @type {any} */ (window).ready.length >= wanted, count, {
            timeout: PATIENCE,
        });
        times.push(
            Math.max(0, .../** @type {number[]} */ (await page.evaluate(() => /** @type {any} */ (window).ready))),
        );
        await new Promise((resolve) => setTimeout(resolve, 1000));
        megabytes = memory(fresh.process().pid);
        await connection.close();
        await fresh.close();
    }
    console.log(`  ${count} drawings: all ready after ${median(times)} ms, renderers ${megabytes} MB`);
}
process.exit(0);
