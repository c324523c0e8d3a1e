//! Parameters that are lengths and scale together, and the equality of parameters.
//!
//! A figure with all lengths doubled is the same figure, twice as large. Modules that differ only by a common factor of
//! their lengths can therefore share a block, under three conditions: every drawn length is a parameter, such a
//! parameter is computed from others homogeneously in the first degree, and nothing else depends on these parameters.

use crate::Turtle;
use lsystem_base::MAX_PARAMETERS;
use lsystem_derive::{LetterId, Rule, Rules, Template};
use lsystem_syntax::Action;
use lsystem_syntax::{Code, Op};
use lsystem_syntax::{Function, Operator};

/// The first of `rules` whose condition holds for these arguments; contexts and chance are ignored.
pub(crate) fn applying<'a>(rules: &'a [Rule], arguments: &[f64]) -> Option<&'a Rule> {
    rules.iter().find(|rule| {
        let value = rule.condition.as_ref().map_or(1.0, |condition| condition.value(arguments, &|_| 0.0));
        value != 0.0 && !value.is_nan()
    })
}

/// The parameters that are lengths and scale together.
#[derive(Clone, Debug)]
pub(crate) struct Scales {
    /// By letter and parameter: whether the parameter is such a length. All false if the lengths do not scale together.
    lengths: Vec<[bool; MAX_PARAMETERS]>,
}

impl Scales {
    /// Finds the lengths.
    pub(crate) fn new(rules: &Rules, turtle: &Turtle) -> Self {
        let none = vec![[false; MAX_PARAMETERS]; rules.letters.len()];
        let mut found = Self { lengths: none.clone() };
        let drawn = DrawnRules { rules, turtle };
        found.grow(&drawn);
        if found.hold(&drawn) { found } else { Self { lengths: none } }
    }

    /// Whether a parameter is one of the lengths.
    pub(crate) fn is_length(&self, letter: LetterId, parameter: usize) -> bool {
        self.lengths[usize::from(letter)].get(parameter).is_some_and(|length| *length)
    }

    /// Divides a module's lengths by their scale and returns the scale: the absolute value of the first length that is
    /// normal, or 1 if there is none or if the quotients would not be finite.
    pub(crate) fn take(&self, letter: LetterId, arguments: &mut [f64]) -> f64 {
        let lengths = || (0..arguments.len()).filter(|&at| self.is_length(letter, at));
        let scale = lengths().map(|at| arguments[at].abs()).find(|size| size.is_normal()).unwrap_or(1.0);
        let divided = |at: usize| arguments[at] / scale;
        if scale == 1.0 || lengths().any(|at| !divided(at).is_finite()) {
            return 1.0;
        }
        for (at, argument) in arguments.iter_mut().enumerate() {
            if self.is_length(letter, at) {
                *argument /= scale;
            }
        }
        scale
    }

    /// Marks the lengths that are drawn, and all parameters from which lengths are computed.
    fn grow(&mut self, drawn: &DrawnRules<'_>) {
        for (letter, lengths) in self.lengths.iter_mut().enumerate() {
            lengths[0] = drawn.length(letter);
        }
        loop {
            let mut changed = false;
            for (maker, made, parameter, code) in drawn.codes() {
                if self.is_length(made, parameter) {
                    for slot in slots(code) {
                        let known = &mut self.lengths[usize::from(maker)][usize::from(slot)];
                        changed |= !core::mem::replace(known, true);
                    }
                }
            }
            if !changed {
                return;
            }
        }
    }

    /// Whether the lengths scale together and nothing else depends on them.
    fn hold(&self, drawn: &DrawnRules<'_>) -> bool {
        let DrawnRules { rules, .. } = drawn;
        let degree = |maker: LetterId, code: &Code| degree(code, &|slot| self.is_length(maker, usize::from(slot)));
        let conditions = (0..rules.letters.len()).flat_map(|letter| {
            let rules = rules.by_letter[letter].iter().chain(&rules.images[letter]);
            rules.filter_map(move |rule| Some((letter as LetterId, rule.condition.as_ref()?)))
        });
        (0..rules.letters.len()).all(|letter| drawn.scales(letter, self.lengths[letter][0]))
            && drawn.codes().all(|(maker, made, parameter, code)| {
                let expected = if self.is_length(made, parameter) { Degree::First } else { Degree::Zero };
                matches!(degree(maker, code), Some(Degree::Any)) || degree(maker, code) == Some(expected)
            })
            && conditions
                .into_iter()
                .all(|(maker, code)| matches!(degree(maker, code), Some(Degree::Zero | Degree::Any)))
    }
}

/// Rules with the turtle that draws their letters.
struct DrawnRules<'a> {
    rules: &'a Rules,
    turtle: &'a Turtle,
}

impl<'a> DrawnRules<'a> {
    /// A letter's own actions; none if the letter is always drawn as an image.
    fn actions(&self, letter: usize) -> &'a [Action] {
        let replaced = self.rules.images[letter].iter().any(|image| image.condition.is_none());
        if replaced { &[] } else { &self.turtle.actions[letter] }
    }

    /// Whether a letter's first argument is the length of a draw or move.
    fn length(&self, letter: usize) -> bool {
        let goes = self.actions(letter).first().is_some_and(|action| action.length().is_some());
        goes && self.rules.letters[letter].arity > 0
    }

    /// Whether a letter's own actions scale with the lengths. `length` says whether the first argument is a length.
    fn scales(&self, letter: usize, length: bool) -> bool {
        let (first, rest) = match self.actions(letter) {
            [first, rest @ ..] if self.rules.letters[letter].arity > 0 => (Some(first), rest),
            all => (None, all),
        };
        let fixed = |action: &Action| action.length().is_some_and(|own| own.unwrap_or(self.turtle.step) != 0.0);
        let counts = |action: &Action| {
            let free =
                matches!(action, Action::Push | Action::Pop | Action::TurnRound | Action::RollUpright | Action::Cut);
            !free && action.length().is_none()
        };
        !(rest.iter().any(fixed) || length && first.is_some_and(counts))
    }

    /// Every argument that a production or an image computes: the predecessor, the letter in the successor, the
    /// parameter's index, and the expression.
    fn codes(&self) -> impl Iterator<Item = (LetterId, LetterId, usize, &'a Code)> {
        let rules = self.rules;
        (0..rules.letters.len()).flat_map(move |letter| {
            let all = rules.by_letter[letter].iter().chain(&rules.images[letter]);
            all.flat_map(move |rule| arguments(rules, &rule.successor))
                .map(move |(made, parameter, code)| (letter as LetterId, made, parameter, code))
        })
    }
}

/// The arguments of a successor: letter, parameter's index, and expression.
fn arguments<'a>(rules: &'a Rules, made: &'a Template) -> impl Iterator<Item = (LetterId, usize, &'a Code)> {
    let places = made.letters.iter().flat_map(|&letter| {
        (0..usize::from(rules.letters[usize::from(letter)].arity)).map(move |parameter| (letter, parameter))
    });
    places.zip(&made.arguments).map(|((letter, parameter), code)| (letter, parameter, code))
}

/// The parameters that an expression reads.
fn slots(code: &Code) -> Vec<u16> {
    match code {
        Code::Constant(_) => vec![],
        Code::Slot(slot) | Code::Scaled(slot, _) | Code::Shifted(slot, _) => vec![*slot],
        Code::Postfix(ops) => {
            ops.iter().filter_map(|op| if let Op::Slot(slot) = op { Some(*slot) } else { None }).collect()
        }
    }
}

/// The degree of homogeneity of an expression in the lengths.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Degree {
    /// The number 0, which has every degree.
    Any,
    /// Independent of the lengths.
    Zero,
    /// Proportional to the lengths.
    First,
}

/// The degree of an expression; `None` if the expression depends on lengths in another way.
fn degree(code: &Code, length: &impl Fn(u16) -> bool) -> Option<Degree> {
    let of = |slot: u16| if length(slot) { Degree::First } else { Degree::Zero };
    let number = |value: f64| if value == 0.0 { Degree::Any } else { Degree::Zero };
    let ops = match code {
        Code::Constant(value) => return Some(number(*value)),
        Code::Slot(slot) | Code::Scaled(slot, _) => return Some(of(*slot)),
        Code::Shifted(slot, _) => return (!length(*slot)).then_some(Degree::Zero),
        Code::Postfix(ops) => ops,
    };
    let mut stack: Vec<Degree> = Vec::new();
    for op in ops {
        let degree = match op {
            Op::Number(value) => number(*value),
            Op::Slot(slot) => of(*slot),
            Op::Negative | Op::Call1(Function::Abs) => stack.pop()?,
            Op::Not | Op::Call1(_) => unscaled(stack.pop()?)?,
            Op::Binary(Operator::Multiply) => match (stack.pop()?, stack.pop()?) {
                (Degree::First, Degree::First) => return None,
                (Degree::First, _) | (_, Degree::First) => Degree::First,
                _ => Degree::Zero,
            },
            Op::Binary(Operator::Divide) => {
                let (by, divided) = (stack.pop()?, stack.pop()?);
                unscaled(by)?;
                if divided == Degree::Any { Degree::Zero } else { divided }
            }
            Op::Binary(Operator::Add | Operator::Subtract) | Op::Call2(Function::Min | Function::Max) => {
                match (stack.pop()?, stack.pop()?) {
                    (Degree::Any, other) | (other, Degree::Any) => other,
                    (a, b) if a == b => a,
                    _ => return None,
                }
            }
            Op::Binary(_) | Op::Call2(_) => {
                unscaled(stack.pop()?)?;
                unscaled(stack.pop()?)?
            }
            // A shape is as large as it is, so the point must not depend on lengths.
            Op::Distance(_) => {
                unscaled(stack.pop()?)?;
                unscaled(stack.pop()?)?;
                unscaled(stack.pop()?)?
            }
            Op::Curve(_) => unscaled(stack.pop()?)?,
            Op::Random(_) | Op::NormalRandom(_) => return None,
        };
        stack.push(degree);
    }
    stack.pop()
}

/// Degree zero for an operand that must not depend on lengths; `None` if it does.
fn unscaled(degree: Degree) -> Option<Degree> {
    (degree != Degree::First).then_some(Degree::Zero)
}

/// The rule by which parameters count as equal.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Keys {
    /// Whether parameters other than lengths must be equal to the last bit: because conditions test parameters, or
    /// because small differences may become large.
    exact: bool,
}

/// The number of low bits that rounding drops from a number. The rest distinguishes numbers to 2^-40 of their size: far
/// more than the error of factors multiplied in another order.
const ROUNDED: u32 = 12;

impl Keys {
    /// The rule for a system.
    pub(crate) fn new(rules: &Rules) -> Self {
        let all = || rules.by_letter.iter().chain(&rules.images).flatten();
        let products = |rule: &Rule| rule.condition.is_none() && rule.successor.arguments.iter().all(is_product);
        Self { exact: !all().all(products) }
    }

    /// The keys of a module's arguments.
    pub(crate) fn of(self, letter: LetterId, arguments: &[f64], scales: &Scales) -> [u64; MAX_PARAMETERS] {
        let mut keys = [0; MAX_PARAMETERS];
        for (at, (key, argument)) in keys.iter_mut().zip(arguments).enumerate() {
            let bits = argument.to_bits();
            let round = !self.exact || scales.is_length(letter, at);
            *key = if round { (bits + (1 << (ROUNDED - 1))) >> ROUNDED } else { bits };
        }
        keys
    }
}

/// Whether an expression only multiplies and divides, so that relative errors stay small.
fn is_product(code: &Code) -> bool {
    let multiplies = |op: &Op| {
        matches!(op, Op::Number(_) | Op::Slot(_) | Op::Negative | Op::Call1(Function::Abs | Function::Sqrt))
            || matches!(op, Op::Binary(Operator::Multiply | Operator::Divide))
    };
    match code {
        Code::Constant(_) | Code::Slot(_) | Code::Scaled(..) => true,
        Code::Shifted(..) => false,
        Code::Postfix(ops) => ops.iter().all(multiplies),
    }
}
