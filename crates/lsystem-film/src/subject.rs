//! The numbers that a track can change.

use core::fmt;
use lsystem_base::MAX_ITERATIONS;
use lsystem_base::{counted, say};
use lsystem_syntax::{Definition, Expected, FIELDS, FieldSpec, Value};

/// The number that a track changes.
#[derive(Clone, Debug)]
pub enum Subject {
    /// The generation, as a continuous number: 2.25 is a quarter of the way from generation 2 to 3.
    Generation,
    /// The part of the segments that is drawn, 0 to 1: the turtle's way.
    Drawn,
    /// The view of a drawing in the plane: x, y, zoom, and optionally the fine parts of x and y.
    View,
    /// The camera of a drawing in space: azimuth, elevation, zoom, x, y, z, fade. Missing numbers at the end are those
    /// of the film's first camera.
    Camera,
    /// A number of the definition, or a list of numbers.
    Field(&'static FieldSpec),
    /// A named constant of the rules, whose value is a literal number.
    Constant(String),
}

/// The longest name of a constant, in bytes.
const LONGEST_NAME: usize = 100;
/// The name of the field of a sway.
const WIND: &str = "sway";
/// The prefix of constants in scripts.
const CONSTANT: &str = "rules.";
/// The most degrees of an azimuth: 100 turns.
const MAX_AZIMUTH: f64 = 36_000.0;

impl PartialEq for Subject {
    fn eq(&self, other: &Self) -> bool {
        self.name() == other.name()
    }
}

impl fmt::Display for Subject {
    fn fmt(&self, out: &mut fmt::Formatter<'_>) -> fmt::Result {
        out.write_str(&self.name())
    }
}

/// The members of a field of links that is a record: its keys and ranges.
fn record(name: &str) -> &'static [(&'static str, Expected)] {
    match FIELDS.iter().find(|spec| spec.name == name).map(|spec| spec.expected) {
        Some(Expected::Record(members)) => members,
        _ => &[],
    }
}

impl Subject {
    /// The subject with this name in scripts; `None` if there is none.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        match name {
            "n" => return Some(Self::Generation),
            "drawn" => return Some(Self::Drawn),
            "view" => return Some(Self::View),
            "camera" => return Some(Self::Camera),
            _ => {}
        }
        if let Some(constant) = name.strip_prefix(CONSTANT) {
            let is_name = !constant.is_empty()
                && constant.len() <= LONGEST_NAME
                && !constant.contains([';', '=', ',', ':', '~', '/', '\n']);
            return is_name.then(|| Self::Constant(constant.to_owned()));
        }
        FIELDS.iter().find(|spec| spec.link == name && is_numeric(spec)).map(Self::Field)
    }

    /// The strength and the phase of a sway.
    pub(crate) fn wind() -> Self {
        FIELDS.iter().find(|spec| spec.name == WIND).map_or(Self::Drawn, Self::Field)
    }

    /// Whether this is the sway.
    pub(crate) fn is_wind(&self) -> bool {
        matches!(self, Self::Field(spec) if spec.name == WIND)
    }

    /// The names of all subjects but constants, in the order of the page's list.
    pub fn names() -> impl Iterator<Item = &'static str> {
        let fields = FIELDS.iter().filter(|spec| is_numeric(spec)).map(|spec| spec.link);
        ["n", "drawn", "view", "camera"].into_iter().chain(fields)
    }

    /// The name in scripts: the key of links, or `rules.` and the name of a constant.
    #[must_use]
    pub fn name(&self) -> String {
        match self {
            Self::Generation => "n".to_owned(),
            Self::Drawn => "drawn".to_owned(),
            Self::View => "view".to_owned(),
            Self::Camera => "camera".to_owned(),
            Self::Field(spec) => spec.link.to_owned(),
            Self::Constant(name) => format!("{CONSTANT}{name}"),
        }
    }

    /// Whether a key of this subject may have this many numbers.
    pub(crate) fn takes(&self, count: usize) -> bool {
        match self {
            Self::View => count == 3 || count == 5,
            Self::Camera => (1..=7).contains(&count),
            Self::Field(spec) => count == if let Expected::Each(each, _) = spec.expected { each } else { 1 },
            _ => count == 1,
        }
    }

    /// The number of values of a key, in words.
    pub(crate) fn count_words(&self) -> String {
        match self {
            Self::View => say!("3 or 5 numbers: x/y/zoom or x/y/zoom/fx/fy"),
            Self::Camera => say!("1 to 7 numbers: azimuth/elevation/zoom/x/y/z/fade"),
            Self::Field(FieldSpec { expected: Expected::Each(count, _), .. }) => {
                counted!(*count as u64, "{} number", "{} numbers")
            }
            _ => say!("one number"),
        }
    }

    /// The range of the number at this place of a key.
    pub(crate) fn range(&self, at: usize) -> Expected {
        match self {
            Self::Generation => Expected::Between(0.0, f64::from(MAX_ITERATIONS)),
            Self::Drawn => Expected::Between(0.0, 1.0),
            Self::View => record("view").get([0, 1, 2, 3, 4][at.min(4)]).map_or(Expected::Number, |member| member.1),
            Self::Camera if at == 0 => Expected::Between(-MAX_AZIMUTH, MAX_AZIMUTH),
            Self::Camera => {
                let name = ["azimuth", "elevation", "zoom", "x", "y", "z", "fade"][at.min(6)];
                record("camera").iter().find(|member| member.0 == name).map_or(Expected::Number, |member| member.1)
            }
            Self::Field(FieldSpec { expected: Expected::Each(_, each), .. }) => **each,
            Self::Field(spec) => spec.expected,
            Self::Constant(_) => Expected::Number,
        }
    }

    /// The range in words.
    pub(crate) fn range_words(&self, at: usize) -> String {
        self.range(at).words()
    }

    /// Whether the numbers of a key are whole, so that numbers between two keys are rounded down.
    pub(crate) fn is_whole(&self) -> bool {
        matches!(self.range(0), Expected::Whole(..))
    }

    /// The numbers in a definition; `None` for other subjects than fields, and for a field that is left out.
    #[must_use]
    pub fn of(&self, definition: &Definition) -> Option<Vec<f64>> {
        let Self::Field(spec) = self else { return None };
        let number = |value: Value| if let Value::Number(number) = value { Some(number) } else { None };
        match spec.get(definition)? {
            Value::List(list) => list.into_iter().map(number).collect(),
            value => Some(vec![number(value)?]),
        }
    }

    /// Sets a field of a definition to numbers in its range.
    pub(crate) fn set(&self, definition: &mut Definition, numbers: &[f64]) {
        let Self::Field(spec) = self else { return };
        let list = || numbers.iter().map(|&number| Value::Number(number)).collect();
        let value = match (spec.expected, numbers) {
            (Expected::Each(..), _) => Value::List(list()),
            (_, [number]) => Value::Number(*number),
            _ => return,
        };
        spec.set(definition, &value);
    }
}

/// Whether a field of a definition holds numbers. The generation is a subject of its own.
fn is_numeric(spec: &FieldSpec) -> bool {
    let is_number = |expected: Expected| {
        matches!(expected, Expected::Number | Expected::Between(..) | Expected::PositiveUpTo(_) | Expected::Whole(..))
    };
    let numbers = match spec.expected {
        Expected::Each(_, each) => is_number(*each),
        expected => is_number(expected),
    };
    numbers && spec.is_defined() && spec.name != "iterations"
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_lead_to_their_subjects() {
        for name in Subject::names().chain(["rules.r", "rules.Länge"]) {
            assert_eq!(Subject::named(name).unwrap().name(), name);
        }
        for name in ["", "rules.", "rules.a;b", "axiom", "palette", "turtle", "iterations", "moon"] {
            assert!(Subject::named(name).is_none(), "{name}");
        }
        assert!(Subject::names().count() > 20);
    }

    #[test]
    fn fields_are_read_and_set() {
        let mut definition = Definition::default();
        for name in Subject::names() {
            let subject = Subject::named(name).unwrap();
            let Some(numbers) = subject.of(&definition) else { continue };
            assert!(subject.takes(numbers.len()), "{name}");
            let more: Vec<f64> = numbers.iter().map(|number| if *number >= 1.0 { 0.0 } else { 1.0 }).collect();
            if (0..more.len()).all(|at| subject.range(at).admits(more[at])) {
                subject.set(&mut definition, &more);
                assert_eq!(subject.of(&definition), Some(more), "{name}");
            }
        }
        assert!(definition.out_of_range().is_empty());
    }
}
