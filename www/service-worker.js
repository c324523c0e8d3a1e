/**
 * Keeps the page for use without a network. The build writes lines in front of this script: BUILD, the name of this
 * version; FILES, the SHA-256 of each file by path ('' is the page itself); SIZES, their bytes; FIRST, the files that
 * the first screen needs; and SOON, those that the page fetches after it.
 *
 * The first screen is kept at the first visit, other files when they are first used or when the reader asks for all.
 * A new version also keeps what the old one had. The first screen of a version is kept completely or not at all, and a
 * file is kept or used only if its hash is that of this version. So a page never gets files of two versions.
 */
(() => {
    const worker = /** @type {ServiceWorkerGlobalScope} */ (/** @type {unknown} */ (self));
    const scope = worker.registration.scope;
    const prefix = `l-systems ${scope} `;
    const name = prefix + BUILD;
    /** Where other programs send what is shared with the page (manifest.webmanifest), and the cache that keeps it. */
    const SHARED = `${scope}shared`;

    worker.addEventListener('install', (event) => event.waitUntil(keepFirst()));
    worker.addEventListener('activate', (event) => event.waitUntil(forgetOthers().then(() => worker.clients.claim())));
    worker.addEventListener('message', (event) => {
        const [port] = event.ports;
        if (event.data === 'take over') worker.skipWaiting();
        if (event.data === 'missing' && port)
            event.waitUntil(missing().then((paths) => port.postMessage(sizeOf(paths))));
        if (event.data === 'keep all' && port) event.waitUntil(keepAll(port));
    });
    worker.addEventListener('fetch', (event) => {
        const { method, url } = event.request;
        if (method === 'POST' && url === SHARED) return event.respondWith(take(event.request));
        const path = pathOf(event.request);
        if (path !== null) event.respondWith(answer(path, event.request));
    });

    /** The path of a requested file, or null if the site has no such file. @param {Request} request */
    function pathOf({ method, url }) {
        const address = new URL(url);
        address.hash = '';
        address.search = '';
        if (method !== 'GET' || !address.href.startsWith(scope)) return null;
        const path = decodeURIComponent(address.href.slice(scope.length)).replace(/^index\.html$/, '');
        return Object.hasOwn(FILES, path) ? path : null;
    }

    /** Keeps a shared file, or else the text, until the page opens it (js/dialogs/shared.js). @param {Request} request */
    async function take(request) {
        const form = await request.formData();
        const words = ['title', 'text', 'url'].map((key) => form.get(key)).filter(Boolean);
        const given = form.get('file');
        const file = given instanceof File ? given : new File([words.join('\n')], '', { type: 'text/plain' });
        const cache = await caches.open(SHARED);
        await cache.put(SHARED, new Response(file, { headers: { name: encodeURIComponent(file.name) } }));
        return Response.redirect(`${scope}?shared`, 303);
    }

    /** @param {string} path @param {Request} request */
    async function answer(path, request) {
        const cache = await caches.open(name);
        const kept = await cache.match(scope + path);
        if (kept) return kept;
        try {
            const fresh = await copy(path, []);
            await cache.put(scope + path, fresh.clone()).catch(() => {});
            return fresh;
        } catch {
            // A document of a newer version is shown; a script or data of a newer version would not fit this page.
            if (request.mode === 'navigate') return fetch(request);
            void worker.registration.update().catch(() => {});
            return Response.error();
        }
    }

    async function keepFirst() {
        const others = (await caches.keys()).filter((other) => other.startsWith(prefix) && other !== name);
        const had = await Promise.all(
            others.map(async (other) =>
                (await caches.open(other).then((cache) => cache.keys())).map((request) => pathOf(request)),
            ),
        );
        const wanted = new Set([...FIRST, ...SOON, ...had.flat().filter((path) => path !== null)]);
        try {
            await keep([...wanted], others);
        } catch (error) {
            await caches.delete(name);
            throw error;
        }
    }

    /** @param {readonly string[]} paths @param {readonly string[]} others older versions */
    async function keep(paths, others) {
        const cache = await caches.open(name);
        await Promise.all(paths.map(async (path) => cache.put(scope + path, await copy(path, others))));
    }

    /** The files that are not kept yet. */
    async function missing() {
        const kept = new Set((await caches.open(name).then((cache) => cache.keys())).map(({ url }) => url));
        return Object.keys(FILES).filter((path) => !kept.has(new URL(scope + path).href));
    }

    /** Their size, in bytes. @param {readonly string[]} paths */
    const sizeOf = (paths) => paths.reduce((sum, path) => sum + (SIZES[path] ?? 0), 0);

    /** Keeps all files, and tells the size that is left after each. @param {MessagePort} port */
    async function keepAll(port) {
        const left = new Set(await missing());
        try {
            for (const path of [...left]) {
                await keep([path], []);
                left.delete(path);
                port.postMessage(sizeOf([...left]));
            }
            port.postMessage(0);
        } catch (error) {
            port.postMessage(String(error instanceof Error ? error.message : error));
        }
    }

    /** Copies an unchanged file from an older version, or fetches it from the network. @param {string} path @param {readonly string[]} others */
    async function copy(path, others) {
        const [address, hash] = [scope + path, FILES[path]];
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
        for (const other of await caches.keys())
            if (other.startsWith(prefix) && other !== name) await caches.delete(other);
    }
})();
