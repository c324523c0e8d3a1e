//! Whether two definitions draw the same shape, as far as a few generations show.

use super::source::{Need, Source};
use lsystem_base::Limits;
use lsystem_base::sorted;
use lsystem_drawing::{Figure, System};
use lsystem_syntax::{Definition, Grammar, Production, print_rules};
use std::collections::HashMap;

/// The limits of one drawing.
const LIMITS: Limits = Limits { symbols: 100_000, modules: 1 << 16, segments: 20_000, work: 1 << 20, memory: 64 << 20 };
/// The most segments that are compared one by one.
const MAX_SEGMENTS: u128 = 50_000;
/// The most choices of a production that are compared.
const MAX_CHOICES: usize = 4;
/// The most derivation steps.
const MAX: u32 = 5;

/// The first difference of two definitions in words; `None` if the first generations draw the same up to place and size,
/// and the same number of derivation steps is made. Colours, widths and seeds do not count.
pub(super) fn difference(a: &Definition, b: &Definition, counts_steps: bool) -> Option<String> {
    if counts_steps && a.iterations != b.iterations {
        return Some(format!("{} and {} iterations", a.iterations, b.iterations));
    }
    let (Ok(one), Ok(other)) = (Source::new(a), Source::new(b)) else { return Some("errors".to_owned()) };
    if one.needs(Need::Chance) || other.needs(Need::Chance) {
        if weights(&one.grammar) != weights(&other.grammar) {
            return Some("other weights".to_owned());
        }
        // The random numbers of programs differ, so each choice is compared alone.
        let chosen = |of: &Source<'_>, at| Definition { rules: chosen(of, at), ..of.definition.clone() };
        return (0..MAX_CHOICES).find_map(|at| difference_of(&chosen(&one, at), &chosen(&other, at)));
    }
    difference_of(a, b)
}

/// The productions of a grammar that differ only in their successors and weights, as ranges.
pub(super) fn choices(grammar: &Grammar) -> Vec<Vec<&Production>> {
    let mut found: Vec<Vec<&Production>> = Vec::new();
    let mut places: HashMap<String, usize> = HashMap::new();
    for rule in &grammar.productions {
        let key = format!("{:?}{:?}{:?}{:?}", rule.left, rule.predecessor, rule.right, rule.condition);
        let place = *places.entry(key).or_insert(found.len());
        if place == found.len() {
            found.push(Vec::new());
        }
        found[place].push(rule);
    }
    found
}

/// The weights of all choices, as texts, in order.
fn weights(grammar: &Grammar) -> Vec<String> {
    let values = grammar.values();
    let weight = |rule: &&Production| rule.weight.as_ref().and_then(|weight| values.value(weight)).unwrap_or(-1.0);
    let several = choices(grammar).into_iter().filter(|group| group.len() > 1);
    let mut found: Vec<String> = several
        .map(|group| {
            let weights: Vec<f64> = group.iter().map(weight).collect();
            let sum: f64 = weights.iter().sum();
            weights.iter().map(|weight| format!("{:.9} ", weight / sum)).collect()
        })
        .collect();
    sorted::sort(&mut found);
    found
}

/// The rules with one production of each choice, and without weights.
fn chosen(source: &Source<'_>, at: usize) -> String {
    let groups = choices(&source.grammar);
    let one = |group: &Vec<&Production>| Production { weight: None, ..group[at % group.len()].clone() };
    let productions = groups.iter().map(one).collect();
    print_rules(&Grammar { productions, ..source.system.grammar.clone() })
}

fn difference_of(a: &Definition, b: &Definition) -> Option<String> {
    let drawn = |own| System::new(own).ok().map(System::without_wires);
    let (Some(one), Some(other)) = (drawn(a), drawn(b)) else { return Some("errors".to_owned()) };
    for n in 0..=a.iterations.min(MAX) {
        let (one, other) = (Figure::draw(&one, n, &LIMITS), Figure::draw(&other, n, &LIMITS));
        let (Ok(one), Ok(other)) = (&one, &other) else {
            return (one.is_ok() != other.is_ok() && n < 2).then(|| format!("limits at n = {n}"));
        };
        let counts = [one, other].map(|figure| (figure.segment_count(), figure.polygon_count()));
        if counts[0] != counts[1] {
            return Some(format!("{} and {} segments at n = {n}", counts[0].0, counts[1].0));
        }
        if counts[0].0 > MAX_SEGMENTS {
            return None;
        }
        let (one, other) = (shape(one), shape(other));
        if one.len() != other.len() {
            return Some(format!("{} and {} coordinates at n = {n}", one.len(), other.len()));
        }
        let far = one.iter().zip(&other).position(|(a, b)| (a - b).abs() > 1e-6);
        if let Some(at) = far {
            return Some(format!("coordinate {at} is {} and {} at n = {n}", one[at], other[at]));
        }
    }
    None
}

/// The coordinates of all segments, then those of all polygons, as parts of the size of the drawing.
pub(super) fn shape(figure: &Figure) -> Vec<f64> {
    let ends = figure.segments_from(0).flat_map(|segment| [segment.from, segment.to]);
    let corners = (0..figure.polygon_count()).filter_map(|at| figure.vertices(at)).flatten();
    placed(&ends.chain(corners).collect::<Vec<_>>())
}

/// The coordinates of points as parts of the size of all.
pub(super) fn placed(points: &[[f64; 3]]) -> Vec<f64> {
    let (mut low, mut high) = ([f64::INFINITY; 3], [f64::NEG_INFINITY; 3]);
    for point in points {
        for axis in 0..3 {
            low[axis] = low[axis].min(point[axis]);
            high[axis] = high[axis].max(point[axis]);
        }
    }
    let size = (0..3).map(|axis| high[axis] - low[axis]).fold(0.0, f64::max).max(f64::MIN_POSITIVE);
    points.iter().flat_map(|point| (0..3).map(|axis| (point[axis] - low[axis]) / size)).collect()
}
