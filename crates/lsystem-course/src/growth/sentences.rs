//! Growth in a few sentences.

use crate::growth::text::decimal;
use crate::growth::{Growth, GrowthKind, Series};
use lsystem_base::words::shown;
use lsystem_base::{say, word};

pub(crate) fn sentences(growth: &Growth) -> Vec<String> {
    let draws = growth.table.iter().any(|row| row.segments.log10.is_some());
    let (what, series) = if draws { (say!("segments"), &growth.segments) } else { (say!("symbols"), &growth.symbols) };
    let mut sentences = vec![grows(growth.is_random, &what, series)];
    if let Some(closed) = &series.closed {
        sentences.push(match series.closed_from {
            0 => say!("After n steps there are {} {}.", closed, what),
            from => say!("After n steps there are {} {}, from n = {} on.", closed, what, from),
        });
    } else if let Some(recurrence) = &series.recurrence {
        sentences.push(say!("The numbers of {} follow {}, from n = {} on.", what, recurrence, series.from));
    }
    if let (true, Some(row)) = (growth.is_random, growth.table.last())
        && let Some(spread) = row.spread
    {
        let words = say!(
            "After {} steps {} {} are expected, with a standard deviation of {}.",
            row.n,
            row.segments.digits,
            what,
            rounded(spread)
        );
        sentences.push(words);
    }
    if let (Some(stretch), Some(dimension)) = (growth.stretch, growth.dimension) {
        let (stretch, factor) = (shown(&decimal(stretch)), rounded(series.factor));
        sentences.push(say!("Each step makes the curve {} times as far and draws {} times as many segments, so its similarity dimension is log {} / log {} = {}. If the pieces meet only at their ends, this is its fractal dimension.", stretch, factor, factor, stretch, four(dimension)));
    }
    sentences
}

fn grows(is_random: bool, what: &str, series: &Series) -> String {
    let factor = match &series.exact_factor {
        Some(exact) if exact.contains('√') => say!("{}, about {}", exact, four(series.factor)),
        Some(exact) => exact.clone(),
        None => four(series.factor),
    };
    let power = if series.degree == 1 { "n".to_owned() } else { format!("n^{}", series.degree) };
    // The first is certain, the second holds on average.
    let both = match (series.kind, series.degree) {
        (GrowthKind::Dying, _) => [word!("The {} die out."), word!("The {} die out on average.")],
        (GrowthKind::Bounded, _) => {
            [word!("The number of {} stays below a bound."), word!("The number of {} stays below a bound on average.")]
        }
        (GrowthKind::Polynomial, _) => {
            let both = [word!("The number of {} grows like {}."), word!("The number of {} grows like {} on average.")];
            return say!(both[usize::from(is_random)], what, power);
        }
        (GrowthKind::Exponential, 0) => [
            word!("In the long run each step multiplies the number of {} by {}."),
            word!("In the long run each step multiplies the number of {} by {} on average."),
        ],
        (GrowthKind::Exponential, _) => {
            let both = [
                word!("The number of {} grows like {} times the n-th power of {}."),
                word!("The number of {} grows like {} times the n-th power of {} on average."),
            ];
            return say!(both[usize::from(is_random)], what, power, factor);
        }
    };
    say!(both[usize::from(is_random)], what, factor)
}

/// Four decimals, without zeros at the end.
fn four(value: f64) -> String {
    let text = format!("{value:.4}");
    shown(text.trim_end_matches('0').trim_end_matches('.'))
}

/// A number for reading.
fn rounded(value: f64) -> String {
    shown(&if value < 1e6 { decimal(value) } else { format!("{value:.3e}") })
}
