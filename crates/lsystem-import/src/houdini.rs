//! The rule lines of Houdini's L-system node.
//!
//! ```text
//! Premise: A(0)
//! Rule 1: A(i):t<=3=FA(i+1)
//! Rule 2: B<A>C=F[+F]:0.5
//! Angle: 30
//! Generations: 5
//! ```
//!
//! `F` draws and `f` moves; `+` turns right and `-` left; `&` pitches up and `^` down. The default angle is 90 degrees,
//! and `"`, `_` and `!` scale by 0.9. Symbols that need geometry or change the angle are refused, and so are the time and
//! the place of the turtle in rules, and numbers of symbols that mean something else here.

use crate::draft::{Draft, turtle};
use crate::source::Source;
use lsystem_base::{decimal, number::number, say, word, words::said};
use lsystem_syntax::{Module, parse};

/// The label of a line, without digits and in lower case, and the value.
fn labelled(line: &str) -> Option<(&'static str, &str)> {
    let at = line
        .find([':', '\t'])
        .or_else(|| line.to_ascii_lowercase().starts_with("rule").then(|| line.find(' ')).flatten())?;
    let (name, value) = (&line[..at], line[at + 1..].trim());
    let name: String = name.chars().filter(|c| c.is_alphabetic()).collect::<String>().to_ascii_lowercase();
    let label = match name.as_str() {
        "premise" | "contextpremise" => "premise",
        "rule" => "rule",
        "angle" | "angles" => "angle",
        "generations" | "generation" => "generations",
        "contextignore" => "ignore",
        "stepsize" => "step",
        "randomseed" | "seed" => "seed",
        _ => return None,
    };
    Some((label, value))
}

pub(super) fn read<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    let all = source.text.lines().map(str::trim).filter(|line| !line.is_empty());
    let lines: Vec<(&str, Option<(&str, &str)>)> = all.map(|line| (line, labelled(line))).collect();
    let has = |name: &str| lines.iter().any(|(_, found)| found.is_some_and(|(label, _)| label == name));
    if !has("premise") || !has("rule") {
        return None;
    }
    let first = lines.iter().find(|(_, found)| found.is_some()).map_or("", |(line, _)| line);
    let mut draft = Draft::new(source, "", source.line_of(source.place(first).unwrap_or_default().start));
    draft.definition.angle = 90.0;
    let (mut rules, mut ignored) = (Vec::new(), None);
    // The last line of each label but `rule`, to note those that it replaces.
    let mut last: Vec<(&str, &str)> = Vec::new();
    for &(line, found) in &lines {
        let place = draft.place(line);
        draft.covers(place.clone());
        let Some((label, value)) = found else {
            draft.note_at(place, say!("This line is not read"));
            continue;
        };
        if let Some(old) = last.iter_mut().find(|(known, _)| *known == label && label != "rule") {
            draft.note_at(draft.place(old.1), say!("A later line with the same label replaces this one"));
            old.1 = line;
        } else if label != "rule" {
            last.push((label, line));
        }
        match label {
            "premise" => {
                draft.definition.axiom = value.to_owned();
                draft.read(place, say!("axiom {}", value));
            }
            "rule" => {
                let rule = rule(value, &mut draft);
                draft.read(place, rule.clone().unwrap_or_default());
                rules.extend(rule);
            }
            "angle" => match decimal::read(value.trim_end_matches('°').trim()).filter(|angle| angle.is_finite()) {
                Some(angle) => {
                    draft.definition.angle = angle;
                    draft.read(place, say!("angle {}", number(angle)));
                }
                None => draft.refuse_at(draft.place(value), say!("The angle is not a number")),
            },
            "generations" => {
                draft.iterations(source.line_of(place.start), value);
                draft.read(place, format!("n {}", draft.definition.iterations));
            }
            "ignore" => {
                ignored = Some(format!("ignore: {value}"));
                draft.read(place, format!("ignore: {value}"));
            }
            "seed" => match value.parse() {
                Ok(seed) => {
                    draft.definition.seed = seed;
                    draft.read(place, say!("seed {}", seed));
                }
                Err(_) => draft.note_at(place, say!("The seed is not a whole number")),
            },
            // The size of the whole drawing.
            _ => draft.pass(place),
        }
    }
    draft.definition.rules = ignored.into_iter().chain(rules).collect::<Vec<_>>().join("\n");
    draft.others = Some("");
    turtle("Houdini").for_each(|(symbol, actions)| draft.meaning(symbol, actions));
    if draft.definition.out_of_range().is_empty() {
        symbols(&mut draft);
    }
    Some(vec![draft])
}

/// Refuses and notes symbols that our turtle cannot follow.
fn symbols(draft: &mut Draft<'_>) {
    let (grammar, _) = parse(&draft.definition.axiom, &draft.definition.rules);
    let line = draft.line;
    let mut with = |symbols: &str, is: fn(&Module) -> bool, message: &str, refused: bool| {
        for symbol in symbols.chars() {
            if grammar.made().any(|module| module.symbol == symbol && is(module)) {
                let text = symbol.to_string();
                if refused { draft.refuse(line, &text, said(message)) } else { draft.note(line, &text, said(message)) }
            }
        }
    };
    with("~T;?${}.#", |_| true, word!("This symbol of Houdini has no equal here"), true);
    with("JKM", |_| true, word!("The geometry of this symbol is not carried over"), false);
    let scales = word!("The number of this symbol is a factor in Houdini; here it would be a width or another factor");
    with("!_", |module| !module.arguments.is_empty(), scales, true);
    with("\'%*|", |module| !module.arguments.is_empty(), word!("The number of this symbol has no equal here"), true);
    with(
        "FfHhG",
        |module| module.arguments.len() > 1,
        word!("Only the first number, the length, is carried over"),
        false,
    );
}

/// A rule in our notation: the first `=` that is no comparison is the arrow.
fn rule(text: &str, draft: &mut Draft<'_>) -> Option<String> {
    let chars: Vec<char> = text.chars().collect();
    let mut depth = 0_usize;
    let arrow = (0..chars.len()).find(|&at| {
        depth = (depth + usize::from(chars[at] == '(')).saturating_sub(usize::from(chars[at] == ')'));
        let near = |at: Option<usize>| at.and_then(|at| chars.get(at)).copied().unwrap_or(' ');
        let compared = matches!(near(at.checked_sub(1)), '<' | '>' | '=' | '!') || near(Some(at + 1)) == '=';
        depth == 0 && chars[at] == '=' && !compared
    });
    let Some(arrow) = arrow else {
        draft.refuse_at(draft.place(text), say!("This rule has no `=`"));
        return None;
    };
    let (head, body): (String, String) = (chars[..arrow].iter().collect(), chars[arrow + 1..].iter().collect());
    let condition = head.split_once(':').map_or("", |(_, condition)| condition);
    let time = |c: &str| {
        c.split(|c: char| !c.is_alphanumeric()).any(|word| matches!(word, "t" | "g" | "x" | "y" | "z" | "A" | "L"))
    };
    if time(condition) || body.split(['(', ',']).skip(1).any(|part| time(part.split(')').next().unwrap_or_default())) {
        let own = head.split_once('(').and_then(|(_, rest)| rest.split(')').next()).unwrap_or_default();
        let named = |name: &str| own.split(',').any(|own| own.trim() == name);
        if !["t", "g", "x", "y", "z"].iter().any(|name| named(name)) {
            draft.refuse_at(
                draft.place(text),
                say!("The time, the age and the place of the turtle are not known in rules"),
            );
            return None;
        }
    }
    Some(format!("{} -> {}", head.trim(), body.trim()))
}

#[cfg(test)]
mod tests {
    use crate::tests::check;
    use expect_test::expect;

    #[test]
    fn cases() {
        check(
            "Premise: A(0)\nRule 1: A(i):i<=3=FA(i+1)\nRule 2: A>B=F\nAngle: 30\nGenerations: 5",
            expect![[r#"
            Houdini
            []
            n 5, angle 30, heading 90, abop
              A(0)
              A(i):i<=3 -> FA(i+1)
              A>B -> F"#]],
        );
        check(
            "Premise: F+F-F&F^F*HJ\nRule 1: F=F\"F!F\nGenerations: 2",
            expect![[r#"
            Houdini
            []
            n 2, angle 90, heading 90, abop
              F+F-F&F^F*HJ
              F -> F"F!F
              | !: width times 0.9
              | ": length times 0.9
              | &: pitch up
              | *: roll left 180
              | +: turn right
              | -: turn left
              | H: draw 0.5
              | ^: pitch down
            note 1 "J": The geometry of this symbol is not carried over"#]],
        );
        check(
            "Premise: A\nRule 1: A=F~F;",
            expect![[r#"
            Houdini
            []
            refused 1 "~": This symbol of Houdini has no equal here
            refused 1 ";": This symbol of Houdini has no equal here"#]],
        );
        check(
            "Premise: A\nRule 1: A(i):t<=3=FA(i+1)\nRule 2: nonsense",
            expect![[r#"
            Houdini
            []
            refused 2 "A(i):t<=3=FA(i+1)": The time, the age and the place of the turtle are not known in rules
            refused 3 "nonsense": This rule has no `=`"#]],
        );
        check(
            "Premise: F\nRule: F=F[+F]F:0.5\nRule: F=FF:0.5\nStep Size: 0.1\nother",
            expect![[r#"
                Houdini
                []
                n 8, angle 90, heading 90, abop
                  F
                  F -> F[+F]F:0.5
                  F -> FF:0.5
                  | +: turn right
                note 5 "other": This line is not read
                note 1 "": The text gives no number of iterations; 8 is chosen by the size"#]],
        );
    }
}
