//! Query modules as cpfg and L-Py write them. L-Py's turtle starts along z, with its left side towards -y; its `x`, `y`
//! and `z` are the `z`, `x` and `y` of this library.

use super::Refusal;
use super::source::Source;
use lsystem_base::say;
use lsystem_syntax::Query;

/// Refuses a system whose queries L-Py would not tell apart by the number of their arguments: it asks for three.
pub(super) fn check_for_lpy(source: &Source<'_>) -> Result<(), Refusal> {
    if source.asks(|query| query == Query::Position) && source.definition.start != [0.0, 0.0] {
        return Err(Refusal::new(say!("L-Py cannot express queries of positions with another start than 0, 0")));
    }
    let arities = |query: Query| {
        let own = source.system.rules.letters.iter().filter(move |letter| letter.symbol == query.symbol());
        own.map(|letter| letter.arity).collect::<Vec<_>>()
    };
    match Query::ALL.into_iter().find(|query| !matches!(arities(*query)[..], [] | [0 | 2 | 3])) {
        Some(query) => {
            Err(Refusal(say!("L-Py cannot express `{}` with another number of arguments than three", query)))
        }
        None => Ok(()),
    }
}

/// The arguments of a query of ours in the order of L-Py; `third` stands for the `z` that a query in the plane lacks.
pub(super) fn of_lpy(arguments: &[String], third: &dyn Fn(&str, &str) -> String) -> Vec<String> {
    match arguments {
        [x, y] => vec![third(x, y), x.clone(), y.clone()],
        [x, y, z] => vec![z.clone(), x.clone(), y.clone()],
        _ => arguments.to_vec(),
    }
}
