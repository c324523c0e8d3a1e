#!/usr/bin/env bash
# GIF counts hundredths of a second, so that a film with 25 or 35 milliseconds a frame needs frames of different times to last as long as
# it should. No library here spreads the rest.
# Seen: of eight frames, Pillow 13.0.0 and imageio 2.38.1 write 2 for 25 and 3 for 35, a film that is up to a quarter too short; sharp
# 0.35.5 writes 2 and 4, which is too short and too long. Pillow joins equal frames, with the sum of their times.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

python3 -m venv python
python/bin/pip install --quiet --disable-pip-version-check pillow==13.0.0 imageio==2.38.1
npm install --silent --no-audit --no-fund --prefix . sharp@0.35.5

cat >write.py <<'END'
import re

import imageio.v3
import numpy
from PIL import Image


def tell(what):
    data = open("film.gif", "rb").read()
    print(what, [int.from_bytes(time, "little") for time in re.findall(rb"\x21\xf9\x04.(..)", data, re.DOTALL)])


def frames(levels):
    return [Image.new("RGB", (8, 8), (level, 0, 0)) for level in levels]


for time in (25, 35):
    first, *others = frames(range(0, 160, 20))
    first.save("film.gif", save_all=True, append_images=others, duration=time, loop=0)
    tell(f"Pillow {time}")
    imageio.v3.imwrite("film.gif", [numpy.asarray(frame) for frame in (first, *others)], duration=time, loop=0)
    tell(f"imageio {time}")
first, *others = frames([0, 0, 0, 90])
first.save("film.gif", save_all=True, append_images=others, duration=40, loop=0)
tell("Pillow, three equal frames")
END

cat >write.mjs <<'END'
import sharp from 'sharp';

const pixels = Buffer.alloc(8 * 8 * 8 * 3).map((_, at) => Math.floor(at / 192) * 20);
for (const time of [25, 35]) {
    const film = sharp(pixels, { raw: { width: 8, height: 64, channels: 3, pageHeight: 8 } });
    const bytes = await film.gif({ delay: Array(8).fill(time), loop: 0 }).toBuffer();
    const found = [...bytes.toString('latin1').matchAll(/\x21\xf9\x04.(..)/gs)];
    const times = found.map(([, time]) => time.charCodeAt(0) + 256 * time.charCodeAt(1));
    console.log(`sharp ${time} [${times.join(', ')}]`);
}
END

{
    python/bin/python write.py
    node write.mjs
} | tee seen.txt

diff - seen.txt <<'END' && echo 'as stated'
Pillow 25 [2, 2, 2, 2, 2, 2, 2, 2]
imageio 25 [2, 2, 2, 2, 2, 2, 2, 2]
Pillow 35 [3, 3, 3, 3, 3, 3, 3, 3]
imageio 35 [3, 3, 3, 3, 3, 3, 3, 3]
Pillow, three equal frames [12, 4]
sharp 25 [2, 2, 2, 2, 2, 2, 2, 2]
sharp 35 [4, 4, 4, 4, 4, 4, 4, 4]
END
