//! Curves in lines such as `curve taper = (0, 1) (0.4, 0.8) (1, 0.1)`.

use super::expression::{self, Names};
use super::token::{Token, span_of, text_of};
use crate::code::Code;
use crate::curve::Curve;
use crate::notes::Notes;
use crate::{Kind, Role};

/// Reads the points of a curve; `None` if they are wrong, which is noted. `end` is the place of what is missing, in
/// bytes.
pub(super) fn read(mut tokens: &[Token], end: usize, names: &mut dyn Names, notes: &mut Notes) -> Option<Curve> {
    let all = span_of(tokens, end);
    let mut points: Vec<[f64; 2]> = Vec::new();
    while let Some(open) = tokens.first() {
        let Some(close) = Some(open).filter(|t| t.is('(')).and_then(|_| super::word::closing(tokens)) else {
            notes.add(Kind::CurvePoint { found: text_of(&[*open]) }, open.span());
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
            notes.add(Kind::CurvePoint { found: text_of(point) }, span_of(point, end));
            return None;
        };
        if points.last().is_some_and(|before| before[0] > x) {
            notes.add(Kind::CurveBack, span_of(point, end));
            return None;
        }
        points.push([x, y]);
        // A comma between points.
        tokens = if rest.len() > 1 && rest[0].is(',') { &rest[1..] } else { rest };
    }
    let count = points.len();
    let curve = Curve::new(points);
    if curve.is_none() {
        notes.add(Kind::CurveCount { found: count }, all);
    }
    curve
}
