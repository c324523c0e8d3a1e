/** The page as the program `lsys FILE` shows it: it follows the file, and saves into it. */

import assert from 'node:assert/strict';
import { spawn } from 'node:child_process';
import { once } from 'node:events';
import { mkdtemp, readFile, readdir, rename, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { createInterface } from 'node:readline';
import { after, before, test } from 'node:test';
import { fileURLToPath } from 'node:url';
import { close, nextPicture, picture, stillPicture, until, withPage } from './browser.mjs';

const PROGRAM = process.env.LSYS ?? fileURLToPath(new URL('../../../target/debug/lsys', import.meta.url));
const PAGE = fileURLToPath(new URL('../../../dist/playground.html', import.meta.url));

/** @typedef {import('playwright-core').Page} Page */

let folder = '';
let file = '';
let address = '';
/** @type {import('node:child_process').ChildProcess} */
let program;

/** A plant with other values. @param {object} values */
const plant = (values) =>
    JSON.stringify({
        name: 'p',
        initial: 'F',
        rules: ['F -> F[+F]F[-F]F'],
        angle_deg: 25,
        num_iters: 3,
        turtle: {},
        ...values,
    });

/** Saves as many editors do: a new file takes the place of the old one. @param {string} text */
async function edit(text) {
    await writeFile(`${file}~`, text);
    await rename(`${file}~`, file);
}

const read = async () => JSON.parse(await readFile(file, 'utf8'));

/** @param {Page} page @param {string} words */
const sign = (page, words) =>
    until(async () => (await page.textContent('#served-sign')) === words, `the sign “${words}”`);

before(async () => {
    folder = await mkdtemp(join(tmpdir(), 'lsys ü '));
    file = join(folder, 'plant_01.json');
    await writeFile(file, plant({}));
    program = spawn(PROGRAM, [file, '--no-browser', '--page', PAGE], { stdio: ['ignore', 'pipe', 'inherit'] });
    assert.ok(program.stdout);
    [address] = await once(createInterface(program.stdout), 'line');
});
after(async () => {
    program.kill();
    await close();
    await rm(folder, { recursive: true });
});

test('follows the file, shows its mistakes, and saves into it', () =>
    withPage({ address }, async (page) => {
        assert.match(address, /^http:\/\/127\.0\.0\.1:\d+\/[0-9a-f]{32}\/$/);
        await sign(page, 'saved');
        assert.equal(await page.inputValue('#angle'), '25');
        assert.ok(await page.isDisabled('#served-save'));

        const first = await stillPicture(page);
        await edit(plant({ angle_deg: 60 }));
        const second = await nextPicture(page, first);
        assert.equal(await page.inputValue('#angle'), '60');
        await sign(page, 'saved');

        await edit(plant({}).slice(0, -2));
        await sign(page, 'has an error');
        assert.match((await page.textContent('#served-words')) ?? '', /^error: .*\n +--> plant_01\.json:1:\d+/);
        assert.equal((await picture(page)).digest, second.digest);
        await edit(plant({ angle_deg: 20 }));
        await nextPicture(page, second);
        await sign(page, 'saved');
        assert.ok(await page.isHidden('#served-note'));

        // The drawing has the focus.
        await page.keyboard.press('ArrowUp');
        await page.keyboard.press('ArrowRight');
        await sign(page, 'not saved');
        assert.equal((await read()).num_iters, 3);
        await page.keyboard.press('Control+s');
        await sign(page, 'saved');
        const saved = await read();
        assert.deepEqual([saved.num_iters, saved.angle_deg, saved.rules], [4, 21, ['F -> F[+F]F[-F]F']]);
        assert.deepEqual(await readdir(folder), ['plant_01.json']);
        assert.ok(await page.isHidden('#save-dialog'));
    }));

test('a file that was changed on both sides is told, and nothing is lost', () =>
    withPage({ address }, async (page) => {
        await edit(plant({}));
        await sign(page, 'saved');
        await until(async () => (await page.inputValue('#angle')) === '25', 'the angle follows');
        await page.fill('#angle', '33');
        await sign(page, 'not saved');
        await edit(plant({ angle_deg: 70 }));
        await sign(page, 'conflict');
        assert.ok(await page.isDisabled('#served-save'));
        await page.keyboard.press('Control+s');
        assert.equal((await read()).angle_deg, 70);

        await page.click('#served-take');
        await sign(page, 'saved');
        assert.equal(await page.inputValue('#angle'), '70');
        await page.click('#undo');
        assert.equal(await page.inputValue('#angle'), '33');
        await sign(page, 'not saved');

        await edit(plant({ angle_deg: 71 }));
        await sign(page, 'conflict');
        await page.click('#served-replace');
        await sign(page, 'saved');
        assert.equal((await read()).angle_deg, 33);
    }));

test('changes of different fields go together', () =>
    withPage({ address }, async (page) => {
        await edit(plant({}));
        await until(async () => (await page.inputValue('#angle')) === '25', 'the angle follows');
        await page.fill('#angle', '33');
        await sign(page, 'not saved');
        await edit(plant({ num_iters: 2, author: 'Ada' }));
        await until(async () => (await page.inputValue('#iterations')) === '2', 'the iterations follow');
        await sign(page, 'not saved');
        await page.keyboard.press('Control+s');
        await sign(page, 'saved');
        assert.equal(await readFile(file, 'utf8'), plant({ num_iters: 2, angle_deg: 33, author: 'Ada' }));
    }));

test('what cannot be edited is told first, and a copy stays', () =>
    withPage({ address, expected: /Failed to load resource/ }, async (page) => {
        const text = '{"initial": "F", "num_iters": 1, "rules": {"F": [{"p": 1, /* one */ "e": "FF"}]}}';
        await edit(text);
        await until(async () => (await page.inputValue('#iterations')) === '1', 'the iterations follow');
        await page.fill('#rules', 'F -> F(2)');
        await sign(page, 'not saved');
        await page.click('#served-save');
        await until(() => page.isVisible('#served-replace'), 'the question');
        assert.match((await page.textContent('#served-words')) ?? '', /A copy of the former file stays/);
        assert.equal(await readFile(file, 'utf8'), text);
        await page.click('#served-replace');
        await sign(page, 'saved');
        assert.equal(await readFile(`${file}.before-1`, 'utf8'), text);
        assert.match(await readFile(file, 'utf8'), /F\(2\)/);
        await rm(`${file}.before-1`);
    }));

test('a reload keeps changes that are not saved, and a removed file is told', () =>
    withPage({ address }, async (page) => {
        await edit(plant({}));
        await until(async () => (await page.inputValue('#angle')) === '25', 'the angle follows');
        await page.fill('#angle', '44');
        await sign(page, 'not saved');
        await until(() => page.url().includes('angle=44'), 'the address follows');
        await page.reload();
        await sign(page, 'not saved');
        assert.equal(await page.inputValue('#angle'), '44');

        await rm(file);
        await sign(page, 'has an error');
        assert.equal(await page.textContent('#served-words'), 'plant_01.json is not there any more.');
        await page.click('#served-replace');
        await sign(page, 'saved');
        assert.equal((await read()).angle_deg, 44);
    }));

test('the page says when the program has ended', () =>
    withPage({ address, expected: /Failed to load resource/ }, async (page) => {
        await sign(page, 'saved');
        program.kill('SIGINT');
        await sign(page, 'not connected');
        assert.deepEqual(await readdir(folder), ['plant_01.json']);
    }));
