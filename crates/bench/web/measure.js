// Runs in the page, behind the generated script (`wasm_bindgen`) and the peer (`LSystem`).

/**
 * The best of at least three batches and half a second: what disturbs a run only ever makes it slower. A batch takes
 * 20 ms or more, because browsers round the time.
 */
const best = (what, work, who, run) => {
    const begin = performance.now();
    let [batches, ms, amount] = [0, Infinity, 0];
    while (batches < 3 || performance.now() - begin < 500) {
        const start = performance.now();
        let [runs, taken] = [0, 0];
        while (taken < 20) {
            amount = run();
            runs += 1;
            taken = performance.now() - start;
        }
        ms = Math.min(ms, taken / runs);
        batches += 1;
    }
    return { what, work: `${work.name}, n = ${work.n}`, who, amount, seconds: ms / 1000 };
};

const peerOf = (work) => {
    const system = new LSystem({ axiom: work.axiom, productions: Object.fromEntries(work.rules) });
    return () => {
        system.setAxiom(work.axiom);
        const text = system.iterate(work.n);
        // Concatenated strings are trees until somebody reads them.
        text.charCodeAt(text.length >> 1);
        return text;
    };
};

/** The peer has no turtle, but a function for each symbol: the usual few lines, writing to an array used again. */
const peerTurtle = (work, text) => {
    const ends = new Float32Array(4 * text.replace(/[^FG]/g, '').length);
    const turn = (work.angle * Math.PI) / 180;
    let [x, y, heading, at, stack] = [0, 0, 0, 0, []];
    const forward = () => {
        ends[at++] = x;
        ends[at++] = y;
        x += Math.cos(heading);
        y += Math.sin(heading);
        ends[at++] = x;
        ends[at++] = y;
    };
    const finals = {
        F: forward,
        G: forward,
        '+': () => (heading += turn),
        '-': () => (heading -= turn),
        '[': () => stack.push([x, y, heading]),
        ']': () => ([x, y, heading] = stack.pop()),
    };
    const system = new LSystem({ axiom: text, finals });
    return () => {
        [x, y, heading, at, stack] = [0, 0, 0, 0, []];
        system.final();
        return at / 4;
    };
};

/** Derives step by step; how many modules were read on the way, and how many there are at the end. */
const steps = (system, axiom, n) => {
    system.setAxiom(axiom);
    let read = 0;
    for (let i = 0; i < n; i++) {
        read += system.axiom.length;
        system.iterate(1);
    }
    return { read, length: system.axiom.length };
};

/** The peer's reading of figure 1.31a: its right contexts go on behind the branch, so that its words are longer. */
const signals = ({ axiom, n }) => {
    const [zero, one] = [
        ['0', '1[+F1F1]', '1', '1'],
        ['0', '1F1', '0', '0'],
    ];
    const contexts = (strict) => ({
        successors: [0, 1].flatMap((left) =>
            [0, 1].map((right) => ({
                leftCtx: String(left),
                rightCtx: String(right),
                successor: [zero, one][left][2 * strict + right],
            })),
        ),
    });
    const productions = { 0: contexts(0), 1: contexts(1), '+': '-', '-': '+' };
    const system = new LSystem({ axiom, productions, ignoredSymbols: '+-F' });
    return () => steps(system, axiom, n);
};

/** Figure 2.6a: modules are objects, productions functions. */
const tree = ({ n }) => {
    const module = (symbol, ...params) => ({ symbol, params });
    const apex = (symbol, l, w, factor) => module(symbol, l * factor, w * 0.707);
    const side = (l, w, ...turn) => [module('!', w), module('F', l), module('['), ...turn];
    const productions = {
        A: ({ params: [l, w] }) => [
            ...side(l, w, module('&', 45), apex('B', l, w, 0.6)),
            module(']'),
            module('/', 137.5),
            apex('A', l, w, 0.9),
        ],
        B: ({ params: [l, w] }) => [
            ...side(l, w, module('-', 45), module('$'), apex('C', l, w, 0.6)),
            module(']'),
            apex('C', l, w, 0.9),
        ],
        C: ({ params: [l, w] }) => [
            ...side(l, w, module('+', 45), module('$'), apex('B', l, w, 0.6)),
            module(']'),
            apex('B', l, w, 0.9),
        ],
    };
    const system = new LSystem({ axiom: [module('A', 1, 10)], productions });
    return () => steps(system, [module('A', 1, 10)], n);
};

/** The derivations that look around or compute. */
const derivations = () => {
    const rows = [];
    for (let i = 0; ; i++) {
        const ours = wasm_bindgen.Derivation.at(i);
        if (!ours) return rows;
        const work = JSON.parse(ours.work());
        rows.push(best(work.what, work, 'ours', () => ours.derive()));
        const peer = { '2.6a': tree, '1.31a': work.n > 30 ? undefined : signals }[work.name]?.(work);
        if (peer) {
            const { length } = peer();
            if (work.name === '2.6a' ? length !== work.modules : length <= work.modules) {
                throw new Error(`the peer does other work: ${length} modules`);
            }
            rows.push(best(work.what, work, 'npm lindenmayer 1.5', () => peer().read));
        }
        ours.free();
    }
};

globalThis.measure = async (base64) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    await wasm_bindgen({ module_or_path: bytes });
    const { Bench } = wasm_bindgen;
    const [expansion, drawing] = [[], []];
    for (let i = 0; ; i++) {
        const short = Bench.at(i, true);
        if (!short) return [...expansion, ...drawing, ...derivations()];
        short.expand();
        const shortWork = JSON.parse(short.work());
        const shortText = peerOf(shortWork)();
        const same = short.text() === shortText && short.draw() === peerTurtle(shortWork, shortText)();
        if (!same) throw new Error('the peer does other work');
        short.free();

        const bench = Bench.at(i, false);
        const work = JSON.parse(bench.work());
        const peer = peerOf(work);
        const expands = (who, run) => expansion.push(best('expansion, symbols/s', work, who, run));
        expands('ours', () => bench.expand());
        expands('copy', () => bench.copyText());
        expands('npm lindenmayer 1.5', () => peer().length);
        const draws = (who, run) => drawing.push(best('drawing, segments/s', work, who, run));
        draws('ours', () => bench.draw());
        draws('ours, in chunks', () => bench.drawInChunks());
        draws('copy', () => bench.copySegments());
        draws('npm lindenmayer 1.5', peerTurtle(work, peer()));
        bench.free();
    }
};
