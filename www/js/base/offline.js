/**
 * Use without a network, by service-worker.js. A new version is downloaded while the old one is in use. The new version
 * takes over when the page is next opened, or at once on request.
 */

import { button, html } from './dom.js';
import { isWhole } from './files.js';

/** The shortest time between checks for a new version, in milliseconds. */
const CHECK_INTERVAL = 60 * 60 * 1000;

/** Wait before the new version takes over, in milliseconds: Chromium delays a takeover while the old version serves the page. */
const TAKE_OVER_DELAY = 1000;

/** Whether the page comes from a development server; then nothing is cached. */
const isLocal = () => ['localhost', '127.0.0.1', '[::1]'].includes(location.hostname);

export async function keepOffline() {
    if (!('serviceWorker' in navigator) || isWhole() || parent !== window) return;
    try {
        if (isLocal()) return await forget();
        if (document.readyState !== 'complete')
            await new Promise((resolve) => addEventListener('load', resolve, { once: true }));
        await keep();
    } catch {
        // Refused, for example in some private windows: the page works only with a network.
    }
}

async function keep() {
    const { serviceWorker } = navigator;
    const registration = await serviceWorker.register('service-worker.js', { updateViaCache: 'none' });
    // A version downloaded earlier takes over now. The address keeps the reader's changes.
    if (serviceWorker.controller && registration.waiting) {
        await new Promise((resolve) => setTimeout(resolve, TAKE_OVER_DELAY));
        if (takeOver(registration)) return;
    }
    html('open-offline').hidden = false;
    let asked = Date.now();
    const watch = () => {
        const fresh = registration.installing;
        fresh?.addEventListener('statechange', () => {
            if (fresh.state === 'installed' && serviceWorker.controller) tell();
        });
    };
    watch();
    registration.addEventListener('updatefound', watch);
    let isFirst = !serviceWorker.controller;
    serviceWorker.addEventListener('controllerchange', () => {
        // At the first visit there is no older version. Later, another tab has let the new version take over.
        if (!isFirst) tell();
        isFirst = false;
    });
    button('renew').addEventListener('click', () => {
        button('renew').disabled = true;
        if (!takeOver(registration)) location.reload();
    });
    button('renew-later').addEventListener('click', () => (html('renewal').hidden = true));
    document.addEventListener('visibilitychange', () => {
        if (document.visibilityState !== 'visible' || Date.now() - asked < CHECK_INTERVAL) return;
        asked = Date.now();
        registration.update().catch(() => {});
    });
}

function tell() {
    html('renewal').hidden = false;
}

/** Lets the waiting version take over, and reloads the page. @param {ServiceWorkerRegistration} registration @returns {boolean} whether a version waits */
function takeOver({ waiting }) {
    if (!waiting) return false;
    navigator.serviceWorker.addEventListener('controllerchange', () => location.reload(), { once: true });
    waiting.postMessage('take over');
    return true;
}

/**
 * Asks the version in use, which may answer several times.
 * @param {'missing' | 'keep all'} question
 * @param {(answer: unknown) => void} hear
 */
export async function askVersion(question, hear) {
    const { active } = await navigator.serviceWorker.ready;
    const { port1, port2 } = new MessageChannel();
    port1.onmessage = ({ data }) => hear(data);
    active?.postMessage(question, [port2]);
}

async function forget() {
    const registration = await navigator.serviceWorker.getRegistration();
    await registration?.unregister();
}
