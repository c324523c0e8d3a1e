#!/usr/bin/env bash
# Two notes of one pitch overlap on one channel: 0 to 960 and 480 to 1440 ticks, as when branches of a tree sound together. MIDI does
# not say which note a note-off ends.
# Seen: @tonejs/midi 2.0.28, symusic 0.6.0 and miditoolkit 1.0.1 end the one that began first; pretty_midi 0.2.11 ends both at once, so that the
# second is half as long; partitura 1.9.0 forgets the first note, begins at the second, and tells of an ignored message.
set -euo pipefail
export PYTHONWARNINGS=ignore
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"

python3 -m venv python
python/bin/pip install --quiet --disable-pip-version-check pretty_midi==0.2.11.post0 mido==1.3.3 symusic==0.6.0 partitura==1.9.0 miditoolkit==1.0.1 setuptools==80.9.0
npm install --silent --no-audit --no-fund --prefix . @tonejs/midi@2.0.28

cat >read.py <<'END'
import mido, miditoolkit, partitura, pretty_midi, symusic

track = mido.MidiTrack()
for kind, ticks in [("note_on", 0), ("note_on", 480), ("note_off", 480), ("note_off", 480)]:
    track.append(mido.Message(kind, note=60, velocity=64, time=ticks))
file = mido.MidiFile(type=1, ticks_per_beat=480)
file.tracks.append(track)
file.save("two.mid")

notes = [note for part in pretty_midi.PrettyMIDI("two.mid").instruments for note in part.notes]
print("pretty_midi", [[round(note.start * 960), round(note.end * 960)] for note in notes])
notes = [note for part in symusic.Score("two.mid").tracks for note in part.notes]
print("symusic", [[note.start, note.end] for note in notes])
notes = [note for part in miditoolkit.MidiFile("two.mid").instruments for note in part.notes]
print("miditoolkit", [[note.start, note.end] for note in notes])
notes = partitura.load_performance_midi("two.mid").performedparts[0].notes
print("partitura", [[round(note["note_on"] * 960), round(note["note_off"] * 960)] for note in notes])
END

cat >read.mjs <<'END'
import Tone from '@tonejs/midi';
import { readFileSync } from 'node:fs';

const { tracks } = new Tone.Midi(readFileSync('two.mid'));
const notes = tracks.flatMap((track) => track.notes.map(({ ticks, durationTicks }) => [ticks, ticks + durationTicks]));
console.log('@tonejs/midi', JSON.stringify(notes));
END

{
    python/bin/python read.py
    node read.mjs
} | tee seen.txt

diff - seen.txt <<'END' && echo 'as stated'
pretty_midi [[0, 960], [480, 960]]
symusic [[0, 960], [480, 1440]]
miditoolkit [[0, 960], [480, 1440]]
partitura [[480, 960]]
@tonejs/midi [[0,960],[480,1440]]
END
