//! Strings, as a whole and page by page, and counts.

use crate::opened::{LIMITS, OpenSystem, Refusal};
use lsystem_base::{LimitName, Progress};
use lsystem_derive::History;
use lsystem_drawing::{Figure, System, count_segments, count_symbols};
use lsystem_syntax::{Diagnostic, print_module};

/// The symbols of a page.
const PAGE: usize = 1 << 15;

pub(crate) fn expand(open: &OpenSystem) -> Result<String, Refusal> {
    lsystem_drawing::expand(&open.system, open.n(), &LIMITS).map_err(|limit| open.exceeds(&limit))
}

/// The numbers of symbols and of segments: added up by the rules, or else from the drawing, or else by derivation.
pub(crate) fn count(open: &OpenSystem) -> Result<[String; 2], Refusal> {
    let (system, n) = (&open.system, open.n());
    let summed = count_symbols(system, n).zip(count_segments(system, n));
    if let Some((symbols, segments)) = summed {
        return Ok([symbols, segments].map(|count| count.to_string()));
    }
    let figure = Figure::draw(system, n, &LIMITS);
    let drawn = figure.ok().and_then(|figure| Some([figure.symbol_count()?.into(), figure.turtle_segments()]));
    if let Some(counts) = drawn {
        return Ok(counts.map(|count: u128| count.to_string()));
    }
    let history = derive(open)?;
    let symbols = history.symbols(n).unwrap_or(0);
    Ok([symbols, history.segments_before(symbols).unwrap_or(0)].map(|count| count.to_string()))
}

/// The derivation up to the shown generation.
fn derive(open: &OpenSystem) -> Result<History, Refusal> {
    let (n, limit) = (open.n(), |largest| open.exceeds(&Diagnostic::limit(LimitName::Memory, LIMITS.memory, largest)));
    let mut history = open.system.history(n, &LIMITS).ok_or_else(|| limit(None))?;
    while history.step(1 << 20) == Progress::More {}
    if history.is_complete() {
        return Ok(history);
    }
    Err(limit((0..n).rev().find(|&n| history.symbols(n).is_some())))
}

/// A reader of a string that never holds the whole of it.
#[derive(Debug)]
pub(crate) struct SymbolPages {
    system: System,
    n: u32,
    /// `None` if the string is read by counts.
    history: Option<History>,
    at: u128,
}

impl SymbolPages {
    pub(crate) fn new(open: &OpenSystem) -> Result<Self, Refusal> {
        let history = if open.system.word(open.n()).is_some() { None } else { Some(derive(open)?) };
        Ok(Self { system: open.system.clone(), n: open.n(), history, at: 0 })
    }

    /// Whether each symbol ends with a line end.
    pub(crate) fn is_apart(&self) -> bool {
        !self.system.rules.is_plain()
    }

    /// The next symbols; empty at the end.
    pub(crate) fn next_page(&mut self) -> String {
        let (apart, start, mut text) = (self.is_apart(), self.at, String::new());
        let mut visit = |symbol: char, arguments: &[f64]| {
            self.at = self.at.saturating_add(1);
            if apart {
                print_module(symbol, arguments, &mut text);
                text.push('\n');
            } else {
                text.push(symbol);
            }
        };
        match (&self.history, self.system.word(self.n)) {
            (Some(history), _) => history.modules(self.n, start, PAGE, &mut visit),
            (None, Some(word)) => word.modules(start, PAGE, &mut visit),
            (None, None) => {}
        }
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn open(json: &str) -> OpenSystem {
        OpenSystem::read(json, None).unwrap()
    }

    const PLAIN: &str = r#"{"axiom": "F", "rules": "F -> F[+F]F", "angle": 20, "iterations": 9}"#;
    const CHANCE: &str = r#"{"axiom": "F", "rules": "F -> F[+F]F : 1\nF -> FF : 1", "iterations": 9, "seed": 3}"#;
    const CONTEXT: &str = r#"{"axiom": "AF", "rules": "A < F -> FA\nF -> FF", "iterations": 9}"#;

    #[test]
    fn pages_together_are_the_string() {
        for json in [PLAIN, CHANCE, CONTEXT] {
            let open = open(json);
            let mut pages = SymbolPages::new(&open).unwrap();
            let mut text = String::new();
            loop {
                let page = pages.next_page();
                if page.is_empty() {
                    break;
                }
                text += &page;
            }
            let string = text.replace('\n', "");
            assert!(string == expand(&open).unwrap() && pages.is_apart() == (text != string), "{json}");
            assert_eq!(count(&open).unwrap()[0], string.chars().count().to_string(), "{json}");
        }
        let tree = open(r#"{"axiom": "A(1)", "rules": "A(l) -> F(l)[+A(l*0.5)]", "iterations": 1}"#);
        let mut pages = SymbolPages::new(&tree).unwrap();
        assert_eq!((pages.is_apart(), pages.next_page()), (true, "F(1)\n[\n+\nA(0.5)\n]\n".to_owned()));
        assert_eq!(pages.next_page(), "");
    }

    #[test]
    fn counts_have_no_limit() {
        let many = open(r#"{"axiom": "F", "rules": "F -> F[+F]F", "iterations": 200}"#);
        let [symbols, segments] = count(&many).unwrap();
        assert!(symbols.len() > 90 && segments.len() == 96, "{symbols} {segments}");
        assert_eq!(count(&open(CHANCE)).unwrap()[1], {
            let text = expand(&open(CHANCE)).unwrap();
            text.matches('F').count().to_string()
        });
        assert!(expand(&many).unwrap_err().message.contains("67,108,864"));
        let chance = open(&CHANCE.replace("\"iterations\": 9", "\"iterations\": 99"));
        assert!(count(&chance).is_err() && SymbolPages::new(&chance).is_err());
    }

    #[test]
    fn the_start_of_a_string_without_end_is_read() {
        let many = open(r#"{"axiom": "F", "rules": "F -> F[+F]F", "iterations": 1000}"#);
        let mut pages = SymbolPages::new(&many).unwrap();
        let first = pages.next_page();
        assert!(first.starts_with("F[+F]F[+F[+F]F]") && pages.next_page() != first);
    }
}
