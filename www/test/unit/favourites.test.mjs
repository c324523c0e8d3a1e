import assert from 'node:assert/strict';
import { test } from 'node:test';
import { MOST_FAVOURITES, favourite, readFavourites, renamed } from '../../js/favourites/favourites.js';
import { MOST_ENTRIES, isFavouritesFile, readFile, writeFile } from '../../js/favourites/file.js';
import { readLink, writeLink } from '../../js/state/link.js';
import { shortestLink } from '../../js/state/packed.js';
import { clean } from '../../js/state/state.js';
import { dice, randomState } from './random.mjs';

const ROUNDS = Math.min(2000, Number(process.env.LSYSTEM_CASES ?? 100));

test('favourites are read back from their file and not added twice', async () => {
    const roll = dice(11);
    for (let round = 0; round < ROUNDS; round++) {
        const states = Array.from({ length: 1 + Math.floor(roll() * 5) }, () => randomState(roll));
        const list = states.map((state, at) => favourite(` Number\t${at} `, state));
        const file = writeFile(list);
        assert.ok(isFavouritesFile(file));
        const read = await readFile([], file);
        assert.deepEqual(
            read?.list.map(({ name, link }) => ({ name, link })),
            list.map(({ name, link }) => ({ name, link })),
        );
        assert.deepEqual(
            read?.list.map(({ link }) => readLink(link)?.state),
            states,
        );
        const twice = await readFile(list, file);
        assert.deepEqual([twice?.added, twice?.known, twice?.list], [0, list.length, list]);
    }
});

test('a favourite always has a name', () => {
    assert.equal(favourite(' \n ', clean({ title: 'Koch' })).name, 'Koch');
    assert.equal(favourite('', clean({})).name, 'Untitled system');
    assert.equal(favourite('x'.repeat(1000), clean({})).name.length, 120);
    const one = favourite('A', clean({}));
    assert.deepEqual(renamed(one, ' New  name '), { ...one, name: 'New name' });
    assert.deepEqual(renamed(one, ' '), one);
});

test('files from elsewhere may have full addresses, compressed or damaged links, and too many entries', async () => {
    const state = clean({ axiom: 'F', rules: 'F -> F+F\n'.repeat(100) });
    const links = [
        `https://example.org/page/${await shortestLink(state)}`,
        '#v=1&axiom=F',
        'axiom=F+F',
        '#v=1&angle=x',
        'nothing',
        '',
        7,
        null,
        '#v=1&z=eJzz',
    ];
    const file = JSON.stringify({
        favourites: [...links.map((link) => ({ name: 'x', link })), null, 7, 'text', {}, { link: '#axiom=G', name: 7 }],
    });
    const read = await readFile([], file);
    assert.deepEqual([read?.added, read?.damaged, read?.known, read?.tooMany], [4, 10, 0, 0]);
    assert.deepEqual(
        read?.list.map(({ link }) => link),
        [writeLink(state), '#v=1&axiom=F', '#v=1&axiom=F+F', '#v=1&axiom=G'],
    );
    const many = JSON.stringify({
        favourites: Array.from({ length: MOST_FAVOURITES + 20 }, (_, at) => ({ name: `${at}`, link: `#seed=${at}` })),
    });
    const full = await readFile(read?.list ?? [], many);
    assert.equal(full?.list.length, MOST_FAVOURITES);
    assert.equal(full?.tooMany, 24);
    for (const none of ['', '[]', '{}', '{"favourites": 7}', 'null', '{"favourites"', '[{"favourites": []}]'])
        assert.equal(await readFile([], none), null, none);
    assert.ok(!isFavouritesFile('{"initial": "F", "notes": "l-systems favourites"}'));
});

test('favourites are read from any stored value', () => {
    for (const value of [undefined, null, 7, 'text', {}, [null], [{}], [{ id: 1, name: 'a', link: '#' }]])
        assert.deepEqual(readFavourites(value), []);
    const list = [favourite('A', clean({}))];
    assert.deepEqual(readFavourites(list), list);
});

test('a file with too many entries is refused', async () => {
    /** @param {number} count */
    const file = (count) =>
        JSON.stringify({
            format: 'l-systems favourites',
            version: 1,
            favourites: Array(count).fill({ name: 'a', link: '#v=1&rules=%' }),
        });
    await assert.rejects(readFile([], file(MOST_ENTRIES + 1)), /more than 10,000 entries/);
    await assert.rejects(readFile([], file(1000)), /are damaged/);
    assert.equal((await readFile([], file(10)))?.damaged, 10);
});
