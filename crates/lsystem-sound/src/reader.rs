//! From the marks of a drawing to lines that know their branch and their letter.

use crate::marked::{BRANCH, LETTERS};
use lsystem_drawing::{Geometry, Mark, Space};
use lsystem_syntax::{CIRCLE_SIDES, TUBE_STROKES};
use std::collections::VecDeque;

/// The most lines of one action.
const MAX_OF_A_LETTER: usize = if CIRCLE_SIDES > TUBE_STROKES { CIRCLE_SIDES } else { TUBE_STROKES } as usize;

/// A line of the drawing, or the beginning of a branch.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Line {
    pub ends: [[f64; 3]; 2],
    pub level: u32,
    /// The letter that draws the line; `None` for the beginning of a branch.
    pub letter: Option<usize>,
}

/// The lines of marks in the order of the drawing. The mark of a letter comes after its lines.
pub(crate) fn lines<S: Space>(marks: impl Iterator<Item = Mark<S>>) -> impl Iterator<Item = Line> {
    let mut marks = marks;
    // The lines of a letter whose mark is still to come, and what is ready, in order.
    let (mut open, mut ready) = (vec![], VecDeque::new());
    core::iter::from_fn(move || {
        while ready.is_empty() {
            match marks.next() {
                Some(Mark::Segment(segment, tint)) => {
                    let ends = [segment.from, segment.to].map(in_space::<S>);
                    open.push(Line { ends, level: tint.level, letter: Some(0) });
                    // So many lines have lost their mark.
                    if open.len() > MAX_OF_A_LETTER {
                        ready.extend(open.drain(..));
                    }
                }
                Some(Mark::Polygon(corners, tint)) if tint.index == BRANCH => {
                    ready.extend(open.drain(..));
                    let ends = [middle::<S>(&corners); 2];
                    ready.push_back(Line { ends, level: tint.level, letter: None });
                }
                Some(Mark::Polygon(_, tint)) => {
                    // Other polygons are no marks.
                    let letter = usize::try_from(tint.index - LETTERS);
                    let Ok(letter) = letter else { continue };
                    ready.extend(open.drain(..).map(|line| Line { letter: Some(letter), ..line }));
                }
                None => {
                    ready.extend(open.drain(..));
                    break;
                }
            }
        }
        ready.pop_front()
    })
}

fn middle<S: Geometry>(corners: &[S::Point]) -> [f64; 3] {
    let mut sum = [0.0; 3];
    let share = 1.0 / corners.len() as f64;
    for corner in corners {
        sum.iter_mut().zip(in_space::<S>(*corner)).for_each(|(sum, value)| *sum += share * value);
    }
    sum
}

fn in_space<S: Geometry>(point: S::Point) -> [f64; 3] {
    let mut all = [0.0; 3];
    all.iter_mut().zip(point.as_ref()).for_each(|(to, from)| *to = *from);
    all
}
