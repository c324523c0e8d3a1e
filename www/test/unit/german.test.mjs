/** Numbers on a page in German, with points between groups and a comma before decimals. */

import assert from 'node:assert/strict';
import { test } from 'node:test';

Object.assign(globalThis, {
    document: { querySelector: () => null },
    location: { search: '?lang=de' },
    localStorage: { getItem: () => null },
    fetch: async () => Response.json({ '{} a second': '{} in der Sekunde' }),
});
Object.defineProperty(globalThis, 'navigator', { value: { languages: ['en'] } });
const { grouped, shortText, zoomText } = await import('../../js/base/numerals.js');
const { paceText, placeText, readPlace } = await import('../../js/reading/places.js');
const { poseText } = await import('../../js/reading/words.js');

const LONG = 10n ** 40n;

test('numbers are written with German marks', () => {
    assert.equal(shortText('1234567890'), '1,23\u2009×\u200910⁹');
    assert.equal(zoomText(1234), '×1.234');
    assert.equal(zoomText(0.056), '5,6\u2009%');
    assert.equal(paceText(1.5), '1,5 in der Sekunde');
    assert.equal(paceText(1234.4), '1.234 in der Sekunde');
    // Commas between numbers with commas could not be told apart.
    assert.match(poseText({ at: [0.5, -1.25], heading: 22.5, level: 2 }), /0,5; −1,25, .*22,5°/);
});

test('places are read as the page writes them, and as English readers do', () => {
    for (const place of [0n, 6n, 999n, 1233n, 123_456n, 7_654_321n, 10n ** 11n + 7n]) {
        assert.equal(readPlace(placeText(place + 1n), LONG), place);
        assert.equal(readPlace(grouped(String(place + 1n)), LONG), place);
    }
    assert.equal(readPlace('1,23 × 10¹²', LONG), 1_229_999_999_999n);
    assert.equal(readPlace('2,5e6', LONG), 2_499_999n);
    assert.equal(readPlace('2.5e6', LONG), 2_499_999n);
    assert.equal(readPlace('1,234,567', LONG), 1_234_566n);
    assert.equal(readPlace('12,5 %', LONG), LONG / 8n);
});
