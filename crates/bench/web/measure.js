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

globalThis.measure = async (base64) => {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  await wasm_bindgen({ module_or_path: bytes });
  const { Bench } = wasm_bindgen;
  const [expansion, drawing] = [[], []];
  for (let i = 0; ; i++) {
    const short = Bench.at(i, true);
    if (!short) return [...expansion, ...drawing];
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
