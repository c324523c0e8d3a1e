//! Systems as declarations of TikZ's library `lindenmayersystems`, where it can express them.
//!
//! The library has letters, `F f + - [ ]`, an angle for each side, a step and an order. It expands and draws while TeX
//! runs, so that the file is short.

use super::bibtex::slug;
use super::figure::{Figure, lengths};
use super::tikz::title;
use crate::svg::warning;
use crate::{FileOptions, Notes, Sink};
use core::fmt::Write;
use lsystem_base::number::number;
use lsystem_base::words::said;
use lsystem_base::{Limits, say, word};
use lsystem_drawing::{Drawer, Drawing, Plane, System, expand};
use lsystem_syntax::{Action, ColourBy, Definition, Diagnostic, Grammar, Halt, Heading, Module, run_steps};

/// The limits of a drawing by TeX, which draws some thousand symbols in a second.
const LIMITS: Limits =
    Limits { symbols: 100_000, modules: 1 << 20, segments: 100_000, work: 2_000_000, memory: 64 << 20 };
/// The most branches in branches. TeX has at most 255 groups, and needs some for the document.
const DEEPEST: usize = 200;

/// The library's own symbols and their codes.
const OWN: [(char, &str); 6] = [
    ('F', "\\pgflsystemdrawforward"),
    ('f', "\\pgflsystemmoveforward"),
    ('+', "\\pgflsystemturnleft"),
    ('-', "\\pgflsystemturnright"),
    ('[', "\\pgflsystemsavestate"),
    (']', "\\pgflsystemrestorestate"),
];

/// Writes the declaration of a definition's system, and a picture with its drawing.
///
/// # Errors
/// If the library cannot express the system, and [`Kind::Limit`](lsystem_syntax::Kind::Limit) if TeX would take too long.
pub fn write_tikz_library(
    definition: &Definition,
    system: &System,
    options: &FileOptions,
    sink: &mut Sink<'_>,
) -> Result<Notes, Halt> {
    if let Some(obstacle) = obstacle(definition, system) {
        return Err(lacking(&obstacle).into());
    }
    let codes = codes(system).map_err(|obstacle| lacking(&obstacle))?;
    let word = expand(system, definition.iterations, &LIMITS)?;
    check_branches(system, &word).map_err(|obstacle| lacking(&obstacle))?;
    let mut drawer = Drawer::<Plane>::new(system, definition.iterations, LIMITS);
    run_steps(sink, |units| drawer.step(units))?;
    let drawing = drawer.finish()?;
    let mut grammar = system.grammar.clone();
    // Rules that never apply may have symbols that TeX cannot read.
    let reached = reached(system);
    grammar.productions.retain(|production| reached.contains(&production.predecessor.symbol));
    write_picture(definition, &grammar, &codes, &drawing, options, &mut sink.text);
    Ok(Notes { remark: warning(0, definition.style.ink), ..Notes::default() })
}

/// Writes the file. `codes` are those that differ from the library's.
fn write_picture(
    definition: &Definition,
    grammar: &Grammar,
    codes: &[(char, String)],
    drawing: &Drawing,
    options: &FileOptions,
    text: &mut String,
) {
    let figure = Figure::for_text(drawing, &options.sheet);
    let look = figure.start(drawing, &definition.style);
    let [r, g, b] = look.rgb;
    let name = slug(&definition.name);
    let name = if name.is_empty() { "l-system" } else { &name };
    text.push_str(&title(&options.title));
    text.push_str("% For documents with \\usepackage{tikz} and \\usetikzlibrary{lindenmayersystems}.\n");
    // Writing to a `String` cannot fail.
    let _ = writeln!(text, "\\pgfdeclarelindenmayersystem{{{name}}}{{");
    for (symbol, code) in codes {
        let _ = writeln!(text, "  \\symbol{{{symbol}}}{{{code}}}");
    }
    let mut known = Vec::new();
    for production in &grammar.productions {
        let symbol = production.predecessor.symbol;
        // Of several productions, the first one applies here and the last one in the library.
        if !known.contains(&symbol) {
            known.push(symbol);
            let _ = writeln!(text, "  \\rule{{{symbol} -> {}}}", symbols(&production.successor));
        }
    }
    let _ = writeln!(text, "}}\n\\begin{{tikzpicture}}\n\\definecolor{{stroke}}{{RGB}}{{{r},{g},{b}}}");
    text.push_str("\\draw[stroke,line cap=round,line join=round,line width=");
    lengths().write(text, look.width);
    let _ = write!(text, "mm,rotate={},\n  l-system={{{name}, ", degrees(definition.heading));
    let _ = write!(text, "axiom={{{}}}, order={}, ", symbols(&grammar.axiom), definition.iterations);
    let right = definition.right_angle.unwrap_or(definition.angle);
    if right == definition.angle {
        let _ = write!(text, "angle={}", degrees(right));
    } else {
        let _ = write!(text, "left angle={}, right angle={}", degrees(definition.angle), degrees(right));
    }
    text.push_str(", step=");
    lengths().write(text, figure.scale * definition.step);
    text.push_str("mm}] lindenmayer system;\n\\end{tikzpicture}\n");
}

/// The error for the first thing that the library lacks.
fn lacking(obstacle: &str) -> Diagnostic {
    Diagnostic::error(say!("TikZ's library lindenmayersystems has no {}", obstacle))
        .hint(say!("The TikZ picture holds any drawing, as paths."))
}

/// An angle in degrees that TeX can hold.
fn degrees(angle: f64) -> String {
    if angle.abs() <= 360.0 { number(angle) } else { number(Heading::from_degrees(angle).degrees()) }
}

fn symbols(modules: &[Module]) -> String {
    modules.iter().map(|module| module.symbol).collect()
}

/// The first thing that the library lacks, except for symbols and branches.
fn obstacle(definition: &Definition, system: &System) -> Option<String> {
    let grammar = &system.grammar;
    let productions = || grammar.productions.iter();
    let has_parameters = productions().any(|p| p.condition.is_some() || !p.predecessor.parameters.is_empty())
        || grammar.made().any(|module| !module.arguments.is_empty());
    let style = &definition.style;
    let is_one_colour = match style.colour_by {
        ColourBy::Single | ColourBy::Density | ColourBy::Symbol => true,
        ColourBy::Level | ColourBy::Turn | ColourBy::Generation | ColourBy::Path => style.palette.len() == 1,
    };
    let found = [
        (productions().any(lsystem_syntax::Production::is_context_sensitive), word!("contexts")),
        (has_parameters, word!("parameters and conditions")),
        (!grammar.images.is_empty(), word!("rules for drawing")),
        (system.is_stochastic(), word!("seeded random choices")),
        (!is_one_colour, word!("colours within one drawing")),
        (definition.length_factor != 1.0 || style.width_factor != 1.0, word!("widths or lengths by branch level")),
        (definition.elasticity != 0.0 || system.turtle.wind.is_some(), word!("tropism and sway")),
        (definition.growth != 1.0, word!("partly grown steps")),
    ];
    found.into_iter().find(|(is_found, _)| *is_found).map(|(_, obstacle)| said(obstacle))
}

/// The symbols that may occur.
fn reached(system: &System) -> Vec<char> {
    let letters = system.rules.letters.iter().zip(system.rules.reachable());
    letters.filter(|(_, is_reached)| *is_reached).map(|(letter, _)| letter.symbol).collect()
}

/// The codes that differ from the library's, of all symbols that may occur.
fn codes(system: &System) -> Result<Vec<(char, String)>, String> {
    let mut codes = Vec::new();
    let reachable = system.rules.reachable();
    for ((letter, actions), _) in
        system.rules.letters.iter().zip(&system.turtle.actions).zip(reachable).filter(|(_, reached)| *reached)
    {
        let symbol = letter.symbol;
        if !symbol.is_ascii_alphanumeric() && !"+-[]|".contains(symbol) {
            return Err(say!("symbol `{}`", symbol));
        }
        let code: Option<String> = actions.iter().map(|&action| code(action)).collect();
        let code = code.ok_or_else(|| say!("action for what `{}` does", symbol))?;
        let own = OWN.iter().find(|(own, _)| *own == symbol).map_or("", |(_, code)| *code);
        if code != own {
            codes.push((symbol, code));
        }
    }
    Ok(codes)
}

/// The code of an action; `None` if the library has none.
fn code(action: Action) -> Option<String> {
    let [draw, go, left, right, push, pop] = OWN.map(|(_, code)| code.to_owned());
    Some(match action {
        Action::Draw(None) => draw,
        Action::Move(None) => go,
        Action::TurnLeft(None) => left,
        Action::TurnRight(None) => right,
        Action::Push => push,
        Action::Pop => pop,
        Action::TurnRound => "\\pgftransformrotate{180}".into(),
        Action::TurnLeft(Some(angle)) => format!("\\pgftransformrotate{{{}}}", degrees(angle)),
        Action::TurnRight(Some(angle)) => format!("\\pgftransformrotate{{{}}}", degrees(-angle)),
        _ => return None,
    })
}

/// Checks that every branch is closed where it is opened, because a branch is a group of TeX, and that TeX has enough
/// groups for the string `word`.
fn check_branches(system: &System, word: &str) -> Result<(), String> {
    let changes: Vec<(char, isize)> = (system.rules.letters.iter().zip(&system.turtle.actions))
        .map(|(letter, actions)| {
            let change = |action: &Action| match action {
                Action::Push => 1,
                Action::Pop => -1,
                _ => 0,
            };
            (letter.symbol, actions.iter().map(change).sum())
        })
        .collect();
    let change = |symbol: char| {
        let at = changes.binary_search_by_key(&symbol, |(own, _)| *own);
        at.map_or(0, |at| changes[at].1)
    };
    let grammar = &system.grammar;
    let texts = core::iter::once(&grammar.axiom).chain(grammar.productions.iter().map(|p| &p.successor));
    let is_rewritten = grammar.productions.iter().any(|p| change(p.predecessor.symbol) != 0);
    let mut balanced = texts.map(|modules| deepest(modules.iter().map(|module| module.symbol), change));
    if is_rewritten || balanced.any(|depth| depth.is_none()) {
        return Err(say!("brackets across rules"));
    }
    match deepest(word.chars(), change) {
        Some(depth) if depth <= DEEPEST => Ok(()),
        _ => Err(say!("room for so many branches in branches")),
    }
}

/// The most branches that are open at a time; `None` if one is not opened or not closed.
fn deepest(symbols: impl Iterator<Item = char>, change: impl Fn(char) -> isize) -> Option<usize> {
    let (mut depth, mut most) = (0_usize, 0);
    for symbol in symbols {
        depth = depth.checked_add_signed(change(symbol))?;
        most = most.max(depth);
    }
    (depth == 0).then_some(most)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::collect;
    use expect_test::{Expect, expect};

    fn written(definition: &Definition) -> Result<String, Diagnostic> {
        let options = FileOptions { title: definition.title.clone(), ..FileOptions::default() };
        let system = System::new(definition).unwrap();
        collect(|sink| write_tikz_library(definition, &system, &options, sink)).map(|(text, _)| text)
    }

    fn check(definition: &Definition, expected: &Expect) {
        expected.assert_eq(&written(definition).unwrap());
    }

    fn plant() -> Definition {
        Definition {
            name: "plant_1".into(),
            title: "A plant".into(),
            axiom: "X".into(),
            rules: "X -> F-[[X]+X]+G[|FX]-X\nF -> FF\nF -> F".into(),
            angle: 25.0,
            iterations: 4,
            overrides: "G: move\nf: nothing".into(),
            ..Definition::default()
        }
    }

    #[test]
    fn declarations() {
        check(
            &plant(),
            &expect![[r#"
            % A plant
            % For documents with \usepackage{tikz} and \usetikzlibrary{lindenmayersystems}.
            \pgfdeclarelindenmayersystem{plant-1}{
              \symbol{G}{\pgflsystemmoveforward}
              \symbol{|}{\pgftransformrotate{180}}
              \rule{X -> F-[[X]+X]+G[|FX]-X}
              \rule{F -> FF}
            }
            \begin{tikzpicture}
            \definecolor{stroke}{RGB}{31,92,58}
            \draw[stroke,line cap=round,line join=round,line width=0.1563mm,rotate=90,
              l-system={plant-1, axiom={X}, order=4, angle=25, step=5.924mm}] lindenmayer system;
            \end{tikzpicture}
        "#]],
        );
        let koch = Definition {
            axiom: "F++F++F".into(),
            rules: "F -> F-F++F-F".into(),
            angle: 60.0,
            right_angle: Some(-3600.5),
            heading: 0.0,
            step: 2.0,
            ..Definition::default()
        };
        check(
            &koch,
            &expect![[r#"
            % For documents with \usepackage{tikz} and \usetikzlibrary{lindenmayersystems}.
            \pgfdeclarelindenmayersystem{l-system}{
              \rule{F -> F-F++F-F}
            }
            \begin{tikzpicture}
            \definecolor{stroke}{RGB}{31,92,58}
            \draw[stroke,line cap=round,line join=round,line width=0.1172mm,rotate=0,
              l-system={l-system, axiom={F++F++F}, order=1, left angle=60, right angle=359.5, step=29.8919mm}] lindenmayer system;
            \end{tikzpicture}
        "#]],
        );
    }

    #[test]
    fn rules_that_never_apply_are_left_out() {
        let text = written(&Definition { rules: "X -> FX\nA -> +%-^".into(), ..plant() }).unwrap();
        assert!(text.contains("\\rule{X -> FX}") && !text.contains("^+") && !text.contains("%-"), "{text}");
    }

    #[test]
    fn the_library_lacks() {
        let check = |change: &dyn Fn(&mut Definition), expected: &str| {
            let mut definition = plant();
            change(&mut definition);
            let message = written(&definition).unwrap_err().message;
            assert_eq!(message, format!("TikZ's library lindenmayersystems has no {expected}"));
        };
        check(&|d| d.rules = "A < X -> F".into(), "contexts");
        check(&|d| d.axiom = "F(2)".into(), "parameters and conditions");
        check(&|d| d.rules = "draw:\nX -> F".into(), "rules for drawing");
        check(&|d| d.rules = "X -> F : 1\nX -> G : 1".into(), "seeded random choices");
        check(&|d| d.angle_variation = 5.0, "seeded random choices");
        check(&|d| d.style.colour_by = ColourBy::Level, "colours within one drawing");
        check(&|d| d.style.width_factor = 0.7, "widths or lengths by branch level");
        check(&|d| d.elasticity = 0.1, "tropism and sway");
        check(&|d| (d.axiom, d.wind) = ("F[F]".into(), [3.0, 0.0]), "tropism and sway");
        check(&|d| d.growth = 0.5, "partly grown steps");
        check(&|d| d.axiom = "{F}".into(), "symbol `{`");
        check(&|d| d.overrides = "F: colour 2".into(), "action for what `F` does");
        check(&|d| d.rules = "X -> [F\nF -> F]".into(), "brackets across rules");
        check(&|d| d.rules = "[ -> F[".into(), "brackets across rules");
        check(&|d| (d.rules, d.iterations) = ("X -> [FX]".into(), 201), "room for so many branches in branches");
        let huge = Definition { iterations: 30, ..plant() };
        assert!(matches!(written(&huge).unwrap_err().kind, lsystem_syntax::Kind::Limit { .. }));
    }
}
