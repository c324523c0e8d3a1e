/** Packages in a learning system: made by the share dialog, opened in a stand-in with faults, and in a real run-time. */

import assert from 'node:assert/strict';
import { mkdir, mkdtemp, readFile, readdir, rm, writeFile } from 'node:fs/promises';
import { tmpdir } from 'node:os';
import { join } from 'node:path';
import { after, before, test } from 'node:test';
import { pathToFileURL } from 'node:url';
import { inflateRawSync } from 'node:zlib';
import { memoryPages, validateXML } from 'xmllint-wasm';
import { some } from '../effort.mjs';
import { ADDRESS, DESKTOP, PHONE, close, until, withPage } from './browser.mjs';

/** @typedef {import('playwright-core').Page} Page */
/** @typedef {import('../scorm-stand-in.mjs').Faults} Faults */

after(close);

const DIST = new URL('../../../dist/', import.meta.url);
/** The place of the learning system, and of the package in it. */
const PLACE = `${ADDRESS}learning/`;
/** The source of the stand-in, as a classic script. */
const STAND_IN = (await readFile(new URL('../scorm-stand-in.mjs', import.meta.url), 'utf8')).replace(/^export /gm, '');
/** @type {{id: string, title: string, x: string}[]} */
const EXERCISES = JSON.parse(await readFile(new URL('exercises.json', DIST), 'utf8'));

/** The files of a zip. @param {Buffer} zip @returns {Map<string, Buffer>} */
function unzipped(zip) {
    const end = zip.lastIndexOf('PK\u0005\u0006', undefined, 'latin1');
    const files = new Map();
    for (let at = zip.readUInt32LE(end + 16), left = zip.readUInt16LE(end + 10); left > 0; left--) {
        const [size, long, extra, comment] = [
            zip.readUInt32LE(at + 20),
            ...[28, 30, 32].map((by) => zip.readUInt16LE(at + by)),
        ];
        const name = zip.toString('utf8', at + 46, at + 46 + Number(long));
        const place = zip.readUInt32LE(at + 42);
        const from = place + 30 + zip.readUInt16LE(place + 26) + zip.readUInt16LE(place + 28);
        files.set(name, inflateRawSync(zip.subarray(from, from + Number(size))));
        at += 46 + Number(long) + Number(extra) + Number(comment);
    }
    return files;
}

/** Packages by what is in them: `koch 1.2`. @type {Map<string, Map<string, Buffer>>} */
const packages = new Map();

/** Makes a package by the share dialog. @param {Page} page @param {string[]} titles none for the lesson @param {'1.2' | '2004'} standard */
async function save(page, titles, standard) {
    if (!(await page.isVisible('#scorm-save'))) {
        await page.click('#share');
        await page.click('#share-scorm > summary');
    }
    if (titles.length === 0 && (await page.inputValue('#scorm-own')) === '') await page.check('#scorm-lesson');
    for (const title of titles) await page.check(`#scorm-list label:has(span:text-is("${title}")) input`);
    await page.selectOption('#scorm-standard', standard);
    const [download] = await Promise.all([page.waitForEvent('download'), page.click('#scorm-save')]);
    for (const title of titles) await page.uncheck(`#scorm-list label:has(span:text-is("${title}")) input`);
    return { name: download.suggestedFilename(), files: unzipped(await readFile(await download.path())) };
}

/** @type {{title: string, task: string}[]} */
const EXERCISES_SOURCE = JSON.parse(await readFile(new URL('../../exercises.json', import.meta.url), 'utf8'));
/** German by its English texts. @type {Record<string, string>} */
const GERMAN = JSON.parse(await readFile(new URL('lang/de/words.json', DIST), 'utf8'));
const [ONE, TWO] = ['koch', 'weed'].map((id) => EXERCISES.find((exercise) => exercise.id === id)?.title ?? '');

before(async () => {
    await withPage({}, async (page) => {
        for (const standard of /** @type {const} */ (['1.2', '2004'])) {
            packages.set(`one ${standard}`, (await save(page, [String(ONE)], standard)).files);
            packages.set(`two ${standard}`, (await save(page, [String(ONE), String(TWO)], standard)).files);
        }
        packages.set('lesson 1.2', (await save(page, [], '1.2')).files);
    });
    await withPage({ address: `${ADDRESS}?lang=de`, also: ADDRESS }, async (page) => {
        packages.set('german 1.2', (await save(page, [String(GERMAN[String(ONE)])], '1.2')).files);
    });
});

/** @param {string} kind */
const filesOf = (kind) => packages.get(kind) ?? assert.fail(kind);

test('the dialog tells what is missing, and takes links', () =>
    withPage({}, async (page) => {
        await page.click('#share');
        await page.click('#share-scorm > summary');
        await page.waitForSelector('#scorm-list label');
        await page.click('#scorm-save');
        await until(async () => /Choose an exercise/.test((await page.textContent('#scorm-note')) ?? ''), 'a refusal');
        await page.fill('#scorm-own', 'hello');
        await page.click('#scorm-save');
        await until(
            async () => /no link of an exercise: hello/.test((await page.textContent('#scorm-note')) ?? ''),
            'words',
        );
        await page.fill('#scorm-own', `https://example.org/exercise.html#v=1&x=${EXERCISES[0]?.x}`);
        await page.fill('#scorm-title', 'Week 3: <plants> & more');
        const [download] = await Promise.all([page.waitForEvent('download'), page.click('#scorm-save')]);
        assert.equal(download.suggestedFilename(), 'Week_3_plants_more_scorm_1.2.zip');
        const manifest =
            unzipped(await readFile(await download.path()))
                .get('imsmanifest.xml')
                ?.toString() ?? '';
        assert.match(manifest, /<title>Week 3: &lt;plants&gt; &amp; more<\/title>/);
        await until(async () => /^Saved \(1\.\d MB\)/.test((await page.textContent('#scorm-note')) ?? ''), 'words');
    }));

for (const standard of /** @type {const} */ (['1.2', '2004']))
    test(`manifests of SCORM ${standard} follow the public schemas`, async () => {
        const folder = new URL(`../scorm-schemas/${standard}/`, import.meta.url);
        const names = await readdir(folder);
        const preload = await Promise.all(
            names.map(async (fileName) => ({
                fileName,
                // The schema of XML names one on the web, which it does not need.
                contents: (await readFile(new URL(fileName, folder), 'utf8')).replace(
                    'http://www.w3.org/2001/03/xml.xsd',
                    'xml.xsd',
                ),
            })),
        );
        const spaces =
            standard === '1.2'
                ? {
                      'http://www.imsproject.org/xsd/imscp_rootv1p1p2': 'imscp_rootv1p1p2.xsd',
                      'http://www.adlnet.org/xsd/adlcp_rootv1p2': 'adlcp_rootv1p2.xsd',
                  }
                : {
                      'http://www.imsglobal.org/xsd/imscp_v1p1': 'imscp_v1p1.xsd',
                      'http://www.adlnet.org/xsd/adlcp_v1p3': 'adlcp_v1p3.xsd',
                      'http://www.imsglobal.org/xsd/imsss': 'imsss_v1p0.xsd',
                  };
        const imports = Object.entries(spaces).map(
            ([space, file]) => `<xs:import namespace="${space}" schemaLocation="${file}"/>`,
        );
        const schema = `<xs:schema xmlns:xs="http://www.w3.org/2001/XMLSchema">${imports.join('')}</xs:schema>`;
        const manifest = filesOf(`two ${standard}`).get('imsmanifest.xml')?.toString() ?? '';
        const check = (/** @type {string} */ contents) =>
            validateXML({
                xml: [{ fileName: 'imsmanifest.xml', contents }],
                schema: [schema],
                preload,
                maxMemoryPages: memoryPages.GiB,
            });
        const { valid, errors } = await check(manifest);
        assert.ok(valid, JSON.stringify(errors));
        assert.equal((await check(manifest.replace('identifierref', 'reference'))).valid, false);
        // All files are named, and only those.
        const named = [...manifest.matchAll(/<file href="([^"]+)"/g)].map(([, name]) => name);
        assert.deepEqual([...named, 'imsmanifest.xml'].sort(), [...filesOf(`two ${standard}`).keys()].sort());
    });

/**
 * Opens a package in a stand-in of a learning system, in a frame. `late`: the run-time is there only after `late()`.
 * @typedef {{kind?: string, standard?: '1.2' | '2004', faults?: Partial<Faults>, late?: boolean, script?: string, options?: import('playwright-core').BrowserContextOptions, expected?: RegExp}} Visit
 * @param {Visit} visit
 * @param {(page: Page) => Promise<unknown>} use
 */
const inSystem = (
    { kind = 'one', standard = '1.2', faults = {}, late = false, script, options = DESKTOP, expected },
    use,
) =>
    withPage(
        {
            address: ADDRESS,
            hash: 'learning/player.html',
            drawing: null,
            options,
            expected,
            before: (page) =>
                page.route(`${PLACE}**`, (route) =>
                    learning(route, `${kind} ${standard}`, player(standard, faults, late, script)),
                ),
        },
        use,
    );

/** Answers as a learning system that has a package. @param {import('playwright-core').Route} route @param {string} kind @param {string} page */
function learning(route, kind, page) {
    const name = new URL(route.request().url()).pathname.split('/learning/')[1] ?? '';
    const body = name === 'player.html' ? page : filesOf(kind).get(name.replace('package/', ''));
    const contentType = name.endsWith('.html') ? 'text/html; charset=utf-8' : 'text/plain';
    return route.fulfill(body === undefined ? { status: 404, body: '' } : { body, contentType });
}

/** The page of a learning system. It keeps what it has between visits. @param {string} standard @param {Partial<Faults>} faults @param {boolean} late @param {string} [script] */
const player = (standard, faults, late, script) => `<!doctype html><meta charset="utf-8"><title>Learning system</title>
<style>body { margin: 0; font: 16px sans-serif } p { margin: 0; padding: 8px; background: #dde } iframe { width: 100%; height: calc(100vh - 40px); border: 0; display: block }</style>
<p>Course &gt; Week 3</p>
<script>${
    script ??
    `${STAND_IN}
const kept = JSON.parse(sessionStorage.getItem('stored') ?? '{}');
const system = createStandIn('${standard}', { ...${JSON.stringify(faults)}, kept });
const provide = () => { window[system.name] = system.api; };
window.system = system;
if (!${late}) provide();
addEventListener('pagehide', () => sessionStorage.setItem('stored', JSON.stringify(system.stored)));`
}</script>
<iframe src="package/index.html" title="Package" allow="clipboard-write"></iframe>`;

/** The values that the stand-in has. @param {Page} page @returns {Promise<Record<string, string>>} */
const stored = (page) => page.evaluate('system.stored');
/** @param {Page} page */
const outer = (page) => page.frameLocator('iframe').first();
/** @param {Page} page */
const inner = (page) => outer(page).frameLocator('.step.now iframe');
/** @param {Page} page */
const told = async (page) => (await outer(page).locator('#learning').textContent()) ?? '';
/** Types rules into the shown step, once its exercise or its drawing is there. @param {Page | import('playwright-core').FrameLocator} place @param {string} rules */
async function type(place, rules) {
    const frame = place.frameLocator('.step.now iframe');
    await frame.locator('#mark-percent:not(:empty), body:not(.exercising) #stage.inked').first().waitFor();
    await frame.locator('#rules').fill(rules);
}
/** @param {Page} page @param {string} rules */
const answer = (page, rules) => type(outer(page), rules);
/** @param {Page} page @param {string} name @param {string} value */
const becomes = (page, name, value) => until(async () => (await stored(page))[name] === value, `${name} is ${value}`);
/** @param {Page} page @param {RegExp} words */
const says = (page, words) => until(async () => words.test(await told(page)), `the student is told ${words}`);
/** @param {Page} page */
const brokeNothing = async (page) => assert.deepEqual(await page.evaluate('system.wrong'), []);

const [WRONG, RIGHT] = ['F -> F+F', 'F -> F+F--F+F'];

test('a page left untouched is incomplete without a score', () =>
    inSystem({}, async (page) => {
        await inner(page).locator('#mark-percent:not(:empty)').waitFor();
        await becomes(page, 'cmi.core.lesson_status', 'incomplete');
        await outer(page).locator('body').press('Tab');
        await page.evaluate("document.querySelector('iframe').remove()");
        await until(async () => (await page.evaluate('system.state')) === 'ended', 'the visit ends');
        const values = await stored(page);
        assert.equal(values['cmi.core.score.raw'], '');
        assert.equal(values['cmi.core.lesson_status'], 'incomplete');
        assert.match(values['cmi.core.session_time'] ?? '', /^0000:0\d:\d\d\.\d\d$/);
        await brokeNothing(page);
    }));

/** The link of an exercise with variants. @returns {Promise<string>} */
async function variedLink() {
    let link = '';
    await withPage({ hash: '#v=1&axiom=F&rules=F%20-%3E%20F%5B%2BF%5DF&n=3&angle=20' }, async (page) => {
        await page.click('#tab-save');
        await page.click('#make-exercise');
        await page.check('#maker-varied input[value=angle]');
        link = await until(async () => {
            const now = await page.inputValue('#maker-link');
            const is = /^\d+ targets/.test((await page.textContent('#maker-variants')) ?? '');
            return is && now !== '' && (await page.locator('#maker-made:visible').count()) > 0 ? now : null;
        }, 'the link');
    });
    return link;
}

test('a package of one exercise fills its frame, and takes the name from the learning system', async () => {
    const link = await variedLink();
    await withPage({}, async (page) => {
        await page.click('#share');
        await page.click('#share-scorm > summary');
        await page.fill('#scorm-own', link);
        packages.set('varied 1.2', (await save(page, [], '1.2')).files);
    });
    for (const { width, height } of some([
        { width: 1000, height: 640 },
        { width: 760, height: 640 },
        { width: 390, height: 844 },
    ]))
        await inSystem({ kind: 'varied', options: { viewport: { width, height } } }, async (page) => {
            const task = outer(page).locator('l-system.task');
            await inner(page).locator('#mark-percent:not(:empty)').waitFor();
            assert.match((await task.getAttribute('link')) ?? '', /&by=Muster%2C%20Anna%20\(student-1\)/);
            assert.match((await inner(page).locator('#variant').textContent()) ?? '', /for Muster, Anna \(student-1\)/);
            const wide = (await task.boundingBox())?.width ?? 0;
            assert.ok(wide > 0.85 * width, `${wide} of ${width}`);
            for (const picture of ['#target', '#stage']) {
                const box = await inner(page).locator(picture).boundingBox();
                assert.ok(box && box.height >= 240 && box.width >= 0.35 * width, `${picture} ${JSON.stringify(box)}`);
            }
            assert.ok(await inner(page).locator('#rules').isVisible());
            await brokeNothing(page);
        });
});

for (const [name, options] of some(
    /** @type {const} */ ([
        ['a desktop', DESKTOP],
        ['a phone', PHONE],
    ]),
))
    test(`wrong, solved, and again at the next visit, on ${name}`, () =>
        inSystem({ options }, async (page) => {
            await answer(page, WRONG);
            await becomes(page, 'cmi.core.score.raw', '0');
            assert.equal((await stored(page))['cmi.core.lesson_status'], 'incomplete');
            await page.reload();
            await until(async () => (await inner(page).locator('#rules').inputValue()) === WRONG, 'the draft is there');
            await answer(page, RIGHT);
            await becomes(page, 'cmi.core.score.raw', '100');
            await says(page, /^Saved in the learning system\./);
            const values = await stored(page);
            assert.equal(values['cmi.core.lesson_status'], 'passed');
            assert.match(
                values['cmi.suspend_data'] ?? '',
                /^l-system 1 at=0\n#v=1&k=[\da-f]{8}&mark=solved&t=\w+&rules=F%20-%3E/,
            );
            assert.equal(values['cmi.interactions.0.result'], 'correct');
            // Whoever goes on to try keeps the solution.
            await answer(page, WRONG);
            await inner(page).locator('#mark:not(.solved)').waitFor();
            await page.reload();
            await until(
                async () => (await inner(page).locator('#rules').inputValue()) === RIGHT,
                'the solution is there',
            );
            assert.equal((await stored(page))['cmi.core.lesson_status'] ?? 'passed', 'passed');
            await brokeNothing(page);
        }));

test('a package made in German is German for every student, and keeps the same', () =>
    inSystem({ kind: 'german' }, async (page) => {
        await answer(page, WRONG);
        await becomes(page, 'cmi.core.score.raw', '0');
        assert.deepEqual(
            await Promise.all([outer(page), inner(page)].map((frame) => frame.locator('html').getAttribute('lang'))),
            ['de', 'de'],
        );
        assert.equal(await inner(page).locator('#exercise-title').textContent(), GERMAN[String(ONE)]);
        const { task } = EXERCISES_SOURCE.find(({ title }) => title === ONE) ?? assert.fail();
        assert.equal(await inner(page).locator('#exercise-task').textContent(), GERMAN[task]);
        assert.equal(await inner(page).locator('label[for=rules]').first().textContent(), GERMAN.Rules);
        await answer(page, RIGHT);
        await becomes(page, 'cmi.core.lesson_status', 'passed');
        await says(page, /^In der Lernplattform gespeichert\./);
        assert.match(await inner(page).locator('#mark-words').innerText(), /^Gelöst\. /);
        assert.match(
            (await stored(page))['cmi.suspend_data'] ?? '',
            /^l-system 1 at=0\n#v=1&k=[\da-f]{8}&mark=solved&t=\w+&rules=F%20-%3E/,
        );
        assert.match(filesOf('german 1.2').get('read-me.txt')?.toString() ?? '', /SCORM 1\.2.*hoch/);
        // The words of these pages only: the site's catalogue has more.
        const words = /data-file="lang\/de\/words\.json">([^<]*)</.exec(
            filesOf('german 1.2').get('exercise.html')?.toString() ?? '',
        );
        const carried = Object.keys(JSON.parse(words?.[1] ?? '{}')).length;
        assert.ok(carried > 500 && carried < Object.keys(GERMAN).length / 2, String(carried));
        await brokeNothing(page);
    }));

test('a set counts by what is solved, in SCORM 2004', () =>
    inSystem({ kind: 'two', standard: '2004' }, async (page) => {
        await answer(page, RIGHT);
        await becomes(page, 'cmi.score.scaled', '0.5');
        assert.equal((await stored(page))['cmi.completion_status'], 'incomplete');
        await outer(page).locator('#onward').click();
        await answer(page, 'F -> F[+F]F[-F]F');
        await becomes(page, 'cmi.score.raw', '100');
        const values = await stored(page);
        assert.equal(values['cmi.completion_status'], 'completed');
        assert.equal(values['cmi.success_status'], 'passed');
        assert.match(values['cmi.session_time'] ?? '', /^PT[\d.]+S$/);
        await page.reload();
        await until(
            async () => /^2\. /.test((await outer(page).locator('.step.now h2').textContent()) ?? ''),
            'the place is kept',
        );
        assert.equal(await outer(page).locator('.places .done').count(), 2);
        await brokeNothing(page);
    }));

test('a learning system that comes late gets the answers', () =>
    inSystem({ late: true }, async (page) => {
        await says(page, /No learning system answers here\. Your answers are kept in this browser only/);
        await answer(page, RIGHT);
        await inner(page).locator('#mark.solved').waitFor();
        await page.evaluate('provide()');
        await becomes(page, 'cmi.core.lesson_status', 'passed');
        await says(page, /^Saved in the learning system\./);
        assert.equal(await inner(page).locator('#rules').inputValue(), RIGHT);
        await brokeNothing(page);
    }));

test('without an answer of the learning system, answers stay in the browser and can be copied', () =>
    inSystem({ faults: { isSilent: true } }, async (page) => {
        await says(
            page,
            /The learning system does not start this page \(it gives no reason\)\. Your answers are kept in this browser only/,
        );
        await answer(page, RIGHT);
        await inner(page).locator('#mark.solved').waitFor();
        await outer(page).locator('#learning button:text("Copy my answers")').click();
        const links = await outer(page).locator('#learning textarea').inputValue();
        assert.match(links, /^#v=1&x=[\w-]+&mark=solved&rules=F%20-%3E%20F%2BF--F%2BF$/);
        await page.reload();
        await until(async () => (await inner(page).locator('#rules').inputValue()) === RIGHT, 'the answer is there');
    }));

test('answers without the learning system are offered once it answers', () =>
    inSystem({ late: true }, async (page) => {
        await answer(page, RIGHT);
        await inner(page).locator('#mark.solved').waitFor();
        await page.reload();
        await until(async () => (await inner(page).locator('#rules').inputValue()) === RIGHT, 'the answer is there');
        await page.evaluate('provide()');
        await says(page, /earlier answers that the learning system does not have/);
        await outer(page).locator('#learning button:text("Use my earlier answers")').click();
        await becomes(page, 'cmi.core.lesson_status', 'passed');
    }));

for (const [name, faults] of some(
    /** @type {[string, Partial<Faults>][]} */ ([
        ['refuses', { refuses: 2 }],
        ['crashes', { throws: true }],
    ]),
))
    test(`a learning system that ${name} is told, and loses nothing`, () =>
        inSystem({ faults }, async (page) => {
            await answer(page, RIGHT);
            await says(
                page,
                /has not saved your last answers \(.+\)\. Your answers are kept in this browser\. Trying again/,
            );
            if (faults.throws) {
                await page.reload();
                await until(
                    async () => (await inner(page).locator('#rules').inputValue()) === RIGHT,
                    'the answer is there',
                );
            } else {
                await becomes(page, 'cmi.core.lesson_status', 'passed');
                await says(page, /^Saved in the learning system\./);
            }
        }));

for (const [name, faults] of some(
    /** @type {[string, Partial<Faults>][]} */ ([
        ['cuts long states without a word', { cuts: 1200 }],
        ['has room for little', { quota: 1200 }],
    ]),
))
    test(`a learning system that ${name} has the marks, and the student is told`, () =>
        inSystem({ faults }, async (page) => {
            const long = `${WRONG}\n${Array.from({ length: 80 }, (_, at) => `// line ${at} of a long remark`).join('\n')}`;
            await answer(page, long);
            await says(page, /no room for the text of step 1: its mark is saved/);
            assert.match(
                (await stored(page))['cmi.suspend_data'] ?? '',
                /^l-system 1 at=0\n#v=1&k=[\da-f]{8}&mark=\d+&t=\w+$/,
            );
            assert.equal((await stored(page))['cmi.core.score.raw'], '0');
            await page.reload();
            await until(async () => (await inner(page).locator('#rules').inputValue()) === long, 'the text is there');
        }));

test('a learning system that forgot everything can have the earlier answers', () =>
    inSystem({}, async (page) => {
        await answer(page, RIGHT);
        await becomes(page, 'cmi.core.lesson_status', 'passed');
        await page.evaluate("addEventListener('pagehide', () => sessionStorage.clear())");
        await page.reload();
        await says(page, /earlier answers that the learning system does not have/);
        await outer(page).locator('#learning button:text("Use my earlier answers")').click();
        await becomes(page, 'cmi.core.lesson_status', 'passed');
        await until(async () => (await inner(page).locator('#rules').inputValue()) === RIGHT, 'the answer is shown');
    }));

test('a preview saves nothing, and says so', () =>
    inSystem(
        {
            faults: { kept: { 'cmi.core.lesson_mode': 'browse' } },
            script: `${STAND_IN}
const system = createStandIn('1.2', { kept: { 'cmi.core.lesson_mode': 'browse' } });
window.API = system.api;`,
        },
        async (page) => {
            await says(page, /This is a preview/);
            await answer(page, RIGHT);
            await inner(page).locator('#mark.solved').waitFor();
            assert.deepEqual(await stored(page), {});
        },
    ));

test('the opener of a window of its own may be the learning system', () =>
    inSystem({}, async (page) => {
        const [opened] = await Promise.all([
            page.waitForEvent('popup'),
            page.evaluate(
                "document.querySelector('iframe').remove(); system.state = 'new'; void open('package/index.html')",
            ),
        ]);
        await opened.route(`${PLACE}**`, (route) => {
            const name = new URL(route.request().url()).pathname.split('/package/')[1] ?? '';
            return route.fulfill({ body: filesOf('one 1.2').get(name) ?? '', contentType: 'text/html; charset=utf-8' });
        });
        await opened.reload();
        await type(opened, RIGHT);
        await becomes(page, 'cmi.core.lesson_status', 'passed');
    }));

/**
 * The page of a learning system whose windows have the values of when they were opened, and whose last window that
 * commits replaces all values of the others.
 */
const TWO_WINDOWS = `${STAND_IN}
const kept = JSON.parse(localStorage.getItem('stored') ?? '{}');
const system = createStandIn('1.2', { kept });
window.system = system;
window.API = {};
for (const [name, call] of Object.entries(system.api))
    API[name] = (...given) => {
        const answer = call(...given);
        if (/Commit|Finish/.test(name)) localStorage.setItem('stored', JSON.stringify(system.stored));
        return answer;
    };`;

test('two windows of a package: both answers are kept, shown and counted', () =>
    inSystem({ kind: 'two', script: TWO_WINDOWS }, async (first) => {
        const open = async () => {
            const page = await first.context().newPage();
            await page.route(`${PLACE}**`, (route) =>
                learning(route, 'two 1.2', player('1.2', {}, false, TWO_WINDOWS)),
            );
            await page.goto(first.url());
            await inner(page).locator('#mark-percent:not(:empty)').waitFor();
            return page;
        };
        const kept = async (/** @type {Page} */ page, /** @type {string} */ name) =>
            JSON.parse(await page.evaluate("localStorage.getItem('stored') ?? '{}'"))[name];
        const score = (/** @type {Page} */ page, /** @type {string} */ value) =>
            until(async () => (await kept(page, 'cmi.core.score.raw')) === value, `the score is ${value}`);
        const done = (/** @type {Page} */ page, /** @type {number} */ count) =>
            until(async () => (await outer(page).locator('.places .done').count()) === count, `${count} are done`);
        await inner(first).locator('#mark-percent:not(:empty)').waitFor();
        const second = await open();
        await answer(first, RIGHT);
        await score(first, '50');
        await done(second, 1);
        assert.equal(await inner(second).locator('#rules').inputValue(), RIGHT, 'shown in the other window');
        await outer(second).locator('#onward').click();
        await answer(second, 'F -> F[+F]F[-F]F');
        await score(first, '100');
        await done(first, 2);
        await says(first, /^Saved in the learning system\./);
        // Whichever is closed last.
        await second.close();
        await first.reload();
        await done(first, 2);
        const third = await open();
        await done(third, 2);
        assert.equal(await kept(third, 'cmi.core.score.raw'), '100');
        assert.equal((await kept(third, 'cmi.suspend_data')).match(/mark=solved/g)?.length, 2);
        for (const page of [first, third]) await brokeNothing(page);
    }));

test('answers of nobody are offered to no other student of this browser', () =>
    inSystem({ late: true }, async (page) => {
        await answer(page, RIGHT);
        await inner(page).locator('#mark.solved').waitFor();
        const other = await page.context().newPage();
        await other.route(`${PLACE}**`, (route) => learning(route, 'one 1.2', player('1.2', {}, false)));
        await other.goto(page.url());
        await inner(other).locator('#mark-percent:not(:empty)').waitFor();
        await becomes(other, 'cmi.core.lesson_status', 'incomplete');
        assert.equal(await outer(other).locator('#learning').isVisible(), false, 'nothing is offered');
        assert.equal(await inner(other).locator('#rules').inputValue(), '');
        // Whoever made them still has them.
        await page.evaluate('provide()');
        await becomes(page, 'cmi.core.lesson_status', 'passed');
    }));

test('the lesson keeps its place, its answers and the own plant', () =>
    inSystem({ kind: 'lesson' }, async (page) => {
        assert.equal(await outer(page).locator('.keep').count(), 0, 'a package has no playground');
        await outer(page).locator('.places a').nth(1).click();
        await answer(page, 'F -> FF');
        await becomes(page, 'cmi.core.score.raw', '9');
        await outer(page).locator('.places a').nth(12).click();
        const plant = 'X -> F[+X]F[-X]X\nF -> FF';
        await answer(page, plant);
        await until(async () => /k=own/.test((await stored(page))['cmi.suspend_data'] ?? ''), 'the plant is kept');
        assert.equal(await inner(page).locator('#open').isVisible(), false, 'no way to a playground');
        await page.reload();
        await until(async () => (await inner(page).locator('#rules').inputValue()) === plant, 'the plant is there');
        assert.equal(await outer(page).locator('.places .done').count(), 2);
        assert.equal((await stored(page))['cmi.core.lesson_status'] ?? 'incomplete', 'incomplete');
        const links = await outer(page)
            .locator('a')
            .evaluateAll((all) => all.map((link) => link.getAttribute('href')));
        assert.ok(
            links.every((href) => href?.startsWith('#step-')),
            'no link leaves the package',
        );
        await brokeNothing(page);
    }));

for (const standard of some(/** @type {const} */ (['1.2', '2004'])))
    test(`scorm-again keeps a package of SCORM ${standard}`, async () => {
        const file = standard === '1.2' ? 'scorm12.min.js' : 'scorm2004.min.js';
        const library = await readFile(new URL(`../../node_modules/scorm-again/dist/${file}`, import.meta.url), 'utf8');
        const [name, api] = standard === '1.2' ? ['Scorm12API', 'API'] : ['Scorm2004API', 'API_1484_11'];
        const kept = "sessionStorage.getItem('kept')";
        const script = `${library}
const settings = { autocommit: false, logLevel: 5 };
window.${api} = new ${name}(settings);
if (${kept}) ${api}.loadFromJSON(JSON.parse(${kept}), '');
const values = () => ${api}.renderCMIToJSONObject().cmi;
addEventListener('pagehide', () => sessionStorage.setItem('kept', JSON.stringify(${api}.renderCMIToJSONObject())));`;
        await inSystem({ kind: 'two', standard, script }, async (page) => {
            const read = (/** @type {string} */ path) => page.evaluate(`String(values().${path})`);
            const status = standard === '1.2' ? 'core.lesson_status' : 'completion_status';
            const score = standard === '1.2' ? 'core.score.raw' : 'score.raw';
            await inner(page).locator('#mark-percent:not(:empty)').waitFor();
            await until(async () => (await read(status)) === 'incomplete', 'incomplete');
            assert.equal(await read(score), '');
            await answer(page, RIGHT);
            await until(async () => (await read(score)) === '50', 'half of the score');
            await outer(page).locator('#onward').click();
            await answer(page, 'F -> F[+F]F[-F]F');
            await until(async () => (await read(score)) === '100', 'the whole score');
            assert.equal(await read(status), standard === '1.2' ? 'passed' : 'completed');
            if (standard === '2004') assert.equal(await read('success_status'), 'passed');
            await says(page, /^Saved in the learning system\./);
            assert.match(await read('suspend_data'), /^l-system 1 at=1\n/);
        });
    });

test('a package opens from a disk, alone and in a frame', async () => {
    const folder = await mkdtemp(join(tmpdir(), 'on a stick ü '));
    try {
        await mkdir(join(folder, 'package'));
        for (const [name, bytes] of filesOf('two 1.2')) await writeFile(join(folder, 'package', name), bytes);
        await writeFile(join(folder, 'player.html'), player('1.2', {}, false));
        const address = pathToFileURL(folder).href;
        await withPage({ address, hash: '/package/index.html', drawing: null }, async (page) => {
            await type(page, RIGHT);
            await until(async () => (await page.locator('.places .done').count()) === 1, 'the first is done');
            assert.match((await page.textContent('#learning')) ?? '', /No learning system answers here/);
            await page.reload();
            await until(async () => (await page.locator('.places .done').count()) === 1, 'kept in this browser');
        });
        // Files are of no common origin, so the run-time around the frame cannot be reached.
        await withPage({ address, hash: '/player.html', drawing: null }, async (page) => {
            await answer(page, RIGHT);
            await inner(page).locator('#mark.solved').waitFor();
            await says(page, /No learning system answers here/);
        });
    } finally {
        await rm(folder, { recursive: true });
    }
});
