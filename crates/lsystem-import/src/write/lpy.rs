//! The files of L-Py, with arrow rules and rules of Python with conditions.

use super::Refusal;
use super::cpfg::File;
use super::expression::PYTHON;
use super::source::{Need, Source};
use super::symbol_words::Kind;
use core::fmt::Write;
use lsystem_base::number::number;
use lsystem_syntax::Vocabulary;

/// The parts of systems that L-Py expresses.
pub(super) const SPEAKS: &[Need] = &[
    Need::Contexts,
    Need::Parameters,
    Need::Conditions,
    Need::Images,
    Need::Space,
    Need::Acts(Vocabulary::Cuts),
    Need::Queries,
];

pub(super) fn write(source: &Source<'_>) -> Result<String, Refusal> {
    let file = File::new(source, Kind::LPy)?;
    let mut text = String::new();
    for constant in file.constants() {
        let _ = writeln!(text, "{} = {}", constant.name, number(constant.value));
    }
    text.push_str(&file.seen()?);
    let _ = writeln!(text, "Axiom: {}", file.axiom()?);
    let _ = writeln!(text, "derivation length: {}\nproduction:", source.definition.iterations);
    file.productions("interpretation:", &mut text)?;
    text.push_str("endlsystem\n");
    let title = source.title(&[]);
    let title = if title.is_empty() { title } else { format!("# {title}\n") };
    let calls = |name: &str| text.contains(&format!("{name}("));
    let import = if PYTHON.iter().any(|(_, name)| calls(name)) { "from math import *\n" } else { "" };
    Ok([&title, import, &text].concat())
}
