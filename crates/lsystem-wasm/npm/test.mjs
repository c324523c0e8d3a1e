// Run by `cargo xtask test` beside the package: node --test test.mjs
import assert from 'node:assert/strict';
import { execFileSync } from 'node:child_process';
import { readFileSync } from 'node:fs';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { draw, expand } from 'lsystem';

test('strings are derived', () => {
    assert.equal(expand({ axiom: 'A', rules: 'A -> AB\nB -> A' }, 5), 'ABAABABAABAAB');
});

test('segments are drawn', () => {
    const { segments, colours, levels } = draw({ axiom: 'F[+F]', rules: 'F -> F', angle: 90 }, 0);
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
});

test('errors are values', () => {
    assert.throws(
        () => expand({ axiom: 'F', rules: 'F FF' }, 1),
        ({ diagnostics }) => {
            assert.equal(diagnostics[0].severity, 'error');
            assert.equal(diagnostics[0].field, 'rules');
            return true;
        },
    );
    assert.throws(
        () => draw({ axiom: 'F', rules: 'F -> FF' }, 100),
        ({ diagnostics }) => diagnostics.length > 0,
    );
});

test('the package has what its list names', () => {
    const path = (name) => fileURLToPath(new URL(`node_modules/lsystem/${name}`, import.meta.url));
    const { exports, version } = JSON.parse(readFileSync(path('package.json'), 'utf8'));
    for (const name of Object.values(exports).flatMap((entry) =>
        typeof entry === 'string' ? entry : Object.values(entry),
    )) {
        assert.ok(readFileSync(path(name)).length > 0, name);
    }
    assert.match(version, /^[1-9]|^0\.[1-9]/);
});

test('the example draws a plant', () => {
    const example = fileURLToPath(new URL('node_modules/lsystem/examples/node.mjs', import.meta.url));
    const svg = execFileSync(process.execPath, [example], { encoding: 'utf8', stdio: ['ignore', 'pipe', 'ignore'] });
    assert.match(svg, /^<svg .*<path d="M0 0L/);
});
