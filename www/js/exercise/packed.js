/** A page of exercises in a package for learning systems. */

import { createPackage } from './package.js';
import { createSteps } from './steps.js';

const { package: id = '', scorm } = document.documentElement.dataset;
/** @type {ReturnType<typeof createPackage> | null} */
let packed = null;
const steps = createSteps(({ at }) => packed?.moved(at));
packed = createPackage({
    id,
    standard: scorm === '2004' ? '2004' : '1.2',
    tasks: steps.tasks,
    above: /** @type {Element} */ (steps.first),
    restored: (at, done) => steps.restore({ at, done: done.map((number) => steps.places[number] ?? 0) }),
});
steps.begin();
