//! Compiled expressions: common forms directly, all others as postfix operations.

use crate::curve::Curve;
use crate::expr::{Expr, Function, Operator};
use crate::shape::Shape;
use std::sync::Arc;

/// A compiled expression.
#[derive(Clone, Debug, PartialEq)]
pub enum Code {
    /// A constant.
    Constant(f64),
    /// A parameter.
    Slot(u16),
    /// A parameter times a constant, the form of most growth rules.
    Scaled(u16, f64),
    /// A parameter plus a constant.
    Shifted(u16, f64),
    /// All other expressions, in postfix order.
    Postfix(Vec<Op>),
}

/// One operation on a stack of values.
#[derive(Clone, Debug, PartialEq)]
pub enum Op {
    /// Push a number onto the stack.
    Number(f64),
    /// Push a parameter onto the stack.
    Slot(u16),
    /// Change the sign.
    Negative,
    /// 1 for 0, 0 for anything else.
    Not,
    /// Apply an operator to the two values on top.
    Binary(Operator),
    /// A function of one argument.
    Call1(Function),
    /// A function of two arguments.
    Call2(Function),
    /// A random number between the two values on top, with its index (0-based) among the production's random numbers.
    Random(u16),
    /// A normal random number: the mean and the standard deviation are on top, and two random numbers make it. This is
    /// the index of the first.
    NormalRandom(u16),
    /// The signed distance of the point on top from a shape.
    Distance(Arc<Shape>),
    /// The value of a curve.
    Curve(Arc<Curve>),
}

/// The most values on the stack. Deeper expressions do not compile.
pub(crate) const STACK: usize = 32;

/// The meaning of a name.
#[derive(Clone, Debug, PartialEq)]
pub enum Meaning {
    /// A named constant.
    Constant(f64),
    /// A named shape.
    Shape(Arc<Shape>),
    /// A named curve.
    Curve(Arc<Curve>),
    /// The parameter with this index, 0-based.
    Slot(u16),
}

/// The reason why an expression does not compile.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unusable {
    /// An unknown name.
    Unknown(String),
    /// The expression needs more than `STACK` values at once.
    TooDeep,
}

impl Code {
    /// Compiles `expr`. `meaning` gives the meaning of names; `randoms` counts the random numbers of the production so
    /// far.
    ///
    /// # Errors
    /// If a name is unknown or the expression is nested too deeply.
    pub fn new(expr: &Expr, meaning: &impl Fn(&str) -> Option<Meaning>, randoms: &mut u16) -> Result<Self, Unusable> {
        let mut ops = Vec::new();
        compile(expr, meaning, randoms, &mut ops, 0)?;
        Ok(match ops.as_slice() {
            [Op::Number(value)] => Self::Constant(*value),
            [Op::Slot(slot)] => Self::Slot(*slot),
            [Op::Slot(slot), Op::Number(value), Op::Binary(Operator::Multiply)]
            | [Op::Number(value), Op::Slot(slot), Op::Binary(Operator::Multiply)] => Self::Scaled(*slot, *value),
            [Op::Slot(slot), Op::Number(value), Op::Binary(Operator::Add)]
            | [Op::Number(value), Op::Slot(slot), Op::Binary(Operator::Add)] => Self::Shifted(*slot, *value),
            [Op::Slot(slot), Op::Number(value), Op::Binary(Operator::Subtract)] => Self::Shifted(*slot, -*value),
            _ => Self::Postfix(ops),
        })
    }

    /// The expression's value for the parameters in `slots`. `random` gives the number in `0.0..1.0` for the index of
    /// each random number.
    #[inline]
    pub fn value(&self, slots: &[f64], random: &impl Fn(u16) -> f64) -> f64 {
        match self {
            Self::Constant(value) => *value,
            Self::Slot(slot) => slots[usize::from(*slot)],
            Self::Scaled(slot, factor) => slots[usize::from(*slot)] * factor,
            Self::Shifted(slot, offset) => slots[usize::from(*slot)] + offset,
            Self::Postfix(ops) => run(ops, slots, random),
        }
    }

    /// The number of operations, with those of shapes and curves.
    #[must_use]
    pub fn length(&self) -> u64 {
        let of = |op: &Op| match op {
            Op::Distance(shape) => 8 * shape.work(),
            Op::Curve(curve) => curve.work(),
            _ => 1,
        };
        if let Self::Postfix(ops) = self { ops.iter().map(of).sum() } else { 1 }
    }

    /// Whether the expression contains a random number.
    #[must_use]
    pub fn is_random(&self) -> bool {
        matches!(self, Self::Postfix(ops) if ops.iter().any(|op| matches!(op, Op::Random(_) | Op::NormalRandom(_))))
    }
}

fn run(ops: &[Op], slots: &[f64], random: &impl Fn(u16) -> f64) -> f64 {
    let mut stack = [0.0; STACK];
    let mut top = 0;
    for op in ops {
        // `compile` keeps the stack within bounds and never lets it run empty.
        let (value, used) = match op {
            Op::Number(value) => (*value, 0),
            Op::Slot(slot) => (slots[usize::from(*slot)], 0),
            Op::Negative => (-stack[top - 1], 1),
            Op::Not => (f64::from(u8::from(stack[top - 1] == 0.0)), 1),
            Op::Binary(operator) => (operator.apply(stack[top - 2], stack[top - 1]), 2),
            Op::Call1(function) => (function.apply(stack[top - 1], 0.0), 1),
            Op::Call2(function) => (function.apply(stack[top - 2], stack[top - 1]), 2),
            Op::Random(place) => {
                let (from, to) = (stack[top - 2], stack[top - 1]);
                (from + (to - from) * random(*place), 2)
            }
            Op::NormalRandom(place) => {
                let (mean, deviation) = (stack[top - 2], stack[top - 1]);
                (mean + deviation * normal(random(*place), random(place.wrapping_add(1))), 2)
            }
            Op::Distance(shape) => (shape.distance([stack[top - 3], stack[top - 2], stack[top - 1]]), 3),
            Op::Curve(curve) => (curve.value(stack[top - 1]), 1),
        };
        top -= used;
        stack[top] = value;
        top += 1;
    }
    stack[0]
}

/// A normal random number with mean 0 and standard deviation 1, from two random numbers in `0.0..1.0`, by Box and
/// Muller.
fn normal(radius: f64, angle: f64) -> f64 {
    (-2.0 * libm::log(1.0 - radius)).sqrt() * libm::cos(core::f64::consts::TAU * angle)
}

/// Appends the postfix form of `expr` with constants folded. `held` is the number of values already on the stack.
fn compile(
    expr: &Expr,
    meaning: &impl Fn(&str) -> Option<Meaning>,
    randoms: &mut u16,
    ops: &mut Vec<Op>,
    held: usize,
) -> Result<(), Unusable> {
    if held >= STACK {
        return Err(Unusable::TooDeep);
    }
    let start = ops.len();
    match expr {
        Expr::Number(value) => ops.push(Op::Number(*value)),
        Expr::Name(name) => match meaning(name) {
            Some(Meaning::Constant(value)) => ops.push(Op::Number(value)),
            Some(Meaning::Slot(slot)) => ops.push(Op::Slot(slot)),
            // Shapes and curves are no numbers.
            Some(Meaning::Shape(_) | Meaning::Curve(_)) | None => return Err(Unusable::Unknown(name.clone())),
        },
        Expr::Negative(a) => {
            compile(a, meaning, randoms, ops, held)?;
            ops.push(Op::Negative);
        }
        Expr::Not(a) => {
            compile(a, meaning, randoms, ops, held)?;
            ops.push(Op::Not);
        }
        Expr::Binary(operator, a, b) => {
            compile(a, meaning, randoms, ops, held)?;
            compile(b, meaning, randoms, ops, held + 1)?;
            ops.push(Op::Binary(*operator));
        }
        Expr::Curve(name, argument) => {
            let Some(Meaning::Curve(curve)) = meaning(name) else { return Err(Unusable::Unknown(name.clone())) };
            compile(argument, meaning, randoms, ops, held)?;
            ops.push(Op::Curve(curve));
        }
        Expr::Call(function, arguments) if function.takes_shape() => {
            let shape = match arguments.first() {
                Some(Expr::Name(name)) => match meaning(name) {
                    Some(Meaning::Shape(shape)) => shape,
                    _ => return Err(Unusable::Unknown(name.clone())),
                },
                _ => return Err(Unusable::Unknown(String::new())),
            };
            // In the plane z is left out.
            let flat = Expr::Number(0.0);
            for index in 0..3 {
                compile(arguments.get(index + 1).unwrap_or(&flat), meaning, randoms, ops, held + index)?;
            }
            ops.push(Op::Distance(shape));
            if *function == Function::Inside {
                ops.extend([Op::Number(0.0), Op::Binary(Operator::LessOrEqual)]);
            }
        }
        Expr::Call(function, arguments) => {
            for (index, argument) in arguments.iter().enumerate() {
                compile(argument, meaning, randoms, ops, held + index)?;
            }
            ops.push(match (function, function.arity()) {
                (Function::Random, _) => {
                    *randoms = randoms.wrapping_add(1);
                    Op::Random(randoms.wrapping_sub(1))
                }
                (Function::NormalRandom, _) => {
                    *randoms = randoms.wrapping_add(2);
                    Op::NormalRandom(randoms.wrapping_sub(2))
                }
                (_, 2) => Op::Call2(*function),
                _ => Op::Call1(*function),
            });
        }
    }
    fold(ops, start);
    Ok(())
}

/// Replaces the operations from `start` on by their value if they are one operation on constants.
fn fold(ops: &mut Vec<Op>, start: usize) {
    let constant = |op: &Op| matches!(op, Op::Number(_));
    if let [arguments @ .., last] = &ops[start..]
        && !arguments.is_empty()
        && arguments.iter().all(constant)
        && !matches!(last, Op::Number(_) | Op::Random(_) | Op::NormalRandom(_))
    {
        let value = run(&ops[start..], &[], &|_| 0.0);
        ops.truncate(start);
        ops.push(Op::Number(value));
    }
}
#[cfg(test)]
mod tests {
    use super::*;

    fn number(value: f64) -> Box<Expr> {
        Box::new(Expr::Number(value))
    }

    fn code(expr: &Expr) -> Result<Code, Unusable> {
        let names = |name: &str| match name {
            "l" => Some(Meaning::Slot(0)),
            "w" => Some(Meaning::Slot(1)),
            "r" => Some(Meaning::Constant(0.9)),
            _ => None,
        };
        Code::new(expr, &names, &mut 0)
    }

    #[test]
    fn common_forms_need_no_stack() {
        let l = || Box::new(Expr::Name("l".into()));
        let r = || Box::new(Expr::Name("r".into()));
        let product = Expr::Binary(Operator::Multiply, l(), r());
        assert_eq!(code(&product), Ok(Code::Scaled(0, 0.9)));
        let folded = Expr::Binary(Operator::Power, r(), number(2.0));
        assert!(matches!(code(&folded), Ok(Code::Constant(v)) if (v - 0.81).abs() < 1e-15));
        let sum = Expr::Binary(Operator::Add, Box::new(product), Box::new(Expr::Name("w".into())));
        assert_eq!(code(&sum).unwrap().value(&[10.0, 0.5], &|_| 0.0), 9.5);
        assert_eq!(code(&Expr::Name("x".into())), Err(Unusable::Unknown("x".into())));
    }

    #[test]
    fn angles_are_in_degrees_and_edges_are_defined() {
        let call = |function, a: f64| code(&Expr::Call(function, vec![Expr::Number(a)])).unwrap().value(&[], &|_| 0.0);
        assert_eq!(call(Function::Sin, 30.0), 0.5);
        assert_eq!(call(Function::Cos, 90.0), 0.0);
        assert!((call(Function::Atan, 1.0) - 45.0).abs() < 1e-13);
        assert!(call(Function::Sin, f64::INFINITY).is_nan());
        assert!(call(Function::Ln, -1.0).is_nan());
        let remainder = Expr::Binary(Operator::Remainder, number(-30.0), number(360.0));
        assert_eq!(code(&remainder), Ok(Code::Constant(330.0)));
        let divided = Expr::Binary(Operator::Divide, number(1.0), number(0.0));
        assert_eq!(code(&divided), Ok(Code::Constant(f64::INFINITY)));
    }

    #[test]
    fn depth_is_bounded() {
        let deep = (0..STACK + 1).fold(Expr::Name("l".into()), |inner, _| {
            Expr::Binary(Operator::Add, Box::new(Expr::Name("w".into())), Box::new(inner))
        });
        assert_eq!(code(&deep), Err(Unusable::TooDeep));
    }

    #[test]
    fn points_of_shapes_stay_on_the_stack() {
        let meaning = |name: &str| match name {
            "l" => Some(Meaning::Slot(0)),
            _ => Some(Meaning::Shape(Arc::new(Shape::Ball([0.0, 0.0, 0.0, 1.0])))),
        };
        let l = || Box::new(Expr::Name("l".into()));
        let point = vec![Expr::Name("ball".into()), Expr::Name("l".into()), Expr::Name("l".into())];
        let mut expr = Expr::Call(Function::Distance, point);
        for depth in 0..2 * STACK {
            match Code::new(&expr, &meaning, &mut 0) {
                Ok(code) => {
                    // Each level adds 3, and the point (3, 3) is 18^0.5 - 1 away.
                    let value = code.value(&[3.0], &|_| 0.0);
                    assert!((value - (18_f64.sqrt() - 1.0 + 3.0 * depth as f64)).abs() < 1e-9, "{depth}: {value}");
                }
                Err(error) => assert!(error == Unusable::TooDeep && depth + 3 > STACK, "{depth}"),
            }
            expr = Expr::Binary(Operator::Add, l(), Box::new(expr));
        }
    }
}
