//! Recurrences and closed forms as text and as LaTeX.

use crate::growth::closed::{Pair, Term};
use crate::growth::fraction::Fraction;
use crate::growth::recurrence::Recurrence;

/// How a formula is written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Style {
    Plain,
    Latex,
}

/// A number with at most three decimals, without zeros at the end.
pub(crate) fn decimal(value: f64) -> String {
    let text = format!("{value:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// `s(n) = 3 s(n-1) - s(n-2)`.
pub(crate) fn recurrence(recurrence: &Recurrence, style: Style) -> String {
    let of = |back: usize| match style {
        Style::Plain => format!("s(n-{back})"),
        Style::Latex => format!("s_{{n-{back}}}"),
    };
    let parts = recurrence.coefficients.iter().enumerate().filter(|(_, value)| **value != 0).map(|(at, &value)| {
        let times = if value.abs() == 1 { String::new() } else { format!("{} ", value.abs()) };
        (value < 0, format!("{times}{}", of(at + 1)))
    });
    let left = if style == Style::Plain { "s(n)" } else { "s_n" };
    format!("{left} = {}", summed(parts))
}

pub(crate) fn closed(terms: &[Term], style: Style) -> String {
    summed(terms.iter().flat_map(|term| {
        match *term {
            Term::Whole { factor, power, root } => vec![whole(factor, power, root, style)],
            Term::Pair { u, v, pair } => [1, -1]
                .map(|sign| {
                    (false, format!("{}{}", surd(u, v, pair.d, sign, style), raised(&root(pair, sign, style), style)))
                })
                .to_vec(),
        }
    }))
}

/// A term with whether it is negative.
fn whole(factor: Fraction, power: u32, root: i128, style: Style) -> (bool, String) {
    let n = match power {
        0 => None,
        1 => Some("n".to_owned()),
        power => Some(raise("n", &power.to_string(), style)),
    };
    let root = match root {
        1 => None,
        root if root < 0 => Some(raise(&format!("({root})"), "n", style)),
        root => Some(raise(&root.to_string(), "n", style)),
    };
    let size = fraction(Fraction { over: factor.over.abs(), under: factor.under }, style);
    let parts: Vec<String> = [n, root].into_iter().flatten().collect();
    let dot = if style == Style::Plain { " · " } else { " \\cdot " };
    let text = match (size.as_str(), parts.is_empty()) {
        (_, true) => size,
        ("1", false) => parts.join(dot),
        _ => format!("{size}{dot}{}", parts.join(dot)),
    };
    (factor.over < 0, text)
}

/// `(p ± k √d) / 2` in lowest terms.
pub(crate) fn root(pair: Pair, sign: i128, style: Style) -> String {
    let halves = |value: i128| Fraction::new(value, 2).unwrap_or(Fraction::ZERO);
    surd_text(halves(pair.p), halves(pair.k * sign), pair.d, style)
}

/// `(u ± v √d) · ` as a factor.
fn surd(u: Fraction, v: Fraction, d: i128, sign: i128, style: Style) -> String {
    let text = surd_text(u, Fraction { over: v.over * sign, ..v }, d, style);
    let dot = if style == Style::Plain { " · " } else { " \\cdot " };
    if text == "1" { String::new() } else { format!("({text}){dot}") }
}

fn surd_text(u: Fraction, v: Fraction, d: i128, style: Style) -> String {
    // Over a common denominator: (a ± b √d) / c.
    let under = u.under / gcd(u.under, v.under) * v.under;
    let (a, b) = (u.over * (under / u.under), v.over * (under / v.under));
    let radical = match style {
        Style::Plain => format!("√{d}"),
        Style::Latex => format!("\\sqrt{{{d}}}"),
    };
    let radical = if b.abs() == 1 { radical } else { format!("{}{radical}", b.abs()) };
    let sum = match (a, b < 0) {
        (0, true) => format!("-{radical}"),
        (0, false) => radical,
        (a, true) => format!("{a} - {radical}"),
        (a, false) => format!("{a} + {radical}"),
    };
    match (under, style) {
        (1, _) => sum,
        (under, Style::Plain) if a == 0 => format!("{sum}/{under}"),
        (under, Style::Plain) => format!("({sum})/{under}"),
        (under, Style::Latex) => format!("\\frac{{{sum}}}{{{under}}}"),
    }
}

fn raised(base: &str, style: Style) -> String {
    match style {
        Style::Plain => format!("({base})^n"),
        Style::Latex => format!("\\left({base}\\right)^n"),
    }
}

fn raise(base: &str, exponent: &str, style: Style) -> String {
    match style {
        Style::Plain => format!("{base}^{exponent}"),
        Style::Latex => format!("{base}^{{{exponent}}}"),
    }
}

fn fraction(value: Fraction, style: Style) -> String {
    match (value.under, style) {
        (1, _) => value.over.to_string(),
        (under, Style::Plain) => format!("{}/{under}", value.over),
        (under, Style::Latex) => format!("\\frac{{{}}}{{{under}}}", value.over),
    }
}

/// Parts with whether each is negative, as a sum.
fn summed(parts: impl Iterator<Item = (bool, String)>) -> String {
    let mut sum = String::new();
    for (is_negative, part) in parts {
        sum += match (sum.is_empty(), is_negative) {
            (true, false) => "",
            (true, true) => "-",
            (false, false) => " + ",
            (false, true) => " - ",
        };
        sum += &part;
    }
    if sum.is_empty() { "0".to_owned() } else { sum }
}

fn gcd(a: i128, b: i128) -> i128 {
    if b == 0 { a.abs().max(1) } else { gcd(b, a % b) }
}
