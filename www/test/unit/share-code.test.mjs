import assert from 'node:assert/strict';
import { test } from 'node:test';
import { elementCode, frameAddress, frameCode, markdownCode, readSide, sizeName } from '../../js/dialogs/share-code.js';
import { clean } from '../../js/state/state.js';

const STATE = clean({ title: 'A [wild] "weed"', axiom: 'A(1)', rules: 'A(x) -> F(x)', iterations: 3 });
const PLAIN = { controls: [], theme: '', width: 480, height: 360 };

test('code has the chosen size, theme and controls', () => {
    const code = frameCode(STATE, '#v=1&n=3', 'https://a.example/embed.html', {
        controls: ['n', 'play'],
        theme: 'dark',
        width: 320,
        height: 240,
    });
    assert.match(
        code,
        /^<iframe src="https:\/\/a\.example\/embed\.html#v=1&amp;n=3&amp;controls=n,play&amp;theme=dark" title="A \[wild\] &quot;weed&quot;" width="320" height="240" /,
    );
    assert.equal(frameAddress('#v=1', 'e.html', PLAIN), 'e.html#v=1');
    const element = elementCode(STATE, 'l-system.js', { ...PLAIN, theme: 'light' });
    assert.match(element, / theme="light" style="width: 480px; max-width: 100%; height: 360px; aspect-ratio: auto">/);
    assert.doesNotMatch(elementCode(STATE, 'l-system.js', PLAIN), /theme=|controls=/);
});

test('Markdown is a link with the title, whose brackets and parentheses are safe', () => {
    assert.equal(
        markdownCode(STATE, 'https://a.example/#v=1&axiom=A(1)'),
        '[A \\[wild\\] "weed"](https://a.example/#v=1&axiom=A%281%29)',
    );
    assert.equal(markdownCode(clean({}), 'a'), '[L-system](a)');
});

test('sizes are read within limits and named', () => {
    assert.deepEqual(['300', ' 5 ', '99999', '', 'wide', '1e3', '-4'].map(readSide), [
        300,
        200,
        4000,
        null,
        null,
        null,
        null,
    ]);
    assert.deepEqual(
        [sizeName(320, 240), sizeName(480, 360), sizeName(640, 480), sizeName(640, 400)],
        ['small', 'medium', 'large', 'custom'],
    );
});
