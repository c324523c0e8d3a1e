//! The text form of anvaka's L-system page: see the reader in `anvaka.rs`.

use super::Refusal;
use super::source::{Source, plain_number};
use core::fmt::Write;
use lsystem_base::say;
use lsystem_syntax::{Action, Module};

/// The page's symbols.
const SYMBOLS: &str = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+_^?~|&*%[]-";
/// The symbols that act where the text gives no action.
const ACTING: &str = "Ff+-[]";

pub(super) fn write(source: &Source<'_>) -> Result<String, Refusal> {
    let mut taken: Vec<char> = Vec::new();
    let mut names: Vec<(char, char)> = Vec::new();
    let mut actions = String::new();
    let keeps =
        |symbol: char, shape: &[Action]| SYMBOLS.contains(symbol) && !(shape.is_empty() && ACTING.contains(symbol));
    let kept = source.symbols.iter().filter(|own| keeps(own.symbol, &own.shape())).map(|own| own.symbol);
    taken.extend(kept);
    for own in &source.symbols {
        let shape = own.shape();
        let mut name = own.symbol;
        if !keeps(name, &shape) {
            let free = SYMBOLS.chars().filter(|c| !ACTING.contains(*c)).find(|c| !taken.contains(c));
            name = free.ok_or_else(|| Refusal::new(say!("anvaka’s page has too few symbols")))?;
            taken.push(name);
        }
        names.push((own.symbol, name));
        let length = |length: Option<f64>| plain_number(10.0 * source.length(length));
        let action = match shape.as_slice() {
            [] => continue,
            [Action::Draw(own)] => format!("draw({})", length(*own)),
            [Action::Move(own)] => format!("move({})", length(*own)),
            [Action::Push] => "push()".into(),
            [Action::Pop] => "pop()".into(),
            [turn] if source.turn(*turn).is_some() => {
                format!("rotate({})", plain_number(source.turn(*turn).unwrap_or_default()))
            }
            _ => {
                let symbol = own.symbol;
                return Err(Refusal(say!("On anvaka’s page a symbol has one action, and `{}` has several", symbol)));
            }
        };
        let _ = writeln!(actions, "  {name} => {action}");
    }
    // In the order of the sorted symbols.
    let name = |symbol: char| names.binary_search_by_key(&symbol, |(own, _)| *own).map_or(symbol, |at| names[at].1);
    let word = |modules: &[Module]| modules.iter().map(|module| name(module.symbol)).collect::<String>();
    let mut text = String::new();
    let title = source.title(&[]);
    if !title.is_empty() {
        let _ = writeln!(text, "// {title}");
    }
    let _ = writeln!(text, "axiom: {}\nrules:", word(&source.grammar.axiom));
    let rules = source.plain_rules();
    for rule in &rules {
        let successor = rule.successors.first().map_or(String::new(), |(_, successor)| word(successor));
        let _ = writeln!(text, "  {} => {successor}", name(rule.symbol));
    }
    // The page needs a rule.
    if let (true, Some(own)) = (rules.is_empty(), source.symbols.first()) {
        let name = name(own.symbol);
        let _ = writeln!(text, "  {name} => {name}");
    }
    let definition = source.definition;
    let _ = writeln!(text, "depth: {}\nangle: {}", definition.iterations, plain_number(definition.angle));
    let [x, y] = direction(definition.heading);
    let _ = writeln!(text, "direction: [{}, {}, 0]", plain_number(x), plain_number(y));
    let _ = write!(text, "actions:\n{actions}");
    Ok(text)
}

/// The direction of a heading.
fn direction(heading: f64) -> [f64; 2] {
    let (x, y) = lsystem_syntax::Heading::from_degrees(heading).cos_sin();
    // Without the signs of zeros.
    [x + 0.0, y + 0.0]
}
