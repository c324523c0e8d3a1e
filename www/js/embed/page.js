/** The page embed.html: the drawing in the address, with the controls that the address asks for. */

import { exerciseIn } from '../exercise/open.js';
import { openLink } from '../state/packed.js';
import { translatePage } from '../base/words.js';
import { createFrame } from './frame.js';
import { readOptions } from './options.js';

translatePage();
if (exerciseIn(location.hash) !== null || readOptions(location.hash).controls.includes('steps')) {
    location.replace(new URL(`exercise.html${location.hash}`, location.href));
    await new Promise(() => {});
}
createFrame({ link: await openLink(location.hash) });
