/**
 * The parts of the page that load with the first of them, most of them dialogs: a row for each. Each script brings its
 * own elements and styles. Its function gets the page once, and returns how to open the part.
 */

import { createBreed, createSeeds } from './dialogs/breed.js';
import { createCheck } from './course/check.js';
import { createMaker } from './course/maker.js';
import { createMarks } from './course/marks.js';
import { createMathematics } from './course/mathematics.js';
import { createCurves } from './curves/curves.js';
import { createFavourites } from './favourites/dialog.js';
import { createFileOpening } from './dialogs/file-opening.js';
import { createFilms } from './film/films.js';
import { createFinding } from './find/finding.js';
import { createGallery } from './dialogs/gallery.js';
import { createImporting } from './dialogs/importing.js';
import { createKeeping } from './dialogs/keeping.js';
import { createLeaves } from './dialogs/leaves.js';
import { createProjector } from './dialogs/projector.js';
import { createSave } from './save/save.js';
import { createShare } from './dialogs/share.js';
import { createShared } from './dialogs/shared.js';
import { createShortcuts } from './dialogs/shortcuts.js';
import { createStepsDialog } from './steps/dialog.js';
import { createSound } from './motion/sound.js';
import { createSurprise } from './dialogs/surprise.js';

export const PARTS = {
    gallery: createGallery,
    breed: createBreed,
    seeds: createSeeds,
    surprise: createSurprise,
    leaves: createLeaves,
    steps: createStepsDialog,
    mathematics: createMathematics,
    save: createSave,
    share: createShare,
    shared: createShared,
    favourites: createFavourites,
    file: createFileOpening,
    film: createFilms,
    find: createFinding,
    import: createImporting,
    curves: createCurves,
    maker: createMaker,
    check: createCheck,
    marks: createMarks,
    shortcuts: createShortcuts,
    projector: createProjector,
    sound: createSound,
    offline: createKeeping,
};
