//! Programs that derive and draw a system themselves: their data, in the syntax that JavaScript and Python share.

use super::Refusal;
use super::object::quoted;
use super::source::{Need, Source};
use core::fmt::Write;
use lsystem_base::number::number;
use lsystem_base::say;
use lsystem_syntax::{Action, Module, Pattern, Seen, Vocabulary};

/// The parts of systems that the programs express.
pub(super) const SPEAKS: &[Need] = &[
    Need::Contexts,
    Need::Chance,
    Need::BranchLengths,
    Need::Acts(Vocabulary::Scaling),
    Need::Acts(Vocabulary::SwappedTurns),
    Need::OpenBranches,
];

/// The data of a program.
pub(super) struct Data {
    axiom: String,
    /// Members of an object: symbols and successors, or lists of weights and successors. Empty if there are contexts.
    rules: Vec<String>,
    /// Lists of a left context, a symbol, a right context and a successor, in the order in which they are tried.
    pub(super) in_context: Vec<String>,
    /// The symbols that contexts see, and whether the list has the symbols that they do not see.
    pub(super) seen: (String, bool),
    /// Members of an object: symbols and lists of commands with numbers.
    actions: Vec<String>,
    pub(super) is_random: bool,
}

impl Data {
    pub(super) fn new(source: &Source<'_>, label: &str) -> Result<Self, Refusal> {
        let word = |modules: &[Module]| modules.iter().map(|module| module.symbol).collect::<String>();
        let has_contexts = source.needs(Need::Contexts);
        let is_random = source.needs(Need::Chance);
        if has_contexts && is_random {
            return Err(Refusal(say!("{} cannot express random productions with contexts", label)));
        }
        let mut rules = Vec::new();
        for rule in source.plain_rules().iter().filter(|_| !has_contexts) {
            let successors: Vec<String> = match rule.successors.as_slice() {
                [(_, only)] => vec![quoted(&word(only))],
                several => several
                    .iter()
                    .map(|(weight, successor)| format!("[{}, {}]", number(*weight), quoted(&word(successor))))
                    .collect(),
            };
            let value = successors.join(", ");
            let value = if rule.successors.len() > 1 { format!("[{value}]") } else { value };
            rules.push(format!("{}: {value}", quoted(&rule.symbol.to_string())));
        }
        let mut in_context = Vec::new();
        for rule in source.grammar.productions.iter().filter(|_| has_contexts) {
            let context = |list: &[Pattern]| quoted(&list.iter().map(|own| own.symbol).collect::<String>());
            if rule.right.iter().any(|own| "[]".contains(own.symbol)) {
                return Err(Refusal(say!("{} cannot express branches in contexts", label)));
            }
            let symbol = quoted(&rule.predecessor.symbol.to_string());
            let (left, right, successor) = (context(&rule.left), context(&rule.right), quoted(&word(&rule.successor)));
            in_context.push(format!("[{left}, {symbol}, {right}, {successor}]"));
        }
        let swaps = source.needs(Need::Acts(Vocabulary::SwappedTurns));
        if swaps && source.right_angle() != source.definition.angle {
            return Err(Refusal(say!("{} cannot swap turns by two angles", label)));
        }
        let mut actions = Vec::new();
        for symbol in &source.symbols {
            let commands: Vec<String> = symbol.shape().iter().filter_map(|action| command(source, *action)).collect();
            if !commands.is_empty() {
                actions.push(format!("{}: [{}]", quoted(&symbol.symbol.to_string()), commands.join(", ")));
            }
        }
        let seen = match &source.grammar.seen {
            Seen::All => (String::new(), true),
            Seen::Except(list) => (list.iter().collect(), true),
            Seen::Only(list) => (list.iter().collect(), false),
        };
        Ok(Self { axiom: quoted(&word(&source.grammar.axiom)), rules, in_context, seen, actions, is_random })
    }
}

impl Data {
    /// The constants of a program: `comment` begins a comment, `set` a constant, and `end` ends one.
    pub(super) fn constants(&self, source: &Source<'_>, [comment, set, end]: [&str; 3]) -> String {
        let mut text = format!("{set}AXIOM = {}{end}\n", self.axiom);
        if self.in_context.is_empty() {
            if self.is_random {
                let _ = writeln!(text, "{comment} Several successors have weights: one is chosen at random.");
            }
            let _ = writeln!(text, "{set}SUCCESSORS = {{\n{}}}{end}", lines(&self.rules));
        } else {
            let (see, name) = if self.seen.1 { ("do not see", "IGNORED") } else { ("see", "CONSIDERED") };
            let fits = "Left context, symbol, right context, successor. The first that fits is applied.";
            let _ = writeln!(text, "{comment} {fits}\n{set}SUCCESSORS = [\n{}]{end}", lines(&self.in_context));
            let _ = writeln!(
                text,
                "{comment} The symbols that contexts {see}.\n{set}{name} = {}{end}",
                quoted(&self.seen.0)
            );
        }
        let (heading, gap) = (number(source.definition.heading), if end.is_empty() { "  " } else { " " });
        let _ = writeln!(text, "{set}ITERATIONS = {}{end}", source.definition.iterations);
        let _ = writeln!(text, "{set}HEADING = {heading}{end}{gap}{comment} degrees, counter-clockwise from the right");
        let _ = writeln!(text, "{comment} What the turtle does: lengths in steps, turns in degrees to the left.");
        let _ = writeln!(text, "{set}ACTIONS = {{\n{}}}{end}", lines(&self.actions));
        text
    }
}

/// A command with its number.
fn command(source: &Source<'_>, action: Action) -> Option<String> {
    let (name, value) = match action {
        Action::Draw(length) | Action::DrawUnmarked(length) => ("draw", source.length(length)),
        Action::Move(length) | Action::MoveUnmarked(length) => ("move", source.length(length)),
        Action::ScaleLength(factor) => ("scale", factor),
        Action::Push => ("push", source.definition.length_factor),
        Action::Pop => ("pop", 0.0),
        Action::SwapTurns => ("swap", 0.0),
        other => ("turn", source.turn(other)?),
    };
    Some(format!("[\"{name}\", {}]", number(value)))
}

/// Members of an object or elements of a list, one on each line.
fn lines(members: &[String]) -> String {
    members.iter().map(|member| format!("    {member},\n")).collect()
}
