/** Calls for films. */

/** @typedef {import('../../js/protocol.js').Film} Film */
/** @typedef {import('../../js/protocol.js').FilmScript} FilmScript */

/** The units of work between two looks at messages: some ten milliseconds. */
const WORK = 1_000_000;
/** The side of a frame that is made for its drawing only, in pixels. */
const SMALL = 16;

/** The open film. @type {{key: string, text: string, player: InstanceType<typeof wasm_bindgen.FilmPlayer>} | null} */
let open = null;

/** Opens a film for one frame at a time, and keeps the drawing if only the text has changed. @param {Film} film */
function opened({ definition, view, camera, text }) {
    const key = JSON.stringify([definition, view, camera]);
    if (open?.key === key) {
        if (open.text !== text) open.player.change(text);
        open.text = text;
        return open.player;
    }
    open?.player.free();
    open = null;
    const player = new wasm_bindgen.FilmPlayer(definition, view, camera, text);
    open = { key, text, player };
    return player;
}

/**
 * Makes a frame.
 * @param {InstanceType<typeof wasm_bindgen.FilmPlayer>} player
 * @param {number} number
 * @param {number} width
 * @param {number} height
 */
function* painted(player, number, width, height) {
    player.begin(number, width, height, false);
    while (!player.step(WORK)) yield;
}

/** @param {{film: Film, script: FilmScript}} asked */
function* gif({ film, script: { frames, width, height } }) {
    const player = opened(film);
    const samples = player.paletteSamples();
    for (const number of samples.numbers) {
        yield* painted(player, number, samples.width, samples.height);
        player.countColours();
    }
    for (let number = 0; number < frames; number++) {
        yield* painted(player, number, width, height);
        yield { done: number + 1, bytes: player.addToGif(number) };
    }
    yield { done: frames, bytes: player.endGif() };
    return null;
}

/** @type {import('../tool.js').CallTable} */
export const calls = {
    read: ({ text }) => wasm_bindgen.readFilm(text),
    preset: ({ text, preset }) => wasm_bindgen.withPreset(text, preset),
    subjects: ({ definition }) => wasm_bindgen.subjects(definition),
    *frame({ film, number, width, height }) {
        const player = opened(film);
        yield* painted(player, number, width, height);
        return player.pixels();
    },
    *dive({ film, text, view }) {
        // A frame may be in the making, so this is another player.
        const player = new wasm_bindgen.FilmPlayer(film.definition, film.view, film.camera, '1');
        try {
            yield* painted(player, 0, SMALL, SMALL);
            return player.dive(text, view) ?? null;
        } finally {
            player.free();
        }
    },
    gif,
};
