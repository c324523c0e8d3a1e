// Runs in the page, behind the generated script: times of whole pictures at 1600 x 1000, in milliseconds.

const DEPTHS = [8, 12, 20, 40];
const ZOOMS = [1, 30, 1e3, 1e6];
/** Milliseconds that a picture may take: of the bush, and of everything else. */
const AIMS = [40, 16];
/** The most that a first picture at n = 40 may take, in those at n = 12. */
const MOST_GROWTH = 3;
/** A picture is cut off after so many milliseconds. */
const CUT = 2000;
/** Rows are measured once only after so many milliseconds in all, so that the whole ends in time. */
const PATIENCE = 240_000;
/** The most segments drawn as single lines of the canvas: a hundred times as many as a frame has time for. */
const MOST = 20_000_000;

const timed = (run) => {
    const start = performance.now();
    run();
    return performance.now() - start;
};

const median = (times) => times.sort((a, b) => a - b)[times.length >> 1];

/** The sums of all medians and of all best runs. Their ratio grows with the load of the machine by other programs. */
const sums = { typical: 0, best: 0 };

/** The median of five runs, or of as many as take a quarter of a second; one where `once`. */
const typical = (run, once) => {
    const times = [];
    for (let taken = 0; times.length < 5 && (times.length === 0 || (!once && taken < 250)); taken += times.at(-1)) {
        times.push(run(times.length));
    }
    const ms = median(times);
    if (times.length > 2) {
        sums.typical += ms;
        sums.best += times[0];
    }
    return ms;
};

const columns = (cells) =>
    cells
        .map((cell, at) =>
            String(cell)
                .padStart(at ? 10 : 0)
                .padEnd(at ? 0 : 34),
        )
        .join('');

globalThis.pictures = async (base64, files) => {
    const bytes = Uint8Array.from(atob(base64), (c) => c.charCodeAt(0));
    const { memory } = await wasm_bindgen({ module_or_path: bytes });
    const pictures = new wasm_bindgen.Pictures(files);
    const canvas = new OffscreenCanvas(1600, 1000);
    const context = canvas.getContext('2d');
    const print = globalThis.printLine;

    pictures.build(0, 8);
    pictures.load();
    pictures.picture(1, 0, CUT, false);
    const image = new ImageData(new Uint8ClampedArray(pictures.pixels()), 1600, 1000);
    const put = () => (context.putImageData(image, 0, 0), context.getImageData(0, 0, 1, 1));
    await print(`one putImageData of the frame: ${median(Array.from({ length: 9 }, () => timed(put))).toFixed(2)} ms`);
    await print(
        columns([
            'system',
            'n',
            'zoom',
            'graph',
            'picture',
            'panned',
            'shaded',
            'first',
            'blocks',
            'strokes',
            'tiles',
            'stamps',
        ]),
    );

    const began = performance.now();
    const slow = [];
    const heavy = [];
    const late = [];
    const growth = [];
    const lateGrowth = [];
    const cut = [];
    let rows = 0;
    let worst = { ratio: 0, what: 'none' };
    let largest = { bytes: 0, what: '' };
    for (let index = 0; pictures.build(index, 1) !== undefined; index++) {
        const first = {};
        const earliest = {};
        for (const n of DEPTHS) {
            let about;
            const graph = timed(() => (about = JSON.parse(pictures.build(index, n))));
            for (const zoom of ZOOMS) {
                const what = `${about.name} n=${n} zoom=${zoom}`;
                const once = performance.now() - began > PATIENCE;
                rows++;
                // Without stored tiles, as after a change of the system.
                let ended = true;
                const ms = typical(
                    () => (pictures.load(), timed(() => (ended &&= pictures.picture(zoom, 0, CUT, false)))),
                    once,
                );
                const stats = pictures.stats();
                if (ended) {
                    const pan = typical(
                        (i) => timed(() => (ended &&= pictures.picture(zoom, i + 1, CUT, false))),
                        once,
                    );
                    // In the default ink, likewise without stored tiles.
                    const shade = typical(
                        () => (pictures.load(), timed(() => pictures.picture(zoom, 0, CUT, true))),
                        once,
                    );
                    // From a new definition to the first picture that the page shows of it, in the default ink.
                    const early = typical(() => (pictures.rest(), timed(() => pictures.first(zoom))), once);
                    const times = [graph, ms, pan, shade, early].map((time) => time.toFixed(2));
                    await print(columns([about.name, n, zoom, ...times, ...stats]));
                    if (shade > AIMS[1]) heavy.push(`${what}: ${ms.toFixed(1)} -> ${shade.toFixed(1)} ms`);
                    if (early > AIMS[1]) late.push(`${what}: ${early.toFixed(1)} ms, whole ${shade.toFixed(1)} ms`);
                    if (n === 12) earliest[zoom] = early;
                    // Times below 2 ms are within the error of the clock.
                    if (n === 40 && early > MOST_GROWTH * Math.max(earliest[zoom] ?? Infinity, 2)) {
                        lateGrowth.push(
                            `${about.name} zoom=${zoom}: ${earliest[zoom].toFixed(1)} -> ${early.toFixed(1)} ms`,
                        );
                    }
                }
                if (!ended) {
                    cut.push(what);
                    await print(columns([about.name, n, zoom, graph.toFixed(2), 'cut off', '', '', ...stats]));
                } else if (ms > AIMS[about.bush ? 0 : 1]) {
                    slow.push(`${what}: ${ms.toFixed(1)} ms`);
                }
                if (n === 12) first[zoom] = ended ? ms : undefined;
                // Times below 2 ms are within the error of the clock.
                if (n === 40 && first[zoom] !== undefined && ms > 2 && ms / Math.max(first[zoom], 1) > worst.ratio) {
                    worst = {
                        ratio: ms / Math.max(first[zoom], 1),
                        what: `${about.name} zoom=${zoom}: ${first[zoom].toFixed(1)} -> ${ms.toFixed(1)} ms`,
                    };
                }
                if (n === 40 && first[zoom] !== undefined && ms > 2 * first[zoom] && ms > 2) {
                    growth.push(`${about.name} zoom=${zoom}: ${first[zoom].toFixed(1)} -> ${ms.toFixed(1)} ms`);
                }
                // The memory never shrinks, so the last growth names the largest picture.
                if (memory.buffer.byteLength > largest.bytes) largest = { bytes: memory.buffer.byteLength, what };
            }
        }
    }
    const list = (lines) => (lines.length ? `\n  ${lines.join('\n  ')}` : ' none');
    await print(`\nSUMMARY of ${rows} rows, in ${((performance.now() - began) / 1000).toFixed(0)} s`);
    const noise = (sums.typical / sums.best).toFixed(2);
    await print(`medians to best runs: ${noise}, near 1 where the machine does nothing else`);
    await print(`within the aim (${AIMS[1]} ms, the bush ${AIMS[0]} ms): ${rows - slow.length - cut.length}`);
    await print(`over it: ${slow.length}${list(slow)}`);
    await print(`over ${AIMS[1]} ms in the default ink, after opaque: ${heavy.length}${list(heavy)}`);
    await print(`first pictures over ${AIMS[1]} ms, in the default ink: ${late.length}${list(late)}`);
    await print(
        `first pictures, n = 40 more than ${MOST_GROWTH} times n = 12: ${lateGrowth.length}${list(lateGrowth)}`,
    );
    await print(`cut off after ${CUT} ms: ${cut.length}${list(cut)}`);
    await print(`n = 40 more than twice n = 12 (above 2 ms): ${growth.length}${list(growth)}`);
    await print(`worst ratio of n = 40 to n = 12: ${worst.ratio.toFixed(1)} (${worst.what})`);
    await print(`largest wasm memory: ${(largest.bytes / 2 ** 20).toFixed(0)} MiB (${largest.what})`);

    // For comparison, every segment as a line of the canvas, at the largest n that ends within ten seconds.
    await print('\nevery segment as a line of the same canvas, in paths of 1,000, beside our picture of the same n:');
    for (let index = 0; index < 7; index++) {
        let last;
        for (let n = 4; n < 40; n++) {
            const about = JSON.parse(pictures.build(index, n));
            const ends = Number(about.segments) <= MOST ? pictures.segments(MOST) : undefined;
            if (!ends) break;
            const lines = timed(() => {
                const [low, high] = [
                    [Infinity, Infinity],
                    [-Infinity, -Infinity],
                ];
                ends.forEach((value, at) => {
                    low[at % 2] = Math.min(low[at % 2], value);
                    high[at % 2] = Math.max(high[at % 2], value);
                });
                const scale = Math.min(1500 / (high[0] - low[0]), 900 / (high[1] - low[1]));
                context.setTransform(scale, 0, 0, -scale, 50 - low[0] * scale, 50 + high[1] * scale);
                context.lineWidth = 1 / scale;
                for (let at = 0; at < ends.length; ) {
                    context.beginPath();
                    for (const end = Math.min(ends.length, at + 4000); at < end; at += 4) {
                        context.moveTo(ends[at], ends[at + 1]);
                        context.lineTo(ends[at + 2], ends[at + 3]);
                    }
                    context.stroke();
                }
                context.getImageData(0, 0, 1, 1);
            });
            context.resetTransform();
            pictures.load();
            last = { ...about, n, lines, ours: timed(() => pictures.picture(1, 0, CUT)) };
            // The next one takes at least twice as long.
            if (lines > 5000) break;
        }
        const { name, n, segments, lines, ours } = last;
        await print(
            `  ${name}, n = ${n}, ${segments} segments: lines ${lines.toFixed(0)} ms, ours ${ours.toFixed(1)} ms, ratio ${(lines / ours).toFixed(0)}`,
        );
    }
};
