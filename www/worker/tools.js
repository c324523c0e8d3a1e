/** The worker for what few visits need. The build joins it with the generated glue. */

import { calls as classes } from './calls/class.js';
import { calls as course } from './calls/course.js';
import { calls as files } from './calls/export.js';
import { calls as films } from './calls/film.js';
import { calls as find } from './calls/find.js';
import { calls as readers } from './calls/import.js';
import { calls as inventions } from './calls/invent.js';
import { calls as packages } from './calls/package.js';
import { calls as pictures } from './calls/picture.js';
import { calls as sounds } from './calls/sound.js';
import { calls as study } from './calls/study.js';
import { calls as writers } from './calls/write.js';
import { serve } from './tool.js';

serve({
    ...classes,
    ...course,
    ...files,
    ...films,
    ...find,
    ...inventions,
    ...packages,
    ...pictures,
    ...readers,
    ...sounds,
    ...study,
    ...writers,
});
