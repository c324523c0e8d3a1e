/** The page of a film alone, for other sites: it plays the film of its address. */

import { button, byId, html, icon, input, reducedMotion, setText } from '../base/dom.js';
import { bestLink, openLink } from '../state/packed.js';
import { definitionOf } from '../state/state.js';
import { reasonOf, say, translatePage } from '../base/words.js';
import { filmIn, guarded } from './embed-code.js';
import { createFilmTool } from './frames.js';
import { createPlayer } from './player.js';

translatePage();

const NOTHING = say`The address of this frame contains no film.`;

const tool = createFilmTool();
const canvas = byId('film-picture', HTMLCanvasElement);
const play = button('film-play');
const slider = input('film-at');
const problem = html('film-problem');
/** The frames of the film. */
let frames = 1;

const player = createPlayer(tool, canvas, {
    most: () => {
        const ratio = Math.min(2, devicePixelRatio);
        return [innerWidth * ratio, innerHeight * ratio];
    },
    shown: (frame) => {
        slider.value = String(frame);
        slider.style.setProperty('--at', String(frames > 1 ? frame / (frames - 1) : 0));
        showPlay();
    },
    failed: (error) => {
        setText(problem, reasonOf(error));
        showPlay();
    },
});

function showPlay() {
    const words = player.playing ? say`Pause` : say`Play`;
    if (play.getAttribute('aria-label') === words) return;
    play.setAttribute('aria-label', words);
    play.replaceChildren(icon(player.playing ? 'i-pause' : 'i-play'));
}

async function open() {
    const text = filmIn(location.hash);
    const link = await openLink(location.hash);
    if (!link || text === '') return setText(problem, NOTHING);
    const { state } = link;
    const title = state.title || state.name || 'L-system';
    document.title = say`${title} – film`;
    setText(html('film-title'), document.title);
    canvas.setAttribute('aria-label', say`Film: ${title}`);
    document.documentElement.style.setProperty('--sheet', state.background);
    // Without a server, a folder address does not open its page.
    const place = new URL(location.protocol === 'file:' ? 'playground.html' : './', location.href).href;
    html('film-open').setAttribute('href', `${place}${await bestLink(state)}&film=${guarded(text)}`);
    try {
        const script = await tool.call('read', { text });
        frames = script.frames;
        slider.max = String(frames - 1);
        setText(problem, '');
        player.show({ definition: definitionOf(state), view: state.view, camera: state.camera, text }, script);
        if (!reducedMotion()) player.play();
        showPlay();
    } catch (error) {
        setText(problem, reasonOf(error));
    }
}

function toggle() {
    if (player.playing) player.pause();
    else player.play();
    showPlay();
}

play.addEventListener('click', toggle);
canvas.addEventListener('click', toggle);
slider.addEventListener('input', () => {
    player.pause();
    player.seek(Number(slider.value));
    showPlay();
});
addEventListener('hashchange', open);
// A film that nobody sees takes no work.
document.addEventListener('visibilitychange', () => {
    if (document.hidden) player.pause();
    showPlay();
});
await open();
