//! Random texts in the notation: mostly valid ones, and texts of arbitrary pieces.

use crate::Source;
use crate::pieces::pieces;
use core::fmt::Write;
use lsystem::syntax::{ACTIONS, Function, NumberForm};

/// Letters, and all symbols with a meaning in a dialect or in the notation.
const SYMBOLS: &str = "FGfgABXYLPQabcxyz+-|[]{}.!#',;%&^\\/$<>v*:=()~@é木🌱○●01";
/// The symbols of most words; they draw in the plane.
const COMMON: &str = "FFFFABX++--fG";
/// Symbols that fill polygons, leave the plane or change the style.
const SPECIAL: &str = "&^\\/$|!#'{}.%;,f";
/// Characters that are wrong in a word: operators, look-alikes and invisible characters.
const STRANGE: &str =
    "`:->=#/*()<ε→.,;{}|\\^&$!'\"% \t\n\r_−–—’“ˆ（）＞⇒\u{feff}\u{200b}\u{a0}\u{2028}\u{0}\u{301}é木🌱";

/// The features of a system beyond plain letters.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct SystemFeatures {
    pub(super) contexts: bool,
    pub(super) parameters: bool,
    pub(super) weights: bool,
    pub(super) images: bool,
    pub(super) special: bool,
    pub(super) unbalanced: bool,
    pub(super) long: bool,
}

impl SystemFeatures {
    pub(super) fn make(source: &mut Source<'_>) -> Self {
        Self {
            contexts: source.once_in(5),
            parameters: source.once_in(3),
            weights: source.once_in(5),
            images: source.once_in(8),
            special: source.once_in(3),
            unbalanced: source.once_in(6),
            long: source.once_in(16),
        }
    }
}

/// A symbol in a text, quoted if necessary.
fn symbol(source: &mut Source<'_>, features: SystemFeatures) -> String {
    match source.below(12) {
        0..8 => source.pick_char(COMMON).to_string(),
        8 | 9 if features.special => match source.pick_char(SPECIAL) {
            // A lone brace leaves a polygon open, and such systems seldom share blocks.
            '{' | '}' if !features.unbalanced => ".".to_owned(),
            special => special.to_string(),
        },
        10 => quoted(source.pick_char(SYMBOLS), features),
        11 if source.once_in(8) => quoted(source.pick_char(STRANGE), features),
        _ => source.pick_char("FABX+-").to_string(),
    }
}

/// A character, in backquotes if it has another meaning in the notation.
fn quoted(symbol: char, features: SystemFeatures) -> String {
    match symbol {
        '[' | ']' | '{' | '}' if !features.unbalanced => "F".to_owned(),
        '`' => "U+60".to_owned(),
        c if c.is_control() || c.is_whitespace() => format!("`U+{:02X}`", u32::from(c)),
        c if c.is_ascii_alphanumeric() || "+-|&^'!,.".contains(c) => c.to_string(),
        c => format!("`{c}`"),
    }
}

/// A word; arguments of its modules use `names`.
pub(super) fn word(source: &mut Source<'_>, features: SystemFeatures, names: &[&str], depth: u32) -> String {
    let mut text = String::new();
    for _ in 0..source.between(1, 6) {
        let piece = match source.below(10) {
            0..5 => symbol(source, features),
            5 if depth > 0 => format!("[{}]", word(source, features, names, depth - 1)),
            6 if depth > 0 && features.special => format!("{{{}}}", word(source, features, names, depth - 1)),
            7 if features.parameters => module(source, names),
            8 if features.unbalanced => source.pick(&["[", "]", "{", "}", "%"]).to_owned(),
            9 if features.long && depth > 0 => {
                let times = source.pick(&[2, 3, 5, 10, 30, 100, 300, 1000, 2048, 8192]);
                // Nested repeats would exceed the limit of texts.
                let few = SystemFeatures { long: false, ..features };
                word(source, few, names, 0).repeat(times)
            }
            _ => symbol(source, features),
        };
        text.push_str(&piece);
    }
    text
}

/// A module with arguments.
fn module(source: &mut Source<'_>, names: &[&str]) -> String {
    let symbol = source.pick_word("A B P Q F f + - ! & / ' ?P ?H ?L ?U ?C ?S");
    let count = source.pick(&[1, 1, 1, 2, 2, 3, 8]);
    let arguments: Vec<String> = (0..count).map(|_| expression(source, names, 2)).collect();
    format!("{symbol}({})", arguments.join(","))
}

/// An expression over these names.
pub(crate) fn expression(source: &mut Source<'_>, names: &[&str], depth: u32) -> String {
    const OPERATORS: [&str; 16] =
        ["+", "-", "*", "/", "%", "^", "<", "<=", ">", ">=", "==", "!=", "&&", "||", " and ", " or "];
    const FUNCTIONS: &str = "sin cos tan asin acos atan atan2 sqrt exp ln abs floor ceil min max random ran nran";
    match source.below(if depth == 0 { 4 } else { 10 }) {
        0 | 1 if !names.is_empty() => source.pick(names).to_owned(),
        0..=2 => source.pick(&["1", "0.5", "2", "0", "-1", "3", "0.9", "10", "r"]).to_owned(),
        3 => match source.number() {
            number if number.is_finite() && number.abs() < 1e15 => format!("{number}"),
            number if number.is_finite() => format!("{number:e}"),
            _ => "1e308".to_owned(),
        },
        4..=6 => {
            let operator = source.pick(&OPERATORS);
            let (a, b) = (expression(source, names, depth - 1), expression(source, names, depth - 1));
            if source.once_in(2) { format!("({a}){operator}({b})") } else { format!("{a}{operator}{b}") }
        }
        7 if source.once_in(4) => {
            let name = source.pick(&["inside", "distance"]);
            let point: Vec<String> = (0..source.pick(&[2, 3])).map(|_| expression(source, names, depth - 1)).collect();
            format!("{name}(crown, {})", point.join(", "))
        }
        7 if source.once_in(6) => format!("taper({})", expression(source, names, depth - 1)),
        7 => {
            let name = source.pick_word(FUNCTIONS);
            let arity = Function::named(name).map_or(1, Function::arity);
            let arguments: Vec<String> = (0..arity).map(|_| expression(source, names, depth - 1)).collect();
            format!("{name}({})", arguments.join(", "))
        }
        8 => {
            let sign = source.pick(&["-", "!", "not "]);
            let times = source.pick(&[1, 1, 1, 2, 8, 40]);
            format!("{}{}", sign.repeat(times), expression(source, names, depth - 1))
        }
        _ => format!("({})", expression(source, names, depth - 1)),
    }
}

/// A predecessor or a part of a context. Adds its parameters to `names`.
fn pattern(source: &mut Source<'_>, features: SystemFeatures, names: &mut Vec<&'static str>) -> String {
    const NAMES: [&str; 8] = ["x", "y", "a", "b", "l", "w", "s", "t"];
    let symbol = if source.once_in(6) {
        symbol(source, features)
    } else if features.parameters && source.once_in(4) {
        source.pick(&["?P", "?H", "?C", "?S"]).to_owned()
    } else {
        source.pick_char("FABXPQ").to_string()
    };
    if !features.parameters || source.once_in(2) {
        return symbol;
    }
    let count = source.pick(&[1, 1, 2, 3]);
    let own: Vec<&str> = NAMES.into_iter().filter(|name| !names.contains(name)).take(count).collect();
    names.extend(&own);
    if own.is_empty() { symbol } else { format!("{symbol}({})", own.join(",")) }
}

/// A production.
fn production(source: &mut Source<'_>, features: SystemFeatures, image: bool) -> String {
    let mut names = vec![];
    let mut text = String::new();
    let context = features.contexts && !image;
    if context && source.once_in(2) {
        for _ in 0..source.pick(&[1, 1, 1, 2, 3, 64]) {
            text += &pattern(source, features, &mut names);
        }
        text += " < ";
    }
    text += &pattern(source, features, &mut names);
    if context && source.once_in(2) {
        text += " > ";
        for _ in 0..source.pick(&[1, 1, 1, 2, 3, 64]) {
            let one = pattern(source, features, &mut names);
            text += &if source.once_in(3) { format!("[{one}]") } else { one };
        }
    }
    if features.parameters && source.once_in(3) {
        let _ = write!(text, " : {}", expression(source, &names, 2));
    }
    text += " -> ";
    text += &if source.once_in(12) { "*".to_owned() } else { word(source, features, &names, 2) };
    if features.weights {
        let weight = if features.parameters && source.once_in(4) {
            expression(source, &names, 1)
        } else {
            source.pick(&["1", "0.5", "2", "0.33", "0", "1e-300", "1e300"]).to_owned()
        };
        let _ = write!(text, " : {weight}");
    }
    text
}

/// A shape of solids with small, large and wrong numbers.
fn shape(source: &mut Source<'_>, depth: u32) -> String {
    let number = |source: &mut Source<'_>| source.pick(&["0", "1", "-2", "3.5", "10", "r", "1e-9", "1e300"]);
    if depth > 0 && source.once_in(2) {
        let sign = source.pick(&["+", "-", "&"]);
        let (a, b) = (shape(source, depth - 1), shape(source, depth - 1));
        return if source.once_in(2) { format!("{a} {sign} {b}") } else { format!("({a}) {sign} ({b})") };
    }
    let shape = source.pick_word("ball:4 box:6 cylinder:7 cone:7 half:6 outline:6 outline:40 mesh:36");
    let (name, count) = shape.split_once(':').unwrap_or((shape, "1"));
    let numbers: Vec<&str> = (0..count.parse().unwrap_or(1)).map(|_| number(source)).collect();
    format!("{name}({})", numbers.join(", "))
}

/// A curve, mostly with points in order.
fn curve(source: &mut Source<'_>) -> String {
    let points = (0..source.pick(&[0, 1, 2, 2, 3, 4, 4, 6, 9, 70])).map(|at| {
        let x = if source.once_in(12) { source.pick(&["-1", "r", "1e300"]).to_owned() } else { at.to_string() };
        format!("({x}, {})", source.pick(&["0", "1", "-2.5", "r", "1e9", "1e300"]))
    });
    points.collect::<Vec<_>>().join(" ")
}

/// Rules, one on each line.
pub(super) fn rules(source: &mut Source<'_>, features: SystemFeatures) -> String {
    let mut lines = vec![];
    if features.parameters || source.once_in(10) {
        lines.push(format!("r = {}", source.pick(&["0.75", "0.9", "1", "2", "-1", "1.5*2", "1e300"])));
    }
    if features.parameters {
        lines.push(format!("shape crown = {}", shape(source, 2)));
        lines.push(format!("curve taper = {}", curve(source)));
    }
    if features.contexts && source.once_in(2) {
        lines.push(source.pick(&["ignore: +-F", "consider: ABX", "ignore: +-&^/\\", "ignore:"]).to_owned());
    }
    for _ in 0..source.pick(&[1, 1, 2, 2, 3, 4, 6]) {
        lines.push(production(source, features, false));
    }
    if features.images {
        lines.push("draw:".to_owned());
        for _ in 0..source.between(1, 3) {
            let image = SystemFeatures { weights: false, ..features };
            lines.push(production(source, image, true));
        }
    }
    lines.join("\n")
}

/// Surfaces, mostly with the right number of numbers.
pub(crate) fn surfaces(source: &mut Source<'_>) -> String {
    let mut text = String::new();
    for _ in 0..source.between(1, 3) {
        text.push(source.pick_char("lm2"));
        text.push(':');
        let count = 48 * source.between(1, 2) - usize::from(source.once_in(20));
        for _ in 0..count {
            let _ = write!(text, " {}", source.between(0, 9) as f64 / 4.0 - 1.0);
        }
        text.push('\n');
    }
    text
}

/// Overrides of a dialect.
pub(crate) fn overrides(source: &mut Source<'_>) -> String {
    let mut lines = vec![];
    for _ in 0..source.between(1, 4) {
        let symbol = if source.once_in(8) { source.pick_char(SYMBOLS) } else { source.pick_char("FABXfG+-") };
        let symbol = quoted(symbol, SystemFeatures { unbalanced: true, ..SystemFeatures::default() });
        let mut actions = vec![];
        for _ in 0..source.pick(&[1, 1, 1, 2, 3, 6, 40]) {
            let number = if source.once_in(4) { source.number() } else { source.pick(&[0.0, 1.0, 90.0, 0.5, 17.3]) };
            let index = source.pick(&[0, 1, 2, 7, 255, i32::MAX]);
            let row = &ACTIONS[source.below(ACTIONS.len())];
            let (words, usual) = row.example();
            let own = if matches!(row.form, NumberForm::Index | NumberForm::Along(_)) { index.into() } else { number };
            let is_usual = matches!(row.form, NumberForm::Plain(_)) || source.once_in(3);
            let action = if is_usual { words + usual } else { format!("{words} {own}") };
            actions.push(if source.once_in(20) { "nothing".to_owned() } else { action });
        }
        lines.push(format!("{symbol}: {}", actions.join(", ")));
    }
    lines.join("\n")
}

/// A text of pieces of the notation and other characters, in any order.
pub(crate) fn random_pieces(source: &mut Source<'_>) -> String {
    let mut text = String::new();
    for _ in 0..source.between(0, 40) {
        match source.below(8) {
            0..3 => text.push_str(source.pick(pieces("notation"))),
            3 | 4 => text.push(source.pick_char(SYMBOLS)),
            5 => text.push(source.pick_char(STRANGE)),
            6 => text.push(char::from_u32(source.word() % 0x11_0000).unwrap_or('\u{fffd}')),
            _ if source.once_in(8) => {
                let piece = source.pick(pieces("notation"));
                text.push_str(&piece.repeat(source.between(1, 300)));
            }
            _ => text.push_str(&expression(source, &["x", "r"], 3)),
        }
    }
    text
}

/// Changes a text up to `most` times: parts are removed, repeated elsewhere, or replaced by pieces.
pub(crate) fn damage(source: &mut Source<'_>, text: &mut String, pieces: &[&str], most: usize) {
    for _ in 0..source.between(0, most) {
        let (from, to) = (source.place(text), source.place(text));
        let times = if source.once_in(60) { source.pick(&[10, 500, 20_000]) } else { 1 };
        let inserted = match source.below(4) {
            0 => text[from.min(to)..from.max(to)].to_owned(),
            _ => source.pick(pieces).repeat(times),
        };
        let end = if source.once_in(4) { to.max(from) } else { from };
        text.replace_range(from..end, &inserted);
    }
}
