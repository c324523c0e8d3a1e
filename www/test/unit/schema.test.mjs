import assert from 'node:assert/strict';
import { readFileSync, readdirSync } from 'node:fs';
import { test } from 'node:test';
import { Ajv } from 'ajv';

const root = new URL('../../', import.meta.url);
/** @param {string} name */
const read = (name) => JSON.parse(readFileSync(new URL(name, root), 'utf8'));
const isRight = new Ajv({ strict: true, strictRequired: false, allErrors: true }).compile(
    read('schema/v1/system.json'),
);

test('the schema accepts every file of the gallery', () => {
    const names = readdirSync(new URL('../data_in', root), { recursive: true, encoding: 'utf8' });
    const files = names.filter((name) => name.endsWith('.json'));
    assert.ok(files.length > 40);
    for (const name of files)
        assert.ok(isRight(read(`../data_in/${name}`)), `${name}: ${JSON.stringify(isRight.errors)}`);
});

test('the schema accepts right files and refuses wrong ones', () => {
    const { right, wrong } = read('test/unit/schema-files.json');
    assert.ok(right.length > 10 && wrong.length > 20);
    for (const { why, file } of right) assert.ok(isRight(file), `${why}: ${JSON.stringify(isRight.errors)}`);
    for (const { why, file } of wrong) assert.ok(!isRight(file), why);
});
