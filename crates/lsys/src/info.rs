//! `lsys info`: what is known about a system without looking at its picture.

use crate::cli::Changes;
use crate::input::{self, Input};
use crate::output::escape_json;
use crate::{Failure, cores, print};
use lsystem::derive::Tally;
use lsystem::drawing::Space;
use lsystem::syntax::visible;
use lsystem::{Diagnostic, Drawing, Progress, count_segments, count_symbols};
use serde::Serialize;
use std::fmt::{self, Display};
use std::path::PathBuf;

/// What `lsys info` tells of one file.
#[derive(Serialize)]
struct Facts {
    file: String,
    name: String,
    title: String,
    /// As [`lsystem::drawing::kind`].
    kind: String,
    iterations: u32,
    seed: u32,
    /// Exact, as decimal digits; `None` where a limit is passed before they are known.
    symbols: Option<String>,
    /// As `symbols`.
    segments: Option<String>,
    /// The least and the greatest coordinates, x, y, and z where the drawing leaves the plane, of all segments' axes, in model units; `None` where nothing is drawn, a limit is
    /// passed, or a number is beyond the range of `f64`.
    bounds: Option<Vec<f64>>,
    growth: Growth,
    /// Whether equal pieces of the drawing are shared.
    memoised: Option<bool>,
    /// Pieces of the drawing.
    blocks: Option<usize>,
    /// The limit that leaves some of it unknown.
    limit: Option<String>,
}

/// By how much the last derivation step multiplied the counts; `None` for the axiom, or where it is unknown.
#[derive(Serialize)]
struct Growth {
    symbols: Option<f64>,
    segments: Option<f64>,
}

/// Prints facts about `files`. Files that cannot be read are reported, and the others still told about.
pub(crate) fn info(files: &[PathBuf], json: bool, changes: &Changes) -> Result<(), Failure> {
    let (all, is_good) = cores::in_order(files, |file, room, say| {
        let input = input::read(file, changes, say)?;
        room.make(|shares| {
            let facts = facts(&input, shares);
            // What a share of the limits leaves unknown, all of them may tell.
            let is_known = facts.limit.is_none() && facts.symbols.is_some() && facts.segments.is_some();
            if is_known || shares == 1 { Ok(facts) } else { Err(Failure::Limit(String::new())) }
        })
    })?;
    print(|out| match (json, all.as_slice(), files.len()) {
        (false, _, _) => {
            (all.iter().enumerate()).try_for_each(|(i, facts)| write!(out, "{}{facts}", if i > 0 { "\n" } else { "" }))
        }
        (true, [], 1) => Ok(()),
        (true, [only], 1) => writeln!(out, "{}", escape_json(&serde_json::to_string_pretty(only)?)),
        (true, ..) => writeln!(out, "{}", escape_json(&serde_json::to_string_pretty(&all)?)),
    })?;
    if is_good { Ok(()) } else { Err(Failure::Said) }
}

/// What is known within one of so many `shares` of the limits.
fn facts(input: &Input, shares: u64) -> Facts {
    if input.system.is_solid() {
        facts_of(input, shares, &input.draw_solid(shares), |drawing| drawing.bounds().map(|bounds| bounds.concat()))
    } else {
        facts_of(input, shares, &input.draw(shares), |drawing| drawing.bounds().map(Vec::from))
    }
}

/// The facts about a system that has this `drawing`.
fn facts_of<S: Space>(
    input: &Input,
    shares: u64,
    drawing: &Result<Drawing<S>, Diagnostic>,
    bounds: fn(&Drawing<S>) -> Option<Vec<f64>>,
) -> Facts {
    let (system, n) = (&input.system, input.iterations);
    let (drawn, limit) = (drawing.as_ref().ok(), drawing.as_ref().err());
    let now = Counts::new(input, shares, n, drawn);
    let before = n.checked_sub(1).map(|n| Counts::new(input, shares, n, None::<&Drawing<S>>));
    let ratio = |of: fn(&Counts) -> &Option<Tally>| ratio(of(&now).as_ref()?, of(before.as_ref()?).as_ref()?);
    Facts {
        file: input.file.display().to_string(),
        name: input.definition.name.clone(),
        title: input.definition.title.clone(),
        kind: lsystem::drawing::kind(system),
        iterations: n,
        seed: system.seed,
        growth: Growth { symbols: ratio(|c| &c.symbols), segments: ratio(|c| &c.segments) },
        symbols: now.symbols.map(|count| count.to_string()),
        segments: now.segments.map(|count| count.to_string()),
        bounds: drawn.and_then(bounds).filter(|b| b.iter().all(|x| x.is_finite())),
        memoised: drawn.map(Drawing::is_memoised),
        blocks: drawn.map(Drawing::block_count),
        limit: limit.map(Diagnostic::message),
    }
}

/// Of one generation; `None` where a limit is passed before they are known.
#[derive(Default)]
struct Counts {
    symbols: Option<Tally>,
    segments: Option<Tally>,
}

impl Counts {
    /// Of generation `n`: added up, or as its drawing knows, or derived.
    fn new<S: Space>(input: &Input, shares: u64, n: u32, drawing: Option<&Drawing<S>>) -> Self {
        let summed = Self { symbols: count_symbols(&input.system, n), segments: count_segments(&input.system, n) };
        let drawn = || Self {
            symbols: drawing.and_then(|drawing| Some(drawing.symbol_count()?.into())),
            segments: drawing.map(|drawing| drawing.segment_count().into()),
        };
        summed.or(drawn).or(|| Self::derived(input, shares, n))
    }

    /// Of generation `n`, derived.
    fn derived(input: &Input, shares: u64, n: u32) -> Self {
        let Some(mut history) = input.system.history(n, &input.limits(shares)) else { return Self::default() };
        while history.step(1 << 20) == Progress::More {}
        let symbols = history.symbols(n);
        let segments = symbols.and_then(|symbols| history.segments_before(symbols));
        Self { symbols: symbols.map(Tally::from), segments: segments.map(Tally::from) }
    }

    /// With what is not known from elsewhere.
    fn or(self, elsewhere: impl FnOnce() -> Self) -> Self {
        if self.symbols.is_some() && self.segments.is_some() {
            return self;
        }
        let other = elsewhere();
        Self { symbols: self.symbols.or(other.symbols), segments: self.segments.or(other.segments) }
    }
}

/// `a / b`, however large they are; `None` for a division by zero.
fn ratio(a: &Tally, b: &Tally) -> Option<f64> {
    /// As many as fit a `u128`, and many more than decide an `f64`.
    const DIGITS: usize = 38;
    let [a, b] = [a, b].map(Tally::to_string);
    let dropped = a.len().max(b.len()).saturating_sub(DIGITS);
    let leading = |digits: &str| digits[..digits.len().saturating_sub(dropped)].parse().unwrap_or(0_u128);
    let (a, b) = (leading(&a), leading(&b));
    let whole = a.checked_div(b)?;
    Some(whole as f64 + (a % b) as f64 / b as f64)
}

/// A number with an exponent where it has more digits than meaning.
fn readable(number: f64) -> String {
    match number.abs() {
        0.0 | 1e-4..1e15 => number.to_string(),
        _ => format!("{number:e}"),
    }
}

impl Display for Facts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let title = [&self.title, &self.name, &self.file].into_iter().find(|text| !text.is_empty());
        writeln!(f, "{}", visible(title.map_or("", String::as_str)))?;
        let unknown = || "unknown".to_owned();
        writeln!(f, "  file        {}", visible(&self.file))?;
        let blocks = self.blocks.map_or_else(String::new, |blocks| match self.memoised {
            Some(true) => format!(", memoised, blocks: {blocks}"),
            _ => format!(", not memoised, blocks: {blocks}"),
        });
        writeln!(f, "  kind        {}{blocks}", self.kind)?;
        writeln!(f, "  iterations  {}", self.iterations)?;
        if self.kind.contains("stochastic") {
            writeln!(f, "  seed        {}", self.seed)?;
        }
        writeln!(f, "  symbols     {}", self.symbols.clone().unwrap_or_else(unknown))?;
        writeln!(f, "  segments    {}", self.segments.clone().unwrap_or_else(unknown))?;
        if let Some((least, most)) = self.bounds.as_ref().and_then(|bounds| bounds.split_at_checked(bounds.len() / 2)) {
            let sides = ["x", "y", "z"].into_iter().zip(least.iter().zip(most));
            let sides = sides.map(|(axis, (&from, &to))| format!("{axis} {} to {}", readable(from), readable(to)));
            writeln!(f, "  bounds      {}", sides.collect::<Vec<_>>().join(", "))?;
        }
        if let Growth { symbols: Some(symbols), segments } = self.growth {
            let segments = segments.map_or_else(unknown, |growth| format!("x {growth:.6}"));
            writeln!(f, "  growth      symbols x {symbols:.6}, segments {segments} in the last step")?;
        }
        self.limit.as_ref().map_or(Ok(()), |limit| writeln!(f, "  limit       {}", visible(limit)))
    }
}

#[cfg(test)]
mod tests {
    use super::ratio;
    use lsystem::derive::Tally;

    fn power(base: u32, exponent: u32) -> Tally {
        (0..exponent).fold(Tally::from(1_u64), |power, _| {
            let mut next = Tally::ZERO;
            next.add_times(base, &power);
            next
        })
    }

    #[test]
    fn ratios_of_numbers_beyond_floating_point() {
        let close = |a: &Tally, b: &Tally, expected: f64| {
            let ratio = ratio(a, b).unwrap_or(f64::NAN);
            assert!((ratio / expected - 1.0).abs() < 1e-15, "{ratio} is not {expected}");
        };
        close(&power(3, 1001), &power(3, 1000), 3.0);
        close(&power(30, 1000), &power(30, 999), 30.0);
        close(&power(7, 20), &power(7, 22), 1.0 / 49.0);
        assert_eq!(ratio(&Tally::from(5_u64), &Tally::from(2_u64)), Some(2.5));
        assert_eq!(ratio(&Tally::ZERO, &power(3, 1000)), Some(0.0));
        assert_eq!(ratio(&power(3, 1000), &Tally::ZERO), None);
    }
}
