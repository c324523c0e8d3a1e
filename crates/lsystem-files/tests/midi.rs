//! MIDI files, read by another library.

use lsystem_base::{Limits, Meter};
use lsystem_drawing::{Figure, System};
use lsystem_files::{
    FileLimits, FileOptions, FileTask, FileView, Format, Notes, OptionValue, collect, make, read_json,
};
use lsystem_sound::{Tune, listen};
use lsystem_syntax::{Definition, Halt, Work};
use midly::{Format as Layout, MetaMessage, MidiMessage, Smf, Timing, TrackEventKind};
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;

const SYSTEMS: [(&str, u32); 6] = [
    ("curves/hilbert", 5),
    ("curves/gosper", 4),
    ("curves/seven-gosper-curves", 2),
    ("abop/1.24a", 3),
    ("abop/1.24f", 4),
    ("practical-1/tree1", 4),
];

fn definition(name: &str, iterations: u32) -> Definition {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../data_in").join(format!("{name}.json"));
    Definition { iterations, ..read_json(&std::fs::read_to_string(path).unwrap()).0.unwrap() }
}

fn options(values: &[(&str, &str)]) -> FileOptions {
    let value = |text: &str| text.parse().map_or_else(|_| OptionValue::Text(text.to_owned()), OptionValue::Number);
    FileOptions::from_values(&values.iter().map(|(name, text)| ((*name).to_owned(), value(text))).collect()).unwrap()
}

fn file(definition: &Definition, options: &FileOptions) -> (Vec<u8>, Notes) {
    let (system, format) = (System::new(definition).unwrap(), Format::named("midi").unwrap());
    let view = FileView::default();
    let task = FileTask { definition, system: &system, format, options, view, limits: FileLimits::PAGE };
    collect(|sink| make(&task, sink)).unwrap()
}

fn tune(definition: &Definition, options: &FileOptions) -> Tune {
    let system = System::new(definition).unwrap();
    let draw =
        &mut |system: &System, n, _: &mut dyn Work| Figure::draw(system, n, &Limits::default()).map_err(Halt::from);
    listen(&system, definition.iterations, &options.sound, draw, &mut Meter::new(u64::MAX)).unwrap()
}

/// A note of a file: its start and end in ticks, its key and its velocity.
type Sounded = ([u32; 2], u8, u8);

/// A file as another library reads it.
struct Heard {
    /// Microseconds of a quarter note.
    tempo: u32,
    /// The last tick.
    length: u32,
    /// By track.
    tracks: Vec<Vec<Sounded>>,
    channels: Vec<u8>,
    /// By channel and key: how often the key sounds at the same time, at most.
    most_at_once: usize,
}

fn read(file: &[u8]) -> Heard {
    let smf = Smf::parse(file).unwrap();
    assert_eq!(smf.header.format, Layout::Parallel);
    assert_eq!(smf.header.timing, Timing::Metrical(480.into()));
    let mut heard = Heard { tempo: 0, length: 0, tracks: vec![], channels: vec![], most_at_once: 0 };
    for (number, track) in smf.tracks.iter().enumerate() {
        let (mut now, mut open, mut notes) = (0, BTreeMap::<u8, Vec<(u32, u8)>>::new(), vec![]);
        let mut channels = BTreeSet::new();
        assert_eq!(track.last().unwrap().kind, TrackEventKind::Meta(MetaMessage::EndOfTrack));
        for event in track {
            now += event.delta.as_int();
            match event.kind {
                TrackEventKind::Meta(MetaMessage::Tempo(tempo)) => {
                    assert_eq!((number, now), (0, 0));
                    heard.tempo = tempo.as_int();
                }
                TrackEventKind::Midi { channel, message } => {
                    channels.insert(channel.as_int());
                    match message {
                        MidiMessage::NoteOn { key, vel } => {
                            let open = open.entry(key.as_int()).or_default();
                            open.push((now, vel.as_int()));
                            heard.most_at_once = heard.most_at_once.max(open.len());
                        }
                        MidiMessage::NoteOff { key, .. } => {
                            let (start, velocity) = open.get_mut(&key.as_int()).unwrap().pop().unwrap();
                            notes.push(([start, now], key.as_int(), velocity));
                        }
                        // The instruments that freepats has beside others.
                        MidiMessage::ProgramChange { program } => {
                            assert!([0, 46, 13, 9, 8].contains(&program.as_int()));
                        }
                        MidiMessage::Controller { .. } => {}
                        other => panic!("{other:?}"),
                    }
                }
                _ => {}
            }
        }
        assert!(open.values().all(Vec::is_empty), "a note that does not end");
        heard.length = heard.length.max(now);
        if number == 0 {
            assert!(notes.is_empty() && channels.is_empty());
            continue;
        }
        assert_eq!(channels.len(), 1, "a track has a channel of its own");
        heard.channels.extend(channels);
        heard.tracks.push(notes);
    }
    heard
}

fn ticks(steps: f64) -> u32 {
    60 * (steps * 2.0).round() as u32
}

#[test]
fn files_have_the_notes_of_the_tune_and_last_as_long_as_the_walk() {
    for (name, n) in SYSTEMS {
        for values in [
            &[][..],
            &[("pitch", "letter"), ("tempo", "90")],
            &[("time", "length"), ("notes", "100000")],
            &[("notes", "50")],
        ] {
            let (definition, options) = (definition(name, n), options(values));
            let (tune, heard) = (tune(&definition, &options), read(&file(&definition, &options).0));
            let case = format!("{name} {values:?}");
            assert_eq!(heard.tempo, (60e6 / options.sound.tempo) as u32, "{case}");
            assert_eq!(heard.length, ticks(tune.length), "{case}");
            assert!(heard.most_at_once == 1 && heard.channels.len() <= 15, "{case}");
            assert!(!heard.channels.contains(&9) && heard.channels.is_sorted(), "{case}");
            let mut found: Vec<Sounded> = heard.tracks.concat();
            let mut expected: Vec<Sounded> = (tune.notes.iter())
                .map(|note| ([note.start, note.start + note.length].map(ticks), note.key, note.velocity))
                .collect();
            found.sort_unstable();
            expected.sort_unstable();
            if found.len() == expected.len() {
                let near = |one: &Sounded, other: &Sounded| one.0[0] == other.0[0] && one.1 == other.1;
                assert!(found.iter().zip(&expected).all(|(one, other)| near(one, other)), "{case}");
            } else {
                // More voices than channels: notes of one key that begin together sound as one.
                assert!(values.contains(&("time", "length")), "{case}");
                let starts =
                    |notes: &[Sounded]| -> BTreeSet<_> { notes.iter().map(|note| (note.0[0], note.1)).collect() };
                assert_eq!(starts(&found), starts(&expected), "{case}");
            }
        }
    }
}

#[test]
fn branches_that_sound_together_are_voices_of_their_own() {
    // A stem, and at its end two branches at once, each with a twig at its middle.
    let definition =
        Definition { axiom: "FF[+FF[+F]F][-FF[-F]F]F".into(), angle: 30.0, iterations: 0, ..Definition::default() };
    let options = options(&[("time", "length")]);
    let heard = read(&file(&definition, &options).0);
    let starts = |track: &Vec<Sounded>| track.iter().map(|note| note.0[0] / 120).collect::<Vec<_>>();
    // The stem, and after its end a twig; the branches; the other twig.
    let mut tracks: Vec<_> = heard.tracks.iter().map(starts).collect();
    tracks.sort();
    assert_eq!(tracks, [vec![0, 1, 2, 4], vec![2, 3, 4], vec![2, 3, 4], vec![4]]);
    assert_eq!((heard.length, tune(&definition, &options).voices), (5 * 120, 5));
    // One after another, a voice waits while its branches sound.
    let heard = read(&file(&definition, &FileOptions::default()).0);
    let tracks: Vec<_> = heard.tracks.iter().map(starts).collect();
    assert_eq!(tracks, [vec![0, 1, 10], vec![2, 3, 5, 6, 7, 9], vec![4, 8]]);
}

#[test]
fn the_part_that_is_heard_is_told() {
    let hilbert = definition("curves/hilbert", 40);
    let (bytes, notes) = file(&hilbert, &FileOptions::default());
    assert_eq!(read(&bytes).tracks.concat().len(), 2_000);
    let told = notes.summary.unwrap();
    assert!(told.starts_with("2,000 notes in 1 voice, 4:10 min: lines at even distances, of 1,208,925,"), "{told}");
    let told = file(&hilbert, &options(&[("time", "length")])).1.summary.unwrap();
    assert_eq!(told, "1,023 notes in 1 voice, 2:08 min: all lines of generation 5, as later ones have too many");
    assert_eq!(
        file(&definition("curves/hilbert", 2), &FileOptions::default()).1.summary.unwrap(),
        "15 notes in 1 voice, 0:02 min"
    );
}

#[test]
fn drawings_without_lines_have_a_file_without_notes() {
    let definition = Definition { axiom: "f".into(), ..Definition::default() };
    let heard = read(&file(&definition, &FileOptions::default()).0);
    assert_eq!((heard.tracks.len(), heard.length), (0, 0));
}
