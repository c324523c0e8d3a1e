/** The worker for exercises and steps alone. The build joins it with the generated glue. */

import { calls as course } from './calls/course.js';
import { calls as study } from './calls/study.js';
import { serve } from './tool.js';

serve({ ...course, ...study });
