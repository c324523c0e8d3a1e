//! Functions by name, and the messages about them.

use crate::Diagnostic;
use crate::expr::Function;
use lsystem_base::{counted, say};

/// The name in cpfg of a random number from 0 up to the only argument.
pub(super) const RAN: &str = "ran";

/// The function with this name.
pub(crate) fn function(name: &str) -> Option<Function> {
    if name == RAN {
        return Some(Function::Random);
    }
    Function::named(name)
}

/// The error for a name before `(` that is not a function.
pub(super) fn unknown_function(name: &str, similar: Option<&'static str>) -> Diagnostic {
    let hint = match (name, similar) {
        ("pow" | "power", _) => say!("For a power write `x^y`."),
        ("mod" | "fmod", _) => say!("For a remainder write `x % y`."),
        ("log" | "log10", _) => say!("The natural logarithm is `ln(x)`."),
        ("rand" | "rnd", _) => say!("A random number between two others is `random(0, 1)`."),
        ("round" | "int" | "trunc", _) => say!("To round write `floor(x + 0.5)`."),
        (_, Some(similar)) => say!("Did you mean `{}`?", similar),
        (_, None) => {
            say!("The functions are {}.", Function::NAMES.join(", "))
        }
    };
    Diagnostic::error(say!("There is no function `{}`", name)).hint(hint).fix(similar.map(str::to_owned))
}

/// The error for a function with a wrong number of arguments.
pub(super) fn wrong_arity(function: Function, found: usize) -> Diagnostic {
    let expected = function.arity();
    let hint = match function {
        Function::Random => say!("`random(a, b)` is a number from a up to b."),
        Function::NormalRandom => say!("`nran(m, s)` has the mean m and the standard deviation s."),
        Function::Atan2 => say!("`atan2(y, x)` is the angle of the point (x, y)."),
        Function::Inside | Function::Distance => say!("Write it as in `{}(crown, x, y, z)`.", function.name()),
        _ if expected == 2 => say!("Write it as in `{}(a, b)`.", function.name()),
        _ => say!("Write it as in `{}(a)`.", function.name()),
    };
    let arguments = counted!(expected, "{} argument", "{} arguments");
    Diagnostic::error(say!("`{}` takes {}, not {}", function.name(), arguments, found)).hint(hint)
}
