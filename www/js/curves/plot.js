/** A plot of a curve with points that are dragged, or moved by the arrow keys. */

import { make, setText } from '../dom.js';
import { plain } from '../numerals.js';
import { say } from '../words.js';
import { MOST_POINTS, along, extentOf, moved, onSteps, stepOf, widestGap, withPoint, withoutPoint } from './curve.js';

/** @typedef {import('./curve.js').Point} Point */
/** @typedef {{element: HTMLElement, name: string, show: (points: readonly Point[]) => void}} Plot */

const SVG = 'http://www.w3.org/2000/svg';
/** The size of the picture in its own units; the page stretches it. */
const [WIDTH, HEIGHT] = [100, 100];
/** The steps of a key with Shift. */
const FAR = 10;

/** @param {string} name @param {string} of the class */
function shape(name, of) {
    const element = document.createElementNS(SVG, name);
    element.setAttribute('class', of);
    element.setAttribute('vector-effect', 'non-scaling-stroke');
    return element;
}

/**
 * @param {string} name of the curve
 * @param {string} label the name as it is shown
 * @param {{change: (points: readonly Point[], held: boolean) => void, settle: () => void, isFixed: boolean}} on points are neither added nor removed if their number is fixed
 * @returns {Plot}
 */
export function createPlot(name, label, { change, settle, isFixed }) {
    const svg = document.createElementNS(SVG, 'svg');
    svg.setAttribute('viewBox', `0 0 ${WIDTH} ${HEIGHT}`);
    svg.setAttribute('preserveAspectRatio', 'none');
    svg.setAttribute('aria-hidden', 'true');
    const [zero, sides, line] = [shape('path', 'zero'), shape('path', 'sides'), shape('path', 'line')];
    svg.append(zero, sides, line);
    const area = make('div', { class: 'plot' }, svg);
    const place = make('output', { class: 'note' });
    const add = make('button', { type: 'button', class: 'button quiet' }, say`Add point`);
    const remove = make('button', { type: 'button', class: 'button quiet' }, say`Remove point`);
    const row = make('div', { class: 'row' }, place, ...(isFixed ? [] : [add, remove]));
    const element = make(
        'div',
        { class: 'curve', role: 'group', 'aria-label': say`Curve ${label}` },
        make('code', {}, label),
        area,
        row,
    );
    /** @type {readonly Point[]} */
    let points = [];
    let extent = extentOf([]);
    /** The point that the buttons are about. */
    let chosen = 0;
    let held = false;
    /** The plot's place when a drag began: the text above may become longer, and then the plot moves. @type {DOMRect | null} */
    let grip = null;
    /** @type {HTMLElement[]} */
    const handles = [];

    const across = () => stepOf(extent.right - extent.left);
    const upwards = () => stepOf(extent.top - extent.bottom);
    /** @param {Point} point @returns {Point} */
    const placed = ([x, y]) => [
        (WIDTH * (x - extent.left)) / (extent.right - extent.left),
        (HEIGHT * (extent.top - y)) / (extent.top - extent.bottom),
    ];
    /** @param {readonly Point[]} list */
    const path = (list) =>
        `M${list
            .map((point) =>
                placed(point)
                    .map((c) => c.toFixed(3))
                    .join(' '),
            )
            .join('L')}`;

    /** @param {PointerEvent} event @returns {Point} */
    function pointAt({ clientX, clientY }) {
        const box = grip ?? area.getBoundingClientRect();
        const [x, y] = [(clientX - box.left) / box.width, 1 - (clientY - box.top) / box.height];
        return [
            onSteps(extent.left + x * (extent.right - extent.left), across()),
            onSteps(extent.bottom + Math.min(Math.max(y, 0), 1) * (extent.top - extent.bottom), upwards()),
        ];
    }

    /** @param {number} at */
    function newHandle(at) {
        const handle = make('button', {
            type: 'button',
            role: 'slider',
            class: 'handle',
            'aria-label': say`Point ${at + 1}`,
        });
        handle.addEventListener('focus', () => choose(at));
        handle.addEventListener('pointerdown', (event) => {
            held = true;
            grip = area.getBoundingClientRect();
            handle.focus({ preventScroll: true });
            handle.setPointerCapture(event.pointerId);
        });
        handle.addEventListener('pointermove', (event) => {
            if (!handle.hasPointerCapture(event.pointerId)) return;
            const [x, y] = pointAt(event);
            // The ends keep their places along x: the plot's extent is theirs.
            const isEnd = at === 0 || at === points.length - 1;
            set(moved(points, at, [isEnd ? (points[at]?.[0] ?? x) : x, y]));
        });
        handle.addEventListener('lostpointercapture', () => {
            held = false;
            grip = null;
            settle();
            show(points);
        });
        handle.addEventListener('keydown', (event) => pressed(event, at));
        handle.addEventListener('blur', settle);
        area.append(handle);
        return handle;
    }

    /** @param {KeyboardEvent} event @param {number} at */
    function pressed(event, at) {
        if (event.altKey || event.ctrlKey || event.metaKey) return;
        const [dx, dy] = { ArrowLeft: [-1, 0], ArrowRight: [1, 0], ArrowUp: [0, 1], ArrowDown: [0, -1] }[event.key] ?? [
            0, 0,
        ];
        const removes = !isFixed && (event.key === 'Delete' || event.key === 'Backspace');
        if (!dx && !dy && !removes) return;
        event.preventDefault();
        if (removes) return removePoint(at);
        const by = event.shiftKey ? FAR : 1;
        const [x, y] = points[at] ?? [0, 0];
        set(
            moved(points, at, [
                dx ? onSteps(x + dx * by * across(), across()) : x,
                dy ? onSteps(y + dy * by * upwards(), upwards()) : y,
            ]),
        );
    }

    /** @param {readonly Point[]} next */
    function set(next) {
        change(next, held);
        show(next);
    }

    /** @param {number} at */
    function choose(at) {
        chosen = at;
        const [x, y] = points[at] ?? [0, 0];
        setText(place, say`Point ${at + 1} of ${points.length}: x ${plain(x)}, y ${plain(y)}`);
        handles.forEach((handle, index) => handle.classList.toggle('chosen', index === at));
        add.disabled = points.length >= MOST_POINTS;
        remove.disabled = at === 0 || at === points.length - 1;
    }

    /** @param {Point} point */
    function addPoint(point) {
        const next = withPoint(points, point);
        settle();
        set(next.points);
        settle();
        handles[next.at]?.focus();
    }

    /** @param {number} at */
    function removePoint(at) {
        const next = withoutPoint(points, at);
        if (next.length === points.length) return;
        settle();
        set(next);
        settle();
        handles[Math.min(at, next.length - 1)]?.focus();
    }

    /** @param {readonly Point[]} next */
    function show(next) {
        points = next;
        if (!held) extent = extentOf(points);
        line.setAttribute('d', path(along(points)));
        sides.setAttribute('d', path(points));
        const isInside = extent.bottom <= 0 && extent.top >= 0;
        zero.setAttribute(
            'd',
            isInside
                ? path([
                      [extent.left, 0],
                      [extent.right, 0],
                  ])
                : 'M0 0',
        );
        while (handles.length > points.length) handles.pop()?.remove();
        while (handles.length < points.length) handles.push(newHandle(handles.length));
        handles.forEach((handle, at) => {
            const [x, y] = points[at] ?? [0, 0];
            const [left, top] = placed([x, y]);
            handle.style.left = `${left}%`;
            handle.style.top = `${top}%`;
            handle.setAttribute('aria-valuemin', String(extent.bottom));
            handle.setAttribute('aria-valuemax', String(extent.top));
            handle.setAttribute('aria-valuenow', String(y));
            handle.setAttribute('aria-valuetext', `x ${plain(x)}, y ${plain(y)}`);
        });
        choose(Math.min(chosen, points.length - 1));
    }

    add.addEventListener('click', () => {
        const [x, y] = widestGap(points);
        addPoint([onSteps(x, across()), onSteps(y, upwards())]);
    });
    remove.addEventListener('click', () => removePoint(chosen));
    area.addEventListener('dblclick', (event) => {
        if (event.target !== area && event.target !== svg) return;
        if (!isFixed && points.length < MOST_POINTS) addPoint(pointAt(/** @type {PointerEvent} */ (event)));
    });
    return { element, name, show };
}
