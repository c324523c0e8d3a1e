//! Fractint's `.l` files.
//!
//! ```text
//! Bush { ; a comment
//!   Angle 16
//!   Axiom ++++F
//!   F=FF-[-F+F+F]+[+F-F-F]
//! }
//! ```
//!
//! Case is ignored. Several rules for one letter are joined. `Angle n` is 360/n degrees. Fractint keeps two headings:
//! `F` and `G` go along the first, which `+ - |` turn; `D` and `M` go along the second, which `\nn` and `/nn` turn. Both
//! start to the right. Our turtle has one heading, so a system with both is read only if every group of turns changes
//! both headings alike.

use crate::draft::{Draft, FreeSymbols, production};
use crate::source::Source;
use lsystem_base::decimal;
use lsystem_base::number::number;
use lsystem_syntax::{Colour, Grammar, Module};

/// A symbol of Fractint.
#[derive(Clone, Copy, Debug, PartialEq)]
enum Token {
    /// A single character, in lower case.
    Plain(char),
    /// A character with a number: `@ \ / c < >`.
    Number(char, f64),
}

/// An entry of a file, as text.
#[derive(Debug, Default)]
struct Block {
    name: String,
    line: usize,
    /// The lines without comments, with their numbers.
    lines: Vec<(usize, String)>,
}

pub(super) fn read<'a>(source: Source<'a>) -> Option<Vec<Draft<'a>>> {
    let text = source.text;
    let blocks = entries(text).or_else(|| bare(text))?;
    Some(blocks.iter().map(|block| entry(source, block)).collect())
}

/// The text of a line before its comment.
fn without_comment(line: &str) -> &str {
    line.split(';').next().unwrap_or_default().trim()
}

/// The first word of a line, in lower case, and the rest without `=` and white space at its start.
fn first_word(line: &str) -> (String, &str) {
    let is_end = |c: char| c == '=' || c.is_whitespace();
    let at = line.find(is_end).unwrap_or(line.len());
    (line[..at].to_ascii_lowercase(), line[at..].trim_start_matches(is_end))
}

/// Whether a line gives an axiom, as in `Axiom F` or `axiom=F`.
fn is_axiom(line: &str) -> bool {
    let (word, rest) = first_word(line);
    word == "axiom" && !rest.is_empty() && !rest.starts_with(':')
}

/// Whether a line gives an angle, as in `Angle 6`.
fn is_angle(line: &str) -> bool {
    let (word, rest) = first_word(line);
    word == "angle" && rest.starts_with(|c: char| c.is_ascii_digit())
}

/// Whether a line is a rule, as in `F=FF`.
fn is_rule(line: &str) -> bool {
    let (word, rest) = first_word(line);
    let mut chars = word.chars();
    let one = chars.next().is_some() && chars.next().is_none();
    let marked = line.trim_start().chars().nth(1).is_some_and(|c| c == '=' || c.is_whitespace());
    one && marked && !rest.starts_with(['>', '=', ':'])
}

/// The entries of a file that give an axiom or an angle; `None` if no entry gives an axiom.
fn entries(text: &str) -> Option<Vec<Block>> {
    let mut found: Vec<Block> = Vec::new();
    let mut open: Option<Block> = None;
    let mut title = String::new();
    for (at, line) in text.lines().enumerate() {
        let mut line = without_comment(line);
        if open.is_none() {
            let Some(brace) = line.find('{') else {
                if !line.is_empty() {
                    title = line.to_owned();
                }
                continue;
            };
            let name = line[..brace].trim();
            let name = if name.is_empty() { core::mem::take(&mut title) } else { name.to_owned() };
            open = Some(Block { name: name.trim_end_matches('=').trim().to_owned(), line: at + 1, lines: Vec::new() });
            line = line[brace + 1..].trim();
        }
        let end = line.find('}');
        if let Some(source) = &mut open {
            let own = line[..end.unwrap_or(line.len())].trim();
            if !own.is_empty() {
                source.lines.push((at + 1, own.to_owned()));
            }
        }
        if end.is_some() {
            found.extend(open.take());
            title.clear();
        }
    }
    found.extend(open.take());
    let sure = |source: &Block| {
        let has = |is: fn(&str) -> bool| source.lines.iter().any(|(_, line)| is(line));
        has(is_axiom) && (has(is_angle) || has(is_rule))
    };
    if !found.iter().any(sure) {
        return None;
    }
    found.retain(|source| source.lines.iter().any(|(_, line)| is_axiom(line) || is_angle(line)));
    Some(found)
}

/// The inside of an entry alone: an angle, an axiom, and otherwise only rules.
fn bare(text: &str) -> Option<Vec<Block>> {
    let lines = text.lines().enumerate().map(|(at, line)| (at + 1, without_comment(line).to_owned()));
    let lines: Vec<(usize, String)> = lines.filter(|(_, line)| !line.is_empty()).collect();
    let has = |is: fn(&str) -> bool| lines.iter().any(|(_, line)| is(line));
    let all = lines.iter().all(|(_, line)| is_axiom(line) || is_angle(line) || is_rule(line));
    let line = lines.first()?.0;
    (all && has(is_axiom) && has(is_angle)).then(|| vec![Block { name: String::new(), line, lines }])
}

/// Splits a word into symbols.
fn tokens(word: &str) -> Vec<Token> {
    let chars: Vec<char> = word.chars().map(|c| c.to_ascii_lowercase()).collect();
    let mut found = Vec::new();
    let mut at = 0;
    while at < chars.len() {
        let ch = chars[at];
        at += 1;
        if !matches!(ch, '@' | '\\' | '/' | 'c' | '<' | '>') {
            found.push(Token::Plain(ch));
            continue;
        }
        let (mut root, mut inverse) = (false, false);
        for _ in 0..2 {
            match chars.get(at) {
                Some('q') => root = true,
                Some('i') => inverse = true,
                _ => break,
            }
            at += 1;
        }
        let from = at;
        while chars.get(at).is_some_and(|c| c.is_ascii_digit() || *c == '.') {
            at += 1;
        }
        found.push(Token::Number(ch, value(&chars[from..at], root, inverse)));
    }
    found
}

/// The number after `@`, `\` and so on. Fractint reads up to a second decimal point and takes 0 for no number.
fn value(digits: &[char], root: bool, inverse: bool) -> f64 {
    let mut points = 0;
    let until_second_point = |c: &&char| {
        points += usize::from(**c == '.');
        points < 2
    };
    let text: String = digits.iter().take_while(until_second_point).take(30).collect();
    let mut value = decimal::read(&text).unwrap_or(0.0);
    if value <= 0.0 {
        return 0.0;
    }
    if root {
        value = value.sqrt();
    }
    if inverse { 1.0 / value } else { value }
}

/// The parts of a system.
#[derive(Debug, Default)]
struct Parts {
    /// The number after `Angle`.
    angle: u32,
    axiom: Vec<Token>,
    /// Letters with their joined successors, in the order of the file.
    rules: Vec<(char, Vec<Token>)>,
    /// All words with their lines.
    words: Vec<(usize, String)>,
}

impl Parts {
    /// The symbols that can occur.
    fn reachable(&self) -> Vec<char> {
        let mut seen: Vec<char> = Vec::new();
        let mut words = vec![&self.axiom[..]];
        while let Some(word) = words.pop() {
            for token in word {
                let (Token::Plain(ch) | Token::Number(ch, _)) = *token;
                if !seen.contains(&ch) {
                    seen.push(ch);
                    let rule = self.rules.iter().find(|(letter, _)| *letter == ch);
                    words.extend(rule.map(|(_, word)| &word[..]));
                }
            }
        }
        seen
    }

    /// The first line that contains one of these characters, and its text.
    fn place(&self, chars: &[char]) -> (usize, String) {
        let found = self.words.iter().find(|(_, word)| word.to_ascii_lowercase().contains(chars));
        found.cloned().unwrap_or((self.words.first().map_or(1, |word| word.0), String::new()))
    }

    fn each_word(&mut self) -> impl Iterator<Item = &mut Vec<Token>> {
        core::iter::once(&mut self.axiom).chain(self.rules.iter_mut().map(|rule| &mut rule.1))
    }
}

/// The symbols that turn.
#[derive(Clone, Copy, PartialEq)]
enum Turns {
    /// `+ - |`, for `F` and `G`.
    Fixed,
    /// `\` and `/`, for `D` and `M`.
    Degrees,
}

/// Reads an entry.
fn entry<'a>(source: Source<'a>, block: &Block) -> Draft<'a> {
    let mut draft = Draft::new(source, &block.name, block.line);
    let parts = statements(block, &mut draft);
    if !draft.is_refused() {
        translate(parts, &mut draft);
    }
    draft
}

/// Reads the lines of an entry.
fn statements(block: &Block, draft: &mut Draft<'_>) -> Parts {
    let mut parts = Parts::default();
    let (mut has_axiom, mut has_angle) = (false, false);
    for (at, line) in &block.lines {
        let (word, rest) = first_word(line);
        let mut rest = rest.split_whitespace();
        match word.as_str() {
            "axiom" => {
                let axiom = rest.next().unwrap_or_default();
                parts.axiom = word_of(axiom, *at, draft);
                parts.words.push((*at, axiom.to_owned()));
                has_axiom = true;
            }
            "angle" => {
                let text = rest.next().unwrap_or_default();
                let digits = text.find(|c: char| !c.is_ascii_digit()).unwrap_or(text.len());
                parts.angle = text[..digits].parse().unwrap_or(0);
                has_angle = true;
                if !(3..=50).contains(&parts.angle) && parts.angle > 0 {
                    draft.note(*at, line, "Fractint accepts angles from 3 to 50 only; 360 is divided by this number");
                }
                if digits < text.len() {
                    draft.note(*at, line, "Fractint reads only the digits at the start of the number");
                }
            }
            _ if word.chars().count() == 1 => {
                let letter = word.chars().next().unwrap_or_default();
                if "+-/\\@|!c<>][".contains(letter) && letter != '!' {
                    draft.refuse(*at, line, "Fractint does not allow a rule for this symbol");
                    continue;
                }
                // `F==FF` is read as `F=FF`.
                let successor = rest.next().unwrap_or_default();
                let (successor, extra) = successor.split_once('=').unwrap_or((successor, ""));
                if !extra.is_empty() {
                    draft.refuse(*at, line, "Fractint does not allow a second `=` in a rule");
                }
                parts.words.push((*at, successor.to_owned()));
                let mut made = word_of(successor, *at, draft);
                match parts.rules.iter_mut().find(|rule| rule.0 == letter) {
                    Some((_, joined)) => joined.append(&mut made),
                    None => parts.rules.push((letter, made)),
                }
            }
            _ => {
                draft.refuse(*at, line, "Fractint cannot read this line");
                continue;
            }
        }
        let extra: Vec<&str> = rest.collect();
        if !extra.is_empty() {
            draft.refuse(*at, &extra.join(" "), "Fractint does not allow more text after a blank");
        }
    }
    if !has_axiom {
        draft.refuse(block.line, "", "There is no Axiom");
    }
    if !has_angle || parts.angle == 0 {
        draft.refuse(block.line, "", "There is no Angle from 3 to 50");
    }
    parts
}

/// Reads a word. Brackets must match within it.
fn word_of(text: &str, line: usize, draft: &mut Draft<'_>) -> Vec<Token> {
    let mut word = tokens(text);
    let mut depth = 0_usize;
    for at in 0..word.len() {
        match word[at] {
            Token::Plain('[') => depth += 1,
            Token::Plain(']') if depth == 0 => {
                draft.note(line, text, "Fractint ignores the rest of a word after a `]` that closes nothing");
                word.truncate(at);
                return word;
            }
            Token::Plain(']') => depth -= 1,
            _ => {}
        }
    }
    if depth > 0 {
        draft.refuse(line, text, "Fractint needs the `]` of a branch in the same word as its `[`");
    }
    word
}

fn translate(mut parts: Parts, draft: &mut Draft<'_>) {
    let symbols = parts.reachable();
    let has = |list: &str| list.chars().any(|c| symbols.contains(&c));
    draft.definition.heading = 0.0;
    draft.definition.angle = 360.0 / f64::from(parts.angle);
    let turns = match (has("fg"), has("dm")) {
        (_, false) => Turns::Fixed,
        (false, true) => Turns::Degrees,
        (true, true) if !has("+-|\\/") => Turns::Fixed,
        (true, true) => {
            if let Some((line, text)) = unequal_turns(&mut parts, has("!")) {
                let why = "F and G go along one heading, turned by + - |, and D and M along another, turned by \\ and /. \
                           Our turtle has one heading, and here the two differ";
                return draft.refuse(line, &text, why);
            }
            Turns::Fixed
        }
    };
    // Turns of the heading that no line and no move uses have no effect.
    for word in parts.each_word() {
        word.retain(|token| match token {
            Token::Plain('+' | '-' | '|') => turns == Turns::Fixed,
            Token::Number('\\' | '/', degrees) => turns == Turns::Degrees && *degrees != 0.0,
            _ => true,
        });
    }
    draft.others = Some("");
    for (symbol, actions) in
        [('F', "draw"), ('D', "draw"), ('G', "move"), ('M', "move"), ('[', "open branch"), (']', "close branch")]
    {
        draft.meaning(symbol, actions);
    }
    draft.meaning('+', "turn left");
    draft.meaning('-', "turn right");
    draft.meaning('!', "swap turns");
    turn_round(&parts, turns, has("!"), draft);
    let mut free = FreeSymbols::default();
    for word in parts.each_word() {
        word.iter().for_each(|token| {
            if let Token::Plain(ch) = token {
                free.add_used(&upper(*ch).to_string());
            }
        });
    }
    parts.rules.iter().for_each(|(letter, _)| free.add_used(&upper(*letter).to_string()));
    let coloured = has("c<>");
    let mut grammar = Grammar::default();
    let mut modules =
        |word: &[Token]| -> Vec<char> { word.iter().map(|token| symbol(*token, &mut free, draft)).collect() };
    grammar.axiom = modules(&parts.axiom).into_iter().map(Module::from).collect();
    let rules = parts.rules.iter().filter(|(letter, _)| symbols.contains(letter));
    grammar.productions = rules.map(|(letter, word)| production(upper(*letter), modules(word))).collect();
    if coloured {
        colours(&parts, &mut grammar, &mut free, draft);
    }
    draft.grammar(&grammar);
}

/// The letter of a Fractint symbol in our notation: upper case, so that the lower case is free.
fn upper(ch: char) -> char {
    ch.to_ascii_uppercase()
}

/// The symbol for a token. Tokens with numbers become custom symbols.
fn symbol(token: Token, free: &mut FreeSymbols, draft: &mut Draft<'_>) -> char {
    let (ch, value) = match token {
        Token::Plain(ch) => return upper(ch),
        Token::Number(ch, value) => (ch, value),
    };
    let whole = value as i64;
    let actions = match ch {
        '@' => format!("length times {}", number(value)),
        // The screen's y axis points down, so an increasing angle is a turn to the right.
        '\\' => format!("turn left {}", number(value)),
        '/' => format!("turn right {}", number(value)),
        'c' => format!("colour {}", whole % 256),
        '<' if whole == 0 => String::new(),
        '<' => format!("next colour {}", whole % 256),
        _ if whole == 0 => String::new(),
        _ => format!("previous colour {}", whole % 256),
    };
    let symbol = free.get(&actions);
    draft.meaning(symbol, actions);
    symbol
}

/// Sets the meaning of `|`: half a circle, or the nearest smaller angle to the right for an odd number of directions.
fn turn_round(parts: &Parts, turns: Turns, swaps: bool, draft: &mut Draft<'_>) {
    let half = f64::from(parts.angle / 2) * 360.0 / f64::from(parts.angle);
    if parts.angle.is_multiple_of(2) {
        draft.meaning('|', "turn round");
        return;
    }
    draft.meaning('|', format!("turn right {}", number(half)));
    let used = |word: &[Token]| word.contains(&Token::Plain('|'));
    if turns == Turns::Fixed && swaps && (used(&parts.axiom) || parts.rules.iter().any(|rule| used(&rule.1))) {
        let (line, text) = parts.place(&['|']);
        let why =
            "`|` is less than half a circle for an odd Angle, and `!` does not swap it: our turtle cannot do both";
        draft.refuse(line, &text, why);
    }
}

/// Makes `\` and `/` unnecessary if each group of turns changes both headings alike. Otherwise returns the line and the
/// text of a group that does not.
fn unequal_turns(parts: &mut Parts, swaps: bool) -> Option<(usize, String)> {
    let unit = 360.0 / f64::from(parts.angle);
    let half = f64::from(parts.angle / 2) * unit;
    let odd = parts.angle % 2 == 1;
    let wrong = |word: &[Token]| {
        let (mut fixed, mut degrees, mut asymmetric) = (0.0, 0.0, false);
        let mut bad = false;
        let mut close = |fixed: &mut f64, degrees: &mut f64, asymmetric: &mut bool| {
            let turn = (*fixed - *degrees) / 360.0;
            bad |= (turn - turn.round()).abs() > 1e-9 || (*asymmetric && swaps && odd);
            (*fixed, *degrees, *asymmetric) = (0.0, 0.0, false);
        };
        for token in word {
            match token {
                Token::Plain('+') => fixed += unit,
                Token::Plain('-') => fixed -= unit,
                Token::Plain('|') => {
                    fixed -= half;
                    asymmetric = true;
                }
                Token::Number('\\', value) => degrees += value,
                Token::Number('/', value) => degrees -= value,
                // These do not depend on the headings.
                Token::Number(..) => {}
                _ => close(&mut fixed, &mut degrees, &mut asymmetric),
            }
        }
        close(&mut fixed, &mut degrees, &mut asymmetric);
        bad
    };
    if wrong(&parts.axiom) || parts.rules.iter().any(|rule| wrong(&rule.1)) {
        let place = parts.words.iter().find(|(_, word)| wrong(&tokens(word)));
        return Some(place.cloned().unwrap_or_else(|| parts.place(&['+', '-', '|', '\\', '/'])));
    }
    None
}

/// The first 16 colours of Fractint, as in all its default palettes.
const PALETTE: [[u8; 3]; 16] = [
    [0, 0, 0],
    [0, 0, 168],
    [0, 168, 0],
    [0, 168, 168],
    [168, 0, 0],
    [168, 0, 168],
    [168, 84, 0],
    [168, 168, 168],
    [84, 84, 84],
    [84, 84, 252],
    [84, 252, 84],
    [84, 252, 252],
    [252, 84, 84],
    [252, 84, 252],
    [252, 252, 84],
    [252, 252, 252],
];

/// Takes over colours: Fractint's first 16 colours, starting with number 15 on black.
fn colours(parts: &Parts, grammar: &mut Grammar, free: &mut FreeSymbols, draft: &mut Draft<'_>) {
    let style = &mut draft.definition.style;
    style.palette = PALETTE.iter().map(|&rgb| Colour { rgb }).collect();
    style.background = Colour { rgb: PALETTE[0] };
    let first = free.get("colour 15");
    draft.meaning(first, "colour 15");
    grammar.axiom.insert(0, Module::from(first));
    let (line, text) = parts.place(&['c', '<', '>']);
    draft.note(line, &text, "Colours are the first 16 of Fractint; higher numbers begin again");
}

#[cfg(test)]
mod tests {
    use crate::tests::check;
    use expect_test::expect;

    #[test]
    fn entries_and_plain_rules() {
        check(
            "Koch1 { ; a comment\n  Angle 6\n  Axiom f--F--F\n  F=F+F--F+F ; more\n  }\n",
            expect![[r#"
            Fractint
            [Koch1]
            n 5, angle 60, heading 0, abop
              F--F--F
              F -> F+F--F+F
            note 1 "": The text gives no number of iterations; 5 is chosen by the size"#]],
        );
        check(
            "; collected\ncomment { not a system }\nTwo {\nangle 8\naxiom x\nx=f+[x]\nX=y ; joined\ny=\n}\n\nNamed = {\nAxiom=FX\nangle=4\nx fy\n}",
            expect![[r#"
                Fractint
                [Two]
                n 16, angle 45, heading 0, abop
                  X
                  X -> F+[X]Y
                  Y -> *
                note 3 "": The text gives no number of iterations; 16 is chosen by the size
                [Named]
                n 1, angle 90, heading 0, abop
                  FX
                  X -> FY
                note 11 "": The text gives no number of iterations; 1 is chosen by the size"#]],
        );
        check(
            "Angle 6\nAxiom F--F--F\nF=F+F--F+F",
            expect![[r#"
            Fractint
            []
            n 5, angle 60, heading 0, abop
              F--F--F
              F -> F+F--F+F
            note 1 "": The text gives no number of iterations; 5 is chosen by the size"#]],
        );
    }

    #[test]
    fn moves_and_letters_without_meaning() {
        check(
            "A {\nangle 4\naxiom fgh\nf=f+g$f\n}",
            expect![[r#"
            Fractint
            [A]
            n 12, angle 90, heading 0, abop
              FGH
              F -> F+G$F
              | $: nothing
              | G: move
            note 1 "": The text gives no number of iterations; 12 is chosen by the size"#]],
        );
        check(
            "D {\nangle 4\naxiom d+m|\nd=d\\45d/30m\n}",
            expect![[r#"
            Fractint
            [D]
            n 12, angle 90, heading 0, abop
              DM
              D -> DaDbM
              | D: draw
              | M: move
              | a: turn left 45
              | b: turn right 30
            note 1 "": The text gives no number of iterations; 12 is chosen by the size"#]],
        );
        check(
            "F {\nangle 4\naxiom f\\30f\n}",
            expect![[r#"
            Fractint
            [F]
            n 1, angle 90, heading 0, abop
              FF
            note 1 "": The text gives no number of iterations; 1 is chosen by the size"#]],
        );
    }

    #[test]
    fn turns_round_and_swapped() {
        check(
            "Even {\nangle 6\naxiom f|f!+f\n}",
            expect![[r#"
                Fractint
                [Even]
                n 1, angle 60, heading 0, abop
                  F|F!+F
                  | !: swap turns
                note 1 "": The text gives no number of iterations; 1 is chosen by the size"#]],
        );
        check(
            "Odd {\nangle 5\naxiom f|f\n}",
            expect![[r#"
            Fractint
            [Odd]
            n 1, angle 72, heading 0, abop
              F|F
              | |: turn right 144
            note 1 "": The text gives no number of iterations; 1 is chosen by the size"#]],
        );
        check(
            "Odd {\nangle 5\naxiom f|f!+f\n}",
            expect![[r#"
            Fractint
            [Odd]
            refused 3 "f|f!+f": `|` is less than half a circle for an odd Angle, and `!` does not swap it: our turtle cannot do both"#]],
        );
    }

    #[test]
    fn numbers() {
        check(
            "L {\nangle 4\naxiom a\na=f@.5f@q2f@iq2f@i2f@1.5.7a@.5\n}",
            expect![[r#"
                Fractint
                [L]
                n 16, angle 90, heading 0, abop
                  A
                  A -> FaFbFcFaFdAa
                  | a: length times 0.5
                  | b: length times 1.4142135623730951
                  | c: length times 0.7071067811865475
                  | d: length times 1.5
                note 1 "": The text gives no number of iterations; 16 is chosen by the size"#]],
        );
        check(
            "Z {\nangle 4\naxiom f@f\n}",
            expect![[r#"
                Fractint
                [Z]
                n 1, angle 90, heading 0, abop
                  FaF
                  | a: length times 0
                note 1 "": The text gives no number of iterations; 1 is chosen by the size"#]],
        );
        check(
            "C {\nangle 4\naxiom c1f<2f>f>3fc300f\n}",
            expect![[r#"
            Fractint
            [C]
            n 1, angle 90, heading 0, abop
              haFbFcFdFeF
              | a: colour 1
              | b: next colour 2
              | d: previous colour 3
              | e: colour 44
              | h: colour 15
            note 3 "c1f<2f>f>3fc300f": Colours are the first 16 of Fractint; higher numbers begin again
            note 1 "": The text gives no number of iterations; 1 is chosen by the size"#]],
        );
    }

    #[test]
    fn two_headings() {
        check(
            "Both {\nangle 4\naxiom f+\\90d-/90d@.5+\\90f\n}",
            expect![[r#"
                Fractint
                [Both]
                n 1, angle 90, heading 0, abop
                  F+D-Da+F
                  | D: draw
                  | a: length times 0.5
                note 1 "": The text gives no number of iterations; 1 is chosen by the size"#]],
        );
        check(
            "Straight {\nangle 4\naxiom fdfm\n}",
            expect![[r#"
            Fractint
            [Straight]
            n 1, angle 90, heading 0, abop
              FDFM
              | D: draw
              | M: move
            note 1 "": The text gives no number of iterations; 1 is chosen by the size"#]],
        );
        check(
            "Differ {\nangle 4\naxiom f\nf=f+d\n}",
            expect![[r#"
            Fractint
            [Differ]
            refused 4 "f+d": F and G go along one heading, turned by + - |, and D and M along another, turned by \ and /. Our turtle has one heading, and here the two differ"#]],
        );
    }

    #[test]
    fn refused() {
        check(
            "E {\nangle 4\naxiom f]f\nf=f[+f\n}",
            expect![[r#"
            Fractint
            [E]
            note 3 "f]f": Fractint ignores the rest of a word after a `]` that closes nothing
            refused 4 "f[+f": Fractint needs the `]` of a branch in the same word as its `[`"#]],
        );
        check(
            "E {\nangle 4\naxiom f f\n+=ff\n what is this\n}",
            expect![[r#"
            Fractint
            [E]
            refused 3 "f": Fractint does not allow more text after a blank
            refused 4 "+=ff": Fractint does not allow a rule for this symbol
            refused 5 "what is this": Fractint cannot read this line"#]],
        );
        check(
            "E {\nangle 2\naxiom f\nf=f+f }",
            expect![[r#"
            Fractint
            [E]
            n 13, angle 180, heading 0, abop
              F
              F -> F+F
            note 2 "angle 2": Fractint accepts angles from 3 to 50 only; 360 is divided by this number
            note 1 "": The text gives no number of iterations; 13 is chosen by the size"#]],
        );
        check(
            "E {\naxiom f\nf=f+f\n}",
            expect![[r#"
            Fractint
            [E]
            refused 1 "": There is no Angle from 3 to 50"#]],
        );
        check(
            "E {\nangle 4\nf=f+f\n}\nG {\nangle 4\naxiom f\n}",
            expect![[r#"
            Fractint
            [E]
            refused 1 "": There is no Axiom
            [G]
            n 1, angle 90, heading 0, abop
              F
            note 5 "": The text gives no number of iterations; 1 is chosen by the size"#]],
        );
    }
}
