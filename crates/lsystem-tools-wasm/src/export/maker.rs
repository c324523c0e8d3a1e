//! Files of systems.

use lsystem_drawing::System;
use lsystem_files::{FileLimits, FileOptions, FileTask, FileView, Format, Notes, Owner, Sink};
use lsystem_syntax::{Definition, Halt, Problem, problems};

/// The file to make.
pub(crate) struct Order {
    pub(crate) definition: Definition,
    pub(crate) format: &'static Format,
    /// The choices of the reader.
    pub(crate) options: FileOptions,
    pub(crate) view: FileView,
}

/// The report on a file.
#[derive(Debug)]
pub(crate) struct Report {
    /// Whether the whole file was written.
    pub(crate) complete: bool,
    /// The reasons why there is no file, or remarks about it.
    pub(crate) diagnostics: Vec<Problem>,
}

/// What writes a file.
pub(crate) type Writer = fn(&FileTask<'_>, &mut Sink<'_>) -> Result<Notes, Halt>;

/// Makes a file. A definition with errors has none.
pub(crate) fn make(order: &Order, write: Writer, owner: &mut dyn Owner) -> Report {
    let Order { definition, format, options, view } = order;
    let system = match System::new(definition) {
        Ok(system) => system,
        Err(wrong) => return Report { complete: false, diagnostics: problems(&wrong.0, definition, "") },
    };
    let task = FileTask { definition, system: &system, format, options, view: view.clone(), limits: FileLimits::PAGE };
    let (complete, remarks) = match Sink::to(owner, |sink| write(&task, sink)) {
        Ok(notes) => (true, notes.remark),
        Err(halt) => (false, Some(halt.diagnostic())),
    };
    Report { complete, diagnostics: problems(remarks.as_slice(), definition, "") }
}

#[cfg(test)]
mod tests {
    use super::*;
    use lsystem_files::FORMATS;

    fn order(format: &str, definition: Definition) -> Order {
        let format = Format::named(format).unwrap();
        let view = FileView { is_described: true, ..FileView::default() };
        Order { definition, format, options: FileOptions::default(), view }
    }

    /// The whole file, and its largest piece.
    #[derive(Default)]
    struct Pieces(Vec<u8>, usize);

    impl Owner for Pieces {
        fn piece(&mut self, bytes: &[u8]) -> Result<(), Halt> {
            self.0.extend(bytes);
            self.1 = self.1.max(bytes.len());
            Ok(())
        }
    }

    fn finish(order: &Order) -> (Report, Vec<u8>, usize) {
        let mut pieces = Pieces::default();
        let report = make(order, lsystem_files::make, &mut pieces);
        (report, pieces.0, pieces.1)
    }

    fn weed(n: u32) -> Definition {
        Definition {
            axiom: "F".into(),
            rules: "F -> F[+F]F[-F]F".into(),
            angle: 25.7,
            iterations: n,
            ..Definition::default()
        }
    }

    #[test]
    fn every_format_is_made_of_systems_in_the_plane_and_in_space() {
        let bent = Definition { rules: "F -> F[&F]F[-F]F".into(), ..weed(3) };
        for definition in [weed(3), bent] {
            // TikZ's library has no symbols for space.
            let says_it = |format: &&Format| format.name != "tikz-library" || !definition.rules.contains('&');
            for format in FORMATS.iter().filter(says_it) {
                let (maker, file, _) = finish(&order(format.name, definition.clone()));
                assert!(maker.complete && !file.is_empty(), "{} {:?}", format.name, maker.diagnostics);
            }
        }
    }

    #[test]
    fn large_files_are_taken_in_small_pieces() {
        for (format, n) in [("csv", 8), ("svg", 8), ("txt", 9), ("obj", 6)] {
            let (maker, file, largest) = finish(&order(format, weed(n)));
            assert!(maker.complete && file.len() > 3_000_000, "{format}: {}", file.len());
            assert!(largest < 1 << 20, "{format}: {largest}");
        }
    }

    #[test]
    fn limits_and_errors_are_told_and_no_file_is_complete() {
        let large = Definition { rules: "F -> FF : 1\nF -> F[+F] : 1".into(), ..weed(40) };
        let wrong = Definition { rules: "F = FF".into(), ..weed(2) };
        for (format, definition) in
            [("svg", weed(20)), ("txt", weed(40)), ("glb", weed(20)), ("csv", large), ("json", wrong)]
        {
            let (maker, _, _) = finish(&order(format, definition));
            assert!(!maker.complete && !maker.diagnostics.is_empty(), "{format}");
        }
    }

    #[test]
    fn pictures_have_a_description_and_their_system_unless_it_is_left_out() {
        for bare in [false, true] {
            // 5^60 segments exceed 128 bits.
            for (format, n) in [("svg", 2), ("svg-compact", 60)] {
                let (maker, file, _) = finish(&Order {
                    options: FileOptions { bare, ..FileOptions::default() },
                    ..order(format, weed(n))
                });
                let text = String::from_utf8(file).unwrap();
                assert!(maker.complete && text.contains("<desc"), "{format}");
                assert_eq!(text.contains("F[+F]F[-F]F"), !bare, "{format}");
            }
        }
    }
}
