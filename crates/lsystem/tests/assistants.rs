//! The cases of `docs/assistants.md`, the notation in one page.

use lsystem::{Definition, Figure, Limits, System, expand};

/// A block of the page: the system, the string, and the number of lines if it is named.
fn read(block: &str) -> (Definition, String, Option<String>) {
    let mut definition = Definition { angle: 25.0, ..Definition::default() };
    let (mut string, mut lines) = (String::new(), None);
    for line in block.lines() {
        match line.split_once(": ") {
            Some(("axiom", axiom)) => definition.axiom = axiom.to_owned(),
            Some(("n", n)) => definition.iterations = n.parse().unwrap(),
            Some(("seed", seed)) => definition.seed = seed.parse().unwrap(),
            Some(("angle", angle)) => definition.angle = angle.parse().unwrap(),
            Some(("string", expected)) => string = expected.to_owned(),
            Some(("lines", count)) => lines = Some(count.to_owned()),
            _ => definition.rules += &format!("{line}\n"),
        }
    }
    (definition, string, lines)
}

#[test]
fn the_cases_of_the_page_are_right() {
    let page = include_str!("../../../docs/assistants.md");
    let blocks: Vec<_> = page.split("```text\n").skip(1).map(|part| part.split_once("```").unwrap().0).collect();
    assert_eq!(blocks.len(), 5);
    for block in blocks {
        let (definition, string, lines) = read(block);
        let system = System::new(&definition).unwrap_or_else(|problems| panic!("{block}: {problems:?}"));
        assert_eq!(system.warnings, [], "{block}");
        let n = definition.iterations;
        assert_eq!(expand(&system, n, &Limits::default()).as_deref(), Ok(&*string), "{block}");
        if let Some(lines) = lines {
            let figure = Figure::draw(&system, n, &Limits::default()).unwrap();
            assert_eq!(figure.segment_count().to_string(), lines, "{block}");
        }
    }
}
