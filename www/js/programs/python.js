/** What runs programs in Python: the files of the interpreter, and the harness around a program. */

/** The interpreter's files: names here, names in the package `pyodide`, and their bytes. */
export const FILES = /** @type {const} */ ([
    ['core', 'pyodide.asm.mjs', 1_250_344],
    ['loader', 'pyodide.mjs', 17_931],
    ['library', 'python_stdlib.zip', 2_545_637],
    ['wasm', 'pyodide.asm.wasm', 9_598_218],
]);

/** What the interpreter wants to know of packages: its own versions, and that there are none. */
export const LOCK = { abi_version: '2026_0', arch: 'wasm32', platform: 'emscripten_5_0_3', python: '3.14.2' };

/** Runs a program and calls, as `worker.js` does for JavaScript: a message for each call. */
export const HARNESS = `
import sys, json, time
class _Out:
    text = ""
    def write(self, words):
        self.text += words
        if len(self.text) > 65536:
            self.text = self.text[:65536]
            raise OverflowError("printed too much")
        return len(words)
    def flush(self):
        pass
def _fault(error):
    line = None
    if isinstance(error, SyntaxError) and error.filename == "answer.py":
        line = error.lineno
    else:
        trace = error.__traceback__
        while trace:
            if trace.tb_frame.f_code.co_filename == "answer.py":
                line = trace.tb_lineno
            trace = trace.tb_next
    return {"type": type(error).__name__, "message": str(getattr(error, "msg", None) or error)[:500], "line": line}
def _run(request, tell):
    asked = json.loads(request)
    out = sys.stdout = sys.stderr = _Out()
    sys.setrecursionlimit(900)
    def post(**message):
        message["printed"], out.text = out.text, ""
        text = json.dumps(message, default=repr)
        tell(text)
    scope = {"__name__": "answer"}
    exec(compile(asked["given"], "given", "exec"), scope)
    former = dict(scope)
    start = time.perf_counter()
    try:
        exec(compile(asked["code"], "answer.py", "exec"), scope)
    except BaseException as error:
        return post(at=-1, fault=_fault(error), ms=0)
    own = [name for name in asked["names"] if callable(scope.get(name)) and scope[name] is not former.get(name)]
    post(at=-1, own=own, ms=1000 * (time.perf_counter() - start))
    results = {}
    for at, call in enumerate(asked["calls"]):
        quiet = call.get("quiet")
        given = [results.get(arg["result"]) if isinstance(arg, dict) and "result" in arg else arg for arg in call["args"]]
        before = "" if quiet else json.dumps(given, default=repr)
        start = time.perf_counter()
        try:
            value = scope[call["name"]](*given)
            ms = 1000 * (time.perf_counter() - start)
            results[at] = value
            text = str(len(value)) if quiet else json.dumps(_plain(value))
            if len(text) > 8000000:
                raise OverflowError("the result is too large")
            changed = not quiet and json.dumps(given, default=repr) != before
            post(at=at, value=text, nothing=value is None, ms=ms, changed=changed)
        except BaseException as error:
            post(at=at, fault=_fault(error), ms=1000 * (time.perf_counter() - start), changed=False)
    tell('{"done": true}')
def _plain(value):
    if isinstance(value, (list, tuple)):
        return [_plain(one) for one in value]
    if isinstance(value, float) and (value != value or value in (float("inf"), float("-inf"))):
        return str(value)
    if value is None or isinstance(value, (str, bool, int, float, dict)):
        return value
    raise TypeError("the result is of the type " + type(value).__name__)
_run`;
