//! The role of an expression, and the hints that depend on it.

use crate::{Diagnostic, Kind};
use lsystem_base::say;

/// The role of an expression.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Role {
    /// The value of a constant.
    Constant,
    /// The weight of a production.
    Weight,
    /// The condition of a production.
    Condition,
    /// An argument of a production's module.
    Argument,
    /// An argument of the axiom.
    Axiom,
}

impl Role {
    /// The text that is probably meant by a character that has no place in arithmetic.
    pub(super) fn instead_of(self, found: char) -> String {
        match found {
            ')' => say!("Nothing is open there: leave it out, or add `(`."),
            '&' if self == Role::Condition => say!("Where both must hold write `&&` or `and`."),
            '|' if self == Role::Condition => say!("Where one of both is enough write `||` or `or`."),
            ',' if self == Role::Condition => {
                say!("Where both must hold write `&&` or `and`; write decimals with a point, as in 0.33.")
            }
            letter if self == Role::Condition && letter.is_alphabetic() => {
                say!("Conditions are joined by `and`, `or` and `not` in small letters, or by `&&`, `||` and `!`.")
            }
            ',' if self == Role::Weight => {
                say!("Each outcome has a line of its own, as in `F -> FF : 0.33`; write decimals with a point.")
            }
            ',' => say!("Write decimals with a point, as in 0.33."),
            '#' => say!("A comment needs a line of its own."),
            '%' => say!("Write percentages as fractions, as in 0.33."),
            '[' | ']' | '{' | '}' => say!("Group with parentheses."),
            _ => match self {
                Role::Weight => say!("The weight starts after the last `:`; write the symbol `:` in backquotes."),
                Role::Constant => say!("A value is made of numbers, constants, functions and + - * / % ^ ( )."),
                Role::Argument | Role::Axiom => {
                    say!("Write products with `*`, as in `2*x`, and separate arguments by commas.")
                }
                Role::Condition => say!("A condition compares values, as in `x > 1 && y <= 2`."),
            },
        }
    }

    /// The error for a name that is neither a constant nor a parameter.
    pub(super) fn unknown(self, name: String, similar: Option<String>) -> Diagnostic {
        let may_be_parameter = matches!(self, Role::Condition | Role::Argument);
        let message = if may_be_parameter {
            say!("There is no parameter or constant `{}`", name)
        } else {
            say!("There is no constant `{}`", name)
        };
        let hint = match (&similar, self) {
            (_, Role::Condition) if name == "if" => {
                say!("A condition needs no `if`: write it right after the colon, as in `A(x) : x < 3 -> B`.")
            }
            (_, Role::Condition) if name == "true" => say!("Leave out a condition that always holds."),
            _ if matches!(name.as_str(), "pi" | "PI" | "Pi" | "π") => {
                say!("Define it, as in `{} = 3.14159265`; angles are in degrees.", name)
            }
            (Some(similar), _) => say!("Did you mean `{}`?", similar),
            (None, Role::Weight) => say!("Define it, as in `{} = 0.5`, or write the symbol `:` in backquotes.", name),
            (None, Role::Constant) => say!("Define it above, as in `{} = 0.5`.", name),
            (None, Role::Axiom) => say!("Define it in the rules, as in `{} = 0.5`.", name),
            (None, Role::Condition | Role::Argument) => {
                say!("Give it to the predecessor, as in `A({})`, or define it, as in `{} = 0.5`.", name, name)
            }
        };
        let kind = Kind::UnknownName { name: name.into(), may_be_parameter };
        Diagnostic::error(message).hint(hint).fix(similar).kind(kind)
    }
}
