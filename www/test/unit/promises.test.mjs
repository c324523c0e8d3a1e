/** What `docs/security.md` promises is held by tests that exist. */

import assert from 'node:assert/strict';
import { existsSync, readFileSync, readdirSync } from 'node:fs';
import { test } from 'node:test';
import { fileURLToPath } from 'node:url';

const ROOT = fileURLToPath(new URL('../../../', import.meta.url));
const read = (/** @type {string} */ path) => readFileSync(ROOT + path, 'utf8');
/** The folders of tests that the document names files of. */
const FOLDERS = ['', 'crates/lsys/tests/', 'www/test/unit/'];
const RUST = ['crates/lsys/tests', 'crates/lsystem-files/tests']
    .flatMap((folder) => readdirSync(ROOT + folder).map((name) => `${folder}/${name}`))
    .filter((path) => path.endsWith('.rs'))
    .map(read)
    .join('');

test('each promise has a test, and each named test exists', () => {
    const table = read('docs/security.md').split('| promise | test |')[1]?.split('\n\n')[0] ?? '';
    const rows = table.split('\n').slice(2);
    assert.ok(rows.length > 10);
    for (const row of rows) {
        const names = [...row.matchAll(/`([^`]+)`/g)].map(([, name = '']) => name);
        assert.ok(names.length > 0, row);
        for (const name of names) {
            const [, target] = /^cargo xtask fuzz ([\w-]+)$/.exec(name) ?? [];
            if (target) assert.ok(read('crates/fuzz/src/target.rs').includes(`target("${target}"`), name);
            else if (/^[a-z]+(_[a-z]+)+$/.test(name)) assert.match(RUST, new RegExp(`fn ${name}\\(`), name);
            else if (name !== 'cargo xtask test --thorough')
                assert.ok(
                    FOLDERS.some((folder) => existsSync(ROOT + folder + name)),
                    name,
                );
        }
    }
});
