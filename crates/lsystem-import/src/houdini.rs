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
//! the place of the turtle in rules.

use crate::draft::Draft;
use lsystem_base::decimal;
use lsystem_syntax::parse;

/// The actions of Houdini's symbols.
const MEANINGS: [(char, &str); 17] = [
    ('F', "draw"),
    ('f', "move"),
    ('H', "draw 0.5"),
    ('h', "move 0.5"),
    ('G', "draw unmarked"),
    ('+', "turn right"),
    ('-', "turn left"),
    ('|', "turn round"),
    ('&', "pitch up"),
    ('^', "pitch down"),
    ('\\', "roll right"),
    ('/', "roll left"),
    ('"', "length times 0.9"),
    ('_', "length times 1.1111111111111112"),
    ('!', "width times 0.9"),
    ('[', "open branch"),
    (']', "close branch"),
];

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

pub(super) fn read(text: &str) -> Option<Vec<Draft>> {
    let lines = text.lines().enumerate().filter_map(|(at, line)| Some((at + 1, labelled(line.trim())?)));
    let lines: Vec<(usize, (&str, &str))> = lines.collect();
    let has = |name: &str| lines.iter().any(|(_, (label, _))| *label == name);
    if !has("premise") || !has("rule") {
        return None;
    }
    let mut draft = Draft::new("", lines.first().map_or(1, |line| line.0));
    draft.definition.angle = 90.0;
    let mut rules = Vec::new();
    for (at, (label, value)) in &lines {
        match *label {
            "premise" => draft.definition.axiom = (*value).to_owned(),
            "rule" => rules.extend(rule(value, *at, &mut draft)),
            "angle" => match decimal::read(value) {
                Some(angle) => draft.definition.angle = angle,
                None => draft.refuse(*at, value, "The angle is not a number"),
            },
            "generations" => draft.iterations(*at, value),
            "ignore" => rules.insert(0, format!("ignore: {value}")),
            "seed" => draft.definition.seed = value.parse().unwrap_or_default(),
            _ => {}
        }
    }
    for (at, line) in
        text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty() && labelled(line.trim()).is_none())
    {
        draft.note(at + 1, line, "This line is not read");
    }
    draft.definition.rules = rules.join("\n");
    draft.others = Some("");
    MEANINGS.into_iter().for_each(|(symbol, actions)| draft.meaning(symbol, actions));
    draft.meaning('%', "cut branch");
    draft.meaning('\'', "next colour");
    draft.meaning('*', "roll left 180");
    let (grammar, _) = parse(&draft.definition.axiom, &draft.definition.rules);
    let line = draft.line;
    for symbol in ['~', 'T', ';', '?', '$', '{', '}', '.', '#'] {
        if grammar.made().any(|module| module.symbol == symbol) {
            draft.refuse(line, &symbol.to_string(), "This symbol of Houdini has no equal here");
        }
    }
    for symbol in ['J', 'K', 'M'] {
        if grammar.made().any(|module| module.symbol == symbol) {
            draft.note(line, &symbol.to_string(), "The geometry of this symbol is not carried over");
        }
    }
    Some(vec![draft])
}

/// A rule in our notation: the first `=` that is no comparison is the arrow.
fn rule(text: &str, line: usize, draft: &mut Draft) -> Option<String> {
    let chars: Vec<char> = text.chars().collect();
    let mut depth = 0_usize;
    let arrow = (0..chars.len()).find(|&at| {
        depth = (depth + usize::from(chars[at] == '(')).saturating_sub(usize::from(chars[at] == ')'));
        let near = |at: Option<usize>| at.and_then(|at| chars.get(at)).copied().unwrap_or(' ');
        let compared = matches!(near(at.checked_sub(1)), '<' | '>' | '=' | '!') || near(Some(at + 1)) == '=';
        depth == 0 && chars[at] == '=' && !compared
    });
    let Some(arrow) = arrow else {
        draft.refuse(line, text, "This rule has no `=`");
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
            draft.refuse(line, text, "The time, the age and the place of the turtle are not known in rules");
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
