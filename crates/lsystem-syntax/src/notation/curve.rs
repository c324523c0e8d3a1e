//! Curves in lines such as `curve taper = (0, 1) (0.4, 0.8) (1, 0.1)`.

use super::expression::{self, Names};
use super::token::{Token, span_of, text_of};
use crate::Role;
use crate::code::Code;
use crate::curve::{Curve, MAX_POINTS};
use crate::notes::DiagnosticList;
use core::ops::Range;
use lsystem_base::{counted, say};

/// Reads the points of a curve; `None` if they are wrong, which is noted. `end` is the place of what is missing, in
/// bytes.
pub(super) fn read(
    mut tokens: &[Token],
    end: usize,
    names: &mut dyn Names,
    notes: &mut DiagnosticList,
) -> Option<Curve> {
    let all = span_of(tokens, end);
    let mut points: Vec<[f64; 2]> = Vec::new();
    while let Some(open) = tokens.first() {
        let Some(close) = Some(open).filter(|t| t.is('(')).and_then(|_| super::word::closing(tokens)) else {
            no_point(&[*open], open.span(), notes);
            return None;
        };
        let (point, rest) = tokens.split_at(close + 1);
        let mut numbers = Vec::new();
        for (part, end) in super::word::parts(&point[1..close]) {
            let expr = expression::read(part, end, Role::Constant, names, notes)?;
            match expression::code(&expr, names) {
                Ok(Code::Constant(value)) => numbers.push(value),
                _ => return None,
            }
        }
        let [x, y] = numbers[..] else {
            no_point(point, span_of(point, end), notes);
            return None;
        };
        if points.last().is_some_and(|before| before[0] > x) {
            notes.error(
                span_of(point, end),
                say!("This point lies to the left of the point before it"),
                say!("x must not decrease along a curve."),
            );
            return None;
        }
        points.push([x, y]);
        // A comma between points.
        tokens = if rest.len() > 1 && rest[0].is(',') { &rest[1..] } else { rest };
    }
    let count = points.len();
    let curve = Curve::new(points);
    if curve.is_none() {
        notes.error(
            all,
            counted!(count, "This curve has {} point", "This curve has {} points"),
            say!("A curve has 2 to {} points, and the last is to the right of the first.", MAX_POINTS),
        );
    }
    curve
}

fn no_point(tokens: &[Token], span: Range<usize>, notes: &mut DiagnosticList) {
    notes.error(
        span,
        say!("`{}` is not a point of a curve", text_of(tokens)),
        say!("Write each point with x and y, as in `(0, 1) (0.5, 2)`."),
    );
}
