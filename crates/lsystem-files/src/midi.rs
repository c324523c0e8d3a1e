//! Tunes as standard MIDI files (RP-001), of format 1: a track for the tempo, and a track and a channel for each group of
//! voices that do not sound together.

use crate::{FileOptions, Sink};
use lsystem_base::sorted;
use lsystem_sound::{Note, Tune};
use lsystem_syntax::{Halt, Work};

/// The ticks of a quarter note.
const QUARTER: u16 = 480;
/// The ticks between two places where notes begin and end: half a step of a sixteenth. Programs for scores take finer
/// places for another metre.
const GRID: u32 = 60;
/// The channels in use, in the order of their tracks: all but the tenth, which is for drums.
const CHANNELS: [u8; 15] = [0, 1, 2, 3, 4, 5, 6, 7, 8, 10, 11, 12, 13, 14, 15];
/// The instruments of General MIDI, in the order of the tracks, again from the first after the last: piano, harp,
/// xylophone, glockenspiel, celesta. The free sounds of freepats have them all.
const PROGRAMS: [u8; 5] = [0, 46, 13, 9, 8];
/// The greatest number of ticks that the format holds between two events.
const MAX: u32 = (1 << 28) - 1;
/// The controller of the place from left to right.
const PAN: u8 = 10;
/// The end of a track.
const END: [u8; 3] = [0xff, 0x2f, 0];

/// Writes a tune with the tempo of [`FileOptions::sound`].
///
/// # Errors
/// If the owner of the sink stops the work.
pub(crate) fn midi_file(tune: &Tune, options: &FileOptions, sink: &mut Sink<'_>) -> Result<(), Halt> {
    let tracks = tracks(tune);
    let mut head = b"MThd\0\0\0\x06\0\x01".to_vec();
    head.extend((tracks.len() as u16 + 1).to_be_bytes());
    head.extend(QUARTER.to_be_bytes());
    sink.bytes(&head)?;
    sink.bytes(&chunk(&conductor(tune, options)))?;
    for (number, notes) in tracks.iter().enumerate() {
        for part in notes.chunks(64) {
            sink.charge(part.len() as u64 * 16)?;
        }
        sink.bytes(&chunk(&track(number, notes)))?;
    }
    Ok(())
}

/// The ticks of a time in steps.
fn ticks(steps: f64) -> u32 {
    (libm::round(2.0 * steps) as u32).saturating_mul(GRID).min(MAX)
}

/// The notes by track. A voice stays in its track from its first to its last note. It gets the first track that is
/// free, or if all are taken, the one that is free first.
fn tracks(tune: &Tune) -> Vec<Vec<&Note>> {
    // By voice: its first note, and its last end.
    let mut spans: Vec<Option<[f64; 2]>> = vec![None; tune.voices as usize];
    for note in &tune.notes {
        let end = note.start + note.length;
        let span = spans[note.voice as usize].get_or_insert([note.start, end]);
        span[1] = span[1].max(end);
    }
    let mut order: Vec<(f64, usize)> =
        (0..).zip(&spans).filter_map(|(voice, span)| Some((span.as_ref()?[0], voice))).collect();
    sorted::sort_by(&mut order, |one, other| one.0.total_cmp(&other.0).then(one.1.cmp(&other.1)));
    // By track: the time from which it is free.
    let mut free: Vec<f64> = vec![];
    let mut track_of = vec![0; spans.len()];
    for (start, voice) in order {
        let end = spans[voice].map_or(start, |[_, end]| end);
        let fit = free.iter().position(|&from| from <= start);
        let first = || (0..free.len()).min_by(|&one, &other| free[one].total_cmp(&free[other]));
        let track = fit.or_else(|| if free.len() < CHANNELS.len() { None } else { first() });
        let track = track.unwrap_or_else(|| {
            free.push(end);
            free.len() - 1
        });
        free[track] = free[track].max(end);
        track_of[voice] = track;
    }
    let mut tracks = vec![vec![]; free.len()];
    tune.notes.iter().for_each(|note| tracks[track_of[note.voice as usize]].push(note));
    tracks
}

/// The track with the title and the tempo, as long as the tune.
fn conductor(tune: &Tune, options: &FileOptions) -> Vec<u8> {
    let mut bytes = vec![];
    name(&options.title, &mut bytes);
    let quarter = (4e6 * options.sound.step_seconds()) as u32;
    bytes.extend([0, 0xff, 0x51, 3]);
    bytes.extend(&quarter.to_be_bytes()[1..]);
    number(ticks(tune.length), &mut bytes);
    bytes.extend(END);
    bytes
}

/// An event's time in ticks, whether it begins a note, and the note.
type Event<'a> = (u32, bool, &'a Note);

/// A track of notes with its own channel.
fn track(place: usize, notes: &[&Note]) -> Vec<u8> {
    let channel = CHANNELS[place];
    let mut bytes = vec![];
    name(&format!("Voice {}", place + 1), &mut bytes);
    bytes.extend([0, 0xc0 | channel, PROGRAMS[place % PROGRAMS.len()]]);
    let (mut now, mut side) = (0, None);
    for (time, begins, note) in events(notes) {
        let pan = libm::round(64.0 + 48.0 * note.side) as u8;
        if begins && side != Some(pan) {
            number(time - now, &mut bytes);
            bytes.extend([0xb0 | channel, PAN, pan]);
            (now, side) = (time, Some(pan));
        }
        number(time - now, &mut bytes);
        bytes.extend(if begins { [0x90 | channel, note.key, note.velocity] } else { [0x80 | channel, note.key, 0] });
        now = time;
    }
    bytes.push(0);
    bytes.extend(END);
    bytes
}

/// The beginnings and ends of notes in the order of time, ends first. A key sounds once at a time: a note ends where the
/// next one of the same key begins, and of notes that begin together one is left. A note lasts half a step at least.
fn events<'a>(notes: &[&'a Note]) -> Vec<Event<'a>> {
    let mut spans: Vec<([u32; 2], &Note)> = (notes.iter())
        .map(|&note| {
            let start = ticks(note.start).min(MAX - GRID);
            ([start, ticks(note.start + note.length).max(start + GRID)], note)
        })
        .collect();
    sorted::sort_by_key(&mut spans, |([start, _], note)| (*start, note.key));
    // By key: the last note.
    let mut last: [Option<usize>; 128] = [None; 128];
    let mut is_left = vec![true; spans.len()];
    for at in 0..spans.len() {
        let ([start, end], note) = spans[at];
        if let Some(before) = last[usize::from(note.key & 127)].replace(at) {
            let earlier = &mut spans[before].0;
            if earlier[0] == start {
                is_left[before] = false;
                let longest = earlier[1].max(end);
                spans[at].0[1] = longest;
            } else {
                earlier[1] = earlier[1].min(start);
            }
        }
    }
    let left = spans.iter().zip(is_left).filter_map(|(span, is_left)| is_left.then_some(span));
    let mut events: Vec<Event<'_>> =
        left.flat_map(|&([start, end], note)| [(start, true, note), (end, false, note)]).collect();
    sorted::sort_by_key(&mut events, |&(time, begins, note)| (time, begins, note.key));
    events
}

/// Appends an event with the name of a track.
fn name(text: &str, bytes: &mut Vec<u8>) {
    bytes.extend([0, 0xff, 0x03]);
    number(text.len() as u32, bytes);
    bytes.extend(text.as_bytes());
}

/// Appends a number of at most 28 bits, seven bits in a byte.
fn number(value: u32, bytes: &mut Vec<u8>) {
    let digit = |place: u32| (value >> (7 * place) & 127) as u8;
    let most = (1..4).rev().find(|&place| value >> (7 * place) > 0).unwrap_or(0);
    bytes.extend((0..=most).rev().map(|place| digit(place) | if place > 0 { 128 } else { 0 }));
}

/// A chunk with its head.
fn chunk(track: &[u8]) -> Vec<u8> {
    let size = (track.len() as u32).to_be_bytes();
    [b"MTrk", &size[..], track].concat()
}
