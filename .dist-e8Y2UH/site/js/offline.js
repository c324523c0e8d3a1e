/**
 * Use without a network, by service-worker.js. A new version is fetched while the old one is used and takes over when
 * the page is next opened, or at once if the reader likes.
 */

import { button, html } from './dom.js';
import { isWhole } from './files.js';

/** A page that stays open asks this often whether there is a new version, in milliseconds. */
const OFTEN = 60 * 60 * 1000;

/** While the old version is at work for a page, Chromium puts off the new one until the page is left; in milliseconds. */
const SETTLED = 1000;

/** Whether this is a copy under development, of which nothing is to be kept. */
const isLocal = () => ['localhost', '127.0.0.1', '[::1]'].includes(location.hostname);

export async function keepOffline() {
    if (!('serviceWorker' in navigator) || isWhole() || parent !== window) return;
    try {
        if (isLocal()) return await forget();
        if (document.readyState !== 'complete') await new Promise((resolve) => addEventListener('load', resolve, { once: true }));
        await keep();
    } catch {
        // Refused, as in some private windows: the page works while there is a network.
    }
}

async function keep() {
    const { serviceWorker } = navigator;
    const registration = await serviceWorker.register('service-worker.js', { updateViaCache: 'none' });
    // What came while the page was last open takes over now. The address keeps what the reader may have begun.
    if (serviceWorker.controller && registration.waiting) {
        await new Promise((resolve) => setTimeout(resolve, SETTLED));
        if (takeOver(registration)) return;
    }
    let asked = Date.now();
    const watch = () => {
        const fresh = registration.installing;
        fresh?.addEventListener('statechange', () => {
            if (fresh.state === 'installed' && serviceWorker.controller) tell();
        });
    };
    watch();
    registration.addEventListener('updatefound', watch);
    // Another tab has let it take over.
    serviceWorker.addEventListener('controllerchange', tell);
    button('renew').addEventListener('click', () => {
        button('renew').disabled = true;
        if (!takeOver(registration)) location.reload();
    });
    button('renew-later').addEventListener('click', () => (html('renewal').hidden = true));
    document.addEventListener('visibilitychange', () => {
        if (document.visibilityState !== 'visible' || Date.now() - asked < OFTEN) return;
        asked = Date.now();
        registration.update().catch(() => {});
    });
}

function tell() {
    html('renewal').hidden = false;
}

/** Lets a version that waits take over, and opens it. @param {ServiceWorkerRegistration} registration @returns {boolean} whether one waits */
function takeOver({ waiting }) {
    if (!waiting) return false;
    navigator.serviceWorker.addEventListener('controllerchange', () => location.reload(), { once: true });
    waiting.postMessage('take over');
    return true;
}

async function forget() {
    const registration = await navigator.serviceWorker.getRegistration();
    await registration?.unregister();
}
