//! Symbols, turns and colours of Fractint in our notation.

use super::{Parts, Token, Turns};
use crate::draft::{Draft, FreeSymbols, production, turtle};
use lsystem_base::{number::number, say};
use lsystem_syntax::{Colour, Grammar, Module};
use std::collections::HashMap;

pub(super) fn translate<'a>(parts: &mut Parts<'a>, draft: &mut Draft<'a>) {
    let symbols = parts.reachable();
    let is_used = |letter: Option<char>| letter.is_none_or(|letter| symbols.contains(&letter));
    for rule in parts.rules.iter().filter(|rule| !is_used(rule.letter)) {
        draft.note_at(draft.place(rule.line), say!("The axiom never becomes this letter, so its rule is left out"));
    }
    parts.rules.retain(|rule| is_used(rule.letter));
    let has = |list: &str| list.chars().any(|c| symbols.contains(&c));
    draft.definition.heading = 0.0;
    draft.definition.angle = 360.0 / f64::from(parts.angle);
    let turns = match (has("fg"), has("dm")) {
        (_, false) => Turns::Fixed,
        (false, true) => Turns::Degrees,
        (true, true) if !has("+-|\\/") => Turns::Fixed,
        (true, true) => {
            if let Some(text) = unequal_turns(parts, has("!")) {
                let why = say!(
                    "F and G go along one heading, turned by + - |, and D and M along another, turned by \\ and /. \
                           Our turtle has one heading, and here the two differ"
                );
                return draft.refuse_at(draft.place(text), why);
            }
            Turns::Fixed
        }
    };
    // Turns of the heading that no line and no move uses have no effect.
    for word in parts.words_mut() {
        word.tokens.retain(|token| match token {
            Token::Plain('+' | '-' | '|') => turns == Turns::Fixed,
            Token::Number('\\' | '/', degrees) => turns == Turns::Degrees && *degrees != 0.0,
            _ => true,
        });
    }
    draft.others = Some("");
    turtle("Fractint").for_each(|(symbol, actions)| draft.meaning(symbol, actions));
    turn_round(parts, turns, has("!"), draft);
    let joined = parts.joined();
    let mut free = FreeSymbols::default();
    for (letter, tokens) in &joined {
        let plain = tokens.iter().filter_map(|token| if let Token::Plain(ch) = token { Some(*ch) } else { None });
        plain.chain(*letter).for_each(|ch| free.add_used(upper(ch).encode_utf8(&mut [0; 4])));
    }
    let mut known = HashMap::new();
    let mut grammar = Grammar::default();
    for (letter, tokens) in joined {
        let word: Vec<char> = tokens.iter().map(|token| symbol(*token, &mut free, &mut known, draft)).collect();
        match letter {
            None => grammar.axiom = word.into_iter().map(Module::from).collect(),
            Some(letter) => grammar.productions.push(production(upper(letter), word)),
        }
    }
    if has("c<>") {
        colours(parts, &mut grammar, &mut free, draft);
    }
    draft.grammar(&grammar);
}

/// The letter of a Fractint symbol in our notation: upper case, so that the lower case is free.
pub(super) fn upper(ch: char) -> char {
    ch.to_ascii_uppercase()
}

/// The symbol for a token. Tokens with numbers become custom symbols, which `known` holds.
pub(super) fn symbol(
    token: Token,
    free: &mut FreeSymbols,
    known: &mut HashMap<(char, u64), char>,
    draft: &mut Draft<'_>,
) -> char {
    let (ch, value) = match token {
        Token::Plain(ch) => return upper(ch),
        Token::Number(ch, value) => (ch, value),
    };
    if let Some(symbol) = known.get(&(ch, value.to_bits())) {
        return *symbol;
    }
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
    known.insert((ch, value.to_bits()), symbol);
    draft.meaning(symbol, actions);
    symbol
}

/// Sets the meaning of `|`: half a circle, or the nearest smaller angle to the right for an odd number of directions.
fn turn_round<'a>(parts: &Parts<'a>, turns: Turns, swaps: bool, draft: &mut Draft<'a>) {
    let half = f64::from(parts.angle / 2) * 360.0 / f64::from(parts.angle);
    if parts.angle.is_multiple_of(2) {
        draft.meaning('|', "turn round");
        return;
    }
    draft.meaning('|', format!("turn right {}", number(half)));
    if turns == Turns::Fixed && swaps && parts.words().any(|word| word.tokens.contains(&Token::Plain('|'))) {
        let why = say!(
            "`|` is less than half a circle for an odd Angle, and `!` does not swap it: our turtle cannot do both"
        );
        draft.refuse_at(draft.place(parts.place(&['|'])), why);
    }
}

/// Looks whether each group of turns changes both headings alike, so that `\` and `/` are unnecessary. Otherwise returns
/// the text of a word where they differ.
fn unequal_turns<'a>(parts: &Parts<'a>, swaps: bool) -> Option<&'a str> {
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
    if parts.joined().iter().any(|(_, word)| wrong(word)) {
        let place = parts.words().find(|word| wrong(&word.tokens)).map(|word| word.text);
        return Some(place.unwrap_or_else(|| parts.place(&['+', '-', '|', '\\', '/'])));
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

/// The other colours of Fractint's default palette, which are those that a VGA starts with: 16 greys, and 24 hues in three
/// brightnesses with three saturations each.
fn higher_colours() -> impl Iterator<Item = [u8; 3]> {
    const GREYS: [u8; 16] = [0, 5, 8, 11, 14, 17, 20, 24, 28, 32, 36, 40, 45, 50, 56, 63];
    const LEVELS: [[u8; 5]; 9] = [
        [0, 16, 31, 47, 63],
        [31, 39, 47, 55, 63],
        [45, 49, 54, 58, 63],
        [0, 7, 14, 21, 28],
        [14, 17, 21, 24, 28],
        [20, 22, 24, 26, 28],
        [0, 4, 8, 12, 16],
        [8, 10, 12, 14, 16],
        [11, 12, 13, 15, 16],
    ];
    // From blue over red and green: one of the three parts rises or falls in each sixth of the hues.
    let hue = |at: usize, levels: [u8; 5]| {
        let (up, down) = (levels[at % 4], levels[4 - at % 4]);
        match at / 4 {
            0 => [up, levels[0], levels[4]],
            1 => [levels[4], levels[0], down],
            2 => [levels[4], up, levels[0]],
            3 => [down, levels[4], levels[0]],
            4 => [levels[0], levels[4], up],
            _ => [levels[0], down, levels[4]],
        }
    };
    let hues = LEVELS.into_iter().flat_map(move |levels| (0..24).map(move |at| hue(at, levels)));
    let all = GREYS.into_iter().map(|grey| [grey; 3]).chain(hues).chain([[0; 3]; 8]);
    all.map(|rgb| rgb.map(|part| part * 4))
}

/// Takes over colours: those of Fractint's default palette, starting with number 15 on black.
fn colours<'a>(parts: &Parts<'a>, grammar: &mut Grammar, free: &mut FreeSymbols, draft: &mut Draft<'a>) {
    let tokens = || parts.words().flat_map(|word| &word.tokens);
    let steps = tokens().any(|token| matches!(token, Token::Number('<' | '>', value) if *value >= 1.0));
    let is_high = |token: &Token| matches!(token, Token::Number('c', value) if *value as i64 % 256 > 15);
    let mut palette: Vec<[u8; 3]> = PALETTE.to_vec();
    if steps || tokens().any(is_high) {
        palette.extend(higher_colours());
    }
    let style = &mut draft.definition.style;
    style.palette = palette.into_iter().map(|rgb| Colour { rgb }).collect();
    style.background = Colour { rgb: PALETTE[0] };
    let first = free.get("colour 15");
    draft.meaning(first, "colour 15");
    grammar.axiom.insert(0, Module::from(first));
    let message = if steps {
        say!(
            "The text gives no palette; colours are those of Fractint’s default palette; there `<` and `>` leave out \
             colour 0"
        )
    } else {
        say!("The text gives no palette; colours are those of Fractint’s default palette")
    };
    draft.note_at(draft.place(parts.place(&['c', '<', '>'])), message);
}
