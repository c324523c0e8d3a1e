/** A page of steps, one shown at a time: the lesson of the site, and packages in learning systems. */

import { html, button, make, setText } from '../base/dom.js';
import { say, translatePage } from '../base/words.js';

/** The shown step, and the steps that are done. @typedef {{at: number, done: number[]}} Place */

/** @param {(place: Place) => void} keep another step is shown, or one is done */
export function createSteps(keep) {
    translatePage();
    const steps = [...document.querySelectorAll('.step')];
    const tasks = [...document.querySelectorAll('[data-step]')].filter((task) => task instanceof HTMLElement);
    /** The steps that have the tasks, by number of task. Other steps are only read. */
    const places = tasks.map((task) => steps.findIndex((step) => step.contains(task)));
    const [back, onward] = [button('back'), button('onward')];
    /** @type {Place} */
    let kept = { at: 0, done: [] };

    const links = steps.map((step, at) => newLink(step, !places.includes(at)));
    const limited = (/** @type {number} */ at) => Math.min(steps.length - 1, Math.max(0, at));
    const named = () => steps.findIndex((step) => `#${step.id}` === location.hash);
    const isDone = (/** @type {number} */ at) => kept.done.includes(at);

    function draw() {
        steps.forEach((step, index) => step.classList.toggle('now', index === kept.at));
        links.forEach((link, index) => {
            link.toggleAttribute('aria-current', index === kept.at);
            if (index === kept.at) link.setAttribute('aria-current', 'step');
            link.classList.toggle('done', isDone(index));
            link.setAttribute('aria-label', isDone(index) ? say`${link.title}, done` : link.title);
        });
        setText(html('told'), isDone(kept.at) ? doneWords(kept.at, steps.length) : '');
        back.disabled = kept.at === 0;
        onward.disabled = kept.at === steps.length - 1;
    }

    /** @param {number} at */
    function show(at) {
        kept.at = limited(at);
        keep(kept);
        draw();
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
    fillWindow(tasks, document.body.classList.toggle('alone', steps.length === 1));

    return {
        tasks,
        places,
        first: steps[0],

        /** Shows what is kept. @param {Place} place */
        restore(place) {
            kept = { ...place, at: limited(place.at) };
            draw();
        },

        /** Shows the step of the address, or else the kept one. */
        begin() {
            document.body.classList.add('stepping');
            show(named() >= 0 ? named() : kept.at);
        },
    };
}

/** The link to a step. @param {Element} step @param {boolean} isRead whether the step is only read */
function newLink(step, isRead) {
    const title = step.querySelector('h2')?.textContent ?? '';
    const link = make('a', { href: `#${step.id}`, title }, step.id.replace('step-', ''));
    link.classList.toggle('read', isRead);
    html('places').append(make('li', {}, link));
    return link;
}

/**
 * Tasks are as high as the window, so that all of them is in sight: one alone, and those beside the text of a wide window.
 * @param {HTMLElement[]} tasks
 * @param {boolean} isAlone
 */
function fillWindow(tasks, isAlone) {
    if (!isAlone && !matchMedia('(min-width: 62rem) and (min-height: 34rem)').matches) return;
    if (!isAlone) document.body.classList.add('beside');
    for (const task of tasks)
        if (task.classList.contains('task')) task.setAttribute('link', `${task.getAttribute('link') ?? '#v=1'}&fill=1`);
}

/** An exercise alone says itself that it is solved. @param {number} at @param {number} count */
function doneWords(at, count) {
    if (count === 1) return '';
    return at < count - 1 ? say`Done. On to the next step.` : say`Done. This was the last step.`;
}
