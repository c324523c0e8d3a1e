/** The worker for films alone. The build joins it with the generated glue. */

import { calls } from './calls/film.js';
import { serve } from './tool.js';

serve(calls);
