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

globalThis.measure = async (base64) => {
  const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
  await wasm_bindgen({ module_or_path: bytes });
  const { Bench } = wasm_bindgen;
  const rows = [];
  for (let i = 0; ; i++) {
    const short = Bench.at(i, true);
    if (!short) return rows;
    short.expand();
    if (short.text() !== peerOf(JSON.parse(short.work()))()) throw new Error('the peer does other work');
    short.free();

    const bench = Bench.at(i, false);
    const work = JSON.parse(bench.work());
    const peer = peerOf(work);
    const what = 'expansion, symbols/s';
    rows.push(best(what, work, 'ours', () => bench.expand()));
    rows.push(best(what, work, 'copy', () => bench.copyText()));
    rows.push(best(what, work, 'npm lindenmayer 1.5', () => peer().length));
    bench.free();
  }
};
