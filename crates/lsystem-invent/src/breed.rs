//! Children of systems: rules, angles and looks of one parent changed a little, or of two parents crossed.

mod cross;
mod mutate;

use crate::Moments;
use crate::dice::Dice;
use crate::judge::{LIMITS, SEGMENTS, frame, lines, overlap};
use cross::cross;
use lsystem_base::{Meter, Progress};
use lsystem_drawing::{Figure, System};
use lsystem_syntax::{Definition, print_axiom, print_rules};

/// How many children are made and refused for each one that is kept.
const PATIENCE: usize = 24;
/// The most units of work for each child.
const WORK: u64 = 1 << 22;
/// The units of work that stand for reading one byte of a system.
const READING_WORK: u64 = 8;
/// The fewest lines of a child's drawing.
const LEAST: usize = 8;
/// The least shorter side of a child's drawing, as a part of the longer one.
const NARROWEST: f64 = 0.12;
/// The most of a child's lines that lie upon others.
const MAX_OVERLAP: f64 = 0.7;

/// `count` children of the parents with this seed, fewer if nearly all have nothing to show or take too long to draw. All
/// children of one seed look different from each other and from their parents. Parents with errors have no children.
#[must_use]
pub fn breed(parents: &[Definition], seed: u32, count: usize) -> Vec<Definition> {
    let systems: Vec<(&Definition, System)> =
        parents.iter().filter_map(|parent| Some((parent, System::new(parent).ok()?))).collect();
    let mut meter = Meter::new(WORK.saturating_mul(count as u64));
    let mut seen: Vec<Moments> = (systems.iter())
        .filter_map(|(parent, system)| Some(shape(system, parent.iterations, &mut meter)?.shape))
        .collect();
    let mut children = vec![];
    let mut dice = Dice::new(0x62_7265_6564 ^ u64::from(seed) << 8);
    for _ in 0..count * PATIENCE {
        if children.len() == count || systems.is_empty() || meter.is_spent() {
            break;
        }
        let mut child = conceive(&mut dice, &systems);
        let Some(shape) = grown(&mut child, &mut meter) else { continue };
        if !seen.iter().any(|other| other.is_like(&shape)) {
            seen.push(shape);
            children.push(child);
        }
    }
    children
}

/// A child that nobody has looked at.
fn conceive(dice: &mut Dice, parents: &[(&Definition, System)]) -> Definition {
    let at = dice.whole(0, parents.len() - 1);
    let (parent, system) = &parents[at];
    let mut child = (*parent).clone();
    let mut grammar = system.grammar.clone();
    let other = (at + 1) % parents.len();
    let mut changes = 1 + usize::from(dice.chance(0.4));
    if other != at {
        let (other, system) = &parents[other];
        cross(dice, &mut child, &mut grammar, other, &system.grammar);
        changes -= usize::from(dice.chance(0.6));
    }
    for _ in 0..changes {
        mutate::form(dice, &mut child, &mut grammar);
    }
    if grammar != system.grammar {
        (child.axiom, child.rules) = (print_axiom(&grammar), print_rules(&grammar));
    }
    if dice.chance(0.35) {
        mutate::look(dice, &mut child);
    }
    child
}

/// The shape of a child that has something to show. Lowers its number of iterations until it can be drawn.
fn grown(child: &mut Definition, meter: &mut Meter) -> Option<Moments> {
    meter.charge(READING_WORK * (child.axiom.len() + child.rules.len()) as u64);
    let system = System::new(child).ok()?;
    let Seen { shape, lines, n } = shape(&system, child.iterations, meter)?;
    let (_, [width, height]) = frame(&lines);
    let is_strip = width.min(height) < NARROWEST * width.max(height);
    if is_strip || !system.is_solid() && overlap(&lines, width.max(height)) > MAX_OVERLAP {
        return None;
    }
    // Between a generation that can be drawn and one that perhaps cannot.
    let (mut low, mut high) = (n, child.iterations.saturating_add(1));
    while low + 1 < high {
        let n = if high > child.iterations { child.iterations } else { low.midpoint(high) };
        *(if draw(&system, n, meter).is_some() { &mut low } else { &mut high }) = n;
    }
    child.iterations = low;
    Some(shape)
}

/// A drawing as it is compared with others.
struct Seen {
    shape: Moments,
    lines: Vec<[[f64; 2]; 2]>,
    /// Its generation.
    n: u32,
}

/// The largest drawing with few enough segments, at generation `n` or before.
fn shape(system: &System, n: u32, meter: &mut Meter) -> Option<Seen> {
    let (n, figure) = (0..=n.min(14)).rev().find_map(|n| {
        let figure = draw(system, n, meter)?;
        (figure.segment_count().saturating_add(figure.polygon_count()) <= SEGMENTS).then_some((n, figure))
    })?;
    let lines = lines(&figure);
    let shape = Moments::of(&lines);
    (lines.len() >= LEAST && shape.spread.is_finite() && shape.tail.is_finite()).then_some(Seen { shape, lines, n })
}

/// A drawing within the limits and within the work that is left.
fn draw(system: &System, n: u32, meter: &mut Meter) -> Option<Figure> {
    let mut drawer = Figure::drawer(system, n, LIMITS);
    let progress = drawer.step(meter.left());
    meter.charge(drawer.spent().max(1));
    if progress == Progress::More { None } else { drawer.finish().ok() }
}
