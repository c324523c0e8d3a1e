//! The parts of expressions.

use lsystem_syntax::{Expr, Function};

/// Visits an expression and all parts of it.
pub(super) fn each_part(expr: &Expr, visit: &mut dyn FnMut(&Expr)) {
    visit(expr);
    match expr {
        Expr::Number(_) | Expr::Name(_) => {}
        Expr::Negative(of) | Expr::Not(of) | Expr::Curve(_, of) => each_part(of, visit),
        Expr::Binary(_, a, b) => [a, b].into_iter().for_each(|of| each_part(of, visit)),
        Expr::Call(_, all) => all.iter().for_each(|of| each_part(of, visit)),
    }
}

/// The number of parts of an expression.
pub(super) fn size(expr: &Expr) -> usize {
    let mut size = 0;
    each_part(expr, &mut |_| size += 1);
    size
}

/// Whether an expression has random numbers.
pub(super) fn is_random(expr: &Expr) -> bool {
    let mut found = false;
    each_part(expr, &mut |part| {
        found |= matches!(part, Expr::Call(Function::Random | Function::NormalRandom, _));
    });
    found
}
