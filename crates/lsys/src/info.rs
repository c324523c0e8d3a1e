//! `lsys info`: facts about a system.

use crate::cli::Changes;
use crate::input::{self, InputSystem};
use crate::output::escape_json;
use crate::{CommandFailure, cores, print};
use lsystem::base::words::{said, shown};
use lsystem::base::{say, word};
use lsystem::derive::Tally;
use lsystem::drawing::why_empty;
use lsystem::files::thin_strokes;
use lsystem::syntax::visible;
use lsystem::{Figure, Progress, count_segments, count_symbols};
use serde::Serialize;
use std::fmt::{self, Display};
use std::path::PathBuf;

/// The facts about one file.
#[derive(Serialize)]
struct FileFacts {
    file: String,
    name: String,
    title: String,
    /// As [`lsystem::drawing::kind`].
    kind: String,
    #[serde(skip)]
    is_random: bool,
    iterations: u32,
    seed: u32,
    /// The number of symbols, exact, in decimal digits; `None` if a limit is exceeded first.
    symbols: Option<String>,
    /// The number of segments, as `symbols`.
    segments: Option<String>,
    /// The least coordinates, then the greatest, of all segments' axes and polygons, in model units: x, y, and in space
    /// z. `None` if nothing is drawn, a limit is exceeded, or a number is beyond the range of `f64`.
    bounds: Option<Vec<f64>>,
    growth: GrowthFactors,
    /// Whether equal pieces of the drawing are shared.
    memoised: Option<bool>,
    /// The number of blocks of the drawing.
    blocks: Option<usize>,
    /// What is too thin for a print, as [`thin_strokes`].
    print: Option<String>,
    /// The message about the limit that the drawing exceeds.
    limit: Option<String>,
}

/// The factors by which the last derivation step multiplied the counts; `None` for the axiom, or if unknown.
#[derive(Serialize)]
struct GrowthFactors {
    symbols: Option<f64>,
    segments: Option<f64>,
}

/// Prints facts about `files`. A file that cannot be read is reported, and the others are still done.
pub(crate) fn info(files: &[PathBuf], json: bool, changes: &Changes) -> Result<(), CommandFailure> {
    let (all, is_good) = cores::in_order(files, |file, limits, say| {
        let input = input::read(file, changes, say)?;
        if let Some(reason) = why_empty(&input.system, input.iterations) {
            let warning = say!("warning: {}", reason);
            say(&format!("{warning}\n --> {}\n", visible(&input.file.display().to_string())));
        }
        limits.make(|shares| {
            let facts = facts(&input, shares);
            // Facts that a share of the limits leaves unknown may be known with all limits.
            let is_known = facts.limit.is_none() && facts.symbols.is_some() && facts.segments.is_some();
            if is_known || shares == 1 { Ok(facts) } else { Err(CommandFailure::Limit(String::new())) }
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
    if is_good { Ok(()) } else { Err(CommandFailure::Said) }
}

/// The facts that are known within one of `shares` equal shares of the limits.
fn facts(input: &InputSystem, shares: u64) -> FileFacts {
    let drawing = input.draw(shares);
    let (system, n) = (&input.system, input.iterations);
    let (drawn, limit) = (drawing.as_ref().ok(), drawing.as_ref().err());
    let now = GenerationCounts::new(input, shares, n, drawn);
    let before = n.checked_sub(1).map(|n| GenerationCounts::new(input, shares, n, None));
    let ratio = |of: fn(&GenerationCounts) -> &Option<Tally>| of(&now).as_ref()?.ratio(of(before.as_ref()?).as_ref()?);
    FileFacts {
        file: input.file.display().to_string(),
        name: input.definition.name.clone(),
        title: input.definition.title.clone(),
        kind: lsystem::drawing::kind(system),
        is_random: system.has_choices(),
        iterations: n,
        seed: system.seed,
        growth: GrowthFactors { symbols: ratio(|c| &c.symbols), segments: ratio(|c| &c.segments) },
        symbols: now.symbols.map(|count| count.to_string()),
        segments: now.segments.map(|count| count.to_string()),
        bounds: drawn
            .and_then(Figure::bounds)
            .map(|bounds| bounds.concat())
            .filter(|b| b.iter().all(|x| x.is_finite())),
        memoised: drawn.map(Figure::is_memoised),
        blocks: drawn.map(Figure::block_count),
        print: drawn.and_then(thin_strokes),
        limit: limit.map(|limit| limit.message.clone()),
    }
}

/// The counts of one generation; `None` if a limit is exceeded first.
#[derive(Default)]
struct GenerationCounts {
    symbols: Option<Tally>,
    segments: Option<Tally>,
}

impl GenerationCounts {
    /// The counts of generation `n`: added up by the rules, or else from the drawing, or else by derivation.
    fn new(input: &InputSystem, shares: u64, n: u32, drawing: Option<&Figure>) -> Self {
        let summed = Self { symbols: count_symbols(&input.system, n), segments: count_segments(&input.system, n) };
        let drawn = || Self {
            symbols: drawing.and_then(|drawing| Some(drawing.symbol_count()?.into())),
            segments: drawing.map(|drawing| drawing.turtle_segments().into()),
        };
        summed.or(drawn).or(|| Self::derived(input, shares, n))
    }

    /// The counts of generation `n`, by derivation.
    fn derived(input: &InputSystem, shares: u64, n: u32) -> Self {
        let Some(mut history) = input.system.history(n, &input.limits(shares)) else { return Self::default() };
        while history.step(1 << 20) == Progress::More {}
        let symbols = history.symbols(n);
        let segments = symbols.and_then(|symbols| history.segments_before(symbols));
        Self { symbols: symbols.map(Tally::from), segments: segments.map(Tally::from) }
    }

    /// Fills unknown counts from `other`.
    fn or(self, other: impl FnOnce() -> Self) -> Self {
        if self.symbols.is_some() && self.segments.is_some() {
            return self;
        }
        let other = other();
        Self { symbols: self.symbols.or(other.symbols), segments: self.segments.or(other.segments) }
    }
}

/// The labels of the rows.
const LABELS: [&str; 10] = [
    word!("file"),
    word!("kind"),
    word!("iterations"),
    word!("seed"),
    word!("symbols"),
    word!("segments"),
    word!("bounds"),
    word!("growth"),
    word!("print"),
    word!("limit"),
];

/// A number in decimal digits, with an exponent if it is very small or very large.
fn readable(number: f64) -> String {
    match number.abs() {
        0.0 | 1e-4..1e15 => shown(&number.to_string()),
        _ => shown(&format!("{number:e}")),
    }
}

impl Display for FileFacts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let title = [&self.title, &self.name, &self.file].into_iter().find(|text| !text.is_empty());
        writeln!(f, "{}", visible(title.map_or("", String::as_str)))?;
        let labels = LABELS.map(said);
        let width = labels.iter().map(|label| label.chars().count()).max().unwrap_or_default();
        let [file, kind, iterations, seed, symbols, segments, bounds, growth, print, limit] = labels;
        let mut row = |label: &str, value: &str| writeln!(f, "  {label:width$}  {value}");
        let unknown = || say!("unknown");
        row(&file, &visible(&self.file))?;
        let kinds = self.kind.split(", ").map(said).collect::<Vec<_>>().join(", ");
        let blocks = self.blocks.map_or_else(String::new, |blocks| match self.memoised {
            Some(true) => say!(", memoised, blocks: {}", blocks),
            _ => say!(", not memoised, blocks: {}", blocks),
        });
        row(&kind, &format!("{kinds}{blocks}"))?;
        row(&iterations, &self.iterations.to_string())?;
        if self.is_random {
            row(&seed, &self.seed.to_string())?;
        }
        row(&symbols, &self.symbols.clone().unwrap_or_else(unknown))?;
        row(&segments, &self.segments.clone().unwrap_or_else(unknown))?;
        if let Some((least, most)) = self.bounds.as_ref().and_then(|bounds| bounds.split_at_checked(bounds.len() / 2)) {
            let sides = ["x", "y", "z"].into_iter().zip(least.iter().zip(most));
            let sides = sides.map(|(axis, (&from, &to))| say!("{} {} to {}", axis, readable(from), readable(to)));
            row(&bounds, &sides.collect::<Vec<_>>().join(", "))?;
        }
        if let GrowthFactors { symbols: Some(symbols), segments } = self.growth {
            let factor = |factor: f64| format!("x {}", shown(&format!("{factor:.6}")));
            let segments = segments.map_or_else(unknown, factor);
            row(&growth, &say!("symbols {}, segments {} in the last step", factor(symbols), segments))?;
        }
        self.print.as_ref().map_or(Ok(()), |words| row(&print, words))?;
        self.limit.as_ref().map_or(Ok(()), |words| row(&limit, &visible(words)))
    }
}
