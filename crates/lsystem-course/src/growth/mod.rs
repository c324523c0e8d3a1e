//! How the generations of an L-system grow: exact counts, the matrix of its productions, recurrences and closed forms,
//! growth factors, the similarity dimension of curves, and expected numbers where chance chooses.
//!
//! For systems whose letters derive independently of each other: the numbers of letters in one generation, times a
//! matrix, are those of the next one (Rozenberg and Salomaa, The Mathematical Theory of L Systems, 1980, chapter I.3).

mod chance;
mod closed;
mod export;
mod fraction;
mod path;
mod process;
mod rate;
mod recurrence;
mod sentences;
mod stretch;
mod text;

use self::closed::{Term, closed, roots};
use self::path::Path;
use self::process::Process;
use self::rate::{Rate, rate};
use self::recurrence::{Recurrence, recurrence};
use self::text::Style;
use lsystem_base::{Limits, MAX_ITERATIONS, Progress, decimal};
use lsystem_derive::Tally;
use lsystem_drawing::{Figure, System};
use serde::Serialize;

/// The most letters that are listed.
const MAX_LISTED: usize = 24;
/// The fewest generations in the table.
const FEWEST_ROWS: u32 = 8;
/// The most digits of all counts in the table.
const MAX_DIGITS: usize = 400_000;
/// The units of work between two looks at what is left.
const PIECE: u64 = 1 << 16;
/// The limits of the drawings that are measured, and their work together.
const LIMITS: Limits =
    Limits { symbols: 1 << 20, modules: 1 << 18, segments: 1 << 30, work: 1 << 20, memory: 16 << 20 };

/// A number of any size.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct Count {
    /// Exact, in decimal digits; with chance, the expected value, rounded.
    pub digits: String,
    /// The logarithm to base 10, for plots; null for 0.
    pub log10: Option<f64>,
}

/// One generation.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
pub struct Generation {
    /// The number of steps.
    pub n: u32,
    /// All symbols.
    pub symbols: Count,
    /// All segments.
    pub segments: Count,
    /// Each listed letter.
    pub letters: Vec<Count>,
    /// With chance, the standard deviation of the number of segments.
    pub spread: Option<f64>,
    /// The width and height of the drawing in the plane, in model units; null where it is too large.
    pub size: Option<[f64; 2]>,
    /// The length of all segments, in model units; null where lengths change on the way.
    pub length: Option<f64>,
    /// Without branches, the turning of the whole way in the plane: degrees counter-clockwise, from 0 up to 360.
    pub turning: Option<f64>,
}

/// How a number grows in the long run.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
#[serde(rename_all = "lowercase")]
pub enum GrowthKind {
    /// It becomes 0.
    Dying,
    /// It stays below a bound.
    Bounded,
    /// It grows like a power of n.
    Polynomial,
    /// It is multiplied in each step.
    Exponential,
}

/// The growth of the symbols or of the segments.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct Series {
    /// How it grows.
    pub kind: GrowthKind,
    /// The power of n beside the factor.
    pub degree: u32,
    /// The factor of each step in the long run: the dominant eigenvalue.
    pub factor: f64,
    /// The factor exactly, such as `4` or `(1 + √5)/2`, if it is known.
    pub exact_factor: Option<String>,
    /// The recurrence, such as `s(n) = s(n-1) + s(n-2)`.
    pub recurrence: Option<String>,
    /// The first generation for which the recurrence holds.
    pub from: usize,
    /// The closed form, such as `3 · 4^n`.
    pub closed: Option<String>,
    /// The first generation for which the closed form holds.
    pub closed_from: usize,
    #[serde(skip)]
    found: Option<Recurrence>,
    #[serde(skip)]
    terms: Option<Vec<Term>>,
}

/// How a system grows.
#[derive(Clone, Debug, PartialEq, Serialize)]
#[cfg_attr(feature = "typescript", derive(ts_rs::TS))]
#[serde(rename_all = "camelCase")]
pub struct Growth {
    /// The listed letters, in the order in which the axiom reaches them.
    pub letters: Vec<String>,
    /// How many letters there are.
    pub letter_count: usize,
    /// Row by row: how many of each listed letter a letter becomes in one step; with chance, the expected numbers.
    pub matrix: Vec<Vec<f64>>,
    /// Whether chance chooses.
    pub is_random: bool,
    /// The growth of all symbols.
    pub symbols: Series,
    /// The growth of the segments.
    pub segments: Series,
    /// The factor by which the curve's reach grows in each step, if there is one.
    pub stretch: Option<f64>,
    /// The similarity dimension: the logarithm of the segments' factor over that of the stretch.
    pub dimension: Option<f64>,
    /// The generations from 0 on.
    pub table: Vec<Generation>,
    /// The essence in a few sentences.
    pub sentences: Vec<String>,
}

/// How a system grows, with a table of at least `n` generations where that is no more than some megabytes.
///
/// # Errors
/// A sentence that says why it is not known.
pub fn growth(system: &System, n: u32) -> Result<Growth, &'static str> {
    let process = Process::new(system)?;
    let all = vec![1; process.letters()];
    let is_flat = !system.is_solid();
    let path = Path::new(system, &process, is_flat);
    let rows = rows(&process, path.as_ref(), n);
    let listed = process.letters().min(MAX_LISTED);
    let series = |weights: &[u32], of: fn(&Generation) -> &Count| {
        let values: Vec<i128> = rows.iter().map_while(|row| of(row).digits.parse().ok()).collect();
        series(&process, weights, &values)
    };
    let (symbols, segments) = (series(&all, |row| &row.symbols), series(&process.drawn, |row| &row.segments));
    let stretch = is_flat.then(|| stretch::stretch(system)).flatten();
    let is_fractal = segments.kind == GrowthKind::Exponential && segments.degree == 0 && !process.is_random();
    let dimension = stretch.filter(|_| is_fractal).map(|stretch| libm::log(segments.factor) / libm::log(stretch));
    let mut growth = Growth {
        letters: process.symbols[..listed].iter().map(char::to_string).collect(),
        letter_count: process.letters(),
        matrix: (0..listed).map(|from| process.expected(from)[..listed].to_vec()).collect(),
        is_random: process.is_random(),
        symbols,
        segments,
        stretch,
        dimension,
        table: measured(system, rows),
        sentences: Vec::new(),
    };
    growth.sentences = sentences::sentences(&growth);
    Ok(growth)
}

/// The generations without the sizes of their drawings.
fn rows(process: &Process, path: Option<&Path>, n: u32) -> Vec<Generation> {
    let most = n.clamp(FEWEST_ROWS, MAX_ITERATIONS) as usize;
    let listed = process.letters().min(MAX_LISTED);
    if process.is_random() {
        let all = vec![1; process.letters()];
        let [symbols, segments] = [&all, &process.drawn].map(|weights| chance::moments(process, weights, most));
        let mut counts: Vec<f64> = process.axiom.iter().map(|&count| f64::from(count)).collect();
        return (0..=most)
            .map(|n| {
                let row = Generation {
                    n: n as u32,
                    symbols: expected(symbols[n][0]),
                    segments: expected(segments[n][0]),
                    letters: counts[..listed].iter().map(|&value| expected(value)).collect(),
                    spread: Some(segments[n][1]).filter(|spread| spread.is_finite()),
                    size: None,
                    length: path.and_then(|path| path.length(counts.iter().copied())),
                    turning: None,
                };
                counts = process.next_expected(&counts);
                row
            })
            .collect();
    }
    let mut counts: Vec<Tally> = process.axiom.iter().map(|&count| Tally::from(u64::from(count))).collect();
    let mut modulo: Vec<u64> = process.axiom.iter().map(|&count| u64::from(count)).collect();
    let mut rows = Vec::new();
    let mut digits = 0;
    for n in 0..=most {
        let sum = |weight: &dyn Fn(usize) -> u32| {
            let mut sum = Tally::ZERO;
            counts.iter().enumerate().for_each(|(letter, count)| sum.add_times(weight(letter), count));
            exact(&sum)
        };
        let row = Generation {
            n: n as u32,
            symbols: sum(&|_| 1),
            segments: sum(&|letter| process.drawn[letter]),
            letters: counts[..listed].iter().map(exact).collect(),
            spread: None,
            size: None,
            length: path.and_then(|path| path.length(counts.iter().map(float))),
            turning: path.and_then(|path| path.turning(&modulo)),
        };
        modulo = process.next_modulo(&modulo, Path::full_turn());
        digits +=
            row.letters.iter().chain([&row.symbols, &row.segments]).map(|count| count.digits.len()).sum::<usize>();
        rows.push(row);
        if digits > MAX_DIGITS {
            break;
        }
        counts = process.next(&counts);
    }
    rows
}

/// The generations with the sizes of their drawings, as far as these are quickly made.
fn measured(system: &System, mut rows: Vec<Generation>) -> Vec<Generation> {
    let mut left = LIMITS.work;
    for row in &mut rows {
        let mut drawer = Figure::drawer(system, row.n, LIMITS);
        while drawer.spent() < left && drawer.step(PIECE) == Progress::More {}
        left = left.saturating_sub(drawer.spent());
        if left == 0 {
            break;
        }
        let Ok(Figure::Plane(drawing)) = drawer.finish() else { break };
        let size = drawing.bounds().map_or([0.0; 2], |[x0, y0, x1, y1]| [x1 - x0, y1 - y0]);
        row.size = Some(size).filter(|size| size.iter().all(|side| side.is_finite()));
    }
    rows
}

/// A count, rounded.
fn float(count: &Tally) -> f64 {
    decimal::read(&count.to_string()).unwrap_or(f64::INFINITY)
}

fn exact(count: &Tally) -> Count {
    let digits = count.to_string();
    let head = decimal::read(&digits[..digits.len().min(17)]).unwrap_or(0.0);
    let log10 = (head > 0.0).then(|| libm::log10(head) + digits.len().saturating_sub(17) as f64);
    Count { digits, log10 }
}

fn expected(value: f64) -> Count {
    let digits = if value < 1e15 { text::decimal(value) } else { format!("{value:.6e}") };
    Count { digits, log10: (value > 0.0 && value.is_finite()).then(|| libm::log10(value)) }
}

fn series(process: &Process, weights: &[u32], values: &[i128]) -> Series {
    let Rate { factor, degree } = rate(process, weights);
    let kind = match () {
        () if factor < 1.0 - 1e-9 => GrowthKind::Dying,
        () if factor > 1.0 + 1e-9 => GrowthKind::Exponential,
        () if degree > 0 => GrowthKind::Polynomial,
        () => GrowthKind::Bounded,
    };
    let found = recurrence(process, weights);
    let roots = found.as_ref().map(roots);
    let closed = found.as_ref().zip(roots.as_ref()).and_then(|(found, roots)| closed(found, roots, values));
    let exact_factor = roots.and_then(|roots| {
        let is_factor = |value: f64| (value - factor).abs() < 1e-9 * factor.max(1.0);
        let whole = roots.whole.iter().find(|(root, _)| is_factor(*root as f64)).map(|(root, _)| root.to_string());
        whole
            .or_else(|| roots.pair.filter(|pair| is_factor(pair.value())).map(|pair| text::root(pair, 1, Style::Plain)))
    });
    Series {
        kind,
        degree,
        factor,
        exact_factor,
        recurrence: found.as_ref().map(|found| text::recurrence(found, Style::Plain)),
        from: found.as_ref().map_or(0, |found| found.from),
        closed: closed.as_ref().map(|(terms, _)| text::closed(terms, Style::Plain)),
        closed_from: closed.as_ref().map_or(0, |(_, from)| *from),
        found,
        terms: closed.map(|(terms, _)| terms),
    }
}
