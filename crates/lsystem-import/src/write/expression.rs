//! Arithmetic in the notations of other programs.

use super::Refusal;
use lsystem_base::number::number;
use lsystem_base::say;
use lsystem_syntax::{Expr, Function, Operator};

/// How a notation writes arithmetic.
pub(super) struct Arithmetic<'a> {
    pub(super) label: &'a str,
    /// What stands for a name.
    pub(super) name: &'a dyn Fn(&str) -> String,
    /// The names of functions; the notation lacks all others. A name may open a function around it: `sin(radians`.
    pub(super) functions: &'a [(Function, &'a str)],
    /// The value of a curve, given its name and its argument; `None` if the notation lacks curves.
    pub(super) curve: &'a dyn Fn(&str, &str) -> Option<String>,
    /// Whether logic has the words of Python, and powers its sign.
    pub(super) is_python: bool,
}

/// The precedence of signs, and of what needs no parentheses.
const SIGN: u8 = 6;
const ATOM: u8 = 8;

impl Arithmetic<'_> {
    /// Writes an expression.
    pub(super) fn write(&self, expr: &Expr) -> Result<String, Refusal> {
        let mut out = String::new();
        self.part(expr, 0, &mut out)?;
        Ok(out)
    }

    /// Writes an expression, in parentheses if it binds less tightly than `outer`.
    fn part(&self, expr: &Expr, outer: u8, out: &mut String) -> Result<(), Refusal> {
        let own = match expr {
            Expr::Number(value) if value.is_sign_negative() => SIGN,
            Expr::Name(name) => {
                let text = (self.name)(name);
                if text.starts_with('-') { SIGN } else { ATOM }
            }
            Expr::Number(_) | Expr::Call(..) | Expr::Curve(..) => ATOM,
            // The word binds less tightly than comparisons.
            Expr::Not(_) if self.is_python => Operator::And.precedence(),
            Expr::Negative(_) | Expr::Not(_) => SIGN,
            Expr::Binary(operator, ..) => operator.precedence(),
        };
        if own < outer {
            out.push('(');
            self.part(expr, 0, out)?;
            out.push(')');
            return Ok(());
        }
        match expr {
            Expr::Number(value) => out.push_str(&number(*value)),
            Expr::Name(name) => out.push_str(&(self.name)(name)),
            Expr::Negative(operand) => {
                out.push('-');
                self.part(operand, SIGN + 1, out)?;
            }
            Expr::Not(operand) => {
                out.push_str(if self.is_python { "not " } else { "!" });
                self.part(operand, SIGN + 1, out)?;
            }
            Expr::Binary(operator, a, b) => {
                // Powers group differently in different programs, and comparisons do not chain.
                let tight = u8::from(operator.is_comparison() || *operator == Operator::Power);
                self.part(a, own + tight, out)?;
                out.push_str(match operator {
                    Operator::And if self.is_python => " and ",
                    Operator::Or if self.is_python => " or ",
                    Operator::Power if self.is_python => "**",
                    _ => operator.name(),
                });
                self.part(b, own + 1, out)?;
            }
            Expr::Curve(name, argument) => {
                let value = (self.curve)(name, &self.write(argument)?);
                out.push_str(&value.ok_or_else(|| Refusal(say!("{} cannot express curves", self.label)))?);
            }
            Expr::Call(function, arguments) => {
                let name = self.functions.iter().find(|(own, _)| own == function);
                let Some((_, name)) = name else {
                    return Err(Refusal(say!("{} cannot express the function {}", self.label, function.name())));
                };
                out.push_str(name);
                for (at, argument) in arguments.iter().enumerate() {
                    out.push(if at == 0 { '(' } else { ',' });
                    self.part(argument, 0, out)?;
                }
                out.extend(core::iter::repeat_n(')', 1 + name.matches('(').count()));
            }
        }
        Ok(())
    }
}

/// The functions that programs have under the same names, with angles in degrees.
pub(super) const COMMON: &[(Function, &str)] = &[
    (Function::Sin, "sin"),
    (Function::Cos, "cos"),
    (Function::Tan, "tan"),
    (Function::Asin, "asin"),
    (Function::Acos, "acos"),
    (Function::Atan, "atan"),
    (Function::Sqrt, "sqrt"),
    (Function::Exp, "exp"),
    (Function::Floor, "floor"),
    (Function::Ceil, "ceil"),
];

/// The functions of Python, some within others: its angles are radians.
pub(super) const PYTHON: &[(Function, &str)] = &[
    (Function::Sin, "sin(radians"),
    (Function::Cos, "cos(radians"),
    (Function::Tan, "tan(radians"),
    (Function::Asin, "degrees(asin"),
    (Function::Acos, "degrees(acos"),
    (Function::Atan, "degrees(atan"),
    (Function::Atan2, "degrees(atan2"),
    (Function::Sqrt, "sqrt"),
    (Function::Exp, "exp"),
    (Function::Ln, "log"),
    (Function::Abs, "abs"),
    (Function::Floor, "floor"),
    (Function::Ceil, "ceil"),
    (Function::Min, "min"),
    (Function::Max, "max"),
];
