//! Files of every format with any choices, also those at the ends of their ranges.

use crate::{Gauge, Source, make};
use lsystem::Limits;
use lsystem::files::{FILE_OPTIONS, FORMATS, FileLimits, FileOptions, FileTask, FileView, OptionKind, OptionValue};
use std::collections::BTreeMap;

/// The most segments of a file in this target.
const MAX: u64 = 5_000;
/// The most parts of a file, of about 16,384 units of work each.
const PARTS: usize = 400;
/// The most pixels of a picture in this target.
const MAX_PIXELS: u64 = 1 << 18;

/// A file of a random format, with random options.
pub(super) fn formats(source: &mut Source<'_>, gauge: &mut Gauge) {
    let Some((definition, system)) = make::system(source) else { return };
    let format = &FORMATS[source.below(FORMATS.len())];
    let values = values(source, format.options);
    let options = FileOptions::from_values(&values).expect("values within their ranges");
    source.show(format_args!("{format:?} {values:?}"));
    let [width, height] = options.size.unwrap_or([1024, 1024]).map(u64::from);
    if width * height > MAX_PIXELS && format.options.contains(&"size") {
        return;
    }
    gauge.allow(64 * MAX_PIXELS as usize);
    let drawing = make::limits(source);
    let limits = FileLimits {
        drawing,
        drawing_bytes: drawing.memory,
        string: Limits { memory: 32 << 20, ..drawing },
        remembers: source.once_in(2),
        segments: MAX,
        held: MAX,
        mesh: [MAX, 32 << 20],
        band: source.pick(&[1 << 22, 1, 1000]),
    };
    let view = FileView { is_described: source.once_in(2), ..FileView::default() };
    let task = FileTask { definition: &definition, system: &system, format, options: &options, view, limits };
    let written = gauge.file(format.name, PARTS, |sink| lsystem::files::make(&task, sink));
    let Ok((bytes, _)) = written else { return gauge.reach("refused") };
    gauge.reach(format.name);
    assert!(!bytes.is_empty() || format.name == "string", "an empty file");
    if bytes.starts_with(b"\x89PNG") {
        let mut reader = png::Decoder::new(std::io::Cursor::new(&bytes)).read_info().expect("a PNG");
        let mut pixels = vec![0; reader.output_buffer_size().expect("a small picture")];
        let frame = reader.next_frame(&mut pixels).expect("a whole PNG");
        let size = options.size.unwrap_or([frame.width, frame.height]);
        assert_eq!([frame.width, frame.height], size, "the size of the picture");
    }
}

/// Values for some of these options.
fn values(source: &mut Source<'_>, names: &[&str]) -> BTreeMap<String, OptionValue> {
    let mut values = BTreeMap::new();
    for option in FILE_OPTIONS.iter().filter(|option| names.contains(&option.name)) {
        if option.name != "size" && !source.once_in(2) {
            continue;
        }
        let text = |words: String| OptionValue::Text(words);
        let value = match option.kind {
            OptionKind::Flag => OptionValue::Flag(source.once_in(2)),
            OptionKind::Number { low, high, default, .. } => {
                OptionValue::Number(source.pick(&[low, high, default, low + (high - low) * 0.37]))
            }
            OptionKind::Word { words, .. } => text(words[source.below(words.len())].0.to_owned()),
            OptionKind::Size => {
                let side = |source: &mut Source<'_>| source.pick(&[1, 2, 7, 64, 300, 32_768]);
                text(format!("{}x{}", side(source), side(source)))
            }
            OptionKind::Sheet { words, low, high, .. } => match source.below(3) {
                0 => text(format!("{low}x{high}")),
                1 => text(format!("{low}x{low}")),
                _ => text(words[source.below(words.len())].0.to_owned()),
            },
        };
        if option.admits(&value) {
            values.insert(option.name.to_owned(), value);
        }
    }
    values
}
