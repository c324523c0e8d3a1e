// Run by `cargo xtask test` in an empty project with the packed package: node --test test.mjs
import assert from 'node:assert/strict';
import { execFile, execFileSync } from 'node:child_process';
import { existsSync, readFileSync, writeFileSync } from 'node:fs';
import { createServer } from 'node:http';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { promisify } from 'node:util';
import * as lsystem from 'lsystem';
import { check, count, draw, expand, file, LSystemError, png, read, segments, svg, symbols } from 'lsystem';

const path = (name) => fileURLToPath(new URL(`node_modules/lsystem/${name}`, import.meta.url));

/** The error of a call, which must be one of the library. */
function refusal(call) {
    try {
        call();
    } catch (error) {
        assert.ok(error instanceof LSystemError && error instanceof Error, String(error));
        return error;
    }
    throw new Error('nothing was thrown');
}

const plant = { axiom: 'X', rules: 'X -> F[+X][-X]FX\nF -> FF', angle: 25.7, iterations: 2 };

test('strings are derived as published', () => {
    assert.equal(expand({ axiom: 'A', rules: 'A -> AB\nB -> A' }, 5), 'ABAABABAABAAB');
    assert.equal(expand(plant, 0), 'X');
    assert.equal(expand(plant, 1), 'F[+X][-X]FX');
    assert.equal(expand(plant), 'FF[+F[+X][-X]FX][-F[+X][-X]FX]FFF[+X][-X]FX');
    assert.equal(expand(plant, 7).length, 12_863);
});

test('segments are drawn', () => {
    const { dimension, segments, colours, levels } = draw({ axiom: 'F[+F]', rules: 'F -> F', angle: 90 }, 0);
    assert.equal(dimension, 2);
    assert.deepEqual(
        [...segments].map((v) => Math.round(v * 1e6) / 1e6 + 0),
        [0, 0, 0, 1, 0, 1, -1, 1],
    );
    assert.deepEqual(
        [[...colours], [...levels]],
        [
            [0, 0],
            [0, 1],
        ],
    );
    const koch = { axiom: 'F', rules: 'F -> F+F--F+F', angle: 60 };
    assert.equal(draw(koch, 6).levels.length, 4 ** 6);
    const drawn = draw({ axiom: 'f+[f]-f', dialect: 'lowercase', angle: 90 }, 0);
    // One segment up; one to the left in a branch, in red; one up again after `-`, in green.
    assert.deepEqual([...drawn.segments], [0, 0, 0, 1, 0, 1, -1, 1, 0, 1, 0, 2]);
    assert.deepEqual(
        [[...drawn.colours], [...drawn.levels]],
        [
            [0, 1, 2],
            [0, 1, 0],
        ],
    );
    assert.equal(draw(plant, 5).segments.length, 4 * 422);
});

test('drawings in space have three coordinates', () => {
    const { dimension, segments: numbers, levels } = draw({ axiom: 'F&F', angle: 90, iterations: 0 });
    assert.deepEqual([dimension, numbers.length, levels.length], [3, 12, 2]);
    assert.ok(Math.abs(numbers[11]) > 0.999, String(numbers));
    const [first, second] = segments({ axiom: 'F&F', angle: 90, iterations: 0 });
    assert.deepEqual(first, { from: [0, 0, 0], to: [0, 1, 0], colour: 0, level: 0 });
    assert.equal(second.to.length, 3);
});

test('a system has its own number of iterations', () => {
    for (const n of [2.5, -1, 1001, Number.NaN, '3', null, {}]) {
        const error = refusal(() => expand(plant, n));
        assert.match(error.message, /Iterations must be a whole number from 0 to 1,000/);
        assert.equal(error.diagnostics[0].severity, 'error');
    }
    assert.equal(draw(plant).levels.length, draw(plant, 2).levels.length);
    assert.match(refusal(() => draw({ ...plant, iterations: 2.5 })).message, /`iterations` must be a whole number/);
});

test('rules are read in all forms of files', () => {
    const rules = [{ F: 'FF' }, new Map([['F', 'FF']]), ['F -> FF'], 'F -> FF', { F: [{ p: 1, e: 'FF' }] }];
    for (const each of rules) assert.equal(expand({ axiom: 'F', rules: each }, 3), 'FFFFFFFF');
    assert.equal(draw({ axiom: 'GF', overrides: { G: 'move' } }, 0).levels.length, 1);
    const saved = { initial: 'F', rules: { F: 'F+F' }, angle_deg: 90, num_iters: 2, author: 'somebody' };
    assert.equal(expand(saved), 'F+F+F+F');
    assert.equal(expand(saved, 1), 'F+F');
    assert.deepEqual([...draw({ axiom: 'F', start: new Float64Array([2, 0]) }, 0).segments], [2, 0, 2, 1]);
    assert.equal(expand({ ...plant, seed: 7n, rightAngle: null, heading: undefined }), expand(plant));
});

test('wrong systems throw readable errors', () => {
    const unknown = refusal(() => draw({ axiom: 'F', angel: 60 }));
    assert.equal(
        `${unknown}`,
        [
            'LSystemError: Unknown key `angel`',
            ' --> system:3:3',
            '  |',
            '3 |   "angel": 60',
            '  |   ^^^^^^^',
            '  = help: Did you mean `angle`?',
        ].join('\n'),
    );
    assert.equal(unknown.diagnostics[0].hint, 'Did you mean `angle`?');
    const lines = (system) => refusal(() => expand(system)).message;
    assert.match(lines({ axiom: 'F', productions: { F: 'FF' } }), /`productions`[^]*`rules`/);
    assert.match(lines({ axiom: 'F', rules: 7 }), /`rules` must be an object or a list of lines, not a number/);
    assert.match(lines({ axiom: 'F', rules: () => 'FF' }), /constant|arrow|rule/i);
    assert.match(lines({ axiom: 'F', angle: Number.NaN }), /`angle` must be a number, not a string/);
    for (const wrong of [undefined, null, 3, 'F', []]) assert.match(lines(wrong), /must hold an object/);
    const { diagnostics } = refusal(() => expand({ axiom: 'F', rules: 'F FF' }, 1));
    assert.deepEqual([diagnostics[0].severity, diagnostics[0].field], ['error', 'rules']);
    // The emoji has two UTF-16 units and four bytes.
    const [error] = refusal(() => expand({ axiom: 'F', rules: '// 🌿\nF = FF' }, 1)).diagnostics;
    assert.ok(6 <= error.start && error.start < error.end && error.end <= 12 && error.hint.includes('->'));
    assert.match(refusal(() => expand(plant, 1000)).message, /67,108,864/);
    assert.ok(refusal(() => draw({ axiom: 'F', rules: 'F -> FF' }, 100)).diagnostics.length > 0);
});

test('warnings are readable', () => {
    const [warning] = check({ axiom: 'F]', rules: 'F -> FF' });
    assert.equal(warning.severity, 'warning');
    assert.match(warning.text, /^warning: [^]*axiom:1:2[^]*\^/);
    assert.deepEqual(check(plant), []);
    assert.equal(check({ axiom: 'F', angel: 1 })[0].severity, 'error');
    assert.match(check('{"initial": "F", "moon": 1}')[0].message, /`moon`/);
    assert.equal(check('no file')[0].severity, 'error');
});

test('counts are big integers', () => {
    assert.deepEqual(count({ axiom: 'F', rules: 'F -> F[+F]F' }, 100).segments, 3n ** 100n);
    assert.deepEqual(count(plant), { symbols: BigInt(expand(plant).length), segments: 10n });
});

test('long strings and drawings are read one by one', () => {
    assert.equal([...symbols(plant, 7)].join(''), expand(plant, 7));
    const tree = { axiom: 'A(1)', rules: 'A(l) -> F(l)[+A(l*0.5)]', iterations: 1 };
    assert.deepEqual([...symbols(tree)], ['F(1)', '[', '+', 'A(0.5)', ']']);
    const endless = symbols({ axiom: 'F', rules: 'F -> F[+F]F', iterations: 1000 });
    let first = '';
    for (const symbol of endless) {
        first += symbol;
        if (first.length === 100_000) break;
    }
    assert.ok(first.startsWith('F[+F]F[+F[+F]F]F[+F]F'));
    const { segments: numbers, colours, levels } = draw(plant, 7);
    let at = 0;
    for (const { from, to, colour, level } of segments(plant, 7)) {
        const ends = [...from, ...to];
        assert.ok(ends.every((v, i) => Math.abs(v - numbers[4 * at + i]) < 1e-3));
        assert.deepEqual([colour, level], [colours[at], levels[at]]);
        at += 1;
    }
    assert.equal(at, levels.length);
    assert.match(refusal(() => symbols({ axiom: 'F', rules: 'F -> FF : 1\nF -> F : 1' }, 100)).message, /memory|MiB/i);
});

test('a seed decides a stochastic system', () => {
    const system = (seed) => ({ axiom: 'F', rules: 'F -> F[+F]F : 0.5\nF -> F[-F] : 0.5', seed });
    assert.equal(expand(system(1), 6), expand(system(1), 6));
    assert.notEqual(expand(system(1), 6), expand(system(2), 6));
});

test('files are made and read back', () => {
    const picture = svg(plant, { n: 4 });
    assert.match(picture, /^<svg [^]*<\/svg>\s*$/);
    assert.deepEqual([read(picture).rules, read(picture).iterations], [plant.rules, 4]);
    const pixels = png(plant, { size: [64, 48] });
    assert.deepEqual([...pixels.slice(1, 4)].map((byte) => String.fromCharCode(byte)).join(''), 'PNG');
    assert.deepEqual([...pixels.slice(16, 24)], [0, 0, 0, 64, 0, 0, 0, 48]);
    assert.equal(expand(read(pixels)), expand(plant));
    assert.equal(expand(read(file(plant, 'json'))), expand(plant));
    assert.equal(String.fromCharCode(...file({ axiom: 'F&F' }, 'glb').slice(0, 4)), 'glTF');
    assert.ok(!svg(plant, { bare: true }).includes('F[+X]'));
    assert.equal(refusal(() => png(plant, { dip: 3 })).message, 'png has no option `dip`: did you mean `dpi`?');
    assert.match(refusal(() => file(plant, 'jpeg')).message, /no format `jpeg`; known are svg, /);
    const camera = (camera) => () => png({ axiom: 'F[&F]', angle: 60 }, { camera, transparent: undefined });
    assert.notDeepEqual(camera({ azimuth: 90 })(), camera({ azimuth: 0 })());
    assert.match(refusal(camera({ azimut: 90 })).message, /did you mean `azimuth`/);
    assert.equal(refusal(camera(7)).message, 'camera must be an object');
    assert.match(refusal(() => png(plant, { size: {} })).message, /size: expected a width and a height/);
    assert.match(refusal(() => read('{}')).message, /keys `initial` and `rules`/);
});

test('the package has what its list names', () => {
    const { exports, version } = JSON.parse(readFileSync(path('package.json'), 'utf8'));
    for (const name of Object.values(exports).flatMap((entry) =>
        typeof entry === 'string' ? entry : Object.values(entry),
    )) {
        assert.ok(readFileSync(path(name)).length > 0, name);
    }
    assert.match(version, /^[1-9]|^0\.[1-9]/);
    assert.ok(['fields.d.ts', 'library.js', 'notices.txt'].every((name) => existsSync(path(name))));
    assert.ok(!existsSync(path('test.mjs')));
    // Every export is declared, and nothing else is.
    const declared = [...readFileSync(path('index.d.ts'), 'utf8').matchAll(/^export (?:function|class) (\w+)/gm)];
    assert.deepEqual([...new Set(declared.map((match) => match[1]))].sort(), Object.keys(lsystem).sort());
});

test('the example draws a plant', () => {
    const svg = execFileSync(process.execPath, [path('examples/node.mjs')], {
        encoding: 'utf8',
        stdio: ['ignore', 'pipe', 'ignore'],
    });
    assert.match(svg, /^<svg [^]*<path /);
});

/** The first program of the README, which must end within ten lines. */
function firstProgram() {
    const lines = readFileSync(path('README.md'), 'utf8').split('\n').slice(0, 10);
    const [, program] = /```js\n([^]*?)\n```/.exec(lines.join('\n'));
    return program;
}

test("the README's first lines draw a plant in Node.js", () => {
    writeFileSync('plant.mjs', firstProgram());
    const picture = execFileSync(process.execPath, ['plant.mjs'], { encoding: 'utf8' });
    assert.match(picture, /^<svg [^]*<\/svg>\s*$/);
    assert.ok(picture.length > 10_000);
});

/** The elements of a page of the project, after its scripts have run. */
async function rendered(page, name = 'index.html') {
    const types = { js: 'text/javascript', wasm: 'application/wasm', html: 'text/html' };
    const server = createServer((request, response) => {
        const file = request.url.slice(1);
        response.setHeader('Content-Type', types[file.split('.').at(-1)] ?? 'text/plain');
        response.end(file === 'index.html' ? page : existsSync(file) ? readFileSync(file) : '');
    });
    await new Promise((ready) => server.listen(0, '127.0.0.1', ready));
    const address = `http://127.0.0.1:${server.address().port}/${name}`;
    const flags = ['--headless', '--no-sandbox', '--disable-gpu', '--virtual-time-budget=20000', '--dump-dom'];
    try {
        return (await promisify(execFile)(process.env.CHROMIUM, [...flags, address], { maxBuffer: 1 << 26 })).stdout;
    } finally {
        server.close();
    }
}

test("the README's first lines draw a plant in a page", async () => {
    const program = firstProgram().replace("from 'lsystem'", "from './node_modules/lsystem/index.js'");
    const page = `<!doctype html><title>Plant</title><body><script type="module">${program}</script>`;
    assert.match(await rendered(page), /<\/script>\s*<svg [^]*<path [^]*<\/svg>/);
});

test('scripts that are no modules have the functions, too', async () => {
    const call = "lsystem.ready.then(({ expand }) => document.write(expand({ axiom: 'F', rules: { F: 'F+F' } }, 2)))";
    const page = `<!doctype html><script src="node_modules/lsystem/global.js"></script><script>${call}</script>`;
    assert.match(await rendered(page), /F\+F\+F\+F/);
});

test('the notebook draws', async () => {
    const drawn = await rendered('', 'node_modules/lsystem/examples/notebook.html');
    assert.match(drawn, /25 degrees, \d{4,} segments/);
});
