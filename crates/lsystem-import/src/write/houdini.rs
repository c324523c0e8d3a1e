//! The rule lines of Houdini's L-system node: see the reader in `houdini.rs`.

use super::Refusal;
use super::expression::{Arithmetic, COMMON};
use super::source::{Need, Source, plain_number};
use super::spelling::{Alphabet, Spelling};
use core::fmt::Write;
use lsystem_base::number::number;
use lsystem_base::say;
use lsystem_syntax::grammar::Values;
use lsystem_syntax::{Action, Expr, Module, Pattern, Production, Seen, Vocabulary};

/// The parts of systems that Houdini expresses.
pub(super) const SPEAKS: &[Need] =
    &[Need::Contexts, Need::Parameters, Need::Conditions, Need::Chance, Need::Space, Need::Acts(Vocabulary::Scaling)];

/// Names of parameters that are no variables of Houdini.
const PARAMETERS: &str = "hjklmnopqrsef";

pub(super) fn write(source: &Source<'_>) -> Result<String, Refusal> {
    let definition = source.definition;
    let angle = definition.angle;
    // Angles of the actions, with the symbols that turn by them.
    let turn = |action: Action| -> Option<(f64, char)> {
        let down = definition.pitch_down;
        let roll = definition.roll_left;
        Some(match action {
            Action::TurnLeft(own) => (own.unwrap_or(angle), '-'),
            Action::TurnRight(own) => (own.unwrap_or(source.right_angle()), '+'),
            Action::PitchDown(own) => (own.or(down).unwrap_or(angle), '^'),
            Action::PitchUp(own) => (own.or(definition.pitch_up).or(down).unwrap_or(angle), '&'),
            Action::RollLeft(own) => (own.or(roll).unwrap_or(angle), '/'),
            Action::RollRight(own) => (own.or(definition.roll_right).or(roll).unwrap_or(angle), '\\'),
            _ => return None,
        })
    };
    let own = |action: Action| match turn(action) {
        _ if action == Action::TurnRound => "|",
        Some((by, '-')) if by == angle => "-",
        Some((by, '+')) if by == angle => "+",
        Some((by, '^')) if by == angle => "^",
        Some((by, '&')) if by == angle => "&",
        Some((by, '/')) if by == angle => "/",
        Some((by, '\\')) if by == angle => "\\",
        _ => "",
    };
    let line = |letter: char, length: f64| format!("{letter}({})", plain_number(length));
    let code = |action: Action| match action {
        Action::Draw(length) => Some(line('F', source.length(length))),
        Action::Move(length) => Some(line('f', source.length(length))),
        Action::ScaleLength(factor) => Some(format!("\"({})", plain_number(factor))),
        Action::TurnRound => Some("|".to_owned()),
        other => {
            let (by, symbol) = turn(other)?;
            Some(if by == angle { symbol.to_string() } else { format!("{symbol}({})", plain_number(by)) })
        }
    };
    let alphabet = Alphabet {
        label: "Houdini",
        idle: "XYZABCDEILNOPQRSUVWabcdeijklmnopqrsuvwxyz",
        is_upper: false,
        steps: ["FG", "f"],
        own: &own,
        code: &code,
        mortal: "Ff",
        fixed: "[]",
    };
    let spelling = Spelling::new(source, &alphabet)?;
    let writer = Writer { source, spelling: &spelling, values: source.grammar.values() };
    let none: &[Pattern] = &[];
    let mut text = String::new();
    let heading = definition.heading - 90.0;
    let start = if heading == 0.0 { String::new() } else { format!("-({})", plain_number(heading)) };
    if !spelling.stays(source, &start) {
        return Err(Refusal::new(say!("Houdini starts upwards, and productions look at the turns")));
    }
    let _ = writeln!(text, "Premise: {start}{}", writer.word(&source.grammar.axiom, none)?);
    match &source.grammar.seen {
        Seen::All => {}
        Seen::Except(list) => {
            let list: String = list.iter().map(|symbol| spelling.word_of(*symbol)).collect();
            let _ = writeln!(text, "Context Ignore: {list}");
        }
        Seen::Only(_) => return Err(Refusal::new(say!("Houdini cannot list the only symbols that contexts see"))),
    }
    let mut rules = Vec::new();
    for rule in &source.grammar.productions {
        rules.push(writer.rule(rule)?);
    }
    rules.extend(spelling.repeated.iter().map(|(name, word)| format!("{name}={word}")));
    rules.extend(spelling.vanishing.iter().map(|name| format!("{name}=")));
    // A node needs a rule.
    if rules.is_empty() {
        rules.push("X=X".to_owned());
    }
    for (at, rule) in rules.iter().enumerate() {
        let _ = writeln!(text, "Rule {}: {rule}", at + 1);
    }
    let _ = writeln!(text, "Angle: {}\nGenerations: {}", plain_number(angle), definition.iterations);
    if source.needs(Need::Chance) {
        let _ = writeln!(text, "Random Seed: {}", definition.seed);
    }
    Ok(text)
}

struct Writer<'a> {
    source: &'a Source<'a>,
    spelling: &'a Spelling,
    values: Values<'a>,
}

impl Writer<'_> {
    fn rule(&self, rule: &Production) -> Result<String, Refusal> {
        let patterns: Vec<Pattern> = rule.patterns().cloned().collect();
        let names = parameters(&patterns)?;
        let context = |list: &[Pattern]| -> Result<String, Refusal> {
            list.iter().map(|own| self.pattern(own, &names)).collect()
        };
        let mut text = String::new();
        if !rule.left.is_empty() {
            text = format!("{}<", context(&rule.left)?);
        }
        text.push_str(&self.pattern(&rule.predecessor, &names)?);
        if !rule.right.is_empty() {
            text.push('>');
            text.push_str(&context(&rule.right)?);
        }
        if let Some(condition) = &rule.condition {
            text.push(':');
            text.push_str(&self.expression(condition, &names)?);
        }
        text.push('=');
        text.push_str(&self.word(&rule.successor, &patterns)?);
        if let Some(weight) = &rule.weight {
            let value = self.values.value(weight);
            let value =
                value.ok_or_else(|| Refusal::new(say!("Houdini cannot express probabilities with parameters")))?;
            text.push(':');
            text.push_str(&number(value.max(0.0)));
        }
        Ok(text)
    }

    fn pattern(&self, pattern: &Pattern, names: &[(String, char)]) -> Result<String, Refusal> {
        let name = self.spelling.name_of(pattern.symbol);
        let own: Vec<String> = pattern.parameters.iter().map(|own| renamed(own, names).to_string()).collect();
        self.check(pattern.symbol, own.len())?;
        Ok(if own.is_empty() { name.to_string() } else { format!("{name}({})", own.join(",")) })
    }

    /// A word; `patterns` have the parameters of its production.
    fn word(&self, modules: &[Module], patterns: &[Pattern]) -> Result<String, Refusal> {
        let names = parameters(patterns)?;
        let mut text = String::new();
        for module in modules {
            text.push_str(self.spelling.word_of(module.symbol));
            self.check(module.symbol, module.arguments.len())?;
            for (at, argument) in module.arguments.iter().enumerate() {
                text.push(if at == 0 { '(' } else { ',' });
                text.push_str(&self.expression(argument, &names)?);
            }
            if !module.arguments.is_empty() {
                text.push(')');
            }
        }
        Ok(text)
    }

    /// Checks that a symbol may have so many arguments: they mean the same in Houdini.
    fn check(&self, symbol: char, arguments: usize) -> Result<(), Refusal> {
        if arguments == 0 {
            return Ok(());
        }
        let own = self.source.symbol(symbol);
        let is_single = self.spelling.word_of(symbol).chars().count() == 1;
        // The number of a look may come first.
        let actions = own.map_or(&[][..], |own| &own.actions);
        let is_numbered = actions.is_empty() || actions.iter().all(|action| action.is_look()) || actions.len() == 1;
        // Lengths are in steps in Houdini.
        let is_length = matches!(actions, [Action::Draw(_) | Action::Move(_)]) && self.source.definition.step != 1.0;
        let is_moved = actions.len() == 1 && own.is_some_and(|own| own.shape().len() == 1);
        let is_wide = is_moved && arguments > 1;
        if is_single && is_numbered && !is_length && !is_wide {
            return Ok(());
        }
        Err(Refusal(say!("Houdini cannot express `{}` with these arguments", symbol)))
    }

    fn expression(&self, expr: &Expr, names: &[(String, char)]) -> Result<String, Refusal> {
        let value = |name: &str| match names.iter().any(|(own, _)| own == name) {
            true => renamed(name, names).to_string(),
            false => self.values.of(name).map_or_else(|| name.to_owned(), number),
        };
        Arithmetic { label: "Houdini", name: &value, functions: COMMON, curve: &|_, _| None, is_python: false }
            .write(expr)
    }
}

/// Names for the parameters of a production.
fn parameters(patterns: &[Pattern]) -> Result<Vec<(String, char)>, Refusal> {
    let own = patterns.iter().flat_map(|pattern| &pattern.parameters);
    let mut names: Vec<(String, char)> = Vec::new();
    for name in own {
        let keeps = |c: &char| name.len() == 1 && name.starts_with(*c);
        let is_free = |c: &char| names.iter().all(|(_, taken)| taken != c);
        let found = PARAMETERS.chars().find(|c| keeps(c) && is_free(c));
        let found = found.or_else(|| PARAMETERS.chars().find(is_free));
        let found = found.ok_or_else(|| Refusal::new(say!("Houdini has too few names for parameters")))?;
        names.push((name.clone(), found));
    }
    Ok(names)
}

fn renamed(name: &str, names: &[(String, char)]) -> char {
    names.iter().find(|(own, _)| own == name).map_or('h', |(_, renamed)| *renamed)
}
