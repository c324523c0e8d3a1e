//! A naive reference: strings replaced symbol by symbol, a turtle with cosines, and pictures compared by brute force.

pub(crate) mod systems;

use lsystem_syntax::{Definition, Dialect};

/// A deterministic system of plain symbols.
#[derive(Clone, Debug, PartialEq)]
pub(crate) struct System {
    pub(crate) name: &'static str,
    pub(crate) axiom: String,
    pub(crate) rules: Vec<(char, String)>,
    pub(crate) angle: f64,
    pub(crate) n: u32,
    /// Whether every letter draws, as in the course's files; otherwise `F` and `G` draw and `f` moves.
    pub(crate) every_letter: bool,
}

/// Pictures with more segments are not compared.
const MAX: usize = 4000;
/// The distance that counts as none, in pictures of size 1.
const NEAR: f64 = 1e-6;

type Ends = [[f64; 2]; 2];

impl System {
    /// The same system for the library.
    pub(crate) fn definition(&self) -> Definition {
        let rules: Vec<String> =
            self.rules.iter().map(|(symbol, successor)| format!("{symbol} -> {successor}")).collect();
        Definition {
            name: self.name.into(),
            axiom: self.axiom.clone(),
            rules: rules.join("\n"),
            angle: self.angle,
            iterations: self.n,
            dialect: if self.every_letter { Dialect::EveryLetter } else { Dialect::Abop },
            ..Definition::default()
        }
    }

    /// The system with another successor.
    pub(crate) fn with_rule(&self, index: usize, successor: String) -> Self {
        let mut system = self.clone();
        system.rules[index].1 = successor;
        system
    }

    /// The symbols that occur.
    pub(crate) fn alphabet(&self) -> Vec<char> {
        let texts = self.rules.iter().map(|(_, successor)| successor.as_str()).chain([self.axiom.as_str()]);
        let mut symbols: Vec<char> = texts.flat_map(str::chars).chain("+-[]".chars()).collect();
        symbols.sort_unstable();
        symbols.dedup();
        symbols
    }

    fn string(&self) -> Option<String> {
        let mut word = self.axiom.clone();
        for _ in 0..self.n {
            let successor = |c: char| match self.rules.iter().find(|rule| rule.0 == c) {
                Some((_, successor)) => successor.clone(),
                None => c.to_string(),
            };
            word = word.chars().map(successor).collect();
            if word.len() > 40 * MAX {
                return None;
            }
        }
        Some(word)
    }

    /// The segments of the picture; `None` if there are too many.
    pub(crate) fn segments(&self) -> Option<Vec<Ends>> {
        let (mut at, mut degrees) = ([0.0, 0.0], 90.0_f64);
        let (mut open, mut found) = (vec![], vec![]);
        for symbol in self.string()?.chars() {
            let is_sign = matches!(symbol, '+' | '-' | '[' | ']');
            let draws = if self.every_letter { !is_sign } else { matches!(symbol, 'F' | 'G') };
            let moves = !self.every_letter && matches!(symbol, 'f' | 'g');
            match symbol {
                '+' => degrees += self.angle,
                '-' => degrees -= self.angle,
                '|' => degrees += if self.every_letter { 0.0 } else { 180.0 },
                '[' => open.push((at, degrees)),
                ']' => (at, degrees) = open.pop().unwrap_or((at, degrees)),
                _ => {}
            }
            if draws || moves {
                let to = [at[0] + libm::cos(degrees.to_radians()), at[1] + libm::sin(degrees.to_radians())];
                if draws {
                    found.push([at, to]);
                }
                at = to;
            }
        }
        (found.len() <= MAX).then_some(found)
    }
}

/// Whether two pictures have the same ink after the centre of each is moved to the origin and its longer side is made 1.
pub(crate) fn is_same(a: &[Ends], b: &[Ends]) -> bool {
    if a.is_empty() || b.is_empty() {
        return a.is_empty() == b.is_empty();
    }
    let (a, b) = (fitted(a), fitted(b));
    is_covered(&a, &b) && is_covered(&b, &a)
}

fn fitted(segments: &[Ends]) -> Vec<Ends> {
    let ends = || segments.iter().flatten();
    let low = [0, 1].map(|axis| ends().map(|end| end[axis]).fold(f64::INFINITY, f64::min));
    let high = [0, 1].map(|axis| ends().map(|end| end[axis]).fold(f64::NEG_INFINITY, f64::max));
    let size = (high[0] - low[0]).max(high[1] - low[1]);
    let place = |end: [f64; 2]| [0, 1].map(|axis| (end[axis] - (low[axis] + high[axis]) / 2.0) / size);
    segments.iter().map(|segment| segment.map(place)).collect()
}

/// Whether the ink of `some` lies in the ink of `all`: for each segment, the parts of all others on its line.
fn is_covered(some: &[Ends], all: &[Ends]) -> bool {
    some.iter().all(|[from, to]| {
        let (dx, dy) = (to[0] - from[0], to[1] - from[1]);
        let length = libm::hypot(dx, dy);
        let (ux, uy) = (dx / length, dy / length);
        let along = |p: &[f64; 2]| (p[0] - from[0]) * ux + (p[1] - from[1]) * uy;
        let aside = |p: &[f64; 2]| ((p[1] - from[1]) * ux - (p[0] - from[0]) * uy).abs();
        let on_line = all.iter().filter(|other| other.iter().all(|end| aside(end) < NEAR));
        let mut parts: Vec<(f64, f64)> = on_line
            .map(|[start, end]| (along(start), along(end)))
            .map(|(start, end)| (start.min(end), start.max(end)))
            .collect();
        parts.sort_by(|a, b| a.0.total_cmp(&b.0));
        let reached = parts
            .iter()
            .fold(0.0, |reached: f64, part| if part.0 < reached + NEAR { reached.max(part.1) } else { reached });
        reached > length - NEAR
    })
}
