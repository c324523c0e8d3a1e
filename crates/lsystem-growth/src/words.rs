//! Growth in a few sentences.

use crate::text::decimal;
use crate::{Growth, GrowthKind, Series};

pub(crate) fn sentences(growth: &Growth) -> Vec<String> {
    let draws = growth.table.iter().any(|row| row.segments.log10.is_some());
    let (what, series) = if draws { ("segments", &growth.segments) } else { ("symbols", &growth.symbols) };
    let mut sentences = vec![grows(growth.is_random, what, series)];
    if let Some(closed) = &series.closed {
        let from =
            if series.closed_from == 0 { String::new() } else { format!(", from n = {} on", series.closed_from) };
        sentences.push(format!("After n steps there are {closed} {what}{from}."));
    } else if let Some(recurrence) = &series.recurrence {
        sentences.push(format!("The numbers of {what} follow {recurrence}, from n = {} on.", series.from));
    }
    if let (true, Some(row)) = (growth.is_random, growth.table.last())
        && let Some(spread) = row.spread
    {
        let words = format!(
            "After {} steps {} {what} are expected, with a standard deviation of {}.",
            row.n,
            row.segments.digits,
            rounded(spread)
        );
        sentences.push(words);
    }
    if let (Some(stretch), Some(dimension)) = (growth.stretch, growth.dimension) {
        let (stretch, factor) = (decimal(stretch), rounded(series.factor));
        sentences.push(format!("Each step makes the curve {stretch} times as far and draws {factor} times as many segments, so its similarity dimension is log {factor} / log {stretch} = {}. If the pieces meet only at their ends, this is its fractal dimension.", four(dimension)));
    }
    sentences
}

fn grows(is_random: bool, what: &str, series: &Series) -> String {
    let mean = if is_random { " on average" } else { "" };
    let factor = match &series.exact_factor {
        Some(exact) if exact.contains('√') => format!("{exact}, about {}", four(series.factor)),
        Some(exact) => exact.clone(),
        None => four(series.factor),
    };
    match (series.kind, series.degree) {
        (GrowthKind::Dying, _) => format!("The {what} die out{mean}."),
        (GrowthKind::Bounded, _) => format!("The number of {what} stays below a bound{mean}."),
        (GrowthKind::Polynomial, 1) => format!("The number of {what} grows like n{mean}."),
        (GrowthKind::Polynomial, degree) => format!("The number of {what} grows like n^{degree}{mean}."),
        (GrowthKind::Exponential, 0) => {
            format!("In the long run each step multiplies the number of {what} by {factor}{mean}.")
        }
        (GrowthKind::Exponential, degree) => {
            let power = if degree == 1 { "n".to_owned() } else { format!("n^{degree}") };
            format!("The number of {what} grows like {power} times the n-th power of {factor}{mean}.")
        }
    }
}

/// Four decimals, without zeros at the end.
fn four(value: f64) -> String {
    let text = format!("{value:.4}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// A number for reading.
fn rounded(value: f64) -> String {
    if value < 1e6 { decimal(value) } else { format!("{value:.3e}") }
}
