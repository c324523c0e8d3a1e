/** A plot of a curve with points that are dragged, or moved by the arrow keys. */

import { make, setText, svg } from '../base/dom.js';
import { plain } from '../base/numerals.js';
import { ARROWS } from '../view/keys.js';
import { say } from '../base/words.js';
import { MOST_POINTS, along, extentOf, moved, onSteps, stepOf, widestGap, withPoint, withoutPoint } from './curve.js';

/** @typedef {import('./curve.js').Point} Point */
/** @typedef {{element: HTMLElement, name: string, show: (points: readonly Point[]) => void}} Plot */

/** The size of the picture in its own units; the page stretches it. */
const [WIDTH, HEIGHT] = [100, 100];
/** The steps of a key with Shift. */
const FAR = 10;

/** @param {string} of the class */
const shape = (of) => svg('path', { class: of, 'vector-effect': 'non-scaling-stroke' });

/**
 * A curve in the editor.
 * @typedef {object} Editor
 * @property {(points: readonly Point[], held: boolean) => void} change
 * @property {() => void} settle
 * @property {boolean} isFixed
 * @property {ReturnType<typeof shape>} zero
 * @property {ReturnType<typeof shape>} sides
 * @property {ReturnType<typeof shape>} line
 * @property {HTMLElementTagNameMap['div']} area
 * @property {HTMLElementTagNameMap['output']} place
 * @property {HTMLElementTagNameMap['button']} add
 * @property {HTMLElementTagNameMap['button']} remove
 * @property {readonly Point[]} points
 * @property {ReturnType<typeof extentOf>} extent
 * @property {number} chosen The point that the buttons are about
 * @property {boolean} held
 * @property {DOMRect | null} grip The plot's place when a drag began: the text above may become longer, and then the plot moves
 * @property {HTMLElement[]} handles
 */

/**
 * @param {string} name of the curve
 * @param {string} label the name as it is shown
 * @param {{change: (points: readonly Point[], held: boolean) => void, settle: () => void, isFixed: boolean}} on points are neither added nor removed if their number is fixed
 * @returns {Plot}
 */
export function createPlot(name, label, { change, settle, isFixed }) {
    const [zero, sides, line] = [shape('zero'), shape('sides'), shape('line')];
    const viewBox = `0 0 ${WIDTH} ${HEIGHT}`;
    const picture = svg('svg', { viewBox, preserveAspectRatio: 'none', 'aria-hidden': 'true' }, zero, sides, line);
    /** @type {Editor} */
    const self = {
        change,
        settle,
        isFixed,
        zero,
        sides,
        line,
        area: make('div', { class: 'plot' }, picture),
        place: make('output', { class: 'note' }),
        add: make('button', { class: 'button quiet' }, say`Add point`),
        remove: make('button', { class: 'button quiet' }, say`Remove point`),
        points: [],
        extent: extentOf([]),
        chosen: 0,
        held: false,
        grip: null,
        handles: [],
    };

    const row = make('div', { class: 'row' }, self.place, ...(isFixed ? [] : [self.add, self.remove]));
    const element = make(
        'div',
        { class: 'curve', role: 'group', 'aria-label': say`Curve ${label}` },
        make('code', {}, label),
        self.area,
        row,
    );

    self.add.addEventListener('click', () => {
        const [x, y] = widestGap(self.points);
        addPoint(self, [onSteps(x, across(self)), onSteps(y, upwards(self))]);
    });
    self.remove.addEventListener('click', () => removePoint(self, self.chosen));
    self.area.addEventListener('dblclick', (event) => {
        if (event.target !== self.area && event.target !== picture) return;
        if (!isFixed && self.points.length < MOST_POINTS)
            addPoint(self, pointAt(self, /** @type {PointerEvent} */ (event)));
    });
    return { element, name, show: (/** @type {readonly Point[]} */ next) => show(self, next) };
}

/** @param {Editor} self */
const across = (self) => stepOf(self.extent.right - self.extent.left);

/** @param {Editor} self */
const upwards = (self) => stepOf(self.extent.top - self.extent.bottom);

/** @param {Editor} self @param {Point} point @returns {Point} */
const placed = (self, [x, y]) => [
    (WIDTH * (x - self.extent.left)) / (self.extent.right - self.extent.left),
    (HEIGHT * (self.extent.top - y)) / (self.extent.top - self.extent.bottom),
];

/** @param {Editor} self @param {readonly Point[]} list */
const path = (self, list) =>
    `M${list
        .map((point) =>
            placed(self, point)
                .map((c) => c.toFixed(3))
                .join(' '),
        )
        .join('L')}`;

/** @param {Editor} self @param {PointerEvent} event @returns {Point} */
function pointAt(self, { clientX, clientY }) {
    const box = self.grip ?? self.area.getBoundingClientRect();
    const [x, y] = [(clientX - box.left) / box.width, 1 - (clientY - box.top) / box.height];
    return [
        onSteps(self.extent.left + x * (self.extent.right - self.extent.left), across(self)),
        onSteps(
            self.extent.bottom + Math.min(Math.max(y, 0), 1) * (self.extent.top - self.extent.bottom),
            upwards(self),
        ),
    ];
}

/** @param {Editor} self @param {number} at */
function newHandle(self, at) {
    const handle = make('button', {
        role: 'slider',
        class: 'handle',
        'aria-label': say`Point ${at + 1}`,
    });
    handle.addEventListener('focus', () => choose(self, at));
    handle.addEventListener('pointerdown', (event) => {
        self.held = true;
        self.grip = self.area.getBoundingClientRect();
        handle.focus({ preventScroll: true });
        handle.setPointerCapture(event.pointerId);
    });
    handle.addEventListener('pointermove', (event) => {
        if (!handle.hasPointerCapture(event.pointerId)) return;
        const [x, y] = pointAt(self, event);
        // The ends keep their places along x: the plot's extent is theirs.
        const isEnd = at === 0 || at === self.points.length - 1;
        set(self, moved(self.points, at, [isEnd ? (self.points[at]?.[0] ?? x) : x, y]));
    });
    handle.addEventListener('lostpointercapture', () => {
        self.held = false;
        self.grip = null;
        self.settle();
        show(self, self.points);
    });
    handle.addEventListener('keydown', (event) => pressed(self, event, at));
    handle.addEventListener('blur', self.settle);
    self.area.append(handle);
    return handle;
}

/** @param {Editor} self @param {KeyboardEvent} event @param {number} at */
function pressed(self, event, at) {
    if (event.altKey || event.ctrlKey || event.metaKey) return;
    const [dx, dy] = ARROWS[event.key] ?? [0, 0];
    const removes = !self.isFixed && (event.key === 'Delete' || event.key === 'Backspace');
    if (!dx && !dy && !removes) return;
    event.preventDefault();
    if (removes) return removePoint(self, at);
    const by = event.shiftKey ? FAR : 1;
    const [x, y] = self.points[at] ?? [0, 0];
    set(
        self,
        moved(self.points, at, [
            dx ? onSteps(x + dx * by * across(self), across(self)) : x,
            dy ? onSteps(y + dy * by * upwards(self), upwards(self)) : y,
        ]),
    );
}

/** @param {Editor} self @param {readonly Point[]} next */
function set(self, next) {
    self.change(next, self.held);
    show(self, next);
}

/** @param {Editor} self @param {number} at */
function choose(self, at) {
    self.chosen = at;
    const [x, y] = self.points[at] ?? [0, 0];
    setText(self.place, say`Point ${at + 1} of ${self.points.length}: x ${plain(x)}, y ${plain(y)}`);
    self.handles.forEach((handle, index) => handle.classList.toggle('chosen', index === at));
    self.add.disabled = self.points.length >= MOST_POINTS;
    self.remove.disabled = at === 0 || at === self.points.length - 1;
}

/** @param {Editor} self @param {Point} point */
function addPoint(self, point) {
    const next = withPoint(self.points, point);
    self.settle();
    set(self, next.points);
    self.settle();
    self.handles[next.at]?.focus();
}

/** @param {Editor} self @param {number} at */
function removePoint(self, at) {
    const next = withoutPoint(self.points, at);
    if (next.length === self.points.length) return;
    self.settle();
    set(self, next);
    self.settle();
    self.handles[Math.min(at, next.length - 1)]?.focus();
}

/** @param {Editor} self @param {readonly Point[]} next */
function show(self, next) {
    self.points = next;
    if (!self.held) self.extent = extentOf(self.points);
    self.line.setAttribute('d', path(self, along(self.points)));
    self.sides.setAttribute('d', path(self, self.points));
    const isInside = self.extent.bottom <= 0 && self.extent.top >= 0;
    self.zero.setAttribute(
        'd',
        isInside
            ? path(self, [
                  [self.extent.left, 0],
                  [self.extent.right, 0],
              ])
            : 'M0 0',
    );
    while (self.handles.length > self.points.length) self.handles.pop()?.remove();
    while (self.handles.length < self.points.length) self.handles.push(newHandle(self, self.handles.length));
    self.handles.forEach((handle, at) => {
        const [x, y] = self.points[at] ?? [0, 0];
        const [left, top] = placed(self, [x, y]);
        handle.style.left = `${left}%`;
        handle.style.top = `${top}%`;
        handle.setAttribute('aria-valuemin', String(self.extent.bottom));
        handle.setAttribute('aria-valuemax', String(self.extent.top));
        handle.setAttribute('aria-valuenow', String(y));
        handle.setAttribute('aria-valuetext', `x ${plain(x)}, y ${plain(y)}`);
    });
    choose(self, Math.min(self.chosen, self.points.length - 1));
}
