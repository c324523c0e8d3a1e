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

    /// How tightly it binds: 1 (`||`) to 7 (`^`). Between 5 and 7 stand the signs, `SIGN`. All group to the left
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
        self.precedence() == COMPARISON
    }

    /// Its value for two numbers; logical values are 1 and 0.
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

/// How tightly `-a` and `!a` bind: `-2^2` is -4.
pub(crate) const SIGN: u8 = 6;

/// How tightly comparisons bind, and `not`, which may stand before one.
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

    /// Of one or two arguments; [`Function::Random`] of its bounds and a number in `0.0..1.0` is left to `Code`.
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

    /// Whether it denies a comparison, once or several times.
    fn denies_comparison(&self) -> bool {
        let mut denied = self;
        while let Self::Not(inner) = denied {
            denied = inner;
        }
        matches!(denied, Self::Binary(operator, ..) if operator.is_comparison())
    }

    /// Writes it, in parentheses where it binds less tightly than `outer`. What is written is nowhere deeper than what it
    /// was read from, so that it can be read again.
    pub(crate) fn write(&self, f: &mut impl fmt::Write, outer: u8) -> fmt::Result {
        if let Self::Not(denied) = self
            && outer <= COMPARISON
            && self.denies_comparison()
        {
            f.write_str("not ")?;
            return denied.write(f, COMPARISON);
        }
        if self.precedence() < outer {
            f.write_str("(")?;
            self.write(f, 0)?;
            return f.write_str(")");
        }
        match self {
            Self::Number(value) => f.write_str(&crate::number::number(*value)),
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
