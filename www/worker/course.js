/** The worker for exercises alone. The build joins it with the generated glue. */

import { calls } from './calls/course.js';
import { serve } from './tool.js';

serve(calls);
