/** The worker for what few visits need. The build joins it with the generated glue. */

import { calls as course } from './calls/course.js';
import { calls as files } from './calls/export.js';
import { calls as films } from './calls/film.js';
import { calls as find } from './calls/find.js';
import { calls as notations } from './calls/import.js';
import { calls as inventions } from './calls/invent.js';
import { calls as sounds } from './calls/sound.js';
import { serve } from './tool.js';

serve({ ...course, ...files, ...films, ...find, ...inventions, ...notations, ...sounds });
