/** Calls for new systems. */

/** @type {import('../tool.js').CallTable} */
export const calls = {
    surprise: ({ seed }) => wasm_bindgen.surprise(seed),
    breed: ({ parents, seed, count }) => wasm_bindgen.breed(parents, seed, count),
    *descent({ definitions, side }) {
        const film = new wasm_bindgen.DescentFilm(side);
        for (const definition of definitions) {
            film.add(definition);
            yield undefined;
        }
        return film.finish();
    },
};
