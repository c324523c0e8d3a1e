/**
 * Keeps the page for use without a network. The build writes two lines in front of this script: BUILD, the name of this
 * version, and FILES, the SHA-256 of each file by path ('' is the page itself).
 *
 * A version is kept completely or not at all. If a file's hash differs, for example during an upload of the site, the
 * installation fails and the browser tries again later. So a page never gets files of two versions.
 */
(() => {
    const worker = /** @type {ServiceWorkerGlobalScope} */ (/** @type {unknown} */ (self));
    const scope = worker.registration.scope;
    const prefix = `l-systems ${scope} `;
    const name = prefix + BUILD;

    worker.addEventListener('install', (event) => event.waitUntil(keepAll()));
    worker.addEventListener('activate', (event) => event.waitUntil(forgetOthers()));
    worker.addEventListener('message', (event) => {
        if (event.data === 'take over') worker.skipWaiting();
    });
    worker.addEventListener('fetch', (event) => {
        const address = addressOf(event.request);
        if (address) event.respondWith(answer(address, event.request));
    });

    /** The cached address of a request, or null if the site has no such file. @param {Request} request */
    function addressOf({ method, url }) {
        const address = new URL(url);
        address.hash = '';
        address.search = '';
        if (method !== 'GET' || !address.href.startsWith(scope)) return null;
        const path = decodeURIComponent(address.href.slice(scope.length)).replace(/^index\.html$/, '');
        return Object.hasOwn(FILES, path) ? scope + path : null;
    }

    /** @param {string} address @param {Request} request */
    async function answer(address, request) {
        const kept = await caches.open(name).then((cache) => cache.match(address));
        return kept ?? fetch(request);
    }

    async function keepAll() {
        const cache = await caches.open(name);
        const others = (await caches.keys()).filter((other) => other.startsWith(prefix) && other !== name);
        try {
            await Promise.all(Object.entries(FILES).map(async ([path, hash]) => cache.put(scope + path, await copy(scope + path, hash, others))));
        } catch (error) {
            await caches.delete(name);
            throw error;
        }
    }

    /** Copies an unchanged file from an older version, or fetches it from the network. @param {string} address @param {string} hash @param {string[]} others */
    async function copy(address, hash, others) {
        for (const other of others) {
            const old = await caches.open(other).then((cache) => cache.match(address));
            if (old && (await hashOf(old)) === hash) return old;
        }
        const fresh = await fetch(address, { cache: 'no-cache' });
        if (!fresh.ok || (await hashOf(fresh)) !== hash) throw new Error(`${address} is not of this version`);
        // Some hosts redirect, and a navigation must not be answered by a redirected response.
        return new Response(fresh.body, { headers: fresh.headers });
    }

    /** @param {Response} response */
    async function hashOf(response) {
        const digest = await crypto.subtle.digest('SHA-256', await response.clone().arrayBuffer());
        return [...new Uint8Array(digest)].map((byte) => byte.toString(16).padStart(2, '0')).join('');
    }

    async function forgetOthers() {
        for (const other of await caches.keys()) if (other.startsWith(prefix) && other !== name) await caches.delete(other);
    }
})();
