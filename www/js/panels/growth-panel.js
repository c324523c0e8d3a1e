/** Iterations, angles, the seed where chance plays a part, and the size of the result. */

import { button, byId, html, input, make, setText } from '../base/dom.js';
import { dial } from '../controls/dial.js';
import { listProblems } from '../controls/editor.js';
import { stateField } from '../controls/state-field.js';
import { largestLabel } from '../base/fix.js';
import { setLayer } from '../base/layers.js';
import { grouped, marked, plain, short, shortText } from '../base/numerals.js';
import { definitionOf, rangeOf } from '../state/state.js';
import { counted, say } from '../base/words.js';

/**
 * The fields and the last report.
 * @typedef {object} Panel
 * @property {import('../state/store.js').Store} store
 * @property {ReturnType<typeof dial>} iterations
 * @property {Report | null} last
 * @property {{system: string, largest: number, why: string} | null} bound The highest possible number of iterations and the reason, once known
 * @property {'symbols' | 'segments' | null} expanded The count that shows all its digits
 */

/** @typedef {import('../engine/engine.js').Report} Report */

/**
 * @param {import('../state/store.js').Store} store
 * @param {{seed: () => Promise<number>}} source
 */
export function growthPanel(store, source) {
    /** @type {Panel} */
    const self = {
        store,
        iterations: dial(store, 'iterations', 'iterations'),
        last: null,
        bound: null,
        expanded: null,
    };

    const angle = dial(store, 'angle', 'angle');
    const right = dial(store, 'rightAngle', 'right');
    const showSeed = stateField(store, 'seed', 'seed', 1);

    const twoAngles = input('two-angles');
    twoAngles.addEventListener('change', () => {
        store.change({ rightAngle: twoAngles.checked ? store.state.angle : null }, '');
    });
    button('dice').addEventListener('click', async () => {
        try {
            store.change({ seed: await source.seed() }, '');
        } catch {
            // The worker has stopped; the stage reports the failure.
        }
    });

    for (const kind of /** @type {const} */ (['symbols', 'segments'])) {
        button(kind).addEventListener('click', () => expand(self.expanded === kind ? null : kind));
    }

    /** @param {'symbols' | 'segments' | null} kind */
    function expand(kind) {
        self.expanded = kind;
        setLayer(fold, kind !== null);
        if (self.last) showDigits(self.last, self.expanded);
    }

    const fold = () => expand(null);

    return {
        /** @param {import('../state/state.js').State} state */
        show(state) {
            self.iterations.show(state.iterations);
            angle.show(state.angle);
            const differs = state.rightAngle !== null;
            twoAngles.checked = differs;
            html('right-row').hidden = !differs;
            setText(html('angle-label'), differs ? say`Left turns` : say`Angle`);
            if (state.rightAngle !== null) right.show(state.rightAngle);
            showSeed(state.seed);
            showAnglePicture(state.angle);
        },

        /** @param {Report} report @param {import('../state/state.js').State} state */
        report: (report, state) => showReport(self, report, state),
    };
}

/** @param {Panel} self @param {Report} report @param {import('../state/state.js').State} state */
function showReport(self, report, state) {
    const wrong = report.diagnostics.filter(({ field }) => field === 'numbers');
    listProblems(html('numbers-problems'), wrong);
    const { largest } = report;
    if (largest !== null && wrong.some(({ severity }) => severity === 'error')) {
        const remedy = make('button', { class: 'button fix' }, largestLabel(largest));
        remedy.addEventListener('click', () => self.store.change({ iterations: largest }, ''));
        html('numbers-problems').lastElementChild?.append(remedy);
    }
    if (!report.ok) return;
    self.last = report;
    for (const kind of /** @type {const} */ (['symbols', 'segments'])) showCount(button(kind), report, kind);
    showDigits(report, self.expanded);
    const system = JSON.stringify({ ...definitionOf(state), iterations: 0 });
    if (self.bound?.system !== system) self.bound = null;
    if (report.largest !== null && report.largest < rangeOf('iterations').high) {
        const passed = report.diagnostics.find(({ field, severity }) => field === 'numbers' && severity === 'error');
        self.bound = { system, largest: report.largest, why: passed?.message ?? '' };
    }
    self.iterations.limit(self.bound && Math.max(self.bound.largest, state.iterations));
    html('seed-row').hidden = !report.stochastic;
    setText(html('status'), statusOf(report, self.bound));
}

/**
 * The kind of the system and how the picture is made, in words.
 * @param {Report} report
 * @param {{largest: number, why: string} | null} bound
 */
function statusOf({ kind, space, memoised, blocks, largest }, bound) {
    const limit = bound ? [say`At most n = ${String(bound.largest)}.`] : [];
    if (bound && largest === null) limit.push(say`Above: ${bound.why}.`);
    if (memoised === null || blocks === null) return bound ? limit.join(' ') : say`Growing…`;
    const named = `${kind.charAt(0).toUpperCase()}${kind.slice(1)}`;
    const sort = space ? say`${named}, in space` : named;
    const made = !memoised
        ? say`${sort}; expanded in full.`
        : blocks <= 1
          ? `${sort}.`
          : counted(blocks, '{1}; drawn from {} reusable part.', '{1}; drawn from {} reusable parts.', sort);
    return [made, ...limit].join(' ');
}

/** @param {HTMLButtonElement} element @param {Report} report @param {'symbols' | 'segments'} kind */
function showCount(element, report, kind) {
    const digits = report[kind];
    const long = digits !== null && short(digits).exponent !== null;
    element.disabled = !long;
    element.title = !long
        ? ''
        : kind === 'symbols'
          ? say`Show all digits of the number of symbols`
          : say`Show all digits of the number of segments`;
    // Before the first picture the count may still come; afterwards it is unknown.
    if (digits === null) return setText(element, report.memoised === null ? '…' : '–');
    const { mantissa, exponent } = short(digits);
    if (exponent === null) return setText(element, mantissa);
    if (element.getAttribute('data-digits') === digits && element.childElementCount > 0) return;
    element.setAttribute('data-digits', digits);
    element.replaceChildren(`${mantissa} × 10`, make('sup', {}, String(exponent)));
}

/** @param {Report} report @param {'symbols' | 'segments' | null} kind */
function showDigits(report, kind) {
    const digits = kind && report[kind];
    const frame = html('digits');
    const shown = Boolean(digits && short(digits).exponent !== null);
    frame.hidden = !shown;
    for (const each of /** @type {const} */ (['symbols', 'segments']))
        button(each).setAttribute('aria-expanded', String(shown && each === kind));
    if (!shown || !digits) return;
    const [number, all] = [Number(digits), grouped(digits)];
    setText(
        frame,
        kind === 'symbols'
            ? counted(number, '{1} symbol', '{1} symbols', all)
            : counted(number, '{1} segment', '{1} segments', all),
    );
}

/** Draws the angle beside its label. @param {number} degrees */
function showAnglePicture(degrees) {
    const picture = byId('angle-picture', SVGSVGElement);
    const turn = ((degrees % 360) + 360) % 360;
    const [x, y] = [Math.cos((turn * Math.PI) / 180), -Math.sin((turn * Math.PI) / 180)];
    const at = (/** @type {number} */ radius) => `${(x * radius).toFixed(2)} ${(y * radius).toFixed(2)}`;
    picture.querySelector('.hand')?.setAttribute('d', `M0 0L${at(10)}`);
    picture.querySelector('.arc')?.setAttribute('d', turn === 0 ? '' : `M6 0A6 6 0 ${turn > 180 ? 1 : 0} 0 ${at(6)}`);
}

/**
 * The text under the title of the caption.
 * @param {import('../state/state.js').State} state
 * @param {Report} report
 */
export function captionOf({ iterations, angle, rightAngle }, { segments }) {
    const [left, right] = [angle, rightAngle ?? angle].map((turn) => `${marked(plain(turn))}°`);
    const turns = rightAngle === null ? left : say`${String(left)} and ${String(right)}`;
    const size =
        segments === null ? [] : [counted(Number(segments), '{1} segment', '{1} segments', shortText(segments))];
    return [`n = ${iterations}`, turns, ...size].join(', ');
}
