//! Arithmetic in productions: what parameters, conditions, weights and constants are computed with.
//!
//! Numbers are `f64`; truth is 1 and falsehood 0, and anything but 0 counts as true. Angles are in degrees.
//! Division by zero, overflow and undefined values give infinities and NaN, which whoever uses the value reports.
//! `a % b` has the sign of `b`: `a - b * floor(a / b)`.

use core::fmt;

/// An expression as written.
#[derive(Clone, Debug, PartialEq)]
pub enum Expr {
    /// A number.
    Number(f64),
    /// A parameter or a named constant.
    Name(String),
    /// `-a`
    Negative(Box<Self>),
    /// `!a`, also `not a`
    Not(Box<Self>),
    /// `a + b` and the like.
    Binary(Operator, Box<Self>, Box<Self>),
    /// `sin(a)` and the like.
    Call(Function, Vec<Self>),
}

/// An operator between two values.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "the names say it all")]
pub enum Operator {
    Or,
    And,
    Equal,
    NotEqual,
    Less,
    LessOrEqual,
    Greater,
    GreaterOrEqual,
    Add,
    Subtract,
    Multiply,
    Divide,
    Remainder,
    Power,
}

impl Operator {
    /// All, in the order of their precedence, loosest first.
    pub const ALL: [Self; 14] = [
        Self::Or,
        Self::And,
        Self::Equal,
        Self::NotEqual,
        Self::Less,
        Self::LessOrEqual,
        Self::Greater,
        Self::GreaterOrEqual,
        Self::Add,
        Self::Subtract,
        Self::Multiply,
        Self::Divide,
        Self::Remainder,
        Self::Power,
    ];

    /// How it is written.
    #[must_use]
    pub fn symbol(self) -> &'static str {
        match self {
            Self::Or => "||",
            Self::And => "&&",
            Self::Equal => "==",
            Self::NotEqual => "!=",
            Self::Less => "<",
            Self::LessOrEqual => "<=",
            Self::Greater => ">",
            Self::GreaterOrEqual => ">=",
            Self::Add => "+",
            Self::Subtract => "-",
            Self::Multiply => "*",
            Self::Divide => "/",
            Self::Remainder => "%",
            Self::Power => "^",
        }
    }

    /// How tightly it binds: 1 (`||`) to 7 (`^`). Between 5 and 7 stand the signs, [`SIGN`]. All group to the left
    /// except `^`.
    #[must_use]
    pub fn precedence(self) -> u8 {
        match self {
            Self::Or => 1,
            Self::And => 2,
            Self::Equal | Self::NotEqual | Self::Less | Self::LessOrEqual | Self::Greater | Self::GreaterOrEqual => 3,
            Self::Add | Self::Subtract => 4,
            Self::Multiply | Self::Divide | Self::Remainder => 5,
            Self::Power => 7,
        }
    }

    /// Whether it compares two numbers.
    #[must_use]
    pub fn is_comparison(self) -> bool {
        self.precedence() == 3
    }

    fn apply(self, a: f64, b: f64) -> f64 {
        let truth = |holds: bool| f64::from(u8::from(holds));
        match self {
            Self::Or => truth(a != 0.0 || b != 0.0),
            Self::And => truth(a != 0.0 && b != 0.0),
            Self::Equal => truth(a == b),
            Self::NotEqual => truth(a != b),
            Self::Less => truth(a < b),
            Self::LessOrEqual => truth(a <= b),
            Self::Greater => truth(a > b),
            Self::GreaterOrEqual => truth(a >= b),
            Self::Add => a + b,
            Self::Subtract => a - b,
            Self::Multiply => a * b,
            Self::Divide => a / b,
            Self::Remainder => a - b * (a / b).floor(),
            Self::Power => libm::pow(a, b),
        }
    }
}

/// How tightly `-a` and `!a` bind: `-2^2` is -4.
pub const SIGN: u8 = 6;

/// A function by name.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
#[expect(missing_docs, reason = "the names say it all")]
pub enum Function {
    Sin,
    Cos,
    Tan,
    Asin,
    Acos,
    Atan,
    Atan2,
    Sqrt,
    Exp,
    Ln,
    Abs,
    Floor,
    Ceil,
    Min,
    Max,
    /// `random(a, b)`: uniform from a up to b, keyed by place as the choice of productions is.
    Random,
}

impl Function {
    /// All of them.
    pub const ALL: [Self; 16] = [
        Self::Sin,
        Self::Cos,
        Self::Tan,
        Self::Asin,
        Self::Acos,
        Self::Atan,
        Self::Atan2,
        Self::Sqrt,
        Self::Exp,
        Self::Ln,
        Self::Abs,
        Self::Floor,
        Self::Ceil,
        Self::Min,
        Self::Max,
        Self::Random,
    ];

    /// How it is written.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::Sin => "sin",
            Self::Cos => "cos",
            Self::Tan => "tan",
            Self::Asin => "asin",
            Self::Acos => "acos",
            Self::Atan => "atan",
            Self::Atan2 => "atan2",
            Self::Sqrt => "sqrt",
            Self::Exp => "exp",
            Self::Ln => "ln",
            Self::Abs => "abs",
            Self::Floor => "floor",
            Self::Ceil => "ceil",
            Self::Min => "min",
            Self::Max => "max",
            Self::Random => "random",
        }
    }

    /// How many arguments it takes.
    #[must_use]
    pub fn arity(self) -> usize {
        match self {
            Self::Atan2 | Self::Min | Self::Max | Self::Random => 2,
            _ => 1,
        }
    }

    /// Of one or two arguments; [`Function::Random`] of its bounds and a number in `0.0..1.0` is left to [`Code`].
    fn apply(self, a: f64, b: f64) -> f64 {
        match self {
            Self::Sin => crate::Heading::from_degrees(a).cos_sin().1 + 0.0 * a,
            Self::Cos => crate::Heading::from_degrees(a).cos_sin().0 + 0.0 * a,
            Self::Tan => {
                let (c, s) = crate::Heading::from_degrees(a).cos_sin();
                s / c + 0.0 * a
            }
            Self::Asin => degrees(libm::asin(a)),
            Self::Acos => degrees(libm::acos(a)),
            Self::Atan => degrees(libm::atan(a)),
            Self::Atan2 => degrees(libm::atan2(a, b)),
            Self::Sqrt => a.sqrt(),
            Self::Exp => libm::exp(a),
            Self::Ln => libm::log(a),
            Self::Abs => a.abs(),
            Self::Floor => a.floor(),
            Self::Ceil => a.ceil(),
            Self::Min => a.min(b),
            Self::Max => a.max(b),
            Self::Random => f64::NAN,
        }
    }
}

fn degrees(radians: f64) -> f64 {
    radians * (180.0 / core::f64::consts::PI)
}

impl fmt::Display for Expr {
    /// In the notation, with no more parentheses than needed.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write(f, 0)
    }
}

impl Expr {
    fn precedence(&self) -> u8 {
        match self {
            Self::Number(value) if value.is_sign_negative() => SIGN,
            Self::Number(_) | Self::Name(_) | Self::Call(..) => 8,
            Self::Negative(_) | Self::Not(_) => SIGN,
            Self::Binary(operator, ..) => operator.precedence(),
        }
    }

    /// Writes it, in parentheses where it binds less tightly than `outer`.
    pub(crate) fn write(&self, f: &mut impl fmt::Write, outer: u8) -> fmt::Result {
        if self.precedence() < outer {
            f.write_str("(")?;
            self.write(f, 0)?;
            return f.write_str(")");
        }
        match self {
            Self::Number(value) => f.write_str(&crate::print::number(*value)),
            Self::Name(name) => f.write_str(name),
            Self::Negative(a) => {
                f.write_str("-")?;
                a.write(f, SIGN + 1)
            }
            Self::Not(a) => {
                f.write_str("!")?;
                a.write(f, SIGN + 1)
            }
            Self::Binary(operator, a, b) => {
                let inner = operator.precedence();
                // `^` groups to the right, comparisons not at all, all others to the left.
                let (left, right) = match operator {
                    Operator::Power => (inner + 1, SIGN),
                    _ if operator.is_comparison() => (inner + 1, inner + 1),
                    _ => (inner, inner + 1),
                };
                a.write(f, left)?;
                if inner <= 4 {
                    write!(f, " {} ", operator.symbol())?;
                } else {
                    f.write_str(operator.symbol())?;
                }
                b.write(f, right)
            }
            Self::Call(function, arguments) => {
                write!(f, "{}(", function.name())?;
                for (index, argument) in arguments.iter().enumerate() {
                    if index > 0 {
                        f.write_str(", ")?;
                    }
                    argument.write(f, 0)?;
                }
                f.write_str(")")
            }
        }
    }
}

/// An expression made ready to be computed many times.
#[derive(Clone, Debug, PartialEq)]
pub enum Code {
    /// Always this.
    Constant(f64),
    /// A parameter.
    Slot(u16),
    /// A parameter times a constant: what most growth rules are made of.
    Scaled(u16, f64),
    /// A parameter plus a constant.
    Shifted(u16, f64),
    /// Anything else, in postfix order.
    Postfix(Vec<Op>),
}

/// One operation on a stack of values.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Op {
    /// Push a number.
    Number(f64),
    /// Push a parameter.
    Slot(u16),
    /// Change the sign.
    Negative,
    /// 1 for 0, 0 for anything else.
    Not,
    /// Combine the two on top.
    Binary(Operator),
    /// A function of one argument.
    Call1(Function),
    /// A function of two arguments.
    Call2(Function),
    /// A random number between the two on top; which of the production's random numbers it is.
    Random(u16),
}

/// Values that a stack holds; deeper expressions do not compile.
pub const STACK: usize = 32;

/// What a name stands for.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Meaning {
    /// A named constant.
    Constant(f64),
    /// The parameter at this place.
    Slot(u16),
}

/// An expression that cannot be computed.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Unusable {
    /// A name that stands for nothing.
    Unknown(String),
    /// It needs more than [`STACK`] values at once.
    TooDeep,
}

impl Code {
    /// Makes `expr` ready: `meaning` says what names stand for; `randoms` counts the random numbers of the
    /// production so far.
    ///
    /// # Errors
    /// Where a name is unknown or the expression too deep.
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

    /// Its value for `slots`, the parameters; `random` gives a number in `0.0..1.0` for each place of one.
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

    /// Whether chance plays a part.
    #[must_use]
    pub fn is_random(&self) -> bool {
        matches!(self, Self::Postfix(ops) if ops.iter().any(|op| matches!(op, Op::Random(_))))
    }
}

fn run(ops: &[Op], slots: &[f64], random: &impl Fn(u16) -> f64) -> f64 {
    let mut stack = [0.0; STACK];
    let mut top = 0;
    for op in ops {
        // `compile` keeps the stack within bounds and never lets it run empty.
        let (value, used) = match *op {
            Op::Number(value) => (value, 0),
            Op::Slot(slot) => (slots[usize::from(slot)], 0),
            Op::Negative => (-stack[top - 1], 1),
            Op::Not => (f64::from(u8::from(stack[top - 1] == 0.0)), 1),
            Op::Binary(operator) => (operator.apply(stack[top - 2], stack[top - 1]), 2),
            Op::Call1(function) => (function.apply(stack[top - 1], 0.0), 1),
            Op::Call2(function) => (function.apply(stack[top - 2], stack[top - 1]), 2),
            Op::Random(place) => {
                let (from, to) = (stack[top - 2], stack[top - 1]);
                (from + (to - from) * random(place), 2)
            }
        };
        top -= used;
        stack[top] = value;
        top += 1;
    }
    stack[0]
}

/// Appends the postfix form of `expr`, constants folded; `held` values are on the stack already.
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
            None => return Err(Unusable::Unknown(name.clone())),
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
        Expr::Call(function, arguments) => {
            for (index, argument) in arguments.iter().enumerate() {
                compile(argument, meaning, randoms, ops, held + index)?;
            }
            ops.push(match (function, function.arity()) {
                (Function::Random, _) => {
                    *randoms = randoms.wrapping_add(1);
                    Op::Random(randoms.wrapping_sub(1))
                }
                (_, 2) => Op::Call2(*function),
                _ => Op::Call1(*function),
            });
        }
    }
    let constant = |op: &Op| matches!(op, Op::Number(_));
    if let [arguments @ .., last] = &ops[start..]
        && !arguments.is_empty()
        && arguments.iter().all(constant)
        && !matches!(last, Op::Number(_) | Op::Random(_))
    {
        let value = run(&ops[start..], &[], &|_| 0.0);
        ops.truncate(start);
        ops.push(Op::Number(value));
    }
    Ok(())
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
    fn prints_with_few_parentheses() {
        let name = |n: &str| Box::new(Expr::Name(n.into()));
        let sum = Expr::Binary(Operator::Add, name("a"), name("b"));
        let product = Expr::Binary(Operator::Multiply, Box::new(sum.clone()), name("c"));
        assert_eq!(product.to_string(), "(a + b)*c");
        let power = Expr::Binary(Operator::Power, Box::new(Expr::Negative(name("a"))), name("b"));
        assert_eq!(power.to_string(), "(-a)^b");
        assert_eq!(Expr::Negative(Box::new(sum)).to_string(), "-(a + b)");
    }
}
