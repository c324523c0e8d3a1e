//! Arithmetic of arguments, conditions, weights and constants.
//!
//! Numbers are `f64`. True is 1 and false is 0; any number except 0 counts as true. Angles are in degrees. Division by
//! zero, overflow and undefined values give infinities and NaN, which the caller reports. `a % b` has the sign of `b`:
//! `a - b * floor(a / b)`.

use core::fmt;
use lsystem_base::named;

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
    /// A binary operator, as in `a + b`.
    Binary(Operator, Box<Self>, Box<Self>),
    /// A function call, as in `sin(a)`.
    Call(Function, Vec<Self>),
    /// The value of a named curve, as in `taper(a)`.
    Curve(String, Box<Self>),
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

// In the order of precedence, loosest first.
named!(Operator: Or "||", And "&&", Equal "==", NotEqual "!=", Less "<", LessOrEqual "<=", Greater ">",
    GreaterOrEqual ">=", Add "+", Subtract "-", Multiply "*", Divide "/", Remainder "%", Power "^");

impl Operator {
    /// The precedence, from 1 (`||`, loosest) to 7 (`^`, tightest). Signs have 6, `SIGN`. `^` groups to the right,
    /// comparisons do not chain, and all other operators group to the left.
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

    /// Whether the operator compares two numbers.
    #[must_use]
    pub fn is_comparison(self) -> bool {
        self.precedence() == COMPARISON
    }

    /// The operator's value for two numbers. True is 1, false is 0.
    pub fn apply(self, a: f64, b: f64) -> f64 {
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

/// The precedence of `-a` and `!a`: `-2^2` is -4.
pub(crate) const SIGN: u8 = 6;

/// The precedence of comparisons, and of `not` before a comparison.
const COMPARISON: u8 = 3;

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
    /// `random(a, b)`: a uniform random number from `a` up to `b`. As with stochastic productions, its key is the place
    /// in the derivation.
    Random,
    /// `nran(m, s)`: a normal random number with mean `m` and standard deviation `s`, as in cpfg.
    NormalRandom,
    /// `inside(shape, x, y, z)`: whether a point is in a named shape; in the plane without z.
    Inside,
    /// `distance(shape, x, y, z)`: the signed distance of a point from a named shape, negative inside.
    Distance,
}

named!(Function: Sin "sin", Cos "cos", Tan "tan", Asin "asin", Acos "acos", Atan "atan", Atan2 "atan2", Sqrt "sqrt",
    Exp "exp", Ln "ln", Abs "abs", Floor "floor", Ceil "ceil", Min "min", Max "max", Random "random",
    NormalRandom "nran", Inside "inside", Distance "distance");

impl Function {
    /// Whether the first argument is the name of a shape.
    #[must_use]
    pub fn takes_shape(self) -> bool {
        matches!(self, Self::Inside | Self::Distance)
    }

    /// The number of arguments: 1, 2 or 4. A function of a shape may also have 3, for a point in the plane.
    #[must_use]
    pub fn arity(self) -> usize {
        match self {
            Self::Inside | Self::Distance => 4,
            Self::Atan2 | Self::Min | Self::Max | Self::Random | Self::NormalRandom => 2,
            _ => 1,
        }
    }

    /// The function's value; functions of one argument ignore `b`. Random numbers and functions of shapes give NaN here,
    /// because `Code` computes them.
    pub fn apply(self, a: f64, b: f64) -> f64 {
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
            Self::Random | Self::NormalRandom | Self::Inside | Self::Distance => f64::NAN,
        }
    }
}

fn degrees(radians: f64) -> f64 {
    radians * (180.0 / core::f64::consts::PI)
}

impl fmt::Display for Expr {
    /// Prints the expression in the notation with as few parentheses as possible.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.write(f, 0)
    }
}

impl Expr {
    fn precedence(&self) -> u8 {
        match self {
            Self::Number(value) if value.is_sign_negative() => SIGN,
            Self::Number(_) | Self::Name(_) | Self::Call(..) | Self::Curve(..) => 8,
            Self::Negative(_) | Self::Not(_) => SIGN,
            Self::Binary(operator, ..) => operator.precedence(),
        }
    }

    /// Whether this is a comparison with one `not` or several before it.
    fn negates_comparison(&self) -> bool {
        let mut operand = self;
        while let Self::Not(inner) = operand {
            operand = inner;
        }
        matches!(operand, Self::Binary(operator, ..) if operator.is_comparison())
    }

    /// Prints the expression, in parentheses if its precedence is below `outer`. The text is never nested more deeply
    /// than the text it was read from, so that it can be read again.
    pub(crate) fn write(&self, f: &mut impl fmt::Write, outer: u8) -> fmt::Result {
        if let Self::Not(operand) = self
            && outer <= COMPARISON
            && self.negates_comparison()
        {
            f.write_str("not ")?;
            return operand.write(f, COMPARISON);
        }
        if self.precedence() < outer {
            f.write_str("(")?;
            self.write(f, 0)?;
            return f.write_str(")");
        }
        match self {
            Self::Number(value) => f.write_str(&lsystem_base::number::number(*value)),
            Self::Name(name) => f.write_str(name),
            Self::Negative(a) => {
                f.write_str("-")?;
                a.write(f, SIGN)
            }
            Self::Not(a) => {
                f.write_str("!")?;
                a.write(f, SIGN)
            }
            Self::Binary(operator, a, b) => {
                let inner = operator.precedence();
                // `^` groups to the right, comparisons do not chain, other operators group to the left.
                let (left, right) = match operator {
                    Operator::Power => (inner + 1, SIGN),
                    _ if operator.is_comparison() => (inner + 1, inner + 1),
                    _ => (inner, inner + 1),
                };
                a.write(f, left)?;
                if inner <= 4 {
                    write!(f, " {} ", operator.name())?;
                } else {
                    f.write_str(operator.name())?;
                }
                b.write(f, right)
            }
            Self::Curve(name, argument) => {
                f.write_str(name)?;
                f.write_str("(")?;
                argument.write(f, 0)?;
                f.write_str(")")
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

#[cfg(test)]
mod tests {
    use super::*;

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

    #[test]
    fn deep_denials_read_back() {
        let read = |condition: &str| {
            let (grammar, diagnostics) = crate::parse("F(1)", &format!("F(x) : {condition} -> F(x)"));
            (!diagnostics.iter().any(crate::Diagnostic::is_error)).then(|| grammar.productions[0].condition.clone())
        };
        for denial in ["!", "-", "not ", "!-", "not !", "not (", "!(", "not (not "] {
            for depth in 1..70 {
                for inner in ["x", "x > 1", "x^-x", "x > 1 && x < 2"] {
                    let closed = ")".repeat(denial.matches('(').count() * depth);
                    let Some(condition) = read(&format!("{}{inner}{closed}", denial.repeat(depth))) else { continue };
                    let printed = condition.as_ref().map(ToString::to_string).unwrap_or_default();
                    assert_eq!(read(&printed), Some(condition), "{printed}");
                }
            }
        }
        assert!(read(&format!("{}x", "!".repeat(64))).is_some());
    }
}
