/**
 * A stand-in for the run-time of a learning system: it follows the calls of SCORM 1.2 and SCORM 2004, remembers what
 * breaks their rules, and has faults on demand. Tests also give its text to a page, so it uses nothing outside itself.
 */

/**
 * `isSilent`: calls answer nothing. `refuses`: so many commits are refused. `throws`: values and commits throw.
 * `quota`: the longest state that is kept, in characters; `cuts`: longer states are cut without a word. `forgets`: what
 * is kept is gone at the next visit. `kept`: from an earlier visit.
 * @typedef {{isSilent: boolean, refuses: number, throws: boolean, quota: number, cuts: number, kept: Record<string, string>}} Faults
 */

/**
 * @param {'1.2' | '2004'} standard
 * @param {Partial<Faults>} faults
 */
export function createStandIn(standard, { isSilent = false, refuses = 0, throws = false, quota, cuts, kept = {} }) {
    const is2004 = standard === '2004';
    const core = is2004 ? 'cmi.' : 'cmi.core.';
    /** Elements that are read, with their first values; others are write-only or unknown. @type {Record<string, string>} */
    const FIRST = is2004
        ? {
              'cmi.completion_status': 'unknown',
              'cmi.success_status': 'unknown',
              'cmi.learner_id': 'student-1',
              'cmi.learner_name': 'Muster, Anna',
              'cmi.entry': 'ab-initio',
              'cmi.mode': 'normal',
              'cmi.suspend_data': '',
              'cmi.score.raw': '',
              'cmi.score.min': '',
              'cmi.score.max': '',
              'cmi.score.scaled': '',
          }
        : {
              'cmi.core.lesson_status': 'not attempted',
              'cmi.core.student_id': 'student-1',
              'cmi.core.student_name': 'Muster, Anna',
              'cmi.core.entry': 'ab-initio',
              'cmi.core.lesson_mode': 'normal',
              'cmi.suspend_data': '',
              'cmi.core.score.raw': '',
              'cmi.core.score.min': '',
              'cmi.core.score.max': '',
          };
    const decimal = /^-?\d{1,7}(\.\d{1,7})?$/;
    /** What may be written, with the form of the values. @type {[RegExp, RegExp][]} */
    const WRITTEN = is2004
        ? [
              [/^cmi\.completion_status$/, /^(completed|incomplete|not attempted|unknown)$/],
              [/^cmi\.success_status$/, /^(passed|failed|unknown)$/],
              [/^cmi\.score\.(raw|min|max)$/, decimal],
              [/^cmi\.score\.scaled$/, /^(-?0(\.\d{1,7})?|-?1)$/],
              [/^cmi\.session_time$/, /^P(?=.)(\d+D)?(T(?=.)(\d+H)?(\d+M)?(\d+(\.\d{1,2})?S)?)?$/],
              [/^cmi\.exit$/, /^(|time-out|suspend|logout|normal)$/],
              [/^cmi\.suspend_data$/, /^[^]{0,64000}$/],
              [/^cmi\.interactions\.\d+\.id$/, /^\S{1,4000}$/],
              [/^cmi\.interactions\.\d+\.type$/, /^long-fill-in$/],
              [/^cmi\.interactions\.\d+\.learner_response$/, /^.{0,4000}$/],
              [/^cmi\.interactions\.\d+\.result$/, /^(correct|incorrect|unanticipated|neutral)$/],
          ]
        : [
              [/^cmi\.core\.lesson_status$/, /^(passed|completed|failed|incomplete|browsed)$/],
              [/^cmi\.core\.score\.(raw|min|max)$/, /^(100|\d{1,2})(\.\d{1,2})?$/],
              [/^cmi\.core\.session_time$/, /^\d{2,4}:[0-5]\d:[0-5]\d(\.\d{1,2})?$/],
              [/^cmi\.core\.exit$/, /^(|time-out|suspend|logout)$/],
              [/^cmi\.suspend_data$/, /^[^]{0,4096}$/],
              [/^cmi\.interactions\.\d+\.id$/, /^[!-~]{1,255}$/],
              [/^cmi\.interactions\.\d+\.type$/, /^fill-in$/],
              [/^cmi\.interactions\.\d+\.student_response$/, /^.{0,255}$/],
              [/^cmi\.interactions\.\d+\.result$/, /^(correct|wrong|unanticipated|neutral)$/],
          ];
    /** @type {string[]} */
    const wrong = [];
    const system = {
        name: is2004 ? 'API_1484_11' : 'API',
        /** @type {Record<string, (...given: string[]) => string | undefined>} */
        api: {},
        kept: { ...FIRST, ...kept },
        /** The values at the last commit. @type {Record<string, string>} */
        stored: {},
        /** @type {'new' | 'open' | 'ended'} */
        state: 'new',
        commits: 0,
        /** What broke the standard's rules. */
        wrong,
    };
    let error = '0';
    /** @param {string} code @param {string} why */
    function fail(code, why) {
        error = code;
        wrong.push(why);
        return 'false';
    }
    const done = () => {
        error = '0';
        return 'true';
    };
    const calls = {
        Initialize() {
            if (system.state === 'open') {
                error = is2004 ? '103' : '101';
                return 'false';
            }
            system.state = 'open';
            return done();
        },
        Terminate() {
            if (system.state !== 'open') return fail(is2004 ? '112' : '301', 'ended without a beginning');
            system.state = 'ended';
            system.stored = { ...system.kept };
            return done();
        },
        /** @param {string} element */
        GetValue(element) {
            if (system.state !== 'open')
                return fail(is2004 ? '122' : '301', `${element} read outside of a visit`) && '';
            if (!(element in FIRST)) return fail(is2004 ? '401' : '201', `${element} is not read`) && '';
            error = '0';
            return system.kept[element] ?? '';
        },
        /** @param {string} element @param {string} value */
        SetValue(element, value) {
            if (throws) throw new Error('the learning system has crashed');
            if (system.state !== 'open') return fail(is2004 ? '132' : '301', `${element} written outside of a visit`);
            if (typeof value !== 'string') return fail(is2004 ? '406' : '405', `${element} is no text`);
            const form = WRITTEN.find(([name]) => name.test(element))?.[1];
            if (!form) return fail(is2004 ? '401' : '201', `${element} is not written`);
            if (!form.test(value)) return fail(is2004 ? '406' : '405', `${element} = ${value}`);
            const at = /^cmi\.interactions\.(\d+)\./.exec(element)?.[1];
            if (at !== undefined && Number(at) > 0 && !(`cmi.interactions.${Number(at) - 1}.id` in system.kept))
                return fail(is2004 ? '351' : '201', `${element} leaves a gap`);
            const isState = element === 'cmi.suspend_data';
            if (isState && quota !== undefined && value.length > quota) {
                error = '101';
                return 'false';
            }
            system.kept[element] = isState && cuts !== undefined ? value.slice(0, cuts) : value;
            return done();
        },
        Commit() {
            if (throws) throw new Error('the learning system has crashed');
            if (system.state !== 'open') return fail(is2004 ? '142' : '301', 'committed outside of a visit');
            system.commits += 1;
            if (system.commits <= refuses) {
                error = is2004 ? '391' : '101';
                return 'false';
            }
            system.stored = { ...system.kept };
            return done();
        },
        GetLastError: () => error,
        /** @param {string} code */
        GetErrorString: (code) => (code === '0' ? 'No error' : 'General exception'),
        GetDiagnostic: () => '',
    };
    for (const [name, answer] of Object.entries(calls)) {
        const called = is2004 ? name : `LMS${name === 'Terminate' ? 'Finish' : name}`;
        system.api[called] = (/** @type {string[]} */ ...given) =>
            isSilent ? undefined : /** @type {any} */ (answer)(...given);
    }
    // Another visit goes on with what was kept.
    if (kept['cmi.suspend_data']) system.kept[`${core}entry`] = 'resume';
    return system;
}
