/** A page of steps, one shown at a time: the lesson of the site, or a package in a learning system. */

import { copyText } from '../copy.js';
import { html, button, make, setText } from '../dom.js';
import { say, translatePage } from '../words.js';
import { createPackage } from './package.js';

/** Where the site's lesson keeps the place and what is done, in this browser. */
const KEY = 'l-system-lesson';

translatePage();

const steps = [...document.querySelectorAll('.step')];
const tasks = [...document.querySelectorAll('[data-step]')].filter((task) => task instanceof HTMLElement);
/** The steps that have the tasks, by number of task. Other steps are only read. */
const places = tasks.map((task) => steps.findIndex((step) => step.contains(task)));
const [back, onward] = [button('back'), button('onward')];
/** @type {{at: number, done: number[]}} */
let kept = { at: 0, done: [] };
const { package: id, scorm } = document.documentElement.dataset;

const links = steps.map((step, at) => {
    const title = step.querySelector('h2')?.textContent ?? '';
    const link = make('a', { href: `#${step.id}`, title }, step.id.replace('step-', ''));
    link.classList.toggle('read', !places.includes(at));
    html('places').append(make('li', {}, link));
    return link;
});
const limited = (/** @type {number} */ at) => Math.min(steps.length - 1, Math.max(0, at));
const named = () => steps.findIndex((step) => `#${step.id}` === location.hash);
const isDone = (/** @type {number} */ at) => kept.done.includes(at);

/** @param {number} at */
function show(at) {
    kept.at = limited(at);
    keep();
    steps.forEach((step, index) => step.classList.toggle('now', index === kept.at));
    links.forEach((link, index) => {
        link.toggleAttribute('aria-current', index === kept.at);
        if (index === kept.at) link.setAttribute('aria-current', 'step');
        link.classList.toggle('done', isDone(index));
        link.setAttribute('aria-label', isDone(index) ? say`${link.title}, done` : link.title);
    });
    const last = steps.length === 1 ? say`Done.` : say`Done. This was the last step.`;
    setText(html('told'), !isDone(kept.at) ? '' : kept.at < steps.length - 1 ? say`Done. On to the next step.` : last);
    back.disabled = kept.at === 0;
    onward.disabled = kept.at === steps.length - 1;
}

/** @param {number} at */
function go(at) {
    history.pushState(null, '', `#${steps[limited(at)]?.id}`);
    show(at);
    scrollTo(0, 0);
}

/** @param {number} at */
function done(at) {
    if (isDone(at)) return;
    kept.done.push(at);
    show(kept.at);
}

back.addEventListener('click', () => go(kept.at - 1));
onward.addEventListener('click', () => go(kept.at + 1));
for (const event of ['hashchange', 'popstate']) addEventListener(event, () => named() >= 0 && show(named()));
for (const [number, task] of tasks.entries()) {
    const at = places[number] ?? 0;
    const detail = (/** @type {Event} */ event) => /** @type {CustomEvent} */ (event).detail;
    task.addEventListener('mark', (event) => detail(event).solved && done(at));
    if (task.classList.contains('own'))
        task.addEventListener('change', (event) => detail(event).by === 'visitor' && done(at));
}
// The own plant leaves by its link; packages have no playground to take it to.
const own = /** @type {(HTMLElement & {state: string | null}) | null} */ (document.querySelector('l-system.own'));
const plant = () => new URL(own?.state ?? '', new URL('./', location.href)).href;
document.getElementById('take')?.addEventListener('click', () => open(plant(), '_blank', 'noopener'));
document.getElementById('copy')?.addEventListener('click', async () => {
    setText(html('told'), (await copyText(plant())) ? say`The link is copied.` : plant());
});
document.body.classList.toggle('alone', steps.length === 1);
// Beside the text, a task is as high as the window: all of it is in sight.
if (matchMedia('(min-width: 62rem) and (min-height: 34rem)').matches) {
    document.body.classList.add('beside');
    for (const task of tasks)
        if (task.classList.contains('task')) task.setAttribute('link', `${task.getAttribute('link') ?? '#v=1'}&fill=1`);
}

/** The package that keeps all; null for the site's lesson, which keeps its place here. @type {ReturnType<typeof createPackage> | null} */
let packed = null;

function keep() {
    if (id !== undefined) return packed?.moved(kept.at);
    try {
        localStorage.setItem(KEY, JSON.stringify({ ...kept, steps: steps.length }));
    } catch {
        // Storage may be forbidden.
    }
}

if (id !== undefined)
    packed = createPackage({
        id,
        standard: scorm === '2004' ? '2004' : '1.2',
        tasks,
        above: /** @type {Element} */ (steps[0]),
        restored(at, done) {
            kept = { at, done: done.map((number) => places[number] ?? 0) };
            show(at);
        },
    });
else
    try {
        const read = JSON.parse(localStorage.getItem(KEY) ?? 'null');
        // Pages without a number of steps began with step 1.
        const shift = read?.steps === undefined ? 1 : 0;
        if (Number.isInteger(read?.at) && Array.isArray(read?.done))
            kept = { at: read.at + shift, done: read.done.map((/** @type {number} */ at) => at + shift) };
    } catch {
        // As above.
    }
document.body.classList.add('stepping');
show(named() >= 0 ? named() : kept.at);
