/** The drawing as a sound. */

import assert from 'node:assert/strict';
import test from 'node:test';
import { pitchAt, sideAt } from '../../js/playback/sound.js';

test('height is pitch, in equal steps to the ear, and left and right are the sides', () => {
    assert.equal(pitchAt(0.5), 330);
    assert.ok(Math.abs(pitchAt(0.5) / pitchAt(0) - pitchAt(1) / pitchAt(0.5)) < 1e-9);
    assert.ok(Math.abs(pitchAt(1) / pitchAt(0) - 8) < 1e-9, 'three octaves');
    assert.deepEqual([0, 0.5, 1].map(sideAt), [-1, 0, 1]);
    for (const far of [-1e9, 1e9]) {
        assert.ok(pitchAt(far) > 100 && pitchAt(far) < 1000);
        assert.ok(Math.abs(sideAt(far)) === 1);
    }
});
