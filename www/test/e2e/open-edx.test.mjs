/** Packages in a real learning system, Open edX: from launch to gradebook, in one window and in two. */

import assert from 'node:assert/strict';
import { mkdtemp, rm } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, test } from 'node:test';
import { some } from '../effort.mjs';
import { withCourse } from '../open-edx/start.mjs';
import { close, until, withPage } from './browser.mjs';

/** @typedef {import('playwright-core').Page} Page */

after(close);

/** Exercises of the gallery, and what solves them. */
const TITLES = ['Koch snowflake', 'A weed'];
const [KOCH, WEED] = ['F -> F+F--F+F', 'F -> F[+F]F[-F]F'];

/** @param {Page} page */
const outer = (page) => page.frameLocator('iframe.scorm-embedded');
/** @param {Page} page */
const step = (page) => outer(page).frameLocator('.step.now iframe');
/** @param {Page} page @param {string} rules */
async function answer(page, rules) {
    await step(page).locator('#mark-percent:not(:empty)').waitFor();
    await step(page).locator('#rules').fill(rules);
}
/** @param {Page} page @param {number} count */
const done = (page, count) =>
    until(async () => (await outer(page).locator('.places .done').count()) === count, `${count} are done`);

/** Makes a package by the share dialog. @param {string} file @param {'1.2' | '2004'} standard */
const save = (file, standard) =>
    withPage({}, async (page) => {
        await page.click('#share');
        await page.click('#share-scorm > summary');
        for (const title of TITLES) await page.check(`#scorm-list label:has(span:text-is("${title}")) input`);
        await page.selectOption('#scorm-standard', standard);
        const [download] = await Promise.all([page.waitForEvent('download'), page.click('#scorm-save')]);
        await download.saveAs(file);
    });

// scorm-again stands for both in the usual test: this learning system takes as long to install as all others to run.
for (const standard of some(/** @type {const} */ (['1.2', '2004']), 0))
    test(`Open edX has the grade of two windows with a package of SCORM ${standard}`, async () => {
        const folder = await mkdtemp(join(tmpdir(), 'package-'));
        try {
            const zip = join(folder, 'package.zip');
            await save(zip, standard);
            await withCourse(zip, (address) =>
                withPage({ address, drawing: null }, async (first) => {
                    const book = async () => (await fetch(`${address}gradebook`)).json();
                    /** @param {Record<string, unknown>} wanted */
                    const holds = (wanted) =>
                        until(
                            async () => {
                                const has = await book();
                                return Object.entries(wanted).every(([name, value]) => has[name] === value);
                            },
                            `the gradebook has ${JSON.stringify(wanted)}`,
                        );
                    const open = async () => {
                        const page = await first.context().newPage();
                        await page.goto(address);
                        await step(page).locator('#mark-percent:not(:empty)').waitFor();
                        return page;
                    };
                    await holds({ lesson_status: 'incomplete', lesson_score: 0 });
                    const second = await open();
                    await answer(first, KOCH);
                    await holds({ lesson_status: 'incomplete', success_status: 'unknown', lesson_score: 0.5 });
                    await done(second, 1);
                    await outer(second).locator('#onward').click();
                    await answer(second, WEED);
                    await holds({ lesson_status: 'completed', success_status: 'passed', lesson_score: 1 });
                    await done(first, 2);
                    await until(async () => (await book()).grades.at(-1) === 1, 'the grade is published');
                    await until(
                        async () => /^Saved/.test((await outer(first).locator('#learning').innerText()) ?? ''),
                        'it is told',
                    );
                    for (const page of [second, first]) await page.goto('about:blank');
                    const third = await open();
                    await done(third, 2);
                    const { scorm_data: data, ...has } = await book();
                    assert.equal(data['cmi.suspend_data'].match(/&mark=solved&/g)?.length, 2);
                    assert.equal(has.lesson_score, 1);
                    assert.equal(has.grades.at(-1), 1);
                }),
            );
        } finally {
            await rm(folder, { recursive: true });
        }
    });
